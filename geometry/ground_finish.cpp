#include "geometry/ground_finish.h"

#include "core/parallel.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {

GroundTextures finish_ground(const std::vector<Vec3>& colours, const Relief& relief) {
  const auto n = static_cast<std::size_t>(relief.size);
  // Summed row by row.
  const Vec3 sum = deterministic_reduce(
      n, 64, Vec3(0.0f),
      [&](std::size_t begin, std::size_t end) {
        Vec3 part{0.0f};
        for (std::size_t i = begin * n; i < end * n; ++i) part += colours[i];
        return part;
      },
      [](Vec3 a, const Vec3& b) { return a + b; });
  const Vec3 scale = kGroundMean * (static_cast<float>(n) * static_cast<float>(n)) / sum;
  GroundTextures out{Image(relief.size, relief.size, 3), normal_map(relief, 1.0f)};
  parallel_for(
      n,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < n; ++x)
          put_srgb(out.base_colour.at(static_cast<int>(x), static_cast<int>(y)), colours[y * n + x] * scale);
      },
      16);
  return out;
}

}  // namespace bosquet::geometry
