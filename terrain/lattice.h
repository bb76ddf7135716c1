// Lattice: how a rectangular site is cut into square cells, shared by heights and masks.
//
// Frame     plan (east, north) metres; cell (i, j) spans (i, j) * cell_m to the next, (0, 0) at the south-west corner
// Rule      cell_m = max(0.5, longest side / 4096), so no side has more than 4096 cells
// Holds     cells * cell_m covers the site; the last column and row may overhang it by less than a cell
// Errors    a side outside 1 m to 200 km
#pragma once

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::terrain {

inline constexpr float kLeastSite_m = 1.0f;
inline constexpr float kLargestSite_m = 200'000.0f;
inline constexpr int kMostCells = 4096;  ///< along a side

struct Lattice {
  Vec2 size_m{1.0f};
  float cell_m = 0.5f;
  IVec2 cells{2};

  bool operator==(const Lattice&) const = default;
};

/// The lattice of a site, by the rule above.
Result<Lattice> make_lattice(Vec2 size_m);

/// A lattice with a chosen cell, enlarged where a side would have more than kMostCells.
Result<Lattice> make_lattice(Vec2 size_m, float cell_m);

}  // namespace bosquet::terrain
