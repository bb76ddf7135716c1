#include "growth/radii.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/scalar.h"
#include "growth/measure.h"

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
  const auto thick = [&](double pipes) { return 0.5f * s.tip_diameter_m * pow(static_cast<float>(pipes), inverse); };
  std::array<float, 32> few{};  // most internodes carry few
  for (std::size_t n = 1; n < few.size(); ++n) few[n] = thick(static_cast<double>(n));
  for (std::size_t i = 0; i < s.size(); ++i) {
    radius[i] = carried[i] < few.size() ? few[static_cast<std::size_t>(carried[i])] : thick(carried[i]);
  }
  return radius;
}

int breast_height_internode(const Skeleton& s) {
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

Result<void> constrain_widths(Skeleton& s, std::span<const GivenWidth> widths) {
  // Part 0 stands on the ground, part k + 1 on the k-th given width.
  constexpr std::size_t kGround = 0;
  std::vector<std::size_t> part(s.size(), kGround);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    assert(widths[k].internode < s.size() && part[widths[k].internode] == kGround);
    part[widths[k].internode] = k + 1;
  }
  const auto is_cut = [&](std::size_t i) { return part[i] != kGround && widths[part[i] - 1].internode == i; };
  const auto width_of = [&](std::size_t i) { return static_cast<double>(widths[part[i] - 1].diameter_m); };

  // What meets at the foot of each part: the pipes of its own wood and the widths given above it.
  std::vector<std::vector<Widths>> meeting(widths.size() + 1, {Widths{static_cast<double>(s.tip_diameter_m), 0.0}});
  for (std::size_t i = 0; i < s.size(); ++i) {
    const bool on_wood = s.parent[i] >= 0;
    const std::size_t below = on_wood ? part[static_cast<std::size_t>(s.parent[i])] : kGround;
    if (is_cut(i)) {
      if (on_wood) meeting[below].push_back({width_of(i), 1.0});
    } else {
      part[i] = below;
    }
    meeting[part[i]][0].count += s.own_pipes(i);
  }
  std::vector<float> exponent(widths.size() + 1, s.pipe_exponent);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    // Between two widths of one internode in pieces no pipe begins: then they are the same and every exponent will do.
    const std::vector<Widths>& meets = meeting[k + 1];
    const auto width = static_cast<double>(widths[k].diameter_m);
    if (meets.size() == 2 && meets[0].count == 0.0 && meets[1].diameter_m == width) continue;
    const Result<double> n = solve_exponent(meets, width);
    if (!n) return Error{"internode " + std::to_string(widths[k].internode) + ": " + n.error().message};
    exponent[k + 1] = static_cast<float>(*n);
  }

  // Down the tree, d^n in units of d_e^n with the exponent of each part.
  std::vector<double> carried(s.size(), 0.0);
  s.radius.resize(s.size());
  for (std::size_t i = s.size(); i-- > 0;) {
    carried[i] += s.own_pipes(i);
    const float n = exponent[part[i]];
    const float ratio =
        is_cut(i) ? widths[part[i] - 1].diameter_m / s.tip_diameter_m : pow(static_cast<float>(carried[i]), 1.0f / n);
    s.radius[i] = 0.5f * s.tip_diameter_m * ratio;
    if (s.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(s.parent[i]);
    carried[p] += part[p] == part[i] ? carried[i] : static_cast<double>(pow(ratio, exponent[part[p]]));
  }
  return {};
}

}  // namespace bosquet::growth
