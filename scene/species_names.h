// Species names: which species a name in somebody's inventory means.
//
// Decision  every tree gets a species: its exact name (botanical, common or ours, in any case and punctuation), else a
//           species whose genus words the name contains, else a conifer when the name says so, else the default. The
//           original name stays with the tree.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "scene/species.h"

namespace bosquet::scene {

enum class NameMatch { exact, genus, leaf_type, fallback };

struct SpeciesMatch {
  std::size_t species = 0;  ///< index into `known`
  NameMatch how = NameMatch::fallback;
};

/// `fallback` is an index into `known`, which must not be empty.
SpeciesMatch match_species(std::string_view name, std::span<const std::shared_ptr<const Species>> known,
                           std::size_t fallback);

}  // namespace bosquet::scene
