#include "distribution/barriers.h"

#include <algorithm>
#include <limits>

namespace bosquet::distribution {
namespace {

constexpr float kFinestBarrier_m = 0.25f;
constexpr float kMostCells = 4096.0f;  // along the longer side

// From where to where a triangle reaches east between two latitudes, both within its own.
Vec2 reach_between(const std::array<Vec2, 3>& corners, float south, float north) {
  Vec2 reach{std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()};
  const auto widen = [&](float x) { reach = {std::min(reach.x, x), std::max(reach.y, x)}; };
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec2 a = corners[n], b = corners[(n + 1) % 3];
    if (a.y >= south && a.y <= north) widen(a.x);
    for (const float y : {south, north})
      if ((a.y < y) != (b.y < y)) widen(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
  }
  return reach;
}

bool near(const std::vector<Vec2>& ring, Vec2 at, float radius_m) {
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 edge = ring[i] - ring[j], to = at - ring[j];
    const float length2 = edge.x * edge.x + edge.y * edge.y;
    const float share = length2 > 0.0f ? std::clamp((to.x * edge.x + to.y * edge.y) / length2, 0.0f, 1.0f) : 0.0f;
    const Vec2 off = to - share * edge;
    if (off.x * off.x + off.y * off.y < radius_m * radius_m) return true;
  }
  return false;
}

bool edge_within(const Region& region, Vec2 at, float radius_m) {
  if (const auto* disc = std::get_if<Disc>(&region)) {
    const Vec2 d = at - disc->centre;
    const float reach = disc->radius_m + radius_m;
    return d.x * d.x + d.y * d.y < reach * reach;
  }
  if (const auto* box = std::get_if<Box2>(&region))
    return near({box->low, {box->high.x, box->low.y}, box->high, {box->low.x, box->high.y}}, at, radius_m);
  const auto& polygon = std::get<Polygon>(region);
  return near(polygon.ring, at, radius_m) ||
         std::any_of(polygon.holes.begin(), polygon.holes.end(),
                     [&](const std::vector<Vec2>& hole) { return near(hole, at, radius_m); });
}

}  // namespace

Barriers::Barriers(Vec2 size_m) {
  const float longest = std::max(size_m.x, size_m.y);
  cell_m_ = std::max(kFinestBarrier_m, longest / kMostCells);
  cells_ = glm::max(IVec2(size_m / cell_m_) + 1, IVec2(1));
}

void Barriers::add(Region outline) {
  const Box2 box = bounds(outline);
  outlines_.push_back({box, std::move(outline)});
}

void Barriers::add_triangle(const std::array<Vec2, 3>& corners) {
  Box2 box;
  for (const Vec2 p : corners) box.add(p);
  const Vec2 end = Vec2(cells_) * cell_m_;
  if (!(box.high.x >= 0.0f && box.high.y >= 0.0f && box.low.x < end.x && box.low.y < end.y)) return;
  if (touched_.empty()) touched_.resize(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y));
  const auto cell = [&](float x, int count) {
    return static_cast<int>(std::clamp(x / cell_m_, 0.0f, static_cast<float>(count - 1)));
  };
  for (int j = cell(box.low.y, cells_.y); j <= cell(box.high.y, cells_.y); ++j) {
    const float south = std::max(box.low.y, static_cast<float>(j) * cell_m_);
    const float north = std::min(box.high.y, static_cast<float>(j + 1) * cell_m_);
    const Vec2 reach = reach_between(corners, south, north);
    if (!(reach.y >= 0.0f && reach.x < end.x)) continue;
    for (int i = cell(reach.x, cells_.x); i <= cell(reach.y, cells_.x); ++i)
      touched_[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_.x) + static_cast<std::size_t>(i)] = true;
    any_cell_ = true;
  }
}

bool Barriers::cell_touched(Vec2 at, float radius_m) const {
  const Vec2 end(cells_);
  const IVec2 low(glm::clamp((at - radius_m) / cell_m_, Vec2(0.0f), end));
  const IVec2 high(glm::clamp((at + radius_m) / cell_m_, Vec2(-1.0f), end - 1.0f));
  for (int j = low.y; j <= high.y; ++j)
    for (int i = low.x; i <= high.x; ++i)
      if (touched_[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_.x) + static_cast<std::size_t>(i)])
        return true;
  return false;
}

bool Barriers::holds(Vec2 at, float radius_m) const {
  if (any_cell_ && cell_touched(at, radius_m)) return true;
  return std::any_of(outlines_.begin(), outlines_.end(), [&](const Outline& outline) {
    const Box2& box = outline.bounds;
    if (!Box2{box.low - radius_m, box.high + radius_m}.contains(at)) return false;
    return contains(outline.region, at) || (radius_m > 0.0f && edge_within(outline.region, at, radius_m));
  });
}

}  // namespace bosquet::distribution
