// Claims of the method's source about what each parameter does, tree by tree over 20 seeds.
//
// Source    Longay 2014, figs. 4.12, 4.13, 4.15-4.18, 4.22, 4.24, 6.20
// The unit is the tree: branches of one tree are not independent. Trees stand free unless said.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/scalar.h"
#include "growth/age.h"
#include "growth/directions.h"
#include "growth/grow.h"
#include "growth/measure.h"
#include "growth/tree.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

constexpr std::uint64_t kSeeds = 20;

Vec3 heading(const Skeleton& s, std::size_t i) { return glm::normalize(s.distal[i] - s.proximal(i)); }

TEST(GrowthClaims, LightSensitivityThinsTheCrownButKeepsItsSilhouette) {
  // Shadows strong and short, about as in Palubicki et al. 2009; under long ones the low, wide limbs slow down too.
  Parameters low = sample_parameters();
  low.shadow_strength = 0.2f, low.shadow_falloff = 2.5f;
  Parameters high = low;
  low.light_sensitivity = 0.5f, high.light_sensitivity = 2.5f;
  Sample internodes[2], height[2], width[2];
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (int k = 0; k < 2; ++k) {
      const Measures m = measure(grow(sample_input(k ? high : low, seed)));
      internodes[k].add(m.internodes), height[k].add(m.height_m), width[k].add(m.crown_diameter_m);
    }
  }
  EXPECT_LE(internodes[1].mean(), 0.8 * internodes[0].mean());
  EXPECT_NEAR(height[1].mean() / height[0].mean(), 1.0, 0.1);
  EXPECT_NEAR(width[1].mean() / width[0].mean(), 1.0, 0.1);
}

TEST(GrowthClaims, RaisingApicalDominanceMakesTallerNarrowerTrees) {
  const std::array<float, 5> lambdas{0.46f, 0.48f, 0.5f, 0.52f, 0.54f};
  std::vector<double> lambda, slenderness;
  for (const float l : lambdas) {
    Parameters p = sample_parameters();
    p.apical_dominance = l;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Measures m = measure(grow(sample_input(p, seed)));
      lambda.push_back(l), slenderness.push_back(m.height_m / m.crown_diameter_m);
    }
  }
  // Spearman's rho: Pearson's correlation of ranks, ties sharing their mean rank.
  const auto ranks = [](const std::vector<double>& v) {
    std::vector<double> r(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      for (const double other : v) r[i] += other < v[i] ? 1.0 : other == v[i] ? 0.5 : 0.0;
    }
    return r;
  };
  const std::vector<double> a = ranks(lambda), b = ranks(slenderness);
  const double mean = 0.5 * static_cast<double>(a.size());
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean), aa += (a[i] - mean) * (a[i] - mean), bb += (b[i] - mean) * (b[i] - mean);
  }
  EXPECT_GE(ab / std::sqrt(aa * bb), 0.5);
}

TEST(GrowthClaims, StraightnessMakesAxesStraighter) {
  Sample chord_over_arc[2];
  for (int k = 0; k < 2; ++k) {
    Parameters p = sample_parameters();
    p.straightness = k ? 0.8f : 0.1f;
    p.tropism = k ? 0.05f : 0.2f, p.space = 1.0f - p.straightness - p.tropism;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Skeleton s = grow(sample_input(p, seed));
      std::vector<int> count(s.size() + 1, 0);
      std::vector<Vec3> first(s.size() + 1), last(s.size() + 1);
      for (std::size_t i = 0; i < s.size(); ++i) {
        if (count[s.axis[i]]++ == 0) first[s.axis[i]] = s.proximal(i);
        last[s.axis[i]] = s.distal[i];
      }
      Sample axes;
      for (std::size_t a = 0; a < count.size(); ++a) {
        if (count[a] >= 10) {
          axes.add(glm::length(last[a] - first[a]) / (static_cast<float>(count[a]) * s.internode_length_m));
        }
      }
      chord_over_arc[k].add(axes.mean());
    }
  }
  EXPECT_GT(difference_in_errors(chord_over_arc[0], chord_over_arc[1]), 3.0);
}

TEST(GrowthClaims, TheSetPointAngleSetsTheInclinationOfBranches) {
  std::array<Sample, 4> inclination;
  for (std::size_t k = 0; k < 4; ++k) {
    Parameters p = sample_parameters();
    p.set_point_angle_deg = 45.0f * static_cast<float>(k);
    p.apical_dominance = 0.52f;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Skeleton s = grow(sample_input(p, seed, 9.0f));
      Sample branches;
      for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.order[i] == 1) branches.add(degrees(acos(heading(s, i).y)));
      }
      inclination[k].add(90.0 - branches.mean());
    }
  }
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_LT(difference_in_errors(inclination[k - 1], inclination[k]), -3.0) << 45 * k << " degrees";
  }
}

TEST(GrowthClaims, LongShootsWithDownwardTropismHangLower) {
  // Upward at first, then down, as the source's figure: how far tips hang below where their branch leaves.
  std::array<Sample, 2> hang;
  for (std::size_t k = 0; k < 2; ++k) {
    Parameters p = sample_parameters();
    p.phases.push_back({0.6f, 1, 12, {}});
    p.phases[0].change.set_point_angle_deg = 180.0f;
    p.phases[0].change.straightness = 0.4f, p.phases[0].change.tropism = 0.5f, p.phases[0].change.space = 0.1f;
    p.phases[0].change.max_shoot_length = k ? 8 : 2;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Skeleton s = grow(sample_input(p, seed, 9.0f));
      std::vector<float> foot(s.size() + 1, -1.0f), low(s.size() + 1, 0.0f);
      for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.order[i] == 0 || s.distal[i].y < 0.0f) continue;
        if (foot[s.axis[i]] < 0.0f) foot[s.axis[i]] = s.proximal(i).y;
        low[s.axis[i]] = s.distal[i].y;
      }
      // The mean of the tenth that hangs lowest, as most axes are short.
      std::vector<float> depth;
      for (std::size_t a = 0; a < foot.size(); ++a) {
        if (foot[a] >= 0.0f) depth.push_back(foot[a] - low[a]);
      }
      std::sort(depth.begin(), depth.end(), std::greater<>());
      depth.resize(std::max<std::size_t>(1, depth.size() / 10));
      hang[k].add(std::accumulate(depth.begin(), depth.end(), 0.0) / static_cast<double>(depth.size()));
    }
  }
  EXPECT_GT(difference_in_errors(hang[0], hang[1]), 3.0);
}

/// Mean of f(chi) over lateral buds that broke minus that over all lateral buds, of one tree, on parents that lean 45
/// to 135 degrees from upright; chi is the bud's azimuth about its parent, 0 on the upper side.
template <class F>
double favoured_side(const Parameters& p, std::uint64_t seed, const F& f) {
  const GrowthInput input = sample_input(p, seed);
  Tree tree;
  plant(tree, input);
  std::vector<double> side;  // by bud, NaN where the parent is too upright
  while (!tree.finished) {
    grow_season(tree);
    // Buds are seen in the season that made them: later they move on as tips.
    for (std::size_t b = side.size(); b < tree.buds.size(); ++b) {
      side.push_back(std::nan(""));
      if (tree.buds.origin[b].carrier < 0) continue;
      const Vec3 h = tree.internodes.parts[static_cast<std::size_t>(tree.buds.origin[b].carrier)].heading;
      if (std::abs(h.y) > 0.70710678f) continue;
      const Vec3 across = glm::normalize(tree.buds[b].direction - glm::dot(tree.buds[b].direction, h) * h);
      side.back() = f(glm::dot(across, most_vertical(h)));
    }
  }
  double all = 0, broken = 0;
  int n_all = 0, n_broken = 0;
  for (std::size_t b = 0; b < side.size(); ++b) {
    if (std::isnan(side[b])) continue;
    all += side[b], ++n_all;
    if (tree.buds.origin[b].axis > 0) broken += side[b], ++n_broken;
  }
  return broken / n_broken - all / n_all;
}

/// One-sided t-test that the mean over the seeds is above 0 at p < 0.001: t(19) > 3.579.
template <class F>
double t_of_favoured_side(const Parameters& p, const F& f) {
  Sample trees;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) trees.add(favoured_side(p, seed, f));
  return trees.mean() / trees.standard_error();
}

TEST(GrowthClaims, EpitonyHypotonyAndAmphitonyFavourTheirSide) {
  constexpr double kCritical = 3.579;
  Parameters p = sample_parameters();
  p.set_point_angle_deg = 80.0f;
  p.gravimorphism_offset = 0.6f;
  EXPECT_GT(t_of_favoured_side(p, [](double cos) { return cos; }), kCritical) << "epitony";
  p.gravimorphism_offset = -0.6f;
  EXPECT_GT(t_of_favoured_side(p, [](double cos) { return -cos; }), kCritical) << "hypotony";
  p.gravimorphism_offset = 0.0f, p.gravimorphism_vertical = 0.4f, p.gravimorphism_level = 1.5f;
  EXPECT_GT(t_of_favoured_side(p, [](double cos) { return -cos * cos; }), kCritical) << "amphitony";
}

TEST(GrowthClaims, AsymmetryTiltsTheTrunkAlongItself) {
  // Azimuth and lean of the trunk at a third of the height.
  Parameters p = sample_parameters();
  p.apical_dominance = 0.52f;
  const auto trunk_at_third = [&](std::uint64_t seed, float v) {
    GrowthInput input = sample_input(p, seed);
    input.key = seed;
    input.asymmetry = {0.6f * v, 0.0f, 0.8f * v};
    const Skeleton s = grow(input);
    Vec3 at{0.0f};
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s.order[i] == 0 && s.distal[i].y <= 4.0f) at = s.distal[i];
    }
    return at;
  };
  Sample before;
  DVec2 resultant{0.0};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Vec3 at = trunk_at_third(seed, 0.0f);
    resultant += glm::normalize(DVec2(at.x, at.z)) / static_cast<double>(kSeeds);
    before.add((0.6f * at.x + 0.8f * at.z) / at.y);
  }
  EXPECT_LT(glm::length(resultant), 0.39) << "Rayleigh: no direction without asymmetry";
  for (const float v : {0.25f, 0.5f, 1.0f}) {
    Sample lean;
    DVec2 mean{0.0};
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Vec3 at = trunk_at_third(seed, v);
      mean += glm::normalize(DVec2(at.x, at.z));
      lean.add((0.6f * at.x + 0.8f * at.z) / at.y);
    }
    mean = glm::normalize(mean);
    EXPECT_GT(mean.x * 0.6 + mean.y * 0.8, std::cos(20.0 * 3.14159265 / 180.0)) << "V = " << v;
    EXPECT_GT(difference_in_errors(before, lean), 2.0) << "V = " << v;
    before = lean;
  }
}

TEST(GrowthClaims, WithoutTheSpaceOnOneSideTheCrownMovesToTheOther) {
  const Parameters p = sample_parameters();
  crowns::CrownRegion half;
  half.voxel_m = half.layer_m = 0.5f;
  half.low = {-0.5f, 0.0f, -12.0f}, half.cells = {25, 28, 48};
  half.bits.assign((static_cast<std::size_t>(25 * 28 * 48) + 63) / 64, ~std::uint64_t{0});
  Sample bounded, free;  // centroid east of the base, in crown widths
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    GrowthInput input = sample_input(p, seed);
    Measures m = measure(grow(input));
    free.add(m.crown_centroid.x / m.crown_diameter_m);
    input.region = &half;
    m = measure(grow(input));
    bounded.add(m.crown_centroid.x / m.crown_diameter_m);
  }
  EXPECT_LT(std::abs(free.mean()), 3.0 * free.standard_error()) << "no side without a reason";
  EXPECT_GT(bounded.mean(), 0.15);
  EXPECT_GT(difference_in_errors(free, bounded), 3.0);
}

TEST(GrowthClaims, InAClosedStandTheCrownBaseRisesAndTheTrunkIsThinner) {
  // The light that a stand of leaf area index 6 lets through down to y: exp(-LAI / 2 * (1 - y / h)).
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.1f, p.light_sensitivity = 2.0f;
  const auto stand_of = [](float leaf_area_index) {
    Transmittance light;
    light.low = {-20.0f, 0.0f, -20.0f}, light.cells = {40, 14, 40};
    for (int y = 0; y < 14; ++y) {
      const float depth = std::max(0.0f, 1.0f - (static_cast<float>(y) + 0.5f) / 12.0f);
      const float open = std::exp(-0.5f * leaf_area_index * depth);
      light.level.insert(light.level.end(), 1600,
                         static_cast<std::uint8_t>(std::clamp(open * 16.0f - 0.5f, 0.0f, 15.0f)));
    }
    return light;
  };
  std::array<Sample, 3> base, trunk;
  const std::array<float, 3> indices{0.0f, 3.0f, 6.0f};
  for (std::size_t k = 0; k < 3; ++k) {
    const Transmittance light = stand_of(indices[k]);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      GrowthInput input = sample_input(p, seed);
      input.light = &light;
      const Measures m = measure(grow(input));
      base[k].add(m.crown_base_m / m.height_m), trunk[k].add(m.trunk_diameter_m);
    }
  }
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_GT(difference_in_errors(base[k - 1], base[k]), 3.0) << "leaf area index " << indices[k];
    EXPECT_LT(difference_in_errors(trunk[k - 1], trunk[k]), -3.0) << "leaf area index " << indices[k];
  }
  EXPECT_GT(base[2].mean(), 1.5 * base[0].mean());
}

TEST(GrowthClaims, AShortYouthMakesYoungTreesWiderForTheirHeight) {
  Sample width[2];
  for (int k = 0; k < 2; ++k) {
    Parameters p = sample_parameters();
    p.max_shoot_length = 6, p.apical_dominance = 0.52f, p.youth = k ? 0.3f : 0.0f;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Skeleton s = grow(sample_input(p, seed));
      const Measures young = measure(s, season_at_height(s, 2.4f));
      width[k].add(young.crown_diameter_m / young.height_m);
    }
  }
  EXPECT_GT(difference_in_errors(width[0], width[1]), 3.0);
}

}  // namespace
}  // namespace bosquet::growth
