// Sky: 13 directions from which light reaches a canopy, as cells passed on the way, and what leaves let through.
//
// Source    Beer-Lambert (Monsi and Saeki 1953) with extinction 1/2, that of leaves at all inclinations seen from any
//           direction; standard overcast sky, luminance as 1 + 2 sin(elevation) (Moon and Spencer 1942)
// Model     a ray of direction d from a cell's centre passes a leaf area index p = sum of what its samples hold, at
//           0 m (half a metre long) and then every metre; it lets exp(-p / 2) through
// Decision  weights are the shares of a level surface's light: the zenith stands for elevations above 75 deg, the ring
//           at 60 deg for 47.5 to 75 deg, the ring at 35 deg for all below. Six directions each, the upper ring turned
//           by 30 deg
// Decision  whole numbers throughout, so that sums are exact in any order: leaf area in 2^-14 m2, exp(-p / 2) and
//           weights in 2^-16, p rounded to 1/256
// Frame     cells of 1 m on the world's lattice, (east, up, north)
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/scalar.h"
#include "core/vec.h"

namespace bosquet::crowns {

inline constexpr int kLeafBits = 14;  ///< leaf area is counted in 2^-14 m2

/// The cells that one direction's samples lie in, relative to the cell they start from, from the second sample on.
struct SkyRay {
  std::vector<IVec3> steps;  ///< (east, up, north), never downward
  std::uint32_t weight = 0;  ///< of 65536
};

/// All rays, followed until `reach_m` of horizontal distance or `most_up` cells of height.
inline std::vector<SkyRay> sky_rays(float reach_m, std::int32_t most_up) {
  constexpr double kCos60 = 0.5, kSin60 = 0.8660254037844386, kCos35 = 0.8191520442889918, kSin35 = 0.573576436351046;
  constexpr std::array<DVec2, 6> kRing{
      {{1, 0}, {kCos60, kSin60}, {-kCos60, kSin60}, {-1, 0}, {-kCos60, -kSin60}, {kCos60, -kSin60}}};
  struct Direction {
    double east, up, north;
    std::uint32_t weight;
  };
  // The zenith takes what rounding leaves of 65536.
  std::vector<Direction> directions{{0, 1, 0, 5578}};
  for (const DVec2& a : kRing) directions.push_back({a.x * kCos35, kSin35, a.y * kCos35, 5046});
  for (const DVec2& a : kRing) directions.push_back({a.y * kCos60, kSin60, a.x * kCos60, 4947});

  std::vector<SkyRay> rays;
  for (const Direction& d : directions) {
    SkyRay ray;
    ray.weight = d.weight;
    const double level = std::sqrt(d.east * d.east + d.north * d.north);
    for (int n = 1; n * level <= static_cast<double>(reach_m); ++n) {
      const auto cell = [n](double along) { return static_cast<std::int32_t>(std::floor(0.5 + n * along)); };
      const IVec3 step{cell(d.east), cell(d.up), cell(d.north)};
      if (step.y > most_up) break;
      ray.steps.push_back(step);
    }
    rays.push_back(std::move(ray));
  }
  return rays;
}

/// Light that leaves let through, and the sixteen levels that growth reads.
class Attenuation {
 public:
  Attenuation() {
    for (int p = 0;; ++p) {
      const float share = exp(-0.5f * static_cast<float>(p) / 256.0f) * 65536.0f;
      passed_.push_back(static_cast<std::uint32_t>(share + 0.5f));
      if (passed_.back() == 0) break;
    }
  }
  /// 65536 exp(-p / 2), `doubled` twice the leaf area index p in 2^-14.
  std::uint32_t passed(std::uint32_t doubled) const {
    const std::uint32_t p = (doubled + 64u) >> (kLeafBits + 1 - 8);
    return p < passed_.size() ? passed_[p] : 0u;
  }
  /// The level whose transmittance (level + 1) / 16 is nearest; `light` in 2^-32.
  static std::uint8_t level(std::uint64_t light) {
    const std::uint64_t sixteenths = (light + (std::uint64_t{1} << 27)) >> 28;
    return static_cast<std::uint8_t>(sixteenths == 0 ? 0 : sixteenths - 1);
  }

 private:
  std::vector<std::uint32_t> passed_;
};

}  // namespace bosquet::crowns
