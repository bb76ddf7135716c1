#include "terrain/heightfield.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace bosquet::terrain {
namespace {

// Where a position lies: the cell and the shares of the way across it.
struct InCell {
  int i, j;
  float u, v;
};

InCell locate(const Lattice& lattice, Vec2 plan) {
  const auto along = [&](float x, float size, int cells, int& cell) {
    const float inside = x > 0.0f ? std::min(x, size) / lattice.cell_m : 0.0f;  // NaN reads as 0
    cell = std::min(static_cast<int>(inside), cells - 1);
    return std::min(inside - static_cast<float>(cell), 1.0f);
  };
  InCell c{};
  c.u = along(plan.x, lattice.size_m.x, lattice.cells.x, c.i);
  c.v = along(plan.y, lattice.size_m.y, lattice.cells.y, c.j);
  return c;
}

// Exact at both ends, and a constant stays that constant.
float mix(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

Heightfield::Heightfield(const Lattice& lattice, float height_m)
    : lattice_(lattice), grid_(lattice.cells + 1, height_m) {}

Heightfield::Heightfield(const Lattice& lattice, const std::function<float(Vec2)>& height_at) : Heightfield(lattice) {
  TileEditor<float> editor(grid_);
  constexpr int kTile = TiledGrid<float>::kTile;
  const IVec2 tiles = grid_.tiles(), size = grid_.size();
  parallel_for(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), [&](std::size_t n) {
    const IVec2 t{static_cast<int>(n) % tiles.x, static_cast<int>(n) / tiles.x};
    auto& tile = editor.tile(t);
    for (int j = t.y * kTile; j < std::min(size.y, (t.y + 1) * kTile); ++j)
      for (int i = t.x * kTile; i < std::min(size.x, (t.x + 1) * kTile); ++i)
        tile[TiledGrid<float>::inside(i, j)] = height_at(Vec2(i, j) * lattice_.cell_m);
  });
}

Result<Heightfield> Heightfield::from_samples(const Lattice& lattice, std::span<const float> samples) {
  const IVec2 size = lattice.cells + 1;
  const std::size_t expected = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  if (samples.size() != expected)
    return Error{fmt::format("{} heights for a ground of {} x {} samples; {} are needed", samples.size(), size.x,
                             size.y, expected)};
  Heightfield field(lattice);
  TileEditor<float> editor(field.grid_);
  for (int j = 0; j < size.y; ++j)
    for (int i = 0; i < size.x; ++i) {
      const float height =
          samples[static_cast<std::size_t>(j) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(i)];
      if (!std::isfinite(height))
        return Error{fmt::format("the height at {} m east, {} m north is not a number",
                                 static_cast<float>(i) * lattice.cell_m, static_cast<float>(j) * lattice.cell_m)};
      editor.set(i, j, height);
    }
  return field;
}

float Heightfield::at(Vec2 plan) const {
  const auto [i, j, u, v] = locate(lattice_, plan);
  constexpr int kTile = TiledGrid<float>::kTile;
  if (i % kTile != kTile - 1 && j % kTile != kTile - 1) {  // all four in one tile
    const auto& tile = grid_.tile({i / kTile, j / kTile});
    const std::size_t n = TiledGrid<float>::inside(i, j);
    return mix(mix(tile[n], tile[n + 1], u), mix(tile[n + kTile], tile[n + kTile + 1], u), v);
  }
  return mix(mix(sample(i, j), sample(i + 1, j), u), mix(sample(i, j + 1), sample(i + 1, j + 1), u), v);
}

Vec2 Heightfield::gradient(Vec2 plan) const {
  const auto [i, j, u, v] = locate(lattice_, plan);
  // One-sided at the site's edge, central elsewhere.
  const auto slope = [&](int a, int b) {
    const IVec2 n = lattice_.cells;
    const int west = std::max(a - 1, 0), east = std::min(a + 1, n.x), south = std::max(b - 1, 0),
              north = std::min(b + 1, n.y);
    return Vec2{(sample(east, b) - sample(west, b)) / (static_cast<float>(east - west) * lattice_.cell_m),
                (sample(a, north) - sample(a, south)) / (static_cast<float>(north - south) * lattice_.cell_m)};
  };
  const Vec2 a = slope(i, j), b = slope(i + 1, j), c = slope(i, j + 1), d = slope(i + 1, j + 1);
  return {mix(mix(a.x, b.x, u), mix(c.x, d.x, u), v), mix(mix(a.y, b.y, u), mix(c.y, d.y, u), v)};
}

Vec3 Heightfield::normal(Vec2 plan) const {
  const Vec2 g = gradient(plan);
  const float scale = 1.0f / std::sqrt(1.0f + g.x * g.x + g.y * g.y);
  return {-g.x * scale, scale, g.y * scale};  // z is south
}

HeightRange Heightfield::range() const {
  HeightRange range{sample(0, 0), sample(0, 0)};
  const IVec2 size = grid_.size();
  for (int j = 0; j < size.y; ++j)
    for (int i = 0; i < size.x; ++i) {
      const float h = sample(i, j);
      range.low = std::min(range.low, h);
      range.high = std::max(range.high, h);
    }
  return range;
}

}  // namespace bosquet::terrain
