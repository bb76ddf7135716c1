#include "terrain/difference.h"

namespace bosquet::terrain {

Difference difference(const Terrain& before, const Terrain& after) {
  Difference d;
  d.height = changed_tiles(before.height.grid(), after.height.grid());
  d.exclusion = changed_tiles(before.exclusion.grid(), after.exclusion.grid());
  d.density = changed_tiles(before.density.grid(), after.density.grid());
  d.areas = changed_tiles(before.areas.grid(), after.areas.grid());
  d.ponds = changed_tiles(before.ponds, after.ponds);
  d.water_level = before.water_level_m != after.water_level_m;
  d.area_table = before.areas.all() != after.areas.all();

  // A tile's entries are asked for between them, slopes across two cells.
  const float cell = after.height.cell_m();
  constexpr float kTile = TiledGrid<float>::kTile;
  const auto add = [&](const std::vector<IVec2>& tiles) {
    for (IVec2 t : tiles) {
      d.where.add((Vec2(t) * kTile - 2.0f) * cell);
      d.where.add((Vec2(t + 1) * kTile + 2.0f) * cell);
    }
  };
  add(d.height), add(d.exclusion), add(d.density);
  if (!after.areas.empty()) add(d.areas);
  if (after.has_ponds()) add(d.ponds);
  const bool all = d.water_level || d.area_table || before.height.lattice() != after.height.lattice() ||
                   before.has_ponds() != after.has_ponds() || before.areas.empty() != after.areas.empty();
  if (all) d.where = {Vec2(0.0f), after.size_m()};
  if (!d.where.empty()) {
    d.where.low = glm::max(d.where.low, Vec2(0.0f));
    d.where.high = glm::min(d.where.high, after.size_m());
  }
  return d;
}

std::vector<Box2> reshaped(const Heightfield& before, const Heightfield& after) {
  constexpr int kTile = TiledGrid<float>::kTile;
  constexpr float kEndless_m = 1e9f;
  const float cell = after.cell_m();
  const IVec2 last = after.grid().tiles() - 1;
  std::vector<Box2> out;
  for (IVec2 t : changed_tiles(before.grid(), after.grid())) {
    Box2 box{(Vec2(t * kTile) - 2.0f) * cell, (Vec2((t + 1) * kTile) + 2.0f) * cell};
    for (int axis = 0; axis < 2; ++axis) {
      if (t[axis] == 0) box.low[axis] = -kEndless_m;
      if (t[axis] == last[axis]) box.high[axis] = kEndless_m;
    }
    out.push_back(box);
  }
  return out;
}

}  // namespace bosquet::terrain
