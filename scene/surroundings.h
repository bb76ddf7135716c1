// Surroundings: what the trees of a document are to each other: crown regions, asymmetry and canopy light.
//
// Model     made of a document at once, or from those of a document before it with only what the edit can have changed
//           computed anew (crowns/update_space.h)
// Holds     both ways give the same bits, after any number of edits
// Cost      an update follows the edited trees, the ground that was reshaped and the trees beside it. Other heights of most
//           of the ground, other options of the crown space and a wider lattice divide all of the space anew
// Errors    a crown space too large for memory; obstacles that cannot be voxelised; cancelled work (kind cannot_finish)
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "crowns/canopy_light.h"
#include "crowns/crown_space.h"
#include "scene/document.h"
#include "scene/standing.h"
#include "scene/tree_growth.h"

namespace bosquet::scene {

/// Which of the stages of the source's comparisons are done.
struct SpaceStages {
  bool regions = true;    ///< trees keep to their crown regions
  bool asymmetry = true;  ///< trees lean away from their neighbours
  bool light = true;      ///< neighbours' crowns shade (where regions are on and the document has it on)

  bool operator==(const SpaceStages&) const = default;
};

struct Surroundings {
  SpaceStages stages;
  crowns::CrownSpace space;
  std::vector<Vec3> asymmetry;  ///< of each tree
  crowns::CanopyLight light;    ///< empty when canopy light is off

  /// Those of tree `i` of the document.
  TreeSurroundings of(std::size_t i) const;
};

/// Seconds spent in each stage, by name.
using Seconds = std::map<std::string, double>;

/// The trees as crowns/ sees them, in the document's order.
std::vector<crowns::Claimant> claimants(const Document& document);

/// Adds "crowns" and "light" to `seconds` (may be null), and says in `warnings` what stands where it cannot.
Result<Surroundings> surround(const Document& document, const SpaceStages& stages, StandingKeeper& standing,
                              std::vector<std::string>& warnings, Seconds* seconds, Progress* progress);

struct SurroundingsUpdate {
  Surroundings now;
  std::vector<std::size_t> touched;  ///< trees of the later document, rising, whose surroundings may be others now
};

/// The same for a document after `before`, whose surroundings are `around`.
Result<SurroundingsUpdate> update_surroundings(const Surroundings& around, const Document& before,
                                               const Document& document, StandingKeeper& standing,
                                               std::vector<std::string>& warnings, Progress* progress);

}  // namespace bosquet::scene
