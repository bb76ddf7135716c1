// Pattern: how clustered or regular a set of points is, on a rectangular window.
//
// Source    plain K: Longay 2014, eq. 6.6. Isotropic edge correction: Ripley 1977, "Modelling spatial patterns".
//           Pair correlation: Stoyan & Stoyan 1994, Epanechnikov kernel
// Model     n points in a window of area A, d_ij their distances, I(...) 1 or 0,
//             plain       K(t) = A/n^2 * sum_{i != j} I(d_ij < t)
//             isotropic   K(t) = A/(n (n - 1)) * sum_{i != j} I(d_ij < t) / p_ij, p_ij the share of the circle about i
//                         through j that lies in the window
//             cross       K_ab(t) = A/(n_a n_b) * sum over i of a, j of b of I(d_ij < t) / p_ij
//             L(t) = sqrt(K(t) / pi),   K = pi t^2 and L = t for points at random
//             g(t) = A/(n (n - 1)) * sum_{i != j} k(t - d_ij) / (2 pi d_ij p_ij), k of half-width
//                    0.15 / sqrt(n / A); 1 for points at random, too low where t is below the half-width
// Holds     the plain estimator misses the pairs across the edge; the isotropic one is unbiased up to t = half the
//           shorter side, beyond which a circle may lie all outside
// Units     metres, square metres; window and points in plan
// Cost      pairs nearer than the largest t
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

namespace bosquet::distribution {

/// K at each t by the source's estimator; zeros when there are fewer than two points.
std::vector<double> ripley_k_plain(std::span<const Vec2> points, const Box2& window, std::span<const double> t);

/// K at each t with isotropic edge correction.
std::vector<double> ripley_k(std::span<const Vec2> points, const Box2& window, std::span<const double> t);

/// K of `b` around `a`, isotropic.
std::vector<double> cross_k(std::span<const Vec2> a, std::span<const Vec2> b, const Box2& window,
                            std::span<const double> t);

/// L = sqrt(K / pi).
std::vector<double> ripley_l(std::span<const double> k);

std::vector<double> pair_correlation(std::span<const Vec2> points, const Box2& window, std::span<const double> t);

/// Distance of each point to its nearest other point; empty when there are fewer than two.
std::vector<double> nearest_distances(std::span<const Vec2> points);

/// The share of the circle about `centre` with this radius that lies inside the window.
double share_inside(Vec2 centre, double radius, const Box2& window);

}  // namespace bosquet::distribution
