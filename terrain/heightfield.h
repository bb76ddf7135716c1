// Heightfield: the height of the ground over a rectangular site.
//
// Frame     plan (east, north) metres; heights in metres, up. Sample (i, j) stands on the cell corner
//           (i, j) * cell_m, so n cells have n + 1 samples a side; row j = 0 is the southern edge
// Model     height is bilinear between the four samples of a cell; the normal comes from central differences at the
//           samples, interpolated likewise, so it is continuous (and exact on a plane)
// Errors    only of from_samples; positions outside the site are read at its nearest edge
// Cost      reading: four samples; copying shares all tiles
#pragma once

#include <functional>
#include <span>

#include "core/result.h"
#include "core/vec.h"
#include "terrain/lattice.h"
#include "terrain/tiled_grid.h"

namespace bosquet::terrain {

struct HeightRange {
  float low = 0, high = 0;
};

class Heightfield {
 public:
  Heightfield() : Heightfield(Lattice{}) {}
  explicit Heightfield(const Lattice& lattice, float height_m = 0.0f);
  Heightfield(const Lattice& lattice, const std::function<float(Vec2)>& height_at);

  /// `samples` holds (cells.x + 1) * (cells.y + 1) heights, the southern row first, each row from west to east. Another
  /// number of samples or one that is not finite is an error.
  static Result<Heightfield> from_samples(const Lattice& lattice, std::span<const float> samples);

  float at(Vec2 plan) const;
  Vec3 normal(Vec2 plan) const;    ///< world axes (x east, y up, z south), unit length
  Vec2 gradient(Vec2 plan) const;  ///< rise per metre to the east and to the north
  float sample(int i, int j) const { return grid_.at(i, j); }

  Vec2 size_m() const { return lattice_.size_m; }
  float cell_m() const { return lattice_.cell_m; }
  IVec2 cells() const { return lattice_.cells; }
  const Lattice& lattice() const { return lattice_; }
  HeightRange range() const;  ///< over all samples

  const TiledGrid<float>& grid() const { return grid_; }
  TiledGrid<float>& grid() { return grid_; }  ///< to be edited through a TileEditor

 private:
  Lattice lattice_;
  TiledGrid<float> grid_;
};

}  // namespace bosquet::terrain
