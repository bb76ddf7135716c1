// Region runs: what a tree owns of a crown space, as runs of voxels along rows.
//
// Frame     the lattice of crown_space.h: columns (i east, j north), layers k
// Cost      the boxes around the tree's layers, each voxel looked at once
#pragma once

#include <cstdint>

#include "crowns/crown_space.h"

namespace bosquet::crowns {

/// Calls visit_run(share, j, first, last) for each run of voxels (first..last, j) that the claimant owns, layer by layer
/// from the lowest up; runs end at tile borders.
template <class VisitRun>
void for_each_run(const CrownSpace& space, std::size_t claimant, const VisitRun& visit_run) {
  const std::int32_t me = space.slot_of(claimant);
  for (const LayerShare& share : space.shares(claimant))
    for (std::int32_t north = share.low.y >> 6; north <= share.high.y >> 6; ++north)
      for (std::int32_t east = share.low.x >> 6; east <= share.high.x >> 6; ++east) {
        const SpaceTile* tile = space.find_tile({east, north});
        if (!tile || !tile->has(share.layer)) continue;
        const IVec2 corner{east * kTileEdge, north * kTileEdge};
        const IVec2 from = glm::max(share.low, corner), to = glm::min(share.high, corner + (kTileEdge - 1));
        const std::int32_t* owner = tile->owner.data() + tile->offset(share.layer);
        for (std::int32_t j = from.y; j <= to.y; ++j) {
          const std::int32_t* row = owner + (j - corner.y) * kTileEdge;
          for (std::int32_t i = from.x; i <= to.x;) {
            if (row[i - corner.x] != me) {
              ++i;
              continue;
            }
            const std::int32_t first = i;
            while (i <= to.x && row[i - corner.x] == me) ++i;
            visit_run(share, j, first, i - 1);
          }
        }
      }
}

}  // namespace bosquet::crowns
