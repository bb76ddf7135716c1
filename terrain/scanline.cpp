#include "terrain/scanline.h"

#include <algorithm>
#include <vector>

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

void visit_covered(const Polygon& polygon, const Lattice& lattice, const std::function<void(int, int, float)>& visit) {
  constexpr int kScans = 8;  // lines through a row of cells
  const Box2 box = polygon.bounds();
  if (box.empty()) return;
  const auto row_of = [&](float north) {
    return static_cast<int>(std::clamp(north / lattice.cell_m, 0.0f, static_cast<float>(lattice.cells.y - 1)));
  };
  std::vector<float> covered(static_cast<std::size_t>(lattice.cells.x));
  for (int j = row_of(box.low.y); j <= row_of(box.high.y); ++j) {
    std::fill(covered.begin(), covered.end(), 0.0f);
    int first = lattice.cells.x, last = -1;
    for (int s = 0; s < kScans; ++s) {
      const float north = (static_cast<float>(j) + (static_cast<float>(s) + 0.5f) / kScans) * lattice.cell_m;
      scan_polygon(polygon, north, [&](float west, float east, int sign) {
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
    for (int i = first; i <= last; ++i) visit(i, j, covered[static_cast<std::size_t>(i)]);
  }
}

}  // namespace bosquet::terrain
