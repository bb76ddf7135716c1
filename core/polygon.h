// Polygons in plan: a ring of (east, north) points in metres, not repeated at the end, either orientation.
#pragma once

#include <vector>

#include "core/vec.h"

namespace bosquet {

struct Polygon {
  std::vector<Vec2> ring;
  std::vector<std::vector<Vec2>> holes;

  /// True inside the ring and in no hole (even-odd rule).
  bool contains(Vec2 p) const {
    bool inside = odd(ring, p);
    for (const auto& hole : holes) inside = inside && !odd(hole, p);
    return inside;
  }
  Box2 bounds() const {
    Box2 box;
    for (Vec2 p : ring) box.add(p);
    return box;
  }

 private:
  static bool odd(const std::vector<Vec2>& ring, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2 a = ring[i], b = ring[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
  }
};

}  // namespace bosquet
