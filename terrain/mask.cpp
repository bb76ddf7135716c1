#include "terrain/mask.h"

#include <algorithm>

namespace bosquet::terrain {

Mask::Mask(const Lattice& lattice, float everywhere) : lattice_(lattice), grid_(lattice.cells, stored(everywhere)) {}

std::uint8_t Mask::stored(float share) {
  if (!(share > 0.0f)) return 0;
  return static_cast<std::uint8_t>(std::min(share, 1.0f) * 255.0f + 0.5f);
}

float Mask::at(Vec2 plan) const {
  // Position among the cells' centres, the outer half cell read at its centre.
  const auto along = [&](float x, int cells, int& low, int& high) {
    const float p = x / lattice_.cell_m - 0.5f;
    const float inside = p > 0.0f ? std::min(p, static_cast<float>(cells - 1)) : 0.0f;
    low = static_cast<int>(inside);
    high = std::min(low + 1, cells - 1);
    return inside - static_cast<float>(low);
  };
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
  const float u = along(plan.x, lattice_.cells.x, i0, i1), v = along(plan.y, lattice_.cells.y, j0, j1);
  const int a = grid_.at(i0, j0), b = grid_.at(i1, j0), c = grid_.at(i0, j1), d = grid_.at(i1, j1);
  if (a == b && a == c && a == d) return static_cast<float>(a) * (1.0f / 255.0f);
  const float south = static_cast<float>(a) + static_cast<float>(b - a) * u;
  const float north = static_cast<float>(c) + static_cast<float>(d - c) * u;
  return (south + (north - south) * v) * (1.0f / 255.0f);
}

}  // namespace bosquet::terrain
