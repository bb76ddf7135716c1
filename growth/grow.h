// Grow: one tree from seed to its final height.
//
// Source    Longay 2014, chapter 4 and 6.6, after Runions et al. 2007 (space) and Palubicki et al. 2009 (light, vigor)
// Model     a season: light of each bud (shadow.h), space by markers (markers.h), signal down and vigor up (vigor.cpp), fate
//           n = floor(v / v_max * n_max), deflection, extension metamer by metamer (shoots.cpp), shedding; seasons repeat
//           until an internode passes h_max, nothing grew for three seasons, or max_seasons
// Frame     tree frame: origin at the tree's base, x east, y up, z south; metres
// Decision  a metamer's lateral buds stand at its base; the first metamer of an axis carries none (its base is the
//           parent's node)
// Decision  h_max / l is kept >= 40: a small tree has smaller internodes, and with them r, d, shadow cells and twigs
// Decision  with painted markers the tree grows only into them: they stay until wood comes near, buds wait for them as
//           long as it takes, and growth ends when none can be claimed any more (painted.cpp)
// Decision  detail is the resolution of the result, not a step of the model: a tree is the same at any (detail.h)
// Holds     the skeleton is a pure function of the input: the same bits on any thread, in any order, in any build
// Cost      about 1.3 microseconds for each internode that lives at the end (docs/performance.md); work arrays are kept from tree to tree
#pragma once

#include <cstdint>
#include <span>

#include "core/progress.h"
#include "core/vec.h"
#include "crowns/crown_region.h"
#include "growth/parameters.h"
#include "growth/skeleton.h"
#include "growth/transmittance.h"

namespace bosquet::growth {

struct GrowthInput {
  const Parameters* parameters = nullptr;       ///< passed check()
  float max_height_m = 20.0f;                   ///< h_max, height at which this tree stops
  const crowns::CrownRegion* region = nullptr;  ///< where markers may stand; null: anywhere above y = 0
  Vec3 asymmetry{0.0f};                         ///< V, horizontal
  const Transmittance* light = nullptr;         ///< of the other trees' canopy; null: full light
  float clear_stem_m = 0.0f;                    ///< below it no branch grows
  std::span<const Vec3> markers;                ///< painted; empty: the tree's buds drop their own
  float detail = 1.0f;                          ///< 0.25 - 4
  std::uint64_t seed = 0;                       ///< of the document
  std::uint64_t key = 0;                        ///< of the tree
};

/// How much work a tree was: to tell a faster program from one that does less.
struct GrowthWork {
  std::uint64_t markers_tested = 0;
  std::uint64_t bud_visits = 0;
  std::uint64_t shadow_updates = 0;  ///< internodes that cast, took back or moved their shadow
  std::uint64_t shadow_cells = 0;    ///< cells whose shadow was brought up to date for them
};

/// Grows one tree. Callers run it for many trees in parallel. Asks progress (may be null) once a season; after a cancel
/// the skeleton is incomplete, to be dropped.
Skeleton grow(const GrowthInput& input, const Progress* progress = nullptr, GrowthWork* work = nullptr);

/// Gives back the arrays that are kept for further trees, some 20 MB for each thread that grew any.
void release_work_memory();

/// Hash of everything that grow() depends on: equal hashes, equal skeletons. For caches.
std::uint64_t hash(const GrowthInput& input);

}  // namespace bosquet::growth
