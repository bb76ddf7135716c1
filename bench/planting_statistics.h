// Planting statistics: the tables of docs/validation.md about the patterns that kernels make.
//
// Test      global rank test of the largest deviation (Myllymäki et al. 2017, there "MAD"): of a pattern and of 199
//           simulated ones, D = max over t of |L(t) - mean L(t)|, the mean over all 200; p is the rank of the pattern's D
//           among all, over 200. Nine tests are made of Lansing Woods, so p >= 0.05 / 9 holds (Bonferroni)
#pragma once

#include <string>

namespace bosquet {

/// K of plantings of one and two species with and without kernels, beside the envelope of random patterns.
std::string kernel_effects();

/// Lansing Woods planted anew by fitted kernels, against its six kinds' L and the cross-L of the three commonest.
std::string lansing_planted();

}  // namespace bosquet
