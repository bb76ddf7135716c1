#include "terrain/pond.h"

#include <algorithm>
#include <cmath>

#include "terrain/exclusion.h"
#include "terrain/line_distance.h"
#include "terrain/scanline.h"

namespace bosquet::terrain {
namespace {

// A bank that has not come out of the hill so far from the outline ends there.
constexpr float kWidestBank_m = 200.0f;
constexpr int kMostSteps = 1'000'000;  // along a ring, for its ground

std::vector<Piece> edges(const Polygon& outline) {
  std::vector<Piece> all;
  const auto add = [&](const std::vector<Vec2>& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) all.push_back({ring[j], ring[i]});
  };
  add(outline.ring);
  for (const auto& hole : outline.holes) add(hole);
  return all;
}

// Lowest and highest ground along the edges, as far as they lie on the site.
std::optional<HeightRange> rim(const Terrain& terrain, const std::vector<Piece>& all) {
  std::optional<HeightRange> range;
  const float step = 0.5f * terrain.height.cell_m();
  for (const Piece& edge : all) {
    const float length = glm::distance(edge.from, edge.to);
    const int steps = static_cast<int>(std::clamp(length / step, 1.0f, static_cast<float>(kMostSteps)));
    for (int n = 0; n < steps; ++n) {
      const Vec2 p = glm::mix(edge.from, edge.to, static_cast<float>(n) / static_cast<float>(steps));
      if (!on_site(terrain, p)) continue;
      const float h = terrain.ground(p);
      if (!range) range = HeightRange{h, h};
      range->low = std::min(range->low, h), range->high = std::max(range->high, h);
    }
  }
  return range;
}

}  // namespace

DugPond dig_pond(const Terrain& terrain, const std::string& name, const Polygon& outline, std::optional<float> level_m,
                 const PondRules& rules) {
  DugPond pond{{terrain, {}}, level_m.value_or(0.0f), false};
  const Lattice& lattice = terrain.height.lattice();
  const float cell = lattice.cell_m;
  const std::vector<Piece> all = edges(outline);
  // An outline around the whole site has no rim on it: its ground is the site's.
  std::optional<HeightRange> ground = rim(terrain, all);
  if (!ground && outline.contains(0.5f * lattice.size_m)) ground = terrain.height.range();
  if (!ground) return pond;
  const float highest_level = ground->low - kFreeboard_m;
  pond.lowered = level_m && *level_m > highest_level;
  pond.level_m = std::min(level_m.value_or(highest_level), highest_level);
  const float level = pond.level_m;

  // Inside, the depth is reached after depth * bank; outside, a bank three times as high as the rim is far enough.
  const float hill = std::max(0.0f, 3.0f * (ground->high - level));
  const float reach =
      std::max(std::min(rules.bank * hill, kWidestBank_m), std::min(rules.bank * rules.depth_m, 4.0f * kWidestBank_m)) +
      2.0f * cell;
  TiledGrid<float> distance(terrain.height.grid().size(), reach);
  {
    TileEditor<float> editor(distance);
    LineDistance line(distance.size(), cell, 0.0f, reach);
    line.extend(all, [&](int i, int j, float d) { editor.set(i, j, d); });
  }

  Terrain& after = pond.edit.terrain;
  {
    TileEditor<float> editor(after.height.grid());
    Box2 box = outline.bounds();
    box.low -= reach, box.high += reach;
    const auto sample = [&](float x, int n) {
      return static_cast<int>(std::clamp(x / cell, 0.0f, static_cast<float>(n)));
    };
    const int i0 = sample(box.low.x, lattice.cells.x), i1 = sample(box.high.x, lattice.cells.x);
    std::vector<bool> inside(static_cast<std::size_t>(lattice.cells.x) + 1);
    for (int j = sample(box.low.y, lattice.cells.y); j <= sample(box.high.y, lattice.cells.y); ++j) {
      std::fill(inside.begin(), inside.end(), false);
      scan_polygon(outline, static_cast<float>(j) * cell, [&](float west, float east, int sign) {
        for (int i = sample(std::ceil(west / cell) * cell, lattice.cells.x);
             i <= lattice.cells.x && static_cast<float>(i) * cell <= east; ++i)
          if (static_cast<float>(i) * cell >= west) inside[static_cast<std::size_t>(i)] = sign > 0;
      });
      for (int i = i0; i <= i1; ++i) {
        const float d = distance.at(i, j);
        const bool in = inside[static_cast<std::size_t>(i)];
        if (!in && d >= reach) continue;
        const float bed = std::max(level - rules.depth_m, level + (in ? -d : d) / rules.bank);
        if (bed < after.height.sample(i, j)) editor.set(i, j, bed);
      }
    }
    pond.edit.touched = {glm::max(box.low - 2.0f * cell, Vec2(0.0f)), glm::min(box.high + 2.0f * cell, lattice.size_m)};
  }

  const Area area{name, AreaKind::water, usual_cover(AreaKind::water), level};
  after = exclude(after, outline, area);
  const AreaId id = after.areas.add(lattice, area);
  if (after.ponds.size() != lattice.cells) after.ponds = TiledGrid<AreaId>(lattice.cells, AreaId{0});
  TileEditor<AreaId> editor(after.ponds);
  visit_covered(outline, lattice, [&](int i, int j, float share) {
    if (share > 0.0f) editor.set(i, j, id);
  });
  return pond;
}

}  // namespace bosquet::terrain
