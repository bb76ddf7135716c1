// The source's polygon method for one layer, kept as the reference that the fronts are compared with.
//
// Source    Longay 2014, 6.5.1 and figure 6.14: each point of a tree's outline moves perpendicular to the line between
//           its two neighbours; it claims a free cell that it comes to lie in and halts in a foreign one; outlines are
//           split where points are farther apart than a threshold
// Decision  steps of half a cell for the fastest tree, split at 0.75 cell, ended when all cells are claimed or nothing
//           was claimed while the fastest tree could cross 20 cells (folded outlines would go on for ever)
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::crowns {

struct PolygonTree {
  DVec2 base{0.0};     ///< cells
  double radius = 0;   ///< of the trunk, cells
  double speed = 1.0;  ///< proportional to the crown area
};

/// Owner of each of side x side cells (row by row from the south), -1 where none came.
std::vector<std::int32_t> polygon_division(const std::vector<PolygonTree>& trees, std::int32_t side);

}  // namespace bosquet::crowns
