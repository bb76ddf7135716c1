// Radii: how thick each internode is, from the wood that it carries.
//
// Source    Longay 2014, 5.3, eq. 5.1-5.3, the pipe model (Shinozaki et al. 1964)
// Model     d^n = sum d_i^n + p * d_e^n over the children d_i; a tip counts as one child of width d_e
// Decision  every internode adds its own pipe (p = 1 / detail; the source is the case p = 0), and pipes of shed wood
//           stay: that thickens old trees and lets shoots taper
// Erratum   the derivative of d^n by n is d^n log d; the source prints 3 d^n / d_e
// Units     metres; d_e = tip_diameter_m, n = pipe_exponent
// Errors    a width that no exponent gives: not wider than the wood it carries
#pragma once

#include <span>
#include <vector>

#include "core/result.h"
#include "growth/parameters.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

/// What the pipes of a skeleton are; a grown skeleton knows its own (pipes_of).
struct Pipes {
  float tip_diameter_m = 0.006f;
  float exponent = 2.0f;
  float pipe_share = 1.0f;  ///< p
};

/// d_e and p as grow() uses them for this skeleton: both follow its internode length.
Pipes pipes_of(const Skeleton& skeleton, const Parameters& parameters);

/// Radius of each internode at the end of `season` (the last by default); 0 for what is not born yet. Shed wood keeps
/// the radius it had when it fell.
std::vector<float> radii(const Skeleton& skeleton, const Pipes& pipes, int season = -1);

/// Makes the trunk `diameter_m` wide at 1.3 m (at the foot of a smaller tree) by solving the exponent, and sets all
/// radii. With several stems it is the thickest one. Returns the exponent.
Result<float> constrain_trunk(Skeleton& skeleton, const Parameters& parameters, float diameter_m);

/// A number of equal widths that meet.
struct Widths {
  double diameter_m;
  double count;
};
/// The n for which base^n = sum count * d^n. Newton-Raphson guarded by bisection: it converges for every input that has
/// a solution, which is when every width is below the base and the counts sum to more than 1.
Result<double> solve_exponent(std::span<const Widths> widths, double base_m);

}  // namespace bosquet::growth
