// Difference: which tiles of the ground two values of it do not share.
//
// Holds     a tile that is not listed is the same memory in both, so all its entries are equal; a listed one may still
//           hold equal entries. Values of different extent differ everywhere
// Frame     tiles (column, row) as terrain/tiled_grid.h, in the order of rows; `where` in plan metres
// Cost      one comparison of pointers for each tile of the grids that were edited at all
#pragma once

#include <vector>

#include "core/vec.h"
#include "terrain/terrain.h"

namespace bosquet::terrain {

template <class T>
std::vector<IVec2> changed_tiles(const TiledGrid<T>& a, const TiledGrid<T>& b) {
  std::vector<IVec2> changed;
  const bool same_size = a.size() == b.size();
  if (same_size && a.shares_all(b)) return changed;
  const IVec2 tiles = b.tiles();
  for (int y = 0; y < tiles.y; ++y)
    for (int x = 0; x < tiles.x; ++x)
      if (!same_size || !a.shares_tile(b, {x, y})) changed.push_back({x, y});
  return changed;
}

struct Difference {
  std::vector<IVec2> height, exclusion, density, areas, ponds;  ///< tiles of the later value
  bool water_level = false;                                     ///< of the site
  bool area_table = false;                                      ///< names, kinds, levels of areas
  Box2 where;  ///< beyond it the ground, its masks and its ponds are as before; empty when they are

  bool none() const {
    return height.empty() && exclusion.empty() && density.empty() && areas.empty() && ponds.empty() && !water_level &&
           !area_table;
  }
  std::size_t tiles() const { return height.size() + exclusion.size() + density.size() + areas.size() + ponds.size(); }
};

Difference difference(const Terrain& before, const Terrain& after);

/// Plan rectangles beyond which heights and slopes are as before; at an edge of the site they go on without end, since what
/// lies off the site is read at its nearest edge. Values of different extent have no such rectangles.
std::vector<Box2> reshaped(const Heightfield& before, const Heightfield& after);

}  // namespace bosquet::terrain
