#include "terrain/scanline.h"

#include <algorithm>

namespace bosquet::terrain {
namespace {

void scan_ring(const std::vector<Vec2>& ring, float north, int sign, std::vector<float>& east,
               const std::function<void(float, float, int)>& span) {
  east.clear();
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 a = ring[i], b = ring[j];
    if ((a.y > north) != (b.y > north)) east.push_back((b.x - a.x) * (north - a.y) / (b.y - a.y) + a.x);
  }
  std::sort(east.begin(), east.end());
  for (std::size_t n = 0; n + 1 < east.size(); n += 2) span(east[n], east[n + 1], sign);
}

}  // namespace

void scan_polygon(const Polygon& polygon, float north, const std::function<void(float, float, int)>& span) {
  std::vector<float> east;
  scan_ring(polygon.ring, north, 1, east, span);
  for (const auto& hole : polygon.holes) scan_ring(hole, north, -1, east, span);
}

}  // namespace bosquet::terrain
