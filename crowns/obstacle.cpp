#include "crowns/obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace bosquet::crowns {
namespace {

// Nearer than this to the surface, in voxels, counts as inside.
constexpr double kMargin = 0.5 - 1e-3;

double squared_distance(DVec2 p, DVec2 a, DVec2 b) {
  const DVec2 along = b - a, to = p - a;
  const double length = along.x * along.x + along.y * along.y;
  const double share = length > 0 ? std::clamp((to.x * along.x + to.y * along.y) / length, 0.0, 1.0) : 0.0;
  const DVec2 off = to - share * along;
  return off.x * off.x + off.y * off.y;
}

bool before(const ColumnSpan& a, const ColumnSpan& b) {
  return std::tie(a.column.y, a.column.x, a.low) < std::tie(b.column.y, b.column.x, b.low);
}

}  // namespace

ObstacleVolume gather(std::vector<ColumnSpan> spans) {
  std::sort(spans.begin(), spans.end(), before);
  ObstacleVolume out;
  for (const ColumnSpan& s : spans) {
    if (s.low >= s.high) continue;
    if (!out.spans.empty() && out.spans.back().column == s.column && s.low <= out.spans.back().high) {
      out.spans.back().high = std::max(out.spans.back().high, s.high);
      continue;
    }
    const bool first = out.spans.empty();
    out.low = first ? s.column : glm::min(out.low, s.column);
    out.high = first ? s.column : glm::max(out.high, s.column);
    out.spans.push_back(s);
  }
  return out;
}

ObstacleVolume extrude(const Polygon& outline, float low_y, float high_y, VoxelSize size, const Box2& within) {
  const double voxel = static_cast<double>(size.voxel_m), layer = static_cast<double>(size.layer_m);
  const auto low = static_cast<std::int32_t>(std::floor(static_cast<double>(low_y) / layer));
  const auto high = std::max(low + 1, static_cast<std::int32_t>(std::ceil(static_cast<double>(high_y) / layer)));

  // Rings in columns.
  std::vector<std::vector<DVec2>> rings;
  const auto add = [&](const std::vector<Vec2>& ring) {
    rings.emplace_back();
    for (Vec2 p : ring) rings.back().push_back(DVec2(p) / voxel);
  };
  add(outline.ring);
  for (const auto& hole : outline.holes) add(hole);
  const Box2 bounds = outline.bounds(), box{glm::max(bounds.low, within.low), glm::min(bounds.high, within.high)};
  if (bounds.empty() || box.empty()) return {};
  const IVec2 from(glm::floor(DVec2(box.low) / voxel - 1.0)), to(glm::ceil(DVec2(box.high) / voxel + 1.0));
  const auto width = static_cast<std::size_t>(to.x - from.x + 1), rows = static_cast<std::size_t>(to.y - from.y + 1);
  std::vector<std::uint8_t> taken(width * rows, 0);
  const auto at = [&](std::int32_t i, std::int32_t j) -> std::uint8_t& {
    return taken[static_cast<std::size_t>(j - from.y) * width + static_cast<std::size_t>(i - from.x)];
  };

  // Inside the outline and in no hole, by the crossings of each row.
  for (std::int32_t j = from.y; j <= to.y; ++j) {
    const double north = j + 0.5;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      std::vector<double> crossings;
      for (std::size_t a = 0, b = rings[r].size() - 1; a < rings[r].size(); b = a++) {
        const DVec2 p = rings[r][a], q = rings[r][b];
        if ((p.y > north) != (q.y > north)) crossings.push_back((q.x - p.x) * (north - p.y) / (q.y - p.y) + p.x);
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
        const auto first = static_cast<std::int32_t>(std::ceil(crossings[n] - 0.5));
        const auto last = static_cast<std::int32_t>(std::ceil(crossings[n + 1] - 0.5)) - 1;
        for (std::int32_t i = std::max(first, from.x); i <= std::min(last, to.x); ++i) at(i, j) = r == 0;
      }
    }
  }
  // Beside an edge.
  for (const auto& ring : rings)
    for (std::size_t a = 0, b = ring.size() - 1; a < ring.size(); b = a++) {
      const IVec2 near(glm::floor(glm::min(ring[a], ring[b]) - 1.0)), far(glm::ceil(glm::max(ring[a], ring[b]) + 1.0));
      for (std::int32_t j = std::max(near.y, from.y); j <= std::min(far.y, to.y); ++j)
        for (std::int32_t i = std::max(near.x, from.x); i <= std::min(far.x, to.x); ++i)
          if (squared_distance({i + 0.5, j + 0.5}, ring[a], ring[b]) < kMargin * kMargin) at(i, j) = 1;
    }

  std::vector<ColumnSpan> spans;
  for (std::int32_t j = from.y; j <= to.y; ++j)
    for (std::int32_t i = from.x; i <= to.x; ++i)
      if (at(i, j)) spans.push_back({{i, j}, low, high});
  return gather(std::move(spans));
}

std::span<const ColumnSpan> row(const ObstacleVolume& volume, std::int32_t north) {
  const auto first = std::partition_point(volume.spans.begin(), volume.spans.end(),
                                          [&](const ColumnSpan& s) { return s.column.y < north; });
  const auto last =
      std::partition_point(first, volume.spans.end(), [&](const ColumnSpan& s) { return s.column.y == north; });
  return {first, last};
}

bool holds(const ObstacleVolume& volume, IVec3 voxel) {
  const IVec2 column{voxel.x, voxel.z};
  if (column.x < volume.low.x || column.y < volume.low.y || column.x > volume.high.x || column.y > volume.high.y)
    return false;
  // The last span that begins at or below the voxel.
  const auto next = std::upper_bound(volume.spans.begin(), volume.spans.end(), ColumnSpan{column, voxel.y, 0}, before);
  if (next == volume.spans.begin()) return false;
  const ColumnSpan& s = *(next - 1);
  return s.column == column && voxel.y < s.high;
}

std::optional<Footprint> footprint_beside(const ObstacleVolume& volume, VoxelSize size, Vec2 point, float above_y,
                                          double within_m) {
  const double voxel = static_cast<double>(size.voxel_m);
  const DVec2 p = DVec2(point) / voxel;
  const double within = within_m / voxel;
  const auto beyond = [](double v, double low, double high) { return std::max({0.0, low - v, v - high}); };
  const double x = beyond(p.x, volume.low.x, volume.high.x + 1.0), y = beyond(p.y, volume.low.y, volume.high.y + 1.0);
  if (volume.spans.empty() || x * x + y * y > within * within) return {};

  const auto least =
      static_cast<std::int32_t>(std::floor(static_cast<double>(above_y) / static_cast<double>(size.layer_m)));
  Footprint out;
  double best = std::numeric_limits<double>::infinity();
  std::int64_t columns = 0, east = 0, north = 0;
  const ColumnSpan* last = nullptr;
  for (const ColumnSpan& s : volume.spans) {
    if (s.high <= least || (last && last->column == s.column)) continue;
    last = &s;
    ++columns, east += s.column.x, north += s.column.y;
    const DVec2 nearest = glm::clamp(p, DVec2(s.column), DVec2(s.column) + 1.0);
    const DVec2 off = nearest - p;
    const double squared = off.x * off.x + off.y * off.y;
    if (squared < best) best = squared, out.nearest = nearest * voxel;
  }
  if (columns == 0 || best > within * within) return {};
  out.distance_m = std::sqrt(best) * voxel;
  const double n = static_cast<double>(columns);
  out.area_m2 = n * voxel * voxel;
  out.middle = (DVec2(static_cast<double>(east), static_cast<double>(north)) / n + 0.5) * voxel;
  return out;
}

}  // namespace bosquet::crowns
