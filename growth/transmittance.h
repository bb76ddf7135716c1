// Transmittance: the share of sky light that other trees' crowns let through, as growth reads it.
//
// Frame     tree frame: origin at the tree's base, x east, y up, z south, metres
// Layout    cell (i, j, k) spans low + cell_m * (i, j, k) to the next; level[(j * cells.z + k) * cells.x + i]
// Units     level 0..15, transmittance (level + 1) / 16, so full light is level 15 and no bud stands in the dark
// Decision  sixteen levels and nothing finer, so that a change too small to matter changes no tree; outside the grid
//           there is full light
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::growth {

struct Transmittance {
  Vec3 low{0.0f};
  float cell_m = 1.0f;
  IVec3 cells{0};
  std::vector<std::uint8_t> level;

  float at(const Vec3& p) const {
    const Vec3 q = (p - low) / cell_m;
    if (!(q.x >= 0.0f && q.y >= 0.0f && q.z >= 0.0f)) return 1.0f;
    const IVec3 c{static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z)};
    if (c.x >= cells.x || c.y >= cells.y || c.z >= cells.z) return 1.0f;
    return static_cast<float>(level[index(c)] + 1) * 0.0625f;
  }
  std::size_t index(IVec3 c) const {
    return (static_cast<std::size_t>(c.y) * static_cast<std::size_t>(cells.z) + static_cast<std::size_t>(c.z)) *
               static_cast<std::size_t>(cells.x) +
           static_cast<std::size_t>(c.x);
  }
};

}  // namespace bosquet::growth
