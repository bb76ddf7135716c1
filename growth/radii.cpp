#include "growth/radii.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::growth {
namespace {

/// d^n in units of d_e^n for every internode: the pipes that pass through it.
std::vector<double> pipes(const Skeleton& s, int season) {
  std::vector<double> carried(s.size(), 0.0);
  for (std::size_t i = s.size(); i-- > 0;) {
    if (s.born[i] > season) continue;
    // A tip is d_e wide; further down each internode adds its own. Of an internode in pieces the last one has it, and
    // while that one is the tip it also is for the pieces below.
    carried[i] += s.own_pipes(i);
    if (s.parent[i] >= 0) carried[static_cast<std::size_t>(s.parent[i])] += carried[i];
  }
  return carried;
}

}  // namespace

std::vector<float> radii(const Skeleton& s, int season) {
  const std::vector<double> carried = pipes(s, season < 0 ? s.seasons : season);
  std::vector<float> radius(s.size());
  const float inverse = 1.0f / s.pipe_exponent;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (carried[i] > 0.0) {
      radius[i] = 0.5f * s.tip_diameter_m * pow(static_cast<float>(carried[i]), inverse);
    }
  }
  return radius;
}

int breast_height_internode(const Skeleton& s) {
  constexpr float kBreastHeight = 1.3f;
  int found = -1;
  float widest = -1.0f;
  std::vector<std::int32_t> next(s.size(), -1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(s.parent[i]);
    if (s.axis[p] == s.axis[i]) next[p] = static_cast<std::int32_t>(i);
  }
  for (std::size_t foot = 0; foot < s.size(); ++foot) {
    if (s.parent[foot] >= 0) continue;
    std::size_t i = foot;
    while (s.distal[i].y < kBreastHeight && next[i] >= 0) i = static_cast<std::size_t>(next[i]);
    if (s.distal[i].y < kBreastHeight) i = foot;
    if (s.radius.empty() ? found < 0 : s.radius[i] > widest) {
      widest = s.radius.empty() ? 0.0f : s.radius[i];
      found = static_cast<int>(i);
    }
  }
  return found;
}

Result<double> solve_exponent(std::span<const Widths> widths, double base) {
  double count = 0.0, widest = 0.0;
  for (const Widths& w : widths) count += w.count, widest = std::max(widest, w.diameter_m);
  if (!(base > widest) || !(count > 1.0)) {
    return Error{"no pipe exponent gives a width of " + std::to_string(base) +
                 " m: the wood that meets there is up to " + std::to_string(widest) + " m wide (" +
                 std::to_string(count) + " pipes)"};
  }
  // f(n) = log sum count * (d/base)^n falls and is convex, from log(count) > 0 at n = 0: Newton's steps from the left
  // stay left of the root. The bracket keeps rounding (f is known to 1e-7) from sending them away.
  const auto f = [&](double n, double& slope) {
    double sum = 0.0, weighted = 0.0;
    for (const Widths& w : widths) {
      const double ratio = static_cast<double>(log(static_cast<float>(w.diameter_m / base)));
      const double term = w.count * static_cast<double>(exp(static_cast<float>(n * ratio)));
      sum += term, weighted += term * ratio;
    }
    slope = weighted / sum;
    return static_cast<double>(log(static_cast<float>(sum)));
  };
  double low = 0.0, high = 1.0, slope = 0.0;
  while (f(high, slope) > 0.0) low = high, high *= 2.0;
  double n = low;
  for (int step = 0; step < 100; ++step) {
    const double value = f(n, slope);
    (value > 0.0 ? low : high) = n;
    double better = n - value / slope;
    if (!(better > low && better < high)) better = 0.5 * (low + high);
    if (std::abs(better - n) <= 2e-7 * better) return better;
    n = better;
  }
  return n;
}

Result<void> constrain_trunk(Skeleton& s, float diameter_m) {
  const int at = breast_height_internode(s);
  if (at < 0) return Error{"a tree without wood has no trunk diameter"};
  const double carried = pipes(s, s.seasons)[static_cast<std::size_t>(at)];
  const std::array<Widths, 1> tips{{{static_cast<double>(s.tip_diameter_m), carried}}};
  const Result<double> n = solve_exponent(tips, static_cast<double>(diameter_m));
  if (!n) return n.error();
  s.pipe_exponent = static_cast<float>(*n);
  s.radius = radii(s);
  return {};
}

}  // namespace bosquet::growth
