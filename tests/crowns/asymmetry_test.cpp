#include "crowns/asymmetry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "stands.h"

namespace bosquet::crowns {
namespace {

constexpr float kStep = 1.0f / 64.0f;

CrownSpace divide_flat(const std::vector<Claimant>& trees, float side_m) {
  auto space = divide_space(trees, flat(side_m), SpaceOptions{});
  EXPECT_TRUE(space);
  return *std::move(space);
}

AsymmetryOptions uncapped() {
  AsymmetryOptions o;
  o.area_ratio_cap = o.asymmetry_max = kUnlimited;
  return o;
}

// Eq. 6.4's ratio from the voxels of the region, in tree frame.
double displacement(const CrownSpace& space, std::size_t t) {
  const CrownRegion r = region(space, t);
  double sum = 0, voxels = 0;
  for (int j = 0; j < r.cells.y; ++j) {
    std::vector<DVec2> held;
    DVec2 centre{0.0};
    for (int k = 0; k < r.cells.z; ++k)
      for (int i = 0; i < r.cells.x; ++i)
        if (r.voxel({i, j, k})) {
          held.push_back({r.low.x + (i + 0.5) * r.voxel_m, r.low.z + (k + 0.5) * r.voxel_m});
          centre += held.back();
        }
    if (held.empty()) continue;
    centre /= static_cast<double>(held.size());
    double radius = 0;
    for (DVec2 p : held) radius = std::max(radius, glm::length(p - centre));
    sum += static_cast<double>(held.size()) * std::min(1.0, glm::length(centre) / radius);
    voxels += static_cast<double>(held.size());
  }
  return sum / voxels;
}

TEST(Asymmetry, ALoneTreeHasNone) {
  EXPECT_EQ(neighbourhood_asymmetry(divide_flat({tree(1, {15, 15}, 8, 10)}, 30), {}), std::vector{Vec3(0.0f)});
  // Nor have two that stand farther apart than 1.5 crown widths of the wider one.
  const auto apart = neighbourhood_asymmetry(divide_flat({tree(1, {5, 5}, 4, 10), tree(2, {12.6f, 5}, 5, 10)}, 30), {});
  EXPECT_EQ(apart, (std::vector{Vec3(0.0f), Vec3(0.0f)}));
  EXPECT_TRUE(neighbourhood_asymmetry(divide_flat({}, 30), {}).empty());
}

TEST(Asymmetry, APairFollowsEquations63And64) {
  const std::vector trees{tree(1, {15, 15}, 6, 10), tree(2, {17, 18}, 9, 12)};
  const auto space = divide_flat(trees, 40);
  const auto v = neighbourhood_asymmetry(space, uncapped());
  const double distance = std::sqrt(13.0), radius = 1.5 * 9.0;
  for (std::size_t i : {0u, 1u}) {
    const std::size_t j = 1 - i;
    const double areas = static_cast<double>(trees[j].projected_area_m2() / trees[i].projected_area_m2());
    const double weight = 1.0 * areas + 2.0 * (1.0 - distance / radius);
    const DVec2 away = (DVec2(trees[i].base) - DVec2(trees[j].base)) / distance;
    const DVec2 expected = displacement(space, i) * weight * away;
    EXPECT_NEAR(static_cast<double>(v[i].x), expected.x, 0.51 * kStep);
    EXPECT_NEAR(static_cast<double>(v[i].z), -expected.y, 0.51 * kStep);  // z runs south
    EXPECT_EQ(v[i].y, 0.0f);
  }
}

TEST(Asymmetry, VectorsAtAClustersRimPointOutwardAndNearlyVanishInItsMiddle) {
  // A round cluster of equal trees on a slightly disturbed triangular lattice.
  std::vector<Claimant> trees;
  const Vec2 middle{30, 30};
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      RandomStream draw(4, static_cast<std::uint64_t>((j + 6) * 13 + i + 6), Purpose::planting);
      const float east = (static_cast<float>(i) + 0.5f * static_cast<float>(j)) * 2.5f + draw.uniform(-0.2f, 0.2f);
      const float north = static_cast<float>(j) * 2.165f + draw.uniform(-0.2f, 0.2f);
      if (east * east + north * north < 12.0f * 12.0f)
        trees.push_back(tree(static_cast<std::int32_t>(trees.size()) + 1, middle + Vec2{east, north}, 6, 10));
    }
  ASSERT_GT(trees.size(), 60u);
  const auto v = neighbourhood_asymmetry(divide_flat(trees, 60), uncapped());
  double rim = 0, inner = 0;
  int rims = 0, inners = 0;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    const Vec2 out = trees[t].base - middle;
    const float distance = glm::length(out);
    const Vec2 plan = to_plan(v[t]);
    if (distance > 10.0f) {
      const float length = glm::length(plan);
      rim += static_cast<double>(length), ++rims;
      EXPECT_GT(glm::dot(plan, out), 0.8f * length * distance) << "tree " << t << " leans more than 37 degrees off";
    } else if (distance < 3.0f) {
      inner += static_cast<double>(glm::length(plan)), ++inners;
    }
  }
  ASSERT_GT(rims, 10);
  ASSERT_GT(inners, 3);
  EXPECT_GT(rim / rims, 1.0);
  EXPECT_LT(inner / inners, 0.1 * rim / rims);
}

TEST(Asymmetry, LargerNeighboursPushHarderAndAreHardlyPushedThemselves) {
  const auto v =
      neighbourhood_asymmetry(divide_flat({tree(1, {15, 15}, 10, 16), tree(2, {19, 15}, 6, 10)}, 40), uncapped());
  EXPECT_LT(v[0].x, 0.0f);
  EXPECT_GT(v[1].x, 0.0f);
  EXPECT_GT(v[1].x, 2.0f * -v[0].x);
}

TEST(Asymmetry, ItIsCappedForASmallTreeBesideAGiant) {
  // At the edge of the giant's reach, so that the small tree has room to yield to: 16 times the area would be V = 8.
  const auto space = divide_flat({tree(1, {20, 20}, 20, 25), tree(2, {34, 20}, 5, 8)}, 60);
  EXPECT_GT(neighbourhood_asymmetry(space, uncapped())[1].x, 4.0f);
  EXPECT_EQ(neighbourhood_asymmetry(space, {})[1], Vec3(1.0f, 0.0f, 0.0f));
}

TEST(Asymmetry, CoincidentBasesPartInOppositeDirections) {
  const std::vector trees{tree(1, {15, 15}, 8, 10), tree(2, {15, 15}, 8, 10)};
  AsymmetryOptions o = uncapped();
  const auto v = neighbourhood_asymmetry(divide_flat(trees, 30), o);
  for (const Vec3& each : v) {
    EXPECT_TRUE(std::isfinite(each.x) && std::isfinite(each.z));
    EXPECT_GT(glm::length(each), 4 * kStep);
  }
  EXPECT_LT(glm::dot(glm::normalize(v[0]), glm::normalize(v[1])), -0.9f);
}

TEST(Asymmetry, ItIsTheSameForAnyOrderOfTreesAndNumberOfThreads) {
  auto trees = clustered(6, 100, 40.0f, 7.0f, 12.0f, 4.0f);
  trees[50].base = trees[51].base;
  const auto expected = neighbourhood_asymmetry(divide_flat(trees, 40), {});
  for (int threads : {1, 8})
    run_with_threads(threads, [&] { EXPECT_EQ(neighbourhood_asymmetry(divide_flat(trees, 40), {}), expected); });
  std::reverse(trees.begin(), trees.end());
  auto reversed = neighbourhood_asymmetry(divide_flat(trees, 40), {});
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(reversed, expected);
}

TEST(Asymmetry, ComponentsAreMultiplesOfASixtyFourth) {
  for (const Vec3& v : neighbourhood_asymmetry(divide_flat(clustered(2, 50, 30.0f, 7.0f, 12.0f, 4.0f), 30), {})) {
    EXPECT_EQ(v.x * 64.0f, std::round(v.x * 64.0f));
    EXPECT_EQ(v.z * 64.0f, std::round(v.z * 64.0f));
  }
}

}  // namespace
}  // namespace bosquet::crowns
