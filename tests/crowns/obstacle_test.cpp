#include "crowns/obstacle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/parallel.h"
#include "crowns/asymmetry.h"
#include "crowns/mesh_solid.h"
#include "crowns/vdb.h"
#include "stands.h"

namespace bosquet::crowns {
namespace {

constexpr VoxelSize kFine{0.25f, 1.0f};

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (std::uint32_t i : b.indices) a.indices.push_back(first + i);
  return a;
}

TriangleMesh without_roof(TriangleMesh box) {
  box.indices.resize(box.indices.size() - 6);
  return box;
}

std::size_t voxels(const ObstacleVolume& v) {
  std::size_t n = 0;
  for (const ColumnSpan& s : v.spans) n += static_cast<std::size_t>(s.high - s.low);
  return n;
}

TEST(Obstacle, AClosedMeshIsFilledWithinHalfAVoxelOfItsSurface) {
  // Walls on the borders between voxels: the half voxel beside them is not taken.
  const Vec3 low{3.0f, 0.0f, -9.0f}, high{9.0f, 5.0f, -4.0f};
  const auto volume = voxelise(box_mesh(low, high), kFine);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->warning, "");
  for (int j = 0; j < 60; ++j)
    for (int k = -2; k < 9; ++k)
      for (int i = 0; i < 60; ++i) {
        const Vec3 centre = to_world((Vec2(i, j) + 0.5f) * 0.25f, static_cast<float>(k) + 0.5f);
        const bool inside = glm::all(glm::greaterThan(centre, low)) && glm::all(glm::lessThan(centre, high));
        EXPECT_EQ(holds(*volume, {i, k, j}), inside) << i << ", " << k << ", " << j;
      }
}

TEST(Obstacle, AnExtrudedOutlineEqualsTheMeshOfItsPrism) {
  const auto mesh = voxelise(box_mesh({3.07f, 0.0f, -9.41f}, {9.3f, 5.0f, -4.2f}), kFine);
  const auto prism = extrude(rectangle({3.07f, 4.2f}, {9.3f, 9.41f}), 0.0f, 5.0f, kFine);
  ASSERT_TRUE(mesh);
  // But for the voxels at the upright edges, where half a voxel is measured round the corner.
  EXPECT_NEAR(static_cast<double>(voxels(*mesh)), static_cast<double>(voxels(prism)), 4 * 5);
  EXPECT_EQ(mesh->low, prism.low);
  EXPECT_EQ(mesh->high, prism.high);
}

TEST(Obstacle, AWallThinnerThanAVoxelHasNoHoles) {
  for (float angle : {0.0f, 0.3f, 0.8f}) {
    const SinCos a = sin_cos(angle);
    const Vec2 along{a.cos, a.sin}, across = 0.02f * Vec2{-a.sin, a.cos}, from{10, 10}, to = from + 12.0f * along;
    const Polygon wall{{from - across, to - across, to + across, from + across}, {}};
    const ObstacleVolume volume = extrude(wall, 0.0f, 2.5f, kFine);
    // Flooding from one side must not reach the other: every way across meets the wall.
    for (float s = 0.5f; s < 11.5f; s += 0.05f) {
      bool met = false;
      const Vec2 p = from + s * along;
      // Along a row of columns, and along a column of rows.
      for (int step = -6; step <= 6; ++step)
        met = met || holds(volume, {static_cast<int>(p.x / 0.25f) + step, 1, static_cast<int>(p.y / 0.25f)});
      EXPECT_TRUE(met) << angle << ", " << s;
    }
  }
}

TEST(Obstacle, AnOpenMeshIsItsSurfaceAndSaysSo) {
  const TriangleMesh open = without_roof(box_mesh({2, 0, -12}, {12, 6, -2}));
  EXPECT_FALSE(is_closed(open));
  const auto volume = voxelise(open, kFine);
  ASSERT_TRUE(volume);
  EXPECT_NE(volume->warning.find("open"), std::string::npos);
  EXPECT_FALSE(holds(*volume, {28, 3, 28}));  // the middle
  EXPECT_TRUE(holds(*volume, {8, 3, 28}));    // the western wall
}

TEST(Obstacle, AMeshThatCrossesItselfIsItsSurfaceAndSaysSo) {
  const TriangleMesh crossing = joined(box_mesh({2, 0, -12}, {12, 6, -2}), box_mesh({7, 1, -15}, {16, 5, -5}));
  EXPECT_TRUE(is_closed(crossing));
  EXPECT_TRUE(crosses_itself(crossing));
  const auto volume = voxelise(crossing, kFine);
  ASSERT_TRUE(volume);
  EXPECT_NE(volume->warning.find("crosses itself"), std::string::npos);
  EXPECT_FALSE(holds(*volume, {14, 3, 14}));
  // Apart, both are filled.
  const TriangleMesh apart = joined(box_mesh({2, 0, -12}, {5, 6, -2}), box_mesh({7, 1, -15}, {16, 5, -5}));
  EXPECT_FALSE(crosses_itself(apart));
  EXPECT_EQ(voxelise(apart, kFine)->warning, "");
}

TEST(Obstacle, AMeshInTheWrongUnitOrWithoutSenseIsRefused) {
  EXPECT_NE(voxelise(box_mesh({0, 0, 0}, {40'000, 12'000, 30'000}), kFine).error().message.find("unit"),
            std::string::npos);
  EXPECT_FALSE(voxelise({}, kFine));
  TriangleMesh broken = box_mesh({0, 0, 0}, {1, 1, 1});
  broken.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(voxelise(broken, kFine));
}

TEST(Obstacle, VoxelsAreTheSameForAnyNumberOfThreads) {
  TriangleMesh roof = box_mesh({2, 0, -22}, {32, 6, -2});
  roof.positions[7] += Vec3{3.0f, 2.7f, 1.1f};  // nothing level, nothing square
  const auto expected = voxelise(roof, kFine);
  for (int threads : {1, 2, 8})
    run_with_threads(threads, [&] { EXPECT_EQ(voxelise(roof, kFine)->spans, expected->spans); });
}

TEST(Obstacle, WhatLiesOutsideTheBoxAskedForIsLeftOut) {
  const Box2 site{{0, 0}, {10, 10}};
  for (const ObstacleVolume& v : {*voxelise(box_mesh({5, 0, -30}, {90, 4, -5}), kFine, site),
                                  extrude(rectangle({5, 5}, {90, 30}), 0, 4, kFine, site)}) {
    EXPECT_GE(v.low.x, 19);
    EXPECT_LE(v.high.x, 41);
    EXPECT_LE(v.high.y, 41);
    EXPECT_TRUE(holds(v, {30, 2, 30}));
  }
}

CrownSpace divide_around(const std::vector<Claimant>& trees, const Standing& standing, float side_m = 30) {
  auto space = divide_space(trees, standing, flat(side_m), SpaceOptions{});
  EXPECT_TRUE(space) << (space ? "" : space.error().message);
  return space ? *std::move(space) : CrownSpace();
}

TEST(ObstacleSpace, CrownsDoNotEnterAnObstacleAndPassOverIt) {
  // A house 5 m high beside a tree of 12 m.
  Standing standing{{building(-1, {17, 5}, {27, 25}, 0, 5, kFine)}, {}};
  const auto space = divide_around({tree(1, {15, 15}, 8, 12)}, standing);
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    const bool inside = v.x >= 68 && v.x < 108 && v.z >= 20 && v.z < 100 && v.y >= 0 && v.y < 5;
    if (inside) {
      ASSERT_EQ(space.id(v), -1);
      ASSERT_EQ(owner, owner_of_id(-1));
    } else {
      ASSERT_GE(owner, kFree);
    }
  });
  EXPECT_EQ(space.owner_at(to_world({16.5f, 15}, 3)), 0);
  EXPECT_EQ(space.owner_at(to_world({18.5f, 15}, 6)), 0);   // over the roof
  EXPECT_EQ(space.owner_at(to_world({18.5f, 15}, 4)), -2);  // in the house
}

TEST(ObstacleSpace, BehindAWallACrownComesRoundItsEnd) {
  Standing standing{{building(-1, {17, 15}, {17.3f, 30}, 0, 20, kFine)}, {}};
  const auto space = divide_around({tree(1, {15, 15.5f}, 10, 12)}, standing);
  EXPECT_EQ(space.owner_at(to_world({18.0f, 14}, 5)), 0);
  EXPECT_EQ(space.owner_at(to_world({18.5f, 16}, 5)), 0);  // round the corner, in the wall's shadow
}

TEST(ObstacleSpace, ATreeInAnObstacleKeepsTheVoxelsOverItsBaseAndIsNamed) {
  Standing standing{{building(-3, {10, 10}, {20, 20}, 0, 6, kFine)}, {}};
  const std::vector trees{tree(7, {15, 15}, 8, 10), tree(8, {5, 5}, 8, 10)};
  const auto space = divide_around(trees, standing);
  EXPECT_EQ(space.claimed_voxels(0), 10u);
  const auto found = problems(space, {30, 30});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, SpaceProblem::Kind::base_in_obstacle);
  EXPECT_EQ(found[0].id, 7);
  EXPECT_EQ(found[0].other, -3);
}

TEST(ObstacleSpace, UnderARoofATreeEndsThere) {
  // A carport: nothing below 3 m.
  Standing standing{{building(-1, {10, 10}, {20, 20}, 3, 4, kFine)}, {}};
  const auto space = divide_around({tree(7, {15, 15}, 8, 10)}, standing);
  EXPECT_EQ(space.shares(0).back().layer, 2);
  EXPECT_TRUE(problems(space, {30, 30}).empty());
}

TEST(ObstacleSpace, BasesInTrunksAndObstaclesOffTheSiteAreNamed) {
  Standing standing{{building(-1, {40, 40}, {50, 50}, 0, 6, kFine), building(-2, {-4, 4}, {2, 9}, 0, 6, kFine)}, {}};
  Claimant giant = tree(3, {15, 15}, 8, 12);
  giant.shape.trunk_width_m = 1.2f;
  const auto space = divide_around({tree(1, {15.4f, 15}, 8, 10), tree(2, {17, 15}, 8, 10), giant}, standing);
  const auto found = problems(space, {30, 30});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].kind, SpaceProblem::Kind::base_in_trunk);
  EXPECT_EQ(found[0].id, 1);
  EXPECT_EQ(found[0].other, 3);
  EXPECT_GT(space.claimed_voxels(0), 10u);
  EXPECT_EQ(found[1].kind, SpaceProblem::Kind::obstacle_off_site);
  EXPECT_EQ(found[1].id, -1);
}

TEST(ObstacleSpace, IdsAboveZeroOrTwiceAreRefused) {
  for (const Standing& wrong : {Standing{{building(1, {1, 1}, {2, 2}, 0, 6, kFine)}, {}},
                                Standing{{building(-1, {1, 1}, {2, 2}, 0, 6, kFine)},
                                         {{-1, "hero", std::make_shared<const std::vector<Segment>>()}}}})
    EXPECT_FALSE(divide_space({}, wrong, flat(30), SpaceOptions{}));
}

TEST(ObstacleSpace, GridsAndSlicesHoldNegativeIds) {
  Standing standing{{building(-4, {17, 5}, {27, 25}, 0, 5, kFine)}, {}};
  const auto space = divide_around({tree(1, {15, 15}, 8, 12)}, standing);
  const TreeGrid grid = build_grid(space);
  EXPECT_EQ(grid.id({80, 2, 60}), -4);
  EXPECT_EQ(grid.id({60, 2, 60}), 1);
  const SpaceSlice cut = slice(space, 2.5f, {{20, 15}, {20.2f, 15.2f}});
  ASSERT_FALSE(cut.ids.empty());
  EXPECT_EQ(cut.ids.front(), -4);
}

TEST(HeroSpace, AHeroTakesTheVoxelsItsWoodPassesThroughAndNoOthers) {
  const auto wood = std::make_shared<const std::vector<Segment>>(std::vector<Segment>{
      {to_world({12, 15}, 0), to_world({12, 15}, 8), 0.4f}, {to_world({12, 15}, 6), to_world({18, 16}, 9), 0.05f}});
  const std::vector trees{tree(1, {15, 15}, 8, 12)};
  const auto with = divide_around(trees, {{}, {{-2, "hero", wood}}}), without = divide_around(trees, {});
  std::size_t taken = 0;
  for_each_voxel(with, [&](IVec3 v, std::int32_t owner) {
    const Vec3 centre = to_world((Vec2(v.x, v.z) + 0.5f) * 0.25f, static_cast<float>(v.y) + 0.5f);
    double nearest = 1e9;
    for (const Segment& s : *wood) {
      const Vec3 along = s.to - s.from;
      const float share = glm::clamp(glm::dot(centre - s.from, along) / glm::dot(along, along), 0.0f, 1.0f);
      nearest = std::min(nearest, static_cast<double>(glm::distance(centre, s.from + share * along) - s.radius));
    }
    if (owner == owner_of_id(-2)) {
      ++taken;
      EXPECT_LT(nearest, 0.54);  // half a voxel's diagonal
    } else {
      EXPECT_GT(nearest, -1e-6);
      EXPECT_EQ(owner, without.owner(v));
    }
  });
  EXPECT_GT(taken, 8 * 7u);
  EXPECT_LT(with.claimed_voxels(0), without.claimed_voxels(0));
}

TEST(AsymmetryObstacle, AFacadePressesATreeAwayFromIt) {
  Standing standing{{building(-1, {0, 16}, {30, 24}, 0, 12, kFine)}, {}};
  const auto v =
      neighbourhood_asymmetry(divide_around({tree(1, {15, 13}, 8, 12), tree(2, {4, 2}, 8, 12)}, standing), {});
  EXPECT_GT(v[0].z, 0.3f);  // south, away from the house in the north
  EXPECT_LT(std::fabs(v[0].x), 0.1f);
  EXPECT_LT(glm::length(v[1]), glm::length(v[0]));
}

TEST(AsymmetryObstacle, AWallBelowTheCrownDoesNotPress) {
  Standing standing{{building(-1, {0, 16}, {30, 17}, 0, 1.5f, kFine)}, {}};
  EXPECT_EQ(neighbourhood_asymmetry(divide_around({tree(1, {15, 13}, 8, 12)}, standing), {})[0], Vec3(0.0f));
}

TEST(AsymmetryObstacle, ItFollowsEquation63WithTheNearestFootprintPoint) {
  Standing standing{{building(-1, {18, 10}, {30, 20}, 0, 12, kFine)}, {}};
  AsymmetryOptions o;
  o.asymmetry_max = o.area_ratio_cap = kUnlimited;
  const std::vector trees{tree(1, {15, 15}, 8, 10)};
  const auto space = divide_around(trees, standing);
  // The region's displacement, from its voxels.
  double sum = 0, n = 0;
  for (const LayerShare& s : space.shares(0)) {
    const DVec2 centre = DVec2(space.centroid(s));
    double radius = 0;
    for (int j = s.low.y; j <= s.high.y; ++j)
      for (int i = s.low.x; i <= s.high.x; ++i)
        if (space.owner({i, s.layer, j}) == 0)
          radius = std::max(radius, glm::length((DVec2(i, j) + 0.5) * 0.25 - centre));
    sum += static_cast<double>(s.voxels) * glm::length(centre - DVec2(15, 15)) / radius;
    n += static_cast<double>(s.voxels);
  }
  const double weight = 120.0 / static_cast<double>(trees[0].projected_area_m2()) + 2.0 * (1.0 - 3.0 / 12.0);
  const Vec3 v = neighbourhood_asymmetry(space, o)[0];
  EXPECT_NEAR(static_cast<double>(v.x), -weight * sum / n, 0.02);
  EXPECT_EQ(v.z, 0.0f);
}

TEST(AsymmetrySlope, CrownsShiftDownhillWhenAsked) {
  const auto bank = ground(30, [](Vec2 p) { return 0.75f * p.x; });
  const std::vector trees{tree(1, {15, 15}, 8, 10, 11.25f)};
  const auto space = *divide_space(trees, bank, SpaceOptions{});
  EXPECT_EQ(neighbourhood_asymmetry(space, {}, &bank)[0], Vec3(0.0f));
  AsymmetryOptions o;
  o.slope_weight = 0.5f;
  EXPECT_NEAR(neighbourhood_asymmetry(space, o, &bank)[0].x, -0.3f, 1.0f / 64);  // sin of the slope is 3/5
}

}  // namespace
}  // namespace bosquet::crowns
