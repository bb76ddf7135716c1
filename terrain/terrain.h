// Terrain: the ground of a site as a value: height, water, areas barred from planting, and planting density.
//
// Frame     plan (east, north) metres, (0, 0) at the site's south-west corner; heights in metres, up
// Model     water stands where the ground is lower than the site's level, and in ponds where it is lower than their own
// Decision  a pond is an area with a level of its own beside the site's: ground with a slope, or two ponds, cannot share
//           one level. Its level holds in the cells of its outline alone (terrain/pond.h)
// Errors    none; positions outside the site are read at the nearest edge
// Cost      copying shares all tiles; an edit copies the tiles that it touches
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "core/vec.h"
#include "terrain/area.h"
#include "terrain/heightfield.h"
#include "terrain/mask.h"

namespace bosquet::terrain {

struct Terrain {
  Heightfield height;
  std::optional<float> water_level_m;  ///< of the whole site
  Mask exclusion;                      ///< 1 where nothing is planted (paths, lawns, buildings)
  Mask density;                        ///< planting density 0..1; 1 everywhere at first
  AreaLayer areas;                     ///< which area an exclusion belongs to
  TiledGrid<AreaId> ponds;             ///< which area's water level holds in a cell; 0 none. A cell of its own at first

  Vec2 size_m() const { return height.size_m(); }
  float ground(Vec2 plan) const { return height.at(plan); }
  bool excluded(Vec2 plan) const { return exclusion.at(plan) >= 0.5f; }

  /// Whether water may stand anywhere, as far as levels go.
  bool has_water() const { return water_level_m || has_ponds(); }
  bool has_ponds() const { return ponds.size() != IVec2{1}; }
  /// The higher of the site's level and that of a pond there; nothing where there is neither.
  std::optional<float> water_level(Vec2 plan) const;
  bool under_water(Vec2 plan) const {
    if (!has_ponds()) return water_level_m && ground(plan) < *water_level_m;
    const std::optional<float> level = water_level(plan);
    return level && ground(plan) < *level;
  }

  /// The area that a place belongs to, of those around it the one with the largest share there; nothing where planting
  /// is not barred. The area may be the one without a name.
  const Area* area_at(Vec2 plan) const;
  /// How far each cover covers the ground there, bilinear between the cells' middles as the exclusion.
  CoverShares covers(Vec2 plan) const;
};

/// Ground without water and exclusions, with full planting density everywhere.
inline Terrain make_terrain(Heightfield height) {
  const Lattice lattice = height.lattice();
  return {std::move(height), std::nullopt, Mask(lattice, 0.0f), Mask(lattice, 1.0f), {}, {}};
}

/// Whether a plan position lies on the site.
inline bool on_site(const Terrain& terrain, Vec2 plan) {
  const Vec2 size = terrain.size_m();
  return plan.x >= 0.0f && plan.y >= 0.0f && plan.x <= size.x && plan.y <= size.y;
}

/// A new value of the ground, and the rectangle beyond which all that one can ask of it is as before. Empty: nothing
/// was touched.
struct Edit {
  Terrain terrain;
  Box2 touched;
};

}  // namespace bosquet::terrain
