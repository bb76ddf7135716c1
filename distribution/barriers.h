// Barriers: what stands on a site and leaves no room for planting: buildings by outline, meshes by their silhouette.
//
// Model     a place is barred inside an outline, and in every cell of a grid of its own that the plan projection of a
//           triangle touches: under a roof or a bridge nothing is sown, nor in the wall that a closed house stands on
// Units     metres in plan (east, north); the grid's cells are max(0.25 m, longest side / 4096)
// Cost      asking: the outlines whose bounds are near, and one bit; memory: the grid, 2 MB at most, once there is a mesh
#pragma once

#include <array>
#include <vector>

#include "distribution/region.h"

namespace bosquet::distribution {

class Barriers {
 public:
  Barriers() = default;  ///< nothing barred
  explicit Barriers(Vec2 size_m);

  void add(Region outline);
  /// Parts off the site are overlooked.
  void add_triangle(const std::array<Vec2, 3>& corners);

  bool empty() const { return outlines_.empty() && !any_cell_; }
  /// Whether a trunk of this radius would touch what stands there.
  bool holds(Vec2 at, float radius_m = 0.0f) const;

 private:
  struct Outline {
    Box2 bounds;
    Region region;
  };
  bool cell_touched(Vec2 at, float radius_m) const;

  std::vector<Outline> outlines_;
  float cell_m_ = 1.0f;
  IVec2 cells_{0};
  std::vector<bool> touched_;  // row by row from the south; empty before the first triangle
  bool any_cell_ = false;
};

}  // namespace bosquet::distribution
