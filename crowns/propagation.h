// Propagation: the fronts of all trees of one layer, each voxel to the first that reaches it.
//
// Source    Longay 2014, 6.5.1, after Grote and Pretzsch 2002 and Schaudt and Drysdale 1991. The source moves polygon
//           points; here the same first arrival is the solution of |grad t| = slowness on each tree's own voxels
// Model     t of a voxel centre = t0 + delay, t0 = slowness * max(0, |p - base| - trunk radius) the time of the
//           straight way from the trunk. With a settled neighbour n and a settled cell d beside n (diagonal to the
//           voxel), both of the same tree, the delay solves
//             (t0_a + delay - delay_n)^2 + (t0_b + delay_n - delay_d)^2 = slowness^2
//           a along the step from n, b from d to n, t0's slopes exact (additive factored eikonal equation, Luo and Qian
//           2012, Treister and Haber 2016, on the eight triangles around a voxel). So the delay is 0 and t exact where
//           the straight way is free, and first order behind corners. A way more oblique than the diagonal takes
//           t_d + sqrt(2) slowness; n alone t_n + slowness, or n's delay if in one row or column with the base; within
//           the trunk's radius t_n + 1. The least counts.
// Decision  where only one of the cells beside the ray is the tree's, at a border, the ray itself is walked: it is free
//           when in each row one of the two cells that it passes between is the tree's. So equal trees divide a layer
//           exactly as Voronoi, also far along the border of two close neighbours
// Decision  the division is defined as a solution, not as a run. t is a whole number of ticks, rounded once, computed
//           from the ticks of neighbours of the same tree, and at least 1 more than each that it uses; a voxel takes
//           the lexicographically smallest (t, key). As each value rests on strictly smaller ones there is one
//           solution, which no order of work can change. Ticks have a fixed length, so a tree far away cannot change
//           them either.
// Units     columns (voxel edges) and ticks: a front of 1 m2 of crown takes 2^40 ticks for a metre
// Cost      each cell is settled once and offered once by each neighbour that was settled before it
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vec.h"

namespace bosquet::crowns {

/// A tree in one layer.
struct Front {
  double east = 0, north = 0;  ///< base, columns from the lattice's origin
  double trunk = 0;            ///< radius, columns
  double slowness = 1;         ///< ticks a column
  double reach_squared = 0;    ///< columns squared, from the base to a voxel's centre
  std::uint32_t root = 0;      ///< cell where it starts; no other front takes it
  std::int32_t rank = 0;       ///< place of its key among all keys; settles ties
  std::int32_t owner = 0;      ///< what its cells are to hold
};

/// Ticks a column of a tree's front.
double front_slowness(float projected_area_m2, float speed_exponent, float voxel_m);

/// One layer of voxels as blocks of 64 x 64 cells: cell = block * 4096 + j * 64 + i.
struct LayerCells {
  static constexpr std::int32_t kNoBlock = -1;
  struct Block {
    IVec2 low{0};                           ///< column (east, north) of its first cell
    std::int32_t west, east, south, north;  ///< blocks beside it or kNoBlock
  };
  std::vector<Block> blocks;
  std::vector<std::uint8_t> open;  ///< for each cell: may be claimed
};

struct LayerResult {
  static constexpr std::int32_t kUnclaimed = -1;
  std::vector<std::int32_t> front;   ///< for each cell: index of the front that claimed it or kUnclaimed
  std::vector<std::uint64_t> ticks;  ///< for each cell: when; 0 where unclaimed
};

LayerResult propagate(std::span<const Front> fronts, const LayerCells& cells);

}  // namespace bosquet::crowns
