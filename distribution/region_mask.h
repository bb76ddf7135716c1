// Region mask: a region as a quadtree over the cells of a probability field.
//
// Model     a cell belongs to the region when its centre does. A node whose cells all belong is full, one without such
//           cells empty; only partial nodes, those on the rim, have children
// Layout    node (level, x, y) covers 2^level cells a side; a parent stands before its four children, which stand
//           together in the order (0,0) (1,0) (0,1) (1,1)
// Cost      nodes: the rim's cells, about; building a polygon's also visits all cells once
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distribution/region.h"

namespace bosquet::distribution {

class RegionMask {
 public:
  enum class Cover : std::uint8_t { empty, full, partial };
  struct Node {
    std::uint16_t x = 0, y = 0;
    std::uint8_t level = 0;
    Cover cover = Cover::empty;
    std::uint32_t first_child = 0;  ///< of four, when partial
  };

  /// `cells` a side and their size as in the field; `top` the level whose only node is the root.
  RegionMask(const Region& region, IVec2 cells, float cell_m, int top);

  std::span<const Node> nodes() const { return nodes_; }

 private:
  std::vector<Node> nodes_;
};

}  // namespace bosquet::distribution
