#include "exchange/substitutes.h"

#include "scene/species_names.h"

namespace bosquet::exchange {

const std::string& Substitutes::stands_for(const scene::Tree& tree) {
  static const std::string none;
  if (tree.inventory_name.empty()) return none;
  const auto [same, fresh] = same_.try_emplace({tree.inventory_name, tree.species}, false);
  if (fresh) {
    const auto match = scene::match_species(tree.inventory_name, document_->species.all(), tree.species);
    same->second = match.how == scene::NameMatch::exact && match.species == tree.species;
  }
  return same->second ? none : tree.inventory_name;
}

}  // namespace bosquet::exchange
