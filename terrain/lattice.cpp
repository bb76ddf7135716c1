#include "terrain/lattice.h"

#include <fmt/format.h>

#include <algorithm>

namespace bosquet::terrain {

Result<Lattice> make_lattice(Vec2 size_m) {
  return make_lattice(size_m, std::max(0.5f, std::max(size_m.x, size_m.y) / kMostCells));
}

Result<Lattice> make_lattice(Vec2 size_m, float cell_m) {
  for (const float side : {size_m.x, size_m.y})
    if (!(side >= kLeastSite_m && side <= kLargestSite_m))
      return Error{fmt::format("the site is {} x {} m; each side must be from {:.0f} m to {:.0f} km", size_m.x,
                               size_m.y, kLeastSite_m, kLargestSite_m / 1000.0f)};
  if (!(cell_m > 0.0f)) return Error{fmt::format("a cell of {} m: it must be larger than 0", cell_m)};
  const float cell = std::max(cell_m, std::max(size_m.x, size_m.y) / kMostCells);
  // A side that is a whole number of cells but for rounding gets no further one.
  const auto count = [&](float side) {
    const float whole = side / cell;
    const int n = static_cast<int>(whole);
    return std::clamp(whole - static_cast<float>(n) > 1e-4f * whole ? n + 1 : n, 1, kMostCells);
  };
  return Lattice{size_m, cell, {count(size_m.x), count(size_m.y)}};
}

}  // namespace bosquet::terrain
