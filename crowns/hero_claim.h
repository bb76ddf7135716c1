// Hero claims: trees that are already grown take, after the division, the voxels that their wood passes through.
//
// Source    Longay 2014, 6.5.1: a voxel that a segment of a hero tree passes through belongs to the hero tree
// Model     a segment holds the voxels that its axis runs through and those whose centres lie within its radius
// Decision  a hero takes no voxel of an obstacle, and of two heroes the one with the higher id (nearer to 0) keeps it
// Frame     world; voxels of the lattice of crown_space.h
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/segment.h"
#include "core/vec.h"
#include "crowns/obstacle.h"

namespace bosquet::crowns {

/// `id` is below 0 and unique among obstacles and hero trees.
struct HeroClaim {
  std::int32_t id = -1;
  std::string name;
  std::shared_ptr<const std::vector<Segment>> segments;

  bool operator==(const HeroClaim&) const = default;
};

/// Voxels that segments pass through, (i, k, j) sorted by (j, i, k), each once.
std::vector<IVec3> voxels_of(const std::vector<Segment>& segments, VoxelSize size);

}  // namespace bosquet::crowns
