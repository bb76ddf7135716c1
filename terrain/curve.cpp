#include "terrain/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bosquet::terrain {
namespace {

constexpr float kStep_m = 0.5f;
constexpr int kMostSteps = 200;  // of a span

float knot_step(Vec2 a, Vec2 b) { return std::sqrt(std::sqrt(glm::dot(b - a, b - a))); }

Vec2 between(Vec2 a, Vec2 b, float from, float to, float t) { return a + ((t - from) / (to - from)) * (b - a); }

}  // namespace

std::vector<Vec2> curve_through(const std::vector<Vec2>& given, bool closed) {
  std::vector<Vec2> points;
  for (const Vec2& p : given)
    if (points.empty() || p != points.back()) points.push_back(p);
  while (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  const std::size_t n = points.size();
  if (n < 3) return given;

  // A line's ends: the point beyond mirrors the one before. A loop that ends where it began turns there as elsewhere.
  const bool loop = closed || points.front() == points.back();
  const auto at = [&](std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(n) - 1, period = closed ? last + 1 : last;
    if (loop) return points[static_cast<std::size_t>((i + period) % period)];
    if (i < 0) return 2.0f * points[0] - points[1];
    if (i > last) return 2.0f * points[n - 1] - points[n - 2];
    return points[static_cast<std::size_t>(i)];
  };
  const auto spans = static_cast<std::ptrdiff_t>(closed ? n : n - 1);
  std::vector<Vec2> out;
  for (std::ptrdiff_t i = 0; i < spans; ++i) {
    const Vec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    const float tb = knot_step(a, b), tc = tb + knot_step(b, c), td = tc + knot_step(c, d);
    const int steps = std::clamp(static_cast<int>(1.2f * glm::length(c - b) / kStep_m) + 1, 1, kMostSteps);
    for (int k = 0; k < steps; ++k) {
      const float t = tb + (tc - tb) * static_cast<float>(k) / static_cast<float>(steps);
      const Vec2 ab = between(a, b, 0.0f, tb, t), bc = between(b, c, tb, tc, t), cd = between(c, d, tc, td, t);
      out.push_back(k == 0 ? b : between(between(ab, bc, 0.0f, tc, t), between(bc, cd, tb, td, t), tb, tc, t));
    }
  }
  if (!closed) out.push_back(points.back());
  return out;
}

}  // namespace bosquet::terrain
