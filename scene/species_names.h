// Species names: which species a name in somebody's inventory means.
//
// Decision  every tree gets a species. In this order: the user's synonyms; its exact name (botanical, common or ours, in
//           any case and punctuation, English, German or French; common_names.h); the botanical name of a species inside
//           it, as of a cultivar or with an author behind; a species whose genus it names; a conifer when it says so; the
//           default. The original name stays with the tree
// Decision  a cultivar that has no species of its own is its species; narrow upright ones claim kColumnarWidth of the
//           species' crown width (crown diameters in nurseries' lists are a quarter to a half of the species')
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/species.h"

namespace bosquet::scene {

inline constexpr float kColumnarWidth = 0.35f;

enum class NameMatch {
  exact,      ///< the name itself
  species,    ///< the species of a cultivar or variety, or with something else around its botanical name
  genus,      ///< another species of the genus
  leaf_type,  ///< another conifer
  fallback    ///< the default
};

struct SpeciesMatch {
  std::size_t species = 0;  ///< index into `known`
  NameMatch how = NameMatch::fallback;
  float width = 1.0f;  ///< of the crown, as a share of the species' own
};

/// Names of a user's own, each for a species by its name.
class Synonyms {
 public:
  /// False when the name has no letter, or is there already for another species.
  bool add(std::string_view name, std::string species);
  const std::string* find(std::string_view name) const;
  bool empty() const { return by_name_.empty(); }

 private:
  std::map<std::string, std::string, std::less<>> by_name_;  ///< folded
};

/// `fallback` is an index into `known`, which must not be empty.
SpeciesMatch match_species(std::string_view name, std::span<const std::shared_ptr<const Species>> known,
                           std::size_t fallback, const Synonyms* synonyms = nullptr);

}  // namespace bosquet::scene
