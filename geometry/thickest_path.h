// Thickest paths: the topology that branch meshes follow.
//
// Source    Longay 2014, C.3: at every fork the thickest branch continues the path and the others begin new ones. With
//           the growth topology (one path for each apical meristem) cracks open where a lateral outgrew its parent
// Decision  equal radii: the internode of the same axis continues, then the one born first
// Holds     every standing internode is in exactly one path; a path runs from its base to a tip; a path's parent
//           precedes it
// Cost      two sweeps over the internodes
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "growth/skeleton.h"

namespace bosquet::geometry {

struct ThickestPaths {
  struct Path {
    std::uint32_t first = 0;   ///< place of the lowest internode in `internodes`
    std::uint32_t count = 0;   ///< at least 1
    std::int32_t parent = -1;  ///< path that it springs from, -1 for a stem
    std::uint32_t node = 0;    ///< place in `internodes` of the parent's internode at whose upper end it springs
  };
  std::vector<Path> paths;
  std::vector<std::uint32_t> internodes;  ///< of all paths, each from base to tip
  std::span<const std::uint32_t> of(const Path& p) const { return {internodes.data() + p.first, p.count}; }
};

/// True for each internode that stands at the end of `season` (-1: of the last one) on wood that stands too.
std::vector<std::uint8_t> standing(const growth::Skeleton& skeleton, int season);

ThickestPaths thickest_paths(const growth::Skeleton& skeleton, std::span<const float> radius,
                             std::span<const std::uint8_t> standing);

}  // namespace bosquet::geometry
