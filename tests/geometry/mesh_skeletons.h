// Skeletons made for tests: trees that fork by a few rules and random numbers, with pipe-model radii.
#pragma once

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/foliage.h"
#include "growth/skeleton.h"

namespace bosquet::geometry {

inline constexpr FoliageLevel kLevels[] = {FoliageLevel::leaves, FoliageLevel::clusters, FoliageLevel::cards};

struct TestTree {
  int seasons = 12;  ///< shoots of the trunk
  int shoot = 3;     ///< internodes of the best shoot
  float internode_m = 0.25f;
  float wobble = 0.25f;     ///< random part of a heading
  float branching = 0.55f;  ///< chance that a node bears a lateral
  float spread = 0.9f;      ///< sideways part of a lateral's heading
  float tip_diameter_m = 0.006f;
  float pipe_exponent = 1.9f;
  float up = 0.15f;       ///< upward pull; below 0 the branches hang
  float shedding = 0.0f;  ///< chance that a lateral falls in the end
  int stems = 1;
};

/// A unit vector across `h`, at this azimuth.
inline Vec3 across(const Vec3& h, float azimuth) {
  const Vec3 side = glm::normalize(glm::cross(h, std::abs(h.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
  const SinCos a = sin_cos(azimuth);
  return side * a.cos + glm::cross(h, side) * a.sin;
}

inline void set_radii(growth::Skeleton& s, float tip_diameter_m, float exponent) {
  std::vector<float> pipes(s.size(), 1.0f);
  for (std::size_t i = s.size(); i-- > 0;)
    if (s.parent[i] >= 0) pipes[static_cast<std::size_t>(s.parent[i])] += pipes[i];
  s.radius.resize(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) s.radius[i] = 0.5f * tip_diameter_m * pow(pipes[i], 1.0f / exponent);
}

inline growth::Skeleton test_skeleton(const TestTree& t, std::uint64_t seed) {
  growth::Skeleton s;
  RandomStream random(seed, 1, Purpose::growth);
  struct Tip {
    std::int32_t internode;
    std::uint32_t axis;
    int order;
    Vec3 heading;
    float azimuth;
  };
  std::vector<Tip> tips;
  std::uint32_t axes = 0;
  for (int stem = 0; stem < t.stems; ++stem)
    tips.push_back(
        {-1, axes++, 0,
         glm::normalize(kUp + 0.2f * static_cast<float>(t.stems > 1) * across(kUp, static_cast<float>(stem) * 2.4f)),
         0});
  for (int season = 0; season < t.seasons; ++season) {
    const std::size_t growing = tips.size();
    for (std::size_t k = 0; k < growing; ++k) {
      const int n =
          tips[k].order == 0 ? t.shoot : static_cast<int>(random.below(static_cast<std::uint32_t>(t.shoot) + 1));
      for (int m = 0; m < n; ++m) {
        Tip& tip = tips[k];
        const float pull = tip.order == 0 ? std::max(0.15f, t.up) : t.up;
        tip.heading = glm::normalize(
            tip.heading + t.wobble * random.uniform() * across(tip.heading, random.uniform(0, 2 * kPi)) + pull * kUp);
        const Vec3 from = tip.internode < 0 ? Vec3{0.0f} : s.distal[static_cast<std::size_t>(tip.internode)];
        s.parent.push_back(tip.internode);
        s.axis.push_back(tip.axis);
        s.order.push_back(static_cast<std::uint8_t>(tip.order));
        s.distal.push_back(from + t.internode_m * tip.heading);
        s.born.push_back(static_cast<std::uint16_t>(season));
        s.shed.push_back(growth::kNever);
        s.light.push_back(1.0f);
        s.vigor.push_back(random.uniform());
        tip.internode = static_cast<std::int32_t>(s.size()) - 1;
        tip.azimuth += 2.4f;
        if (tip.order < 4 && s.size() > 3 && random.uniform() < t.branching) {
          const Vec3 lateral = glm::normalize(tip.heading + t.spread * across(tip.heading, tip.azimuth));
          const Tip bud{tip.internode, axes++, tip.order + 1, lateral, random.uniform(0, 6)};
          tips.push_back(bud);
        }
      }
    }
  }
  s.seasons = t.seasons;
  s.internode_length_m = t.internode_m;
  // What falls takes along what it carries.
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto below = static_cast<std::size_t>(std::max(0, s.parent[i]));
    const bool lateral = s.parent[i] >= 0 && s.axis[i] != s.axis[below];
    if (s.parent[i] >= 0 && s.shed[below] != growth::kNever)
      s.shed[i] = s.shed[below];
    else if (lateral && random.uniform() < t.shedding)
      s.shed[i] = static_cast<std::uint16_t>(t.seasons - 1);
  }
  set_radii(s, t.tip_diameter_m, t.pipe_exponent);
  // Light as in a crown: much at its top and skin, little within.
  float top = 0.1f, wide = 0.1f;
  for (const Vec3& p : s.distal) top = std::max(top, p.y), wide = std::max(wide, std::sqrt(p.x * p.x + p.z * p.z));
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vec3 p = s.distal[i];
    s.light[i] = std::clamp(0.6f * p.y / top + 0.5f * std::sqrt(p.x * p.x + p.z * p.z) / wide - 0.1f, 0.02f, 1.0f);
  }
  return s;
}

/// Trees of many habits: slim, bushy, hanging, gnarled, thick and short, with several stems, one twig.
inline std::vector<growth::Skeleton> test_skeletons() {
  std::vector<growth::Skeleton> all;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    all.push_back(test_skeleton({}, seed));
    all.push_back(test_skeleton({.seasons = 9, .up = -0.25f}, seed));
    all.push_back(test_skeleton({.seasons = 9, .wobble = 1.2f}, seed));
    all.push_back(test_skeleton({.seasons = 8, .internode_m = 0.12f, .pipe_exponent = 1.4f}, seed));
    all.push_back(test_skeleton({.seasons = 8, .branching = 0.9f, .spread = 3.0f, .shedding = 0.3f}, seed));
    all.push_back(test_skeleton({.seasons = 6, .stems = 7}, seed));
    all.push_back(test_skeleton({.seasons = 1, .shoot = 1, .branching = 0.0f}, seed));
  }
  return all;
}

}  // namespace bosquet::geometry
