// Crown region: the room that one tree won, as a dense bit grid that answers "may a marker stand here?".
//
// Frame     tree frame: origin at the tree's base, x east, y up, z south, metres
// Layout    voxel (i, j, k) spans low + (i * voxel_m, j * layer_m, k * voxel_m) to the next one; its bit is number
//           (j * cells.z + k) * cells.x + i, bit b of word b / 64 is 1 << (b % 64)
// Holds     nothing outside the grid belongs to the region
// Who       crown_space.h makes it, growth reads it
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::crowns {

struct CrownRegion {
  Vec3 low{0.0f};
  float voxel_m = 1.0f;  ///< horizontal edge
  float layer_m = 1.0f;  ///< vertical edge
  IVec3 cells{0};
  std::vector<std::uint64_t> bits;

  bool contains(const Vec3& p) const {
    const float x = (p.x - low.x) / voxel_m, y = (p.y - low.y) / layer_m, z = (p.z - low.z) / voxel_m;
    if (!(x >= 0.0f && y >= 0.0f && z >= 0.0f)) return false;
    const IVec3 c{static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
    return c.x < cells.x && c.y < cells.y && c.z < cells.z && voxel(c);
  }
  bool voxel(IVec3 c) const {
    const std::size_t b = index(c);
    return (bits[b >> 6] >> (b & 63)) & 1u;
  }
  void claim(IVec3 c) {
    const std::size_t b = index(c);
    bits[b >> 6] |= std::uint64_t{1} << (b & 63);
  }
  std::size_t index(IVec3 c) const {
    return (static_cast<std::size_t>(c.y) * static_cast<std::size_t>(cells.z) + static_cast<std::size_t>(c.z)) *
               static_cast<std::size_t>(cells.x) +
           static_cast<std::size_t>(c.x);
  }
};

}  // namespace bosquet::crowns
