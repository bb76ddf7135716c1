// Radii: how thick each internode is, from the wood that it carries.
//
// Source    Longay 2014, 5.3, eq. 5.1-5.3, the pipe model (Shinozaki et al. 1964)
// Model     d^n = sum d_i^n + p * d_e^n over the children d_i; a tip is d_e wide; p is 1 for an internode as it grew
//           (at other details the number of internodes that it stands for, detail.h)
// Decision  every internode adds its own pipe (the source is the case p = 0), and pipes of shed wood stay: that
//           thickens old trees and lets shoots taper
// Erratum   the derivative of d^n by n is d^n log d; the source prints 3 d^n / d_e
// Units     metres; d_e, n and detail are kept in the skeleton
// Errors    a width that no exponent gives: not wider than the wood it carries
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/result.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

/// Radius of each internode at the end of `season` (the last by default); 0 for what is not born yet. Shed wood keeps
/// the radius it had when it fell.
std::vector<float> radii(const Skeleton& skeleton, int season = -1);

/// Makes the trunk `diameter_m` wide at 1.3 m (at the foot of a smaller tree) by solving the exponent, and sets all
/// radii. With several stems it is the thickest one.
Result<void> constrain_trunk(Skeleton& skeleton, float diameter_m);

/// A width that an internode was given.
struct GivenWidth {
  std::size_t internode;
  float diameter_m;
};
/// Sets all radii so that these internodes, each named once, have their widths. The given widths cut the tree: what
/// stands on an internode with a width, up to the next ones and the tips, gets the exponent that leads from those to it;
/// what stands below all of them keeps the tree's. Nothing changes when some width cannot be had.
Result<void> constrain_widths(Skeleton& skeleton, std::span<const GivenWidth> widths);

/// The internode that crosses 1.3 m on the thickest stem (the foot of a smaller tree); -1 for an empty skeleton.
int breast_height_internode(const Skeleton& skeleton);

/// Equal widths that meet at a base.
struct Widths {
  double diameter_m;
  double count;
};
/// The n for which base^n = sum count * d^n. Newton-Raphson guarded by bisection: it converges for every input that has
/// a solution, which is when every width is below the base and the counts sum to more than 1.
Result<double> solve_exponent(std::span<const Widths> widths, double base_m);

}  // namespace bosquet::growth
