// Filling gaps: heights where a grid has none.
//
// Model     in a gap the surface is harmonic, each cell the mean of its neighbours (Laplace), so a gap in a plane comes
//           out as that plane; at the grid's edge and where a gap has no far side the surface runs out level
// Method    a first guess from ever coarser means (push-pull, Gortler et al. 1996), then relaxation sweeps
// Cost      proportional to the cells, plus kSweeps times the gaps
#pragma once

#include <vector>

namespace bosquet::exchange {

/// `samples` holds columns x rows heights, NaN where there is none, and at least one number.
void fill_gaps(int columns, int rows, std::vector<float>& samples);

}  // namespace bosquet::exchange
