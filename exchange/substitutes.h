// Substitutes: trees that are drawn as another kind than their inventory names.
//
// Model     the inventory's name stays with a tree; when it does not mean just the tree's species (another of its genus, a
//           cultivar, a name that nobody knows, a species chosen since), plans and schedules must name it
// Cost      each name is looked up once
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>

#include "scene/document.h"

namespace bosquet::exchange {

class Substitutes {
 public:
  /// The document must outlive this.
  explicit Substitutes(const scene::Document& document) : document_(&document) {}

  /// The inventory's name when the tree stands for another kind than it is drawn as; else empty.
  const std::string& stands_for(const scene::Tree& tree);

 private:
  const scene::Document* document_;
  std::map<std::pair<std::string, std::size_t>, bool> same_;  ///< by name and species
};

}  // namespace bosquet::exchange
