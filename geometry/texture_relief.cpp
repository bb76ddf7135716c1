#include "geometry/texture_relief.h"

#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

// The mean of 2 * radius + 1 samples around each of a wrapped line, every `stride` floats. Sums are restarted each
// line, so a line's means depend on that line alone.
void box_line(const float* in, float* out, int n, int radius, std::size_t stride) {
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  const auto wrapped = [n](int i) { return static_cast<std::size_t>((i + n) % n); };
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += in[wrapped(i) * stride];
  for (int i = 0; i < n; ++i) {
    out[static_cast<std::size_t>(i) * stride] = static_cast<float>(sum) * scale;
    sum += in[wrapped(i + radius + 1) * stride] - in[wrapped(i - radius) * stride];
  }
}

}  // namespace

Image normal_map(const Relief& relief, float steepest) {
  const int n = relief.size;
  Image image(n, n, 3);
  const float per_slope = 0.5f * static_cast<float>(n) / relief.side;
  parallel_for(
      static_cast<std::size_t>(n),
      [&](std::size_t row) {
        const int y = static_cast<int>(row), above = (y + n - 1) % n, below = (y + 1) % n;
        for (int x = 0; x < n; ++x) {
          const float right = relief.at(x + 1 == n ? 0 : x + 1, y), left = relief.at(x == 0 ? n - 1 : x - 1, y);
          Vec2 slope{(right - left) * per_slope, (relief.at(x, above) - relief.at(x, below)) * per_slope};
          // A soft limit keeps the direction: s / sqrt(1 + (s / steepest)^2).
          const float s2 = slope.x * slope.x + slope.y * slope.y;
          slope *= 1.0f / std::sqrt(1.0f + s2 / (steepest * steepest));
          const float inverse = 1.0f / std::sqrt(1.0f + slope.x * slope.x + slope.y * slope.y);
          put_normal(image.at(x, y), Vec3(-slope.x, -slope.y, 1.0f) * inverse);
        }
      },
      16);
  return image;
}

Relief hollowness(const Relief& relief, int radius) {
  const int n = relief.size;
  assert(radius >= 1 && 2 * radius + 1 <= n);
  Relief across(n, relief.side), out(n, relief.side);
  const auto stride = static_cast<std::size_t>(n);
  parallel_for(
      stride, [&](std::size_t y) { box_line(&relief.heights[y * stride], &across.heights[y * stride], n, radius, 1); },
      16);
  parallel_for(
      stride, [&](std::size_t x) { box_line(&across.heights[x], &out.heights[x], n, radius, stride); }, 16);
  parallel_for(
      stride,
      [&](std::size_t y) {
        for (std::size_t i = y * stride; i < (y + 1) * stride; ++i) out.heights[i] -= relief.heights[i];
      },
      16);
  return out;
}

}  // namespace bosquet::geometry
