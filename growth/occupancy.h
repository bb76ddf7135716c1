// Occupancy: where living wood stands so near that nothing new may grow.
//
// Source    Runions et al. 2007 (kill distance); Longay 2014, 4.2.1: a sphere of radius r around every node
// Decision  every node of living wood occupies, whatever its bud does; shedding frees it
// Layout    cells of a little under r / sqrt(3), so that a cell that holds a node is occupied as a whole and most
//           markers are refused without a distance; node lists by cell; the grid grows when wood leaves it
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::growth {

class Occupancy {
 public:
  void reset(const Box3& room, float radius_m);

  void add(std::int32_t node, const Vec3& p);
  void remove(std::int32_t node);

  /// True when a node stands nearer than r.
  bool occupied(const Vec3& p) const;

 private:
  IVec3 cell(const Vec3& p) const {
    const Vec3 q = (p - low_) * inverse_;
    return {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)), static_cast<int>(std::floor(q.z))};
  }
  bool inside(IVec3 c, int margin) const {
    return c.x >= margin && c.y >= margin && c.z >= margin && c.x < cells_.x - margin && c.y < cells_.y - margin &&
           c.z < cells_.z - margin;
  }
  std::int32_t index(IVec3 c) const { return (c.y * cells_.z + c.z) * cells_.x + c.x; }
  void lay_out(const Box3& room);
  void link(std::int32_t node, std::int32_t cell);

  float radius_m_ = 1.0f, cell_m_ = 1.0f, inverse_ = 1.0f;
  Vec3 low_{0.0f};
  IVec3 cells_{0};
  Box3 room_;
  std::vector<std::int32_t> first_;           ///< by cell
  std::vector<std::int32_t> next_, cell_of_;  ///< by node; cell -1: not here
  std::vector<Vec3> at_;                      ///< by node
  std::vector<std::int32_t> near_;            ///< index offsets of cells that may hold a node within r, nearest first
};

}  // namespace bosquet::growth
