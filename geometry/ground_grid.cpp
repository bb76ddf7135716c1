#include "geometry/ground_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "geometry/ground_covers.h"

namespace bosquet::geometry {
namespace {

int steps(float length, float step) { return std::max(1, static_cast<int>(std::ceil(length / step - 1e-3f))); }

}  // namespace

Vec2 GroundGrid::plan_in(int i, int j, int s, int t, int n) const {
  const Vec2 low = plan(i, j), high = plan(i + 1, j + 1);
  const auto along = [n](float a, float b, int k) {
    return k == n ? b : a + (b - a) * (static_cast<float>(k) / static_cast<float>(n));
  };
  return {along(low.x, high.x, s), along(low.y, high.y, t)};
}

Vec3 GroundGrid::world_in(int i, int j, int s, int t, int n) const {
  const float a = height[index(i, j)], b = height[index(i + 1, j)];
  const float c = height[index(i, j + 1)], d = height[index(i + 1, j + 1)];
  const float u = static_cast<float>(s) / static_cast<float>(n), v = static_cast<float>(t) / static_cast<float>(n);
  const auto along = [](float from, float to, float share) { return share == 1.0f ? to : from + (to - from) * share; };
  float y = 0;
  if (t == 0)
    y = along(a, b, u);
  else if (t == n)
    y = along(c, d, u);
  else if (s == 0)
    y = along(a, c, v);
  else if (s == n)
    y = along(b, d, v);
  else
    y = s + t <= n ? a + (b - a) * u + (c - a) * v : d + (c - d) * (1.0f - u) + (b - d) * (1.0f - v);
  return to_world(plan_in(i, j, s, t, n), y);
}

float GroundGrid::height_at(Vec2 plan) const {
  const Vec2 place = plan / size * Vec2(nx, ny);
  const int i = std::clamp(static_cast<int>(place.x), 0, nx - 1), j = std::clamp(static_cast<int>(place.y), 0, ny - 1);
  const float a = height[index(i, j)], b = height[index(i + 1, j)];
  const float c = height[index(i, j + 1)], d = height[index(i + 1, j + 1)];
  const float u = place.x - static_cast<float>(i), v = place.y - static_cast<float>(j);
  return u + v <= 1.0f ? a + (b - a) * u + (c - a) * v : d + (c - d) * (1.0f - u) + (b - d) * (1.0f - v);
}

GroundGrid make_ground_grid(const terrain::Terrain& terrain, std::size_t max_triangles) {
  assert(max_triangles >= 2);
  GroundGrid grid;
  grid.size = terrain.size_m();
  // Lines between covers take triangles too.
  const std::size_t for_cells = bars_anything(terrain) ? max_triangles / 4 * 3 : max_triangles;
  for (grid.fineness = 1;; ++grid.fineness) {
    const float step = terrain.height.cell_m() * static_cast<float>(grid.fineness);
    grid.nx = steps(grid.size.x, step), grid.ny = steps(grid.size.y, step);
    if (2 * grid.cells() <= for_cells || grid.cells() == 1) break;
  }
  grid.height.resize(static_cast<std::size_t>(grid.nx + 1) * static_cast<std::size_t>(grid.ny + 1));
  parallel_for(
      static_cast<std::size_t>(grid.ny) + 1,
      [&](std::size_t row) {
        const int j = static_cast<int>(row);
        for (int i = 0; i <= grid.nx; ++i) grid.height[grid.index(i, j)] = terrain.ground(grid.plan(i, j));
      },
      16);
  return grid;
}

}  // namespace bosquet::geometry
