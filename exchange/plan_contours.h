// Plan contours: lines of equal value through a grid of samples, and the areas above a value.
//
// Source    marching squares; a saddle is joined by the mean of its four corners
// Frame     plan metres; sample (i, j) at low + step * (i, j), the first row southernmost
// Holds     rings of an area are closed along the grid's edge and part inside from outside by the even-odd rule; points
//           of neighbouring cells meet in the same bits
// Units     metres; `tolerance_m` is how far a simplified line may lie from the full one
#pragma once

#include <vector>

#include "core/vec.h"

namespace bosquet::exchange {

struct SampleGrid {
  IVec2 size{0};
  DVec2 low{0.0};
  double step_m = 1.0;
  std::vector<float> values;  ///< at j * size.x + i

  float at(int i, int j) const {
    return values[static_cast<std::size_t>(j) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(i)];
  }
};

/// Rings around where the values are above `level`.
std::vector<std::vector<DVec2>> rings_above(const SampleGrid& grid, float level, double tolerance_m);

/// Lines at `level`, ending at the grid's edge; a ring's last point is its first.
std::vector<std::vector<DVec2>> lines_at(const SampleGrid& grid, float level, double tolerance_m);

/// A line without the points that lie within the tolerance of what is left (Douglas & Peucker 1973).
std::vector<DVec2> simplified(const std::vector<DVec2>& line, double tolerance_m);

}  // namespace bosquet::exchange
