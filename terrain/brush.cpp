#include "terrain/brush.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "terrain/perlin.h"

namespace bosquet::terrain {
namespace {

// The smoothing brush looks this share of its radius around, in at most kBlurSteps equal steps to each side.
constexpr float kBlurShare = 1.0f / 3.0f;
constexpr int kBlurSteps = 6;

float weight(const Stroke& stroke, float distance) {
  const float plateau = std::clamp(stroke.hardness, 0.0f, 1.0f) * stroke.radius_m;
  if (distance <= plateau) return 1.0f;
  if (distance >= stroke.radius_m) return 0.0f;
  const float x = (distance - plateau) / (stroke.radius_m - plateau);
  return 1.0f - x * x * x * (x * (x * 6.0f - 15.0f) + 10.0f);
}

// Mean of the heights around a sample, each direction weighted as a tent; beyond the edge the ground is continued
// point-symmetrically, so that a plane stays the same plane everywhere.
class Surroundings {
 public:
  Surroundings(const Heightfield& field, float radius_m) : field_(field) {
    const int cells = std::max(1, static_cast<int>(radius_m / field.cell_m()));
    stride_ = (cells + kBlurSteps - 1) / kBlurSteps;
    steps_ = cells / stride_;
  }

  float mean(int i, int j) const {
    double sum = 0.0, weights = 0.0;
    for (int b = -steps_; b <= steps_; ++b)
      for (int a = -steps_; a <= steps_; ++a) {
        const double w = (steps_ + 1 - std::abs(a)) * (steps_ + 1 - std::abs(b));
        sum += w * height(i + a * stride_, j + b * stride_);
        weights += w;
      }
    return static_cast<float>(sum / weights);
  }

 private:
  double height(int i, int j) const {
    const IVec2 n = field_.cells();
    const int ci = std::clamp(i, 0, n.x), cj = std::clamp(j, 0, n.y);
    if (ci == i && cj == j) return field_.sample(i, j);
    const int mi = std::clamp(2 * ci - i, 0, n.x), mj = std::clamp(2 * cj - j, 0, n.y);
    return 2.0 * field_.sample(ci, cj) - field_.sample(mi, mj);
  }

  const Heightfield& field_;
  int stride_ = 1, steps_ = 1;
};

// One half of a cell's diagonal, in cells: a line that is narrower could slip between the cells' middles.
constexpr float kHalfDiagonal = 0.7072f;

// How far a stroke reaches on the grid that it writes to.
float reach_of(const Stroke& stroke, float cell) {
  const bool barring = stroke.kind == BrushKind::exclude || stroke.kind == BrushKind::include;
  return barring ? std::max(stroke.radius_m, kHalfDiagonal * cell) + cell : stroke.radius_m;
}

bool shapes_ground(BrushKind kind) {
  return kind != BrushKind::exclude && kind != BrushKind::include && kind != BrushKind::density;
}

}  // namespace

LiveStroke::LiveStroke(const Terrain& before, Stroke stroke)
    : before_(before), stroke_(std::move(stroke)), distance_(empty_distance()) {
  const std::vector<Vec2> points = std::exchange(stroke_.points, {});
  begin();
  extend(points);
}

void LiveStroke::begin() {
  after_ = before_;
  if (stroke_.kind == BrushKind::exclude) area_ = after_.areas.add(after_.exclusion.lattice(), stroke_.area);
  distance_.clear();
}

LineDistance LiveStroke::empty_distance() const {
  const float cell = before_.height.cell_m(), reach = reach_of(stroke_, cell);
  if (shapes_ground(stroke_.kind)) return {before_.height.grid().size(), cell, 0.0f, reach};
  return {before_.exclusion.lattice().cells, before_.exclusion.lattice().cell_m, 0.5f, reach};
}

Box2 LiveStroke::extend(std::span<const Vec2> points) {
  if (points.empty()) return {};
  std::vector<Piece> fresh;
  if (stroke_.points.empty() && points.size() == 1) {
    fresh.push_back({points[0], points[0]});
  } else {
    // A click that becomes a line is no piece of that line: at its rim it may reach a point that the line just misses.
    if (stroke_.points.size() == 1) begin();
    Vec2 from = stroke_.points.empty() ? points[0] : stroke_.points.back();
    for (std::size_t n = stroke_.points.empty() ? 1 : 0; n < points.size(); from = points[n++])
      fresh.push_back({from, points[n]});
  }
  stroke_.points.insert(stroke_.points.end(), points.begin(), points.end());
  if (shapes_ground(stroke_.kind))
    shape(fresh);
  else if (stroke_.kind == BrushKind::density)
    set_density(fresh);
  else
    bar(fresh);

  // Heights are asked for between samples and slopes across two cells.
  Box2 touched;
  const float cell = before_.height.cell_m(), margin = reach_of(stroke_, cell) + 2.0f * cell;
  for (const Piece& piece : fresh) touched.add(piece.from), touched.add(piece.to);
  touched.low = glm::max(touched.low - margin, Vec2(0.0f));
  touched.high = glm::min(touched.high + margin, before_.size_m());
  return touched.empty() ? Box2{} : touched;
}

void LiveStroke::shape(std::span<const Piece> fresh) {
  const Heightfield& before = before_.height;
  const float cell = before.cell_m();
  const float touched_first = before.at(stroke_.points.front());
  const Surroundings surroundings(before, stroke_.radius_m * kBlurShare);
  const PerlinNoise noise{stroke_.amount_m, stroke_.noise_scale_m, 4};
  TileEditor<float> editor(after_.height.grid());
  distance_.extend(fresh, [&](int i, int j, float distance) {
    const float f = stroke_.strength * weight(stroke_, distance);
    const float h = before.sample(i, j);
    if (!(f > 0.0f)) {
      // At the rim a nearer piece may weigh a rounding less than the one before it, which then left its mark.
      if (after_.height.sample(i, j) != h) editor.set(i, j, h);
      return;
    }
    float after = h;
    switch (stroke_.kind) {
      case BrushKind::raise:
        after = h + f * stroke_.amount_m;
        break;
      case BrushKind::lower:
        after = h - f * stroke_.amount_m;
        break;
      case BrushKind::noise:
        after = h + f * perlin_height(noise, stroke_.seed, Vec2(i, j) * cell);
        break;
      case BrushKind::flatten:
        after = f < 1.0f ? h + f * (touched_first - h) : touched_first;
        break;
      case BrushKind::smooth:
        after = h + f * (surroundings.mean(i, j) - h);
        break;
      default:
        assert(false);
    }
    editor.set(i, j, after);
  });
}

// Raises (or lowers, for include) the mask to a ramp that is 1/2 at the radius and falls over a cell to either side:
// interpolating it gives the edge back where it was.
void LiveStroke::bar(std::span<const Piece> fresh) {
  const TiledGrid<std::uint8_t>& before = before_.exclusion.grid();
  const float cell = before_.exclusion.lattice().cell_m;
  const float edge = std::max(stroke_.radius_m, kHalfDiagonal * cell);
  const bool include = stroke_.kind == BrushKind::include, named = !after_.areas.empty();
  TileEditor<std::uint8_t> editor(after_.exclusion.grid());
  std::optional<TileEditor<AreaCell>> areas;
  if (named && !include) areas.emplace(after_.areas.grid());
  distance_.extend(fresh, [&](int i, int j, float distance) {
    const std::uint8_t covered = Mask::stored(0.5f * (edge - distance) / cell + 0.5f);
    const std::uint8_t was = before.at(i, j);
    const auto now = include ? std::min<std::uint8_t>(was, static_cast<std::uint8_t>(255 - covered))
                             : std::max<std::uint8_t>(was, covered);
    if (now != was) editor.set(i, j, now);
    if (!areas) return;
    const AreaCell cell_was = before_.areas.cell(i, j), cell_now = AreaLayer::painted(cell_was, area_, covered, was);
    if (cell_now != cell_was) areas->set(i, j, cell_now);
  });
}

void LiveStroke::set_density(std::span<const Piece> fresh) {
  TileEditor<std::uint8_t> editor(after_.density.grid());
  distance_.extend(fresh, [&](int i, int j, float distance) {
    const float f = stroke_.strength * weight(stroke_, distance);
    const float was = before_.density.cell(i, j);
    if (f > 0.0f) editor.set(i, j, Mask::stored(was + f * (stroke_.density - was)));
  });
}

Edit edit(const Terrain& terrain, const Stroke& stroke) {
  Stroke brush = stroke;
  brush.points.clear();
  LiveStroke live(terrain, std::move(brush));
  const Box2 touched = live.extend(stroke.points);
  return {live.terrain(), touched};
}

Terrain apply(const Terrain& terrain, const Stroke& stroke) { return edit(terrain, stroke).terrain; }

}  // namespace bosquet::terrain
