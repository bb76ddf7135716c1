#include "exchange/plan_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exchange/plan_contours.h"

namespace bosquet::exchange {
namespace {

using terrain::AreaKind;

constexpr float kFine_mm = 0.13f, kThin_mm = 0.18f, kMedium_mm = 0.3f;
// A line may be simplified by so much on paper.
constexpr double kTolerance_mm = 0.06;
// Along the longest side, the ground is sampled at most so often: three samples a millimetre on A3.
constexpr int kMostSamples = 1000;
// Ground flatter than this has no contour lines of its own accord.
constexpr float kFlat_m = 0.6f;
constexpr int kLinesWanted = 14;

using Rings = std::vector<std::vector<DVec2>>;

void keep_on_site(Rings& rings, Vec2 size_m) {
  for (auto& ring : rings)
    for (DVec2& p : ring) p = glm::clamp(p, DVec2(0.0), DVec2(size_m));
}

SampleGrid empty_grid(IVec2 size, DVec2 low, double step_m) {
  SampleGrid grid{size, low, step_m, {}};
  grid.values.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  return grid;
}

/// The ground at even places over the site, the last ones at or beyond its edge.
template <class Value>
SampleGrid sampled(const terrain::Terrain& ground, Value value) {
  const Vec2 size = ground.size_m();
  const double step = std::max(static_cast<double>(ground.height.lattice().cell_m),
                               static_cast<double>(std::max(size.x, size.y)) / kMostSamples);
  const auto count = [&](float side) { return static_cast<int>(std::ceil(static_cast<double>(side) / step)) + 1; };
  SampleGrid grid = empty_grid({count(size.x), count(size.y)}, DVec2(0.0), step);
  for (int j = 0, n = 0; j < grid.size.y; ++j)
    for (int i = 0; i < grid.size.x; ++i, ++n)
      grid.values[static_cast<std::size_t>(n)] = value(glm::min(Vec2(DVec2(i, j) * step), size));
  return grid;
}

/// Where each area shows, in cells.
std::map<terrain::AreaId, std::pair<IVec2, IVec2>> shown_areas(const terrain::Terrain& ground) {
  std::map<terrain::AreaId, std::pair<IVec2, IVec2>> bounds;
  const IVec2 cells = ground.exclusion.lattice().cells;
  const auto note = [&](terrain::AreaId id, IVec2 c) {
    const auto [at, fresh] = bounds.try_emplace(id, c, c);
    if (!fresh) at->second = {glm::min(at->second.first, c), glm::max(at->second.second, c)};
  };
  for (int j = 0; j < cells.y; ++j)
    for (int i = 0; i < cells.x; ++i) {
      if (ground.exclusion.cell(i, j) == 0.0f) continue;
      const terrain::AreaCell cell = ground.areas.cell(i, j);
      if (cell.cover > 0) note(cell.top, {i, j});
      if (cell.cover < 255) note(cell.under, {i, j});
    }
  return bounds;
}

Rings area_rings(const terrain::Terrain& ground, terrain::AreaId id, IVec2 low, IVec2 high, double tolerance_m) {
  const terrain::Lattice& lattice = ground.exclusion.lattice();
  const auto share = [&](int i, int j) {
    i = std::clamp(i, 0, lattice.cells.x - 1), j = std::clamp(j, 0, lattice.cells.y - 1);
    const terrain::AreaCell cell = ground.areas.cell(i, j);
    const float barred = ground.exclusion.cell(i, j);
    const float top = std::min(static_cast<float>(cell.cover) / 255.0f, barred);
    return (cell.top == id ? top : 0.0f) + (cell.under == id ? barred - top : 0.0f);
  };
  // One cell more on each side, so that an area that ends at the site's edge is drawn up to it.
  const double cell_m = static_cast<double>(lattice.cell_m);
  SampleGrid grid = empty_grid(high - low + 3, (DVec2(low) - 0.5) * cell_m, cell_m);
  for (int j = 0, n = 0; j < grid.size.y; ++j)
    for (int i = 0; i < grid.size.x; ++i, ++n)
      grid.values[static_cast<std::size_t>(n)] = share(low.x + i - 1, low.y + j - 1);
  Rings rings = rings_above(grid, 0.5f, tolerance_m);
  keep_on_site(rings, ground.size_m());
  return rings;
}

/// The hull of plan points, counter-clockwise (Andrew 1979).
std::vector<DVec2> hull(std::vector<DVec2> points) {
  std::sort(points.begin(), points.end(), [](DVec2 a, DVec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  const auto turn = [](DVec2 o, DVec2 a, DVec2 b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); };
  std::vector<DVec2> ring;
  for (int way = 0; way < 2; ++way) {
    const std::size_t first = ring.size();
    for (const DVec2& p : points) {
      while (ring.size() >= first + 2 && turn(ring[ring.size() - 2], ring.back(), p) <= 0) ring.pop_back();
      ring.push_back(p);
    }
    if (!ring.empty()) ring.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return ring;
}

Rings obstacle_rings(const scene::Obstacle& o) {
  Rings rings;
  const auto take = [&](const std::vector<Vec2>& ring) { rings.emplace_back(ring.begin(), ring.end()); };
  if (o.outline) {
    take(o.outline->ring);
    for (const auto& hole : o.outline->holes) take(hole);
  } else {
    std::vector<DVec2> points;
    for (const Vec3& p : o.mesh->positions) points.emplace_back(to_plan(p));
    rings.push_back(hull(std::move(points)));
  }
  return rings;
}

/// A usual height between lines, so that there are some kLinesWanted of them at most.
double contour_step(float relief_m) {
  for (const double step : {0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (static_cast<double>(relief_m) / step <= kLinesWanted) return step;
  return 200.0;
}

double draw_contours(PlanDrawing& plan, const scene::Document& document) {
  const terrain::Terrain& ground = *document.terrain;
  const float asked = document.plan.contours_m;
  if (asked < 0.0f) return 0;
  const SampleGrid heights = sampled(ground, [&](Vec2 p) { return ground.ground(p); });
  const auto [low, high] = std::minmax_element(heights.values.begin(), heights.values.end());
  const float relief = *high - *low;
  if (asked == 0.0f && relief < kFlat_m) return 0;
  double step = asked > 0.0f ? static_cast<double>(asked) : contour_step(relief);
  constexpr double kMostLines = 500;
  while (static_cast<double>(relief) / step > kMostLines) step *= 10;

  const std::size_t layer = add_layer(plan, "CONTOURS", 33);
  const Vec3 brown(0.62f, 0.50f, 0.38f);
  for (auto n = static_cast<long>(std::ceil(static_cast<double>(*low) / step));
       static_cast<double>(n) * step < static_cast<double>(*high); ++n) {
    const bool index = n % 5 == 0;
    PlanPath path;
    path.closed = false;
    path.pen = {index ? 0.25f : kFine_mm, brown, Dashes::none};
    path.lines = lines_at(heights, static_cast<float>(static_cast<double>(n) * step), plan.metres(3 * kTolerance_mm));
    keep_on_site(path.lines, ground.size_m());
    if (path.lines.empty()) continue;
    const auto longest = std::max_element(path.lines.begin(), path.lines.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const DVec2 middle = (*longest)[longest->size() / 2];
    const bool labelled = index || static_cast<double>(relief) / step < 6.0;
    plan.items.push_back({layer, std::move(path)});
    if (labelled) {
      PlanText height{middle, 1.8f, fmt::format("{:g}", static_cast<double>(n) * step), PlanAlign::centre, false,
                      false,  brown};
      plan.items.push_back({layer, std::move(height)});
    }
  }
  return step;
}

}  // namespace

std::size_t add_layer(PlanDrawing& plan, std::string name, int colour) {
  plan.layers.push_back({std::move(name), colour});
  return plan.layers.size() - 1;
}

PlanFill area_fill(AreaKind kind) {
  switch (kind) {
    case AreaKind::path:
      return {1.0f, {0.93f, 0.90f, 0.84f}};
    case AreaKind::lawn:
      return {1.0f, {0.90f, 0.95f, 0.84f}};
    case AreaKind::bed:
      return {1.0f, {0.91f, 0.86f, 0.80f}};
    case AreaKind::building:
      return building_fill();
    case AreaKind::water:
      return water_fill();
    case AreaKind::other:
      break;
  }
  return {1.0f, {0.95f, 0.94f, 0.91f}};
}
PlanFill water_fill() { return {1.0f, {0.78f, 0.88f, 0.94f}}; }
PlanFill building_fill() { return {1.0f, {0.72f, 0.71f, 0.70f}}; }

std::string_view area_words(AreaKind kind) {
  constexpr std::string_view kWords[] = {"Kept free of trees", "Path", "Lawn", "Bed", "Building", "Water"};
  return kWords[static_cast<std::size_t>(kind)];
}

GroundKinds draw_ground(PlanDrawing& plan, const scene::Document& document) {
  const terrain::Terrain& ground = *document.terrain;
  const double tolerance_m = plan.metres(kTolerance_mm);
  GroundKinds kinds;

  // Areas by kind, lawns under paths.
  const auto shown = shown_areas(ground);
  for (const AreaKind kind :
       {AreaKind::other, AreaKind::lawn, AreaKind::bed, AreaKind::water, AreaKind::path, AreaKind::building}) {
    if (std::none_of(shown.begin(), shown.end(),
                     [&](const auto& s) { return ground.areas.area(s.first).kind == kind; }))
      continue;
    constexpr std::string_view kNames[] = {"OTHER", "PATH", "LAWN", "BED", "BUILDING", "WATER"};
    constexpr int kColours[] = {9, 41, 81, 43, 8, 140};
    const auto k = static_cast<std::size_t>(kind);
    const std::size_t layer = add_layer(plan, fmt::format("AREA-{}", kNames[k]), kColours[k]);
    bool drawn = false;
    for (const auto& [id, bounds] : shown) {
      if (ground.areas.area(id).kind != kind) continue;
      PlanPath path;
      path.lines = area_rings(ground, id, bounds.first, bounds.second, tolerance_m);
      if (path.lines.empty()) continue;
      path.pen = {kThin_mm, Vec3(0.45f), Dashes::none};
      path.fill = area_fill(kind);
      plan.items.push_back({layer, std::move(path)});
      drawn = true;
    }
    // A pond's area is its outline; its water is drawn with the rest.
    if (drawn && kind != AreaKind::water) kinds.areas.push_back(kind);
  }

  if (ground.has_water()) {
    constexpr float kDry_m = 0.5f;  // what stands for no water; the shore lies where the depth is 0
    const SampleGrid depth = sampled(ground, [&](Vec2 p) {
      const std::optional<float> level = ground.water_level(p);
      return level ? std::max(-kDry_m, *level - ground.ground(p)) : -kDry_m;
    });
    PlanPath water;
    water.lines = rings_above(depth, 0.0f, tolerance_m);
    keep_on_site(water.lines, ground.size_m());
    if (!water.lines.empty()) {
      water.pen = {0.25f, {0.25f, 0.45f, 0.65f}, Dashes::none};
      water.fill = water_fill();
      plan.items.push_back({add_layer(plan, "WATER", 5), std::move(water)});
      kinds.water = true;
    }
  }

  kinds.contours_m = draw_contours(plan, document);

  if (!document.obstacles.empty()) {
    const std::size_t layer = add_layer(plan, "BUILDINGS", 8);
    for (const scene::Obstacle& o : document.obstacles) {
      PlanPath path;
      path.lines = obstacle_rings(o);
      path.pen = {kMedium_mm, Vec3(0.15f), Dashes::none};
      path.fill = building_fill();
      plan.items.push_back({layer, std::move(path)});
    }
    kinds.buildings = true;
  }
  return kinds;
}

}  // namespace bosquet::exchange
