#include "growth/detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "growth/digest.h"
#include "growth/grow.h"
#include "growth/measure.h"
#include "growth/radii.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

constexpr float kDetails[] = {0.25f, 0.5f, 0.7f, 1.5f, 2.0f, 3.3f};

/// Trees of four habits: spreading, excurrent with whorls, weeping, upright with several stems and falling branches.
std::vector<Parameters> habits() {
  std::vector<Parameters> all(4, sample_parameters());
  Parameters& excurrent = all[1];
  excurrent.internode_length_m = 0.24f, excurrent.occupancy_radius = 1.6f, excurrent.perception_depth = 2.4f;
  excurrent.apical_dominance = 0.52f, excurrent.max_shoot_length = 6;
  excurrent.buds_at = BudsAt::shoot_end, excurrent.whorl = 5, excurrent.scattered = 0.5f;
  excurrent.set_point_angle_deg = 85.0f, excurrent.branching_angle_deg = 75.0f;
  Parameters& weeping = all[2];
  weeping.max_shoot_length = 8;
  weeping.phases.push_back({0.6f, 1, 12, {}});
  weeping.phases[0].change.set_point_angle_deg = 180.0f;
  weeping.phases[0].change.straightness = 0.4f, weeping.phases[0].change.tropism = 0.5f;
  weeping.phases[0].change.space = 0.1f;
  Parameters& upright = all[3];
  upright.stems = 4, upright.shedding_threshold = 0.15f, upright.set_point_angle_deg = 20.0f;
  upright.deflection_angle_deg = 15.0f, upright.phyllotaxis = Phyllotaxis::decussate;
  return all;
}

Skeleton tree_at(const Parameters& p, std::uint64_t seed, float detail) {
  GrowthInput input = sample_input(p, seed);
  input.detail = detail;
  return grow(input);
}

TEST(Detail, TheSilhouetteIsThatOfDetailOne) {
  for (const Parameters& p : habits()) {
    for (const float detail : kDetails) {
      double crown_base[2] = {0, 0}, trunk[2] = {0, 0};
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Measures one = measure(tree_at(p, seed, 1.0f)), other = measure(tree_at(p, seed, detail));
        EXPECT_EQ(other.height_m, one.height_m) << "detail " << detail;
        EXPECT_NEAR(other.crown_diameter_m / one.crown_diameter_m, 1.0f, 0.02f) << "detail " << detail;
        crown_base[0] += one.crown_base_m, crown_base[1] += other.crown_base_m;
        trunk[0] += one.trunk_diameter_m, trunk[1] += other.trunk_diameter_m;
      }
      EXPECT_NEAR(crown_base[1] / crown_base[0], 1.0, 0.05) << "detail " << detail;
      // Internodes of up to a metre around 1.3 m: a limb more or less.
      EXPECT_NEAR(trunk[1] / trunk[0], 1.0, 0.1) << "detail " << detail;
    }
  }
}

TEST(Detail, InternodesAreAsManyTimesShorter) {
  for (const Parameters& p : habits()) {
    const auto one = static_cast<double>(tree_at(p, 1, 1.0f).size());
    for (const float detail : {1.5f, 2.0f, 4.0f}) {
      // A run of n internodes becomes floor(n k) pieces: up to one less.
      EXPECT_LE(static_cast<double>(tree_at(p, 1, detail).size()), one * static_cast<double>(detail));
      EXPECT_GT(static_cast<double>(tree_at(p, 1, detail).size()), one * (static_cast<double>(detail) - 0.5));
    }
    // Coarser, no axis is left out: one internode of it stays at least.
    EXPECT_LT(static_cast<double>(tree_at(p, 1, 0.5f).size()), 0.67 * one);
    EXPECT_LT(static_cast<double>(tree_at(p, 1, 0.25f).size()), 0.5 * one);
  }
}

TEST(Detail, NoPipeIsLost) {
  for (const Parameters& p : habits()) {
    const Skeleton one = tree_at(p, 2, 1.0f);
    for (const float detail : kDetails) {
      const Skeleton s = tree_at(p, 2, detail);
      std::size_t pipes = 0;
      for (std::size_t i = 0; i < s.size(); ++i) pipes += static_cast<std::size_t>(s.own_pipes(i));
      EXPECT_EQ(pipes, one.size()) << "detail " << detail;
    }
  }
}

TEST(Detail, WholePiecesLeaveNodesRadiiAndSeasonsAsTheyAre) {
  for (const Parameters& p : habits()) {
    const Skeleton one = tree_at(p, 3, 1.0f), two = tree_at(p, 3, 2.0f);
    ASSERT_EQ(two.size(), 2 * one.size());
    const int season = one.seasons / 2;
    const std::vector<float> before = radii(one, season), before_two = radii(two, season);
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(two.distal[2 * i + 1], one.distal[i]);
      for (const std::size_t piece : {2 * i, 2 * i + 1}) {
        ASSERT_EQ(two.radius[piece], one.radius[i]);
        ASSERT_EQ(before_two[piece], before[i]);
        ASSERT_EQ(two.born[piece], one.born[i]);
        ASSERT_EQ(two.shed[piece], one.shed[i]);
      }
      ASSERT_GE(two.distal[2 * i].y, 0.0f);
      // The curve's middle is off the chord's by at most an eighth of what its tangents differ.
      const Vec3 middle = 0.5f * (one.distal[i] + one.proximal(i));
      ASSERT_LE(glm::length(two.distal[2 * i] - middle), 0.25f * one.internode_length_m);
    }
  }
}

TEST(Detail, AParentPrecedesItsChildrenAndOutlivesThem) {
  for (const Parameters& p : habits()) {
    for (const float detail : kDetails) {
      const Skeleton s = tree_at(p, 4, detail);
      for (std::size_t i = 0; i < s.size(); ++i) {
        ASSERT_LT(s.parent[i], static_cast<std::int32_t>(i));
        if (s.parent[i] < 0) continue;
        const auto parent = static_cast<std::size_t>(s.parent[i]);
        ASSERT_LE(s.born[parent], s.born[i]);
        ASSERT_GE(s.shed[parent], s.shed[i]);
        ASSERT_LE(s.order[parent], s.order[i]);
      }
    }
  }
}

TEST(Detail, EveryAxisEndsWhereItGrew) {
  for (const Parameters& p : habits()) {
    const Skeleton one = tree_at(p, 5, 1.0f);
    const auto tips = [](const Skeleton& s) {
      std::vector<Vec3> tip;
      for (std::size_t i = 0; i < s.size(); ++i) {
        tip.resize(std::max<std::size_t>(tip.size(), s.axis[i] + 1));
        tip[s.axis[i]] = s.distal[i];
      }
      return tip;
    };
    for (const float detail : kDetails) EXPECT_EQ(tips(tree_at(p, 5, detail)), tips(one)) << "detail " << detail;
  }
}

TEST(Detail, CoarserWoodLeavesOutBendsNotLimbs) {
  // Limbs stay on their own node: where a branch moved it is the lightest of its run.
  const Skeleton one = tree_at(sample_parameters(), 6, 1.0f), half = tree_at(sample_parameters(), 6, 0.5f);
  const auto heavy_bases = [](const Skeleton& s) {
    std::vector<int> carried(s.size(), 0);
    std::vector<std::pair<std::uint32_t, Vec3>> bases;
    for (std::size_t i = s.size(); i-- > 0;) {
      carried[i] += s.own_pipes(i);
      if (s.parent[i] < 0) continue;
      const auto p = static_cast<std::size_t>(s.parent[i]);
      carried[p] += carried[i];
      if (s.axis[p] != s.axis[i] && carried[i] >= 100) bases.push_back({s.axis[i], s.proximal(i)});
    }
    std::sort(bases.begin(), bases.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return bases;
  };
  const auto a = heavy_bases(one), b = heavy_bases(half);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 5u);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].first, b[i].first);
    moved += a[i].second != b[i].second;
    EXPECT_LE(glm::length(a[i].second - b[i].second), 2.01f * one.internode_length_m);
  }
  EXPECT_LE(moved, a.size() / 4);
}

TEST(Detail, AnEmptyTreeStaysEmpty) {
  for (const float detail : kDetails) EXPECT_EQ(at_detail(Skeleton{}, detail).size(), 0u);
}

}  // namespace
}  // namespace bosquet::growth
