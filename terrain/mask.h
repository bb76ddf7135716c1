// Mask: a share between 0 and 1 at every place of a site, such as how far a cell is covered by a path.
//
// Frame     plan (east, north) metres; value (i, j) belongs to the middle of cell (i, j), bilinear between
// Storage   8 bits a value, so 0, 1 and multiples of 1/255 are exact
// Decision  an area's edge is stored as a ramp about a cell wide (the share of a cell that lies inside), so that the
//           contour at 0.5 of the bilinear value follows a straight edge much closer than a cell
// Errors    none; positions outside are read at the nearest edge
#pragma once

#include <cstdint>

#include "core/vec.h"
#include "terrain/lattice.h"
#include "terrain/tiled_grid.h"

namespace bosquet::terrain {

class Mask {
 public:
  Mask() : Mask(Lattice{}) {}
  explicit Mask(const Lattice& lattice, float everywhere = 0.0f);

  float at(Vec2 plan) const;
  float cell(int i, int j) const { return static_cast<float>(grid_.at(i, j)) * (1.0f / 255.0f); }

  const Lattice& lattice() const { return lattice_; }
  const TiledGrid<std::uint8_t>& grid() const { return grid_; }
  TiledGrid<std::uint8_t>& grid() { return grid_; }  ///< to be edited through a TileEditor

  /// The stored value nearest to `share`.
  static std::uint8_t stored(float share);

 private:
  Lattice lattice_;
  TiledGrid<std::uint8_t> grid_;
};

}  // namespace bosquet::terrain
