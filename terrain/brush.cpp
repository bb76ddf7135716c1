#include "terrain/brush.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "terrain/perlin.h"
#include "terrain/scanline.h"

namespace bosquet::terrain {
namespace {

constexpr int kTile = TiledGrid<float>::kTile;

// The smoothing brush looks this share of its radius around, in at most kBlurSteps equal steps to each side.
constexpr float kBlurShare = 1.0f / 3.0f;
constexpr int kBlurSteps = 6;

struct Piece {
  Vec2 from, to;
};

std::vector<Piece> pieces(std::span<const Vec2> line) {
  std::vector<Piece> out;
  if (line.size() == 1) out.push_back({line[0], line[0]});
  for (std::size_t n = 1; n < line.size(); ++n) out.push_back({line[n - 1], line[n]});
  return out;
}

float squared_distance(const Piece& piece, Vec2 p) {
  const Vec2 along = piece.to - piece.from, to = p - piece.from;
  const float length2 = along.x * along.x + along.y * along.y;
  const float t = length2 > 0.0f ? std::clamp((to.x * along.x + to.y * along.y) / length2, 0.0f, 1.0f) : 0.0f;
  const float x = to.x - t * along.x, y = to.y - t * along.y;
  return x * x + y * y;
}

bool near_box(const Piece& piece, const Box2& box, float radius) {
  const Vec2 low = glm::min(piece.from, piece.to) - radius, high = glm::max(piece.from, piece.to) + radius;
  if (low.x > box.high.x || low.y > box.high.y || high.x < box.low.x || high.y < box.low.y) return false;
  // Within the box's circumscribed circle widened by the radius; a few tiles too many do no harm.
  const Vec2 half = 0.5f * box.size();
  const float reach = radius + std::sqrt(half.x * half.x + half.y * half.y);
  return squared_distance(piece, box.centre()) <= reach * reach;
}

// Calls visit(i, j, distance) for each grid point within `reach` of the line; the point (i, j) lies at
// (i + offset, j + offset) * cell. Tiles are visited in parallel, each by one thread.
template <class Visit>
void visit_near(std::span<const Vec2> line, float reach, IVec2 size, float cell, float offset, const Visit& visit) {
  const std::vector<Piece> all = pieces(line);
  Box2 box;
  for (const Piece& piece : all) box.add(piece.from), box.add(piece.to);
  if (box.empty()) return;
  const auto tile_of = [&](float x, int n) {
    const float t = x / cell / kTile;
    return t > 0.0f ? static_cast<int>(std::min(t, static_cast<float>((n - 1) / kTile))) : 0;
  };
  const Vec2 margin{reach + cell};
  const Vec2 from = box.low - margin, to = box.high + margin;
  if (to.x < 0.0f || to.y < 0.0f) return;
  const IVec2 low{tile_of(from.x, size.x), tile_of(from.y, size.y)};
  const IVec2 high{tile_of(to.x, size.x), tile_of(to.y, size.y)};
  const IVec2 count = high - low + 1;
  parallel_for(static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y), [&](std::size_t n) {
    const IVec2 t = low + IVec2{static_cast<int>(n) % count.x, static_cast<int>(n) / count.x};
    const IVec2 begin = t * kTile, end = glm::min(begin + kTile, size);
    const Box2 tile_box{(Vec2(begin) + offset) * cell, (Vec2(end - 1) + offset) * cell};
    std::vector<Piece> close;
    for (const Piece& piece : all)
      if (near_box(piece, tile_box, reach)) close.push_back(piece);
    if (close.empty()) return;
    for (int j = begin.y; j < end.y; ++j)
      for (int i = begin.x; i < end.x; ++i) {
        const Vec2 p = (Vec2(i, j) + offset) * cell;
        float least = std::numeric_limits<float>::max();
        for (const Piece& piece : close) least = std::min(least, squared_distance(piece, p));
        if (least <= reach * reach) visit(i, j, std::sqrt(least));
      }
  });
}

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

void shape(Heightfield& field, const Stroke& stroke) {
  const Heightfield before = field;  // shares all tiles
  const float cell = field.cell_m();
  const float touched_first = before.at(stroke.points.front());
  const Surroundings surroundings(before, stroke.radius_m * kBlurShare);
  const PerlinNoise noise{stroke.amount_m, stroke.noise_scale_m, 4};
  TileEditor<float> editor(field.grid());
  visit_near(stroke.points, stroke.radius_m, before.grid().size(), cell, 0.0f, [&](int i, int j, float distance) {
    const float f = stroke.strength * weight(stroke, distance);
    if (!(f > 0.0f)) return;
    const float h = before.sample(i, j);
    float after = h;
    switch (stroke.kind) {
      case BrushKind::raise:
        after = h + f * stroke.amount_m;
        break;
      case BrushKind::lower:
        after = h - f * stroke.amount_m;
        break;
      case BrushKind::noise:
        after = h + f * perlin_height(noise, stroke.seed, Vec2(i, j) * cell);
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
// interpolating it gives the edge back where it was. A line narrower than a cell's diagonal could slip between the
// cells' centres, so it is widened to that.
void cover_near(Mask& mask, std::span<const Vec2> line, float radius, bool include) {
  constexpr float kHalfDiagonal = 0.7072f;
  const float cell = mask.lattice().cell_m;
  const float edge = std::max(radius, kHalfDiagonal * cell);
  const Mask before = mask;
  TileEditor<std::uint8_t> editor(mask.grid());
  visit_near(line, edge + cell, before.lattice().cells, cell, 0.5f, [&](int i, int j, float distance) {
    const std::uint8_t covered = Mask::stored(0.5f * (edge - distance) / cell + 0.5f);
    const std::uint8_t was = before.grid().at(i, j);
    const auto now = include ? std::min<std::uint8_t>(was, static_cast<std::uint8_t>(255 - covered))
                             : std::max<std::uint8_t>(was, covered);
    if (now != was) editor.set(i, j, now);
  });
}

void set_density(Mask& mask, const Stroke& stroke) {
  const Mask before = mask;
  TileEditor<std::uint8_t> editor(mask.grid());
  visit_near(stroke.points, stroke.radius_m, before.lattice().cells, before.lattice().cell_m, 0.5f,
             [&](int i, int j, float distance) {
               const float f = stroke.strength * weight(stroke, distance);
               const float was = before.cell(i, j);
               if (f > 0.0f) editor.set(i, j, Mask::stored(was + f * (stroke.density - was)));
             });
}

}  // namespace

Terrain apply(const Terrain& terrain, const Stroke& stroke) {
  Terrain after = terrain;
  if (stroke.points.empty()) return after;
  switch (stroke.kind) {
    case BrushKind::exclude:
    case BrushKind::include:
      cover_near(after.exclusion, stroke.points, stroke.radius_m, stroke.kind == BrushKind::include);
      break;
    case BrushKind::density:
      set_density(after.density, stroke);
      break;
    default:
      shape(after.height, stroke);
  }
  return after;
}

Terrain exclude_path(const Terrain& terrain, std::span<const Vec2> path, float width_m) {
  Terrain after = terrain;
  if (!path.empty()) cover_near(after.exclusion, path, 0.5f * width_m, false);
  return after;
}

Terrain exclude(const Terrain& terrain, const Polygon& area) {
  constexpr int kScans = 8;  // lines through a cell; along a line the covered length is exact
  Terrain after = terrain;
  Mask& mask = after.exclusion;
  const Lattice& lattice = mask.lattice();
  const Box2 box = area.bounds();
  if (box.empty()) return after;
  TileEditor<std::uint8_t> editor(mask.grid());
  const auto row_of = [&](float north) {
    return static_cast<int>(std::clamp(north / lattice.cell_m, 0.0f, static_cast<float>(lattice.cells.y - 1)));
  };
  std::vector<float> covered(static_cast<std::size_t>(lattice.cells.x));
  for (int j = row_of(box.low.y); j <= row_of(box.high.y); ++j) {
    std::fill(covered.begin(), covered.end(), 0.0f);
    int first = lattice.cells.x, last = -1;
    for (int s = 0; s < kScans; ++s) {
      const float north = (static_cast<float>(j) + (static_cast<float>(s) + 0.5f) / kScans) * lattice.cell_m;
      scan_polygon(area, north, [&](float west, float east, int sign) {
        const float a = std::max(west / lattice.cell_m, 0.0f);
        const float b = std::min(east / lattice.cell_m, static_cast<float>(lattice.cells.x));
        if (!(a < b)) return;
        const int to = std::min(static_cast<int>(b), lattice.cells.x - 1);
        first = std::min(first, static_cast<int>(a));
        last = std::max(last, to);
        for (int i = static_cast<int>(a); i <= to; ++i) {
          const float in = std::min(b, static_cast<float>(i + 1)) - std::max(a, static_cast<float>(i));
          covered[static_cast<std::size_t>(i)] += static_cast<float>(sign) * std::max(in, 0.0f) / kScans;
        }
      });
    }
    for (int i = first; i <= last; ++i) {
      const std::uint8_t now = Mask::stored(covered[static_cast<std::size_t>(i)]);
      if (now > mask.grid().at(i, j)) editor.set(i, j, now);
    }
  }
  return after;
}

}  // namespace bosquet::terrain
