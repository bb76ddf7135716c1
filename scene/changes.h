// Changes: what one document has that another has not, for whoever keeps something that follows from it.
//
// Model     parts that both share are equal and cost nothing; only what is not shared is compared. Trees are told apart
//           by their ids, and an id that both have is a changed tree when any of its numbers differ
// Holds     what is not named is equal in both
// Cost      follows the blocks and tiles that are not shared
#pragma once

#include <cstdint>
#include <vector>

#include "scene/document.h"
#include "terrain/difference.h"

namespace bosquet::scene {

struct Changes {
  bool site = false;  ///< seed or georeference
  terrain::Difference ground;
  std::vector<std::int32_t> added, removed, changed;  ///< trees, by rising id
  std::vector<std::size_t> species;                   ///< of the later document, those that are new or not the same
  bool fewer_species = false;
  bool interactions = false, species_bar = false;
  bool obstacles = false, heroes = false;
  bool space = false, asymmetry = false, light = false;  ///< settings of the crown space and what follows
  bool cameras = false, figures = false, sun = false, max_triangles = false;
  bool clearance = false, ground_cover = false, plan = false;  ///< plan: the sheet's settings or its underlay
  bool counters = false;

  bool trees() const { return !added.empty() || !removed.empty() || !changed.empty(); }
  /// Whether anything but the counters is another.
  bool any() const {
    return site || !ground.none() || trees() || !species.empty() || fewer_species || interactions || species_bar ||
           obstacles || heroes || space || asymmetry || light || cameras || figures || sun || max_triangles ||
           clearance || ground_cover || plan;
  }
};

Changes changes(const Document& before, const Document& after);

}  // namespace bosquet::scene
