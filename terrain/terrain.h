// Terrain: the ground of a site as a value: height, water level, exclusion areas and planting density.
//
// Frame     plan (east, north) metres, (0, 0) at the site's south-west corner; heights in metres, up
// Errors    none; positions outside the site are read at the nearest edge
// Cost      copying shares all tiles; an edit copies the tiles that it touches
#pragma once

#include <optional>
#include <utility>

#include "core/vec.h"
#include "terrain/heightfield.h"
#include "terrain/mask.h"

namespace bosquet::terrain {

struct Terrain {
  Heightfield height;
  std::optional<float> water_level_m;  ///< where the ground is lower there is water
  Mask exclusion;                      ///< 1 where nothing is planted (paths, lawns, buildings)
  Mask density;                        ///< planting density 0..1; 1 everywhere at first

  Vec2 size_m() const { return height.size_m(); }
  float ground(Vec2 plan) const { return height.at(plan); }
  bool under_water(Vec2 plan) const { return water_level_m && ground(plan) < *water_level_m; }
  bool excluded(Vec2 plan) const { return exclusion.at(plan) >= 0.5f; }
};

/// Ground without water and exclusions, with full planting density everywhere.
inline Terrain make_terrain(Heightfield height) {
  const Lattice lattice = height.lattice();
  return {std::move(height), std::nullopt, Mask(lattice, 0.0f), Mask(lattice, 1.0f)};
}

/// Whether a plan position lies on the site.
inline bool on_site(const Terrain& terrain, Vec2 plan) {
  const Vec2 size = terrain.size_m();
  return plan.x >= 0.0f && plan.y >= 0.0f && plan.x <= size.x && plan.y <= size.y;
}

}  // namespace bosquet::terrain
