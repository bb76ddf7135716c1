#include "distribution/region.h"

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

float ring_area(const std::vector<Vec2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    twice += (static_cast<double>(ring[j].x) - ring[0].x) * (static_cast<double>(ring[i].y) - ring[0].y) -
             (static_cast<double>(ring[i].x) - ring[0].x) * (static_cast<double>(ring[j].y) - ring[0].y);
  return static_cast<float>(0.5 * (twice < 0.0 ? -twice : twice));
}

}  // namespace

bool contains(const Region& region, Vec2 at) {
  if (const auto* box = std::get_if<Box2>(&region)) return box->contains(at);
  if (const auto* disc = std::get_if<Disc>(&region)) {
    const Vec2 d = at - disc->centre;
    return d.x * d.x + d.y * d.y <= disc->radius_m * disc->radius_m;
  }
  return std::get<Polygon>(region).contains(at);
}

Box2 bounds(const Region& region) {
  if (const auto* box = std::get_if<Box2>(&region)) return *box;
  if (const auto* disc = std::get_if<Disc>(&region))
    return {disc->centre - Vec2{disc->radius_m}, disc->centre + Vec2{disc->radius_m}};
  return std::get<Polygon>(region).bounds();
}

float area_m2(const Region& region) {
  if (const auto* box = std::get_if<Box2>(&region)) return box->empty() ? 0.0f : box->size().x * box->size().y;
  if (const auto* disc = std::get_if<Disc>(&region)) return kPi * disc->radius_m * disc->radius_m;
  const auto& polygon = std::get<Polygon>(region);
  if (polygon.ring.empty()) return 0.0f;
  float area = ring_area(polygon.ring);
  for (const auto& hole : polygon.holes)
    if (!hole.empty()) area -= ring_area(hole);
  return area > 0.0f ? area : 0.0f;
}

}  // namespace bosquet::distribution
