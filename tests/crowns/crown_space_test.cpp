#include "crowns/crown_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "core/parallel.h"
#include "stands.h"

namespace bosquet::crowns {
namespace {

CrownSpace divide(const std::vector<Claimant>& trees, const terrain::Terrain& terrain, const SpaceOptions& options) {
  auto space = divide_space(trees, terrain, options);
  EXPECT_TRUE(space) << (space ? "" : space.error().message);
  return space ? *std::move(space) : CrownSpace();
}

// A hillside with a bump, steep enough that neighbouring bases lie layers apart.
terrain::Terrain hillside(float side_m) {
  return ground(side_m, [](Vec2 p) { return 0.25f * p.x + 2.0f * (p.y - 10.0f) * (p.y - 10.0f) / 100.0f - 3.0f; });
}

std::vector<Claimant> stand_on(const terrain::Terrain& terrain, std::uint64_t seed, int count) {
  auto trees = clustered(seed, count, terrain.size_m().x, 7.0f, 12.0f, 6.0f);
  for (Claimant& t : trees) t.ground_y = terrain.ground(t.base);
  return trees;
}

TEST(CrownSpace, LargerTreesGetLargerRegions) {
  const auto space = divide({tree(1, {10, 15}, 4, 10), tree(2, {20, 15}, 6, 10)}, flat(30), unlimited(0.25f, 1));
  // The border between them divides their distance as their areas, 16 to 36.
  EXPECT_GT(space.claimed_voxels(1), 2 * space.claimed_voxels(0));
  EXPECT_EQ(space.owner_at({12.9f, 5.0f, -15.0f}), 0);
  EXPECT_EQ(space.owner_at({13.3f, 5.0f, -15.0f}), 1);
  EXPECT_EQ(space.claimed_voxels(), 120u * 120u * 10u);

  // With exponent 0 size does not count.
  SpaceOptions even = unlimited(0.25f, 1);
  even.speed_exponent = 0;
  const auto halves = divide({tree(1, {10, 15}, 4, 10), tree(2, {20, 15}, 6, 10)}, flat(30), even);
  EXPECT_NEAR(static_cast<double>(halves.claimed_voxels(0)), static_cast<double>(halves.claimed_voxels(1)), 120 * 10);
}

TEST(CrownSpace, ASmallTreeBesideAGiantKeepsARegionUnderItAndTheGiantOverhangs) {
  const Vec2 small_base{19, 15};
  const auto space = divide({tree(1, {15, 15}, 12, 24), tree(2, small_base, 5, 6)}, flat(30), SpaceOptions{});
  for (float y = 0.5f; y < 6.0f; y += 1.0f) EXPECT_EQ(space.owner_at(to_world(small_base, y)), 1) << y;
  for (float y = 6.5f; y < 24.0f; y += 1.0f) EXPECT_EQ(space.owner_at(to_world(small_base, y)), 0) << y;
  EXPECT_EQ(space.owner_at(to_world(small_base, 24.5f)), kFree);
}

TEST(CrownSpace, EqualTreesDivideALayerLikeVoronoi) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::vector<Claimant> trees = clustered(seed, 25, 60.0f, 8.0f, 1.0f, 1.0f);
    const auto space = divide(trees, flat(60), unlimited(0.5f, 1));
    int compared = 0;
    for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
      if (v.x < 0 || v.z < 0 || v.x >= 120 || v.z >= 120) return;
      std::size_t nearest = 0;
      for (std::size_t t = 1; t < trees.size(); ++t)
        if (plan_distance(space, v, trees[t].base) < plan_distance(space, v, trees[nearest].base)) nearest = t;
      // Distance to the nearest bisector with that tree.
      const double d = plan_distance(space, v, trees[nearest].base);
      double bisector = 1e9;
      for (std::size_t t = 0; t < trees.size(); ++t) {
        if (t == nearest) continue;
        const double other = plan_distance(space, v, trees[t].base);
        const double apart = static_cast<double>(glm::distance(trees[t].base, trees[nearest].base));
        bisector = std::min(bisector, (other * other - d * d) / (2 * apart));
      }
      if (bisector <= 0.5) return;  // within a voxel
      ++compared;
      EXPECT_EQ(owner, static_cast<std::int32_t>(nearest)) << "seed " << seed << ", voxel " << v.x << ", " << v.z;
    });
    EXPECT_GT(compared, 8000);
  }
}

TEST(CrownSpace, ALoneTreesFrontIsACircle) {
  SpaceOptions o = unlimited(0.5f, 1);
  o.keep_ticks = true;
  const Claimant lone = tree(1, {25.1f, 24.8f}, 8, 1);
  const auto space = divide({lone}, flat(50), o);
  // The farthest voxel reached at the time of radius 40 voxels lies within a voxel of it, in every direction.
  const double metre = 0x1p40 / static_cast<double>(lone.projected_area_m2());
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    if (owner != 0) return;
    const double reached = static_cast<double>(space.ticks(v)) / metre + static_cast<double>(lone.trunk_radius_m());
    const double d = plan_distance(space, v, lone.base);
    if (d < 19.5) {
      EXPECT_LT(reached, 20.0);
    }
    if (d > 20.5) {
      EXPECT_GT(reached, 20.0);
    }
  });
}

TEST(CrownSpace, ALoneTreeReachesOneAndAHalfCrownRadiiAndNoFarther) {
  const auto space = divide({tree(1, {15, 15}, 8, 10)}, flat(30), SpaceOptions{});
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    const bool within = plan_distance(space, v, {15, 15}) <= 6.0 && v.y >= 0 && v.y < 10;
    EXPECT_EQ(owner, within ? 0 : kFree);
  });
}

TEST(CrownSpace, CrownsOverhangTheSiteUnlessToldOtherwise) {
  SpaceOptions o;
  const std::vector trees{tree(1, {1, 1}, 8, 10)};
  const auto over = divide(trees, flat(30), o);
  EXPECT_EQ(over.owner_at(to_world({-4.5f, 1.0f}, 5)), 0);
  EXPECT_EQ(over.owner_at(to_world({-5.5f, 1.0f}, 5)), kFree);
  o.overhang_m = 0;
  const auto cut = divide(trees, flat(30), o);
  EXPECT_EQ(cut.owner_at(to_world({-0.1f, 1.0f}, 5)), kFree);
  EXPECT_EQ(cut.owner_at(to_world({0.1f, 1.0f}, 5)), 0);
}

TEST(CrownSpace, EveryRegionIsConnectedInEachLayerFromItsBaseUp) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto terrain = hillside(30);
    const auto trees = stand_on(terrain, seed, 120);
    SpaceOptions o = seed % 2 ? unlimited(0.5f, 0.5f) : SpaceOptions{};
    const auto space = divide(trees, terrain, o);
    for (std::size_t t = 0; t < trees.size(); ++t)
      for (const LayerShare& share : space.shares(t)) {
        if (static_cast<float>(share.layer + 1) * o.layer_m <= trees[t].ground_y) continue;
        // Flood from any voxel of the share.
        std::set<std::pair<int, int>> left, edge;
        for (int j = share.low.y; j <= share.high.y; ++j)
          for (int i = share.low.x; i <= share.high.x; ++i)
            if (space.owner({i, share.layer, j}) == static_cast<std::int32_t>(t)) left.insert({i, j});
        ASSERT_EQ(left.size(), static_cast<std::size_t>(share.voxels));
        edge.insert(left.extract(left.begin()));
        while (!edge.empty()) {
          const auto [i, j] = *edge.begin();
          edge.erase(edge.begin());
          for (auto next : {std::pair{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}})
            if (auto node = left.extract(next)) edge.insert(std::move(node));
        }
        EXPECT_TRUE(left.empty()) << "tree " << t << ", layer " << share.layer << ", seed " << seed;
      }
  }
}

TEST(CrownSpace, EveryTreeOwnsTheVoxelUnderItsBaseInAllItsLayers) {
  const auto terrain = hillside(30);
  const auto trees = stand_on(terrain, 5, 60);
  SpaceOptions o;
  o.voxel_m = 0.1f;  // finer than any two trunks are apart
  const auto space = divide(trees, terrain, o);
  for (std::size_t t = 0; t < trees.size(); ++t)
    for (float y = trees[t].ground_y + 0.01f; y < trees[t].top_y(); y += 0.5f)
      EXPECT_EQ(space.owner_at(to_world(trees[t].base, y)), static_cast<std::int32_t>(t));
}

TEST(CrownSpace, OnASlopeCrownsHangDownToTheGroundBelowTheirBase) {
  // A bank: level ground at 5 m, falling at 45 degrees to water level east of x = 15.
  const auto terrain = ground(30, [](Vec2 p) { return std::clamp(20.0f - p.x, 0.0f, 5.0f); });
  const auto space = divide({tree(1, {14, 15}, 10, 12, 5)}, terrain, SpaceOptions{});
  EXPECT_EQ(space.owner_at(to_world({18.0f, 15.0f}, 5.5f)), 0);
  EXPECT_EQ(space.owner_at(to_world({18.0f, 15.0f}, 2.5f)), 0);      // below the base, above the bank
  EXPECT_EQ(space.owner_at(to_world({18.0f, 15.0f}, 0.5f)), kFree);  // in the ground
  EXPECT_EQ(space.owner_at(to_world({14.0f, 15.0f}, 3.5f)), kFree);  // in the ground under the base

  // A tree on the lower ground keeps what it claims below the upper one's base.
  const auto two = divide({tree(1, {14, 15}, 10, 12, 5), tree(2, {20, 15}, 5, 4, 0)}, terrain, SpaceOptions{});
  EXPECT_EQ(two.owner_at(to_world({20.0f, 15.0f}, 2.5f)), 1);
  EXPECT_EQ(two.owner_at(to_world({20.0f, 15.0f}, 5.5f)), 0);
}

TEST(CrownSpace, NoVoxelLiesWhollyInTheGround) {
  const auto terrain = hillside(30);
  const auto trees = stand_on(terrain, 9, 60);
  const auto space = divide(trees, terrain, SpaceOptions{});
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    if (owner == kFree) return;
    const Vec2 centre = (Vec2(v.x, v.z) + 0.5f) * space.voxel_m();
    // But for the voxel under a base, which its tree owns even where the column's centre stands higher.
    if (glm::distance(centre, trees[static_cast<std::size_t>(owner)].base) < 0.2f) return;
    EXPECT_GT(static_cast<float>(v.y + 1) * space.layer_m(), terrain.ground(centre));
  });
}

struct Held {
  IVec3 voxel;
  std::int32_t id;
  std::uint64_t tick;
  bool operator==(const Held&) const = default;
};

// Owners and times of all claimed voxels in the order of their tiles, with trees by id.
std::vector<Held> contents(const CrownSpace& space) {
  std::vector<Held> all;
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    if (owner != kFree) all.push_back({v, space.claimants()[static_cast<std::size_t>(owner)].id, space.ticks(v)});
  });
  return all;
}

TEST(CrownSpace, TheDivisionIsTheSameForAnyNumberOfThreadsAndAnyOrderOfTrees) {
  const auto terrain = hillside(30);
  auto trees = stand_on(terrain, 3, 80);
  trees[40].base = trees[7].base;  // two in one place
  trees[41].base = trees[7].base + 0.01f;
  SpaceOptions o;
  o.voxel_m = 0.4f;
  o.keep_ticks = true;
  const auto expected = contents(divide(trees, terrain, o));
  for (int threads : {1, 2, 8})
    run_with_threads(threads, [&] { EXPECT_TRUE(contents(divide(trees, terrain, o)) == expected) << threads; });

  RandomStream draw(1, 1, Purpose::statistics);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = trees.size() - 1; i > 0; --i)
      std::swap(trees[i], trees[draw.below(static_cast<std::uint32_t>(i + 1))]);
    EXPECT_TRUE(contents(divide(trees, terrain, o)) == expected);
  }
}

TEST(CrownSpace, MovingATreeChangesOnlyNearbyRegions) {
  auto trees = clustered(11, 85, 60.0f, 7.0f, 12.0f, 4.0f);
  const auto terrain = flat(60);
  SpaceOptions o;
  o.voxel_m = 0.4f;
  o.keep_ticks = true;
  const auto before = divide(trees, terrain, o);
  const Vec2 old_base = trees[30].base;
  trees[30].base += Vec2{0.8f, -0.5f};
  const auto after = divide(trees, terrain, o);

  std::set<std::int32_t> changed;
  const auto compare = [&](const CrownSpace& a, const CrownSpace& b) {
    for_each_voxel(a, [&](IVec3 v, std::int32_t owner) {
      if (owner == b.owner(v) && a.ticks(v) == b.ticks(v)) return;
      changed.insert(owner);
      EXPECT_LT(plan_distance(a, v, old_base), 3 * 1.5 * 3.5) << "more than three reaches away";
    });
  };
  compare(before, after);
  compare(after, before);
  EXPECT_TRUE(changed.contains(30));
  EXPECT_LT(changed.size(), 30u);
}

TEST(CrownSpace, TreesInOnePlaceAllKeepARegion) {
  std::vector<Claimant> trees;
  for (int n = 0; n < 12; ++n) trees.push_back(tree(n + 1, {15, 15}, 6, 10));
  const auto space = divide(trees, flat(30), SpaceOptions{});
  for (std::size_t t = 0; t < trees.size(); ++t) {
    EXPECT_GE(space.claimed_voxels(t), 10u) << t;
    EXPECT_EQ(space.shares(t).size(), 10u) << t;
  }
}

TEST(CrownSpace, ARegionInItsTreesFrameHoldsExactlyItsVoxels) {
  const auto terrain = hillside(30);
  const auto trees = stand_on(terrain, 2, 40);
  SpaceOptions o;
  o.layer_m = 0.7f;
  const auto space = divide(trees, terrain, o);
  for (std::size_t t = 0; t < trees.size(); ++t) {
    const CrownRegion r = region(space, t);
    const Vec3 base = to_world(trees[t].base, trees[t].ground_y);
    std::size_t bits = 0;
    for (std::uint64_t word : r.bits) bits += static_cast<std::size_t>(std::popcount(word));
    EXPECT_EQ(bits, space.claimed_voxels(t));
    for (int k = -1; k <= r.cells.z; ++k)
      for (int j = -1; j <= r.cells.y; ++j)
        for (int i = -1; i <= r.cells.x; ++i) {
          const Vec3 p = r.low + (Vec3(i, j, k) + 0.5f) * Vec3(r.voxel_m, r.layer_m, r.voxel_m);
          EXPECT_EQ(r.contains(p), space.owner_at(base + p) == static_cast<std::int32_t>(t));
        }
    EXPECT_TRUE(r.contains({0.0f, 0.5f * o.layer_m, 0.0f}));
  }
}

TEST(CrownSpace, WhatLiesNorthInPlanLiesAtNegativeZInTheRegion) {
  // The neighbour to the north-east takes that corner of the region.
  const auto space = divide({tree(1, {15, 15}, 8, 10), tree(2, {18, 19}, 8, 10)}, flat(30), SpaceOptions{});
  const CrownRegion r = region(space, 0);
  EXPECT_TRUE(r.contains({-2.5f, 5.0f, 3.0f}));
  EXPECT_FALSE(r.contains({2.5f, 5.0f, -3.0f}));
  EXPECT_TRUE(r.contains({-2.5f, 5.0f, -3.0f}));
  EXPECT_TRUE(r.contains({2.5f, 5.0f, 3.0f}));
}

TEST(CrownSpace, SharesCountAndCentreWhatATreeOwns) {
  const auto trees = clustered(4, 30, 30.0f, 7.0f, 6.0f, 4.0f);
  const auto space = divide(trees, flat(30), SpaceOptions{});
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<double, DVec2>> sums;
  for_each_voxel(space, [&](IVec3 v, std::int32_t owner) {
    auto& [n, sum] = sums[{owner, v.y}];
    n += 1, sum += (DVec2(v.x, v.z) + 0.5) * 0.25;
  });
  std::size_t total = 0;
  for (std::size_t t = 0; t < trees.size(); ++t)
    for (const LayerShare& share : space.shares(t)) {
      const auto& [n, sum] = sums[{static_cast<std::int32_t>(t), share.layer}];
      EXPECT_EQ(static_cast<double>(share.voxels), n);
      EXPECT_NEAR(static_cast<double>(space.centroid(share).x), sum.x / n, 1e-4);
      EXPECT_NEAR(static_cast<double>(space.centroid(share).y), sum.y / n, 1e-4);
      total += static_cast<std::size_t>(share.voxels);
    }
  EXPECT_EQ(space.claimed_voxels(), total);
}

TEST(CrownSpace, ASliceShowsTheOwnersOfALayer) {
  const auto trees = clustered(4, 30, 30.0f, 7.0f, 12.0f, 4.0f);
  const auto space = divide(trees, flat(30), SpaceOptions{});
  const SpaceSlice cut = slice(space, 3.5f, {{-2.0f, 4.0f}, {25.0f, 28.0f}});
  ASSERT_EQ(cut.ids.size(), static_cast<std::size_t>(cut.width * cut.height));
  EXPECT_EQ(cut.width, 108);
  EXPECT_EQ(cut.height, 96);
  for (int j = 0; j < cut.height; ++j)
    for (int i = 0; i < cut.width; ++i) {
      const Vec2 plan = cut.low + (Vec2(i, j) + 0.5f) * cut.voxel_m;
      const std::int32_t owner = space.owner_at(to_world(plan, 3.5f));
      const std::int32_t id = owner == kFree ? 0 : trees[static_cast<std::size_t>(owner)].id;
      EXPECT_EQ(cut.ids[static_cast<std::size_t>(j * cut.width + i)], id);
    }
  const float far = std::numeric_limits<float>::max();
  EXPECT_GT(slice(space, 3.5f, {Vec2{-far}, Vec2{far}}).ids.size(), cut.ids.size());
  EXPECT_TRUE(slice(space, 3.5f, Box2{}).ids.empty());
}

TEST(CrownSpace, WithoutTreesAllIsFree) {
  const auto space = divide({}, flat(30), SpaceOptions{});
  EXPECT_EQ(space.claimed_voxels(), 0u);
  EXPECT_EQ(space.owner_at({1, 1, -1}), kFree);
  EXPECT_TRUE(slice(space, 1.0f, {{0, 0}, {30, 30}}).ids.empty());
}

TEST(CrownSpace, VolumeExistsOnlyWhereTreesCanReach) {
  // Two trees 199 km apart on a site of 200 km.
  const auto space =
      divide({tree(1, {100, 100}, 8, 10), tree(2, {199'000, 199'000}, 8, 10)}, flat(200'000), SpaceOptions{});
  EXPECT_GT(space.claimed_voxels(0), 0u);
  EXPECT_GT(space.claimed_voxels(1), 0u);
  EXPECT_LE(space.tiles().size(), 8u);
}

TEST(CrownSpace, MoreMemoryThanAllowedIsRefusedWithASizeThatFits) {
  const auto trees = clustered(4, 100, 60.0f, 7.0f, 12.0f, 4.0f);
  SpaceOptions o;
  o.voxel_m = 0.05f;
  o.memory_gb = 0.02f;
  const auto refused = divide_space(trees, flat(60), o);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::input);
  const std::string message = refused.error().message, before = "; voxel_m = ", after = " would fit";
  const std::size_t from = message.find(before), to = message.find(after);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << message;
  EXPECT_NE(message.find(" GB"), std::string::npos);
  o.voxel_m = std::stof(message.substr(from + before.size()));
  EXPECT_LT(o.voxel_m, 0.4f);
  EXPECT_TRUE(divide_space(trees, flat(60), o)) << message;

  // Absurd sizes come back at once.
  o = unlimited(0.02f, 0.05f);
  EXPECT_FALSE(divide_space(trees, flat(200'000), o));
}

TEST(CrownSpace, WhatAUserCannotMeanIsOneMessage) {
  const auto refusal = [](std::vector<Claimant> trees, SpaceOptions o) {
    const auto result = divide_space(trees, flat(30), o);
    return result ? std::string("accepted") : result.error().message;
  };
  SpaceOptions coarse;
  coarse.voxel_m = 50;
  EXPECT_NE(refusal({}, coarse).find("voxel_m = 50 is out of range"), std::string::npos);
  SpaceOptions strange;
  strange.speed_exponent = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal({}, strange).find("speed_exponent"), std::string::npos);
  EXPECT_NE(refusal({tree(17, {kUnlimited, 3}, 4, 4)}, {}).find("tree 17"), std::string::npos);
  EXPECT_NE(refusal({tree(18, {3, 3}, 0, 4)}, {}).find("tree 18"), std::string::npos);
}

TEST(CrownSpace, MoreTreesThanColumnsAreRefused) {
  SpaceOptions o;
  o.voxel_m = 10;
  o.overhang_m = 0;
  std::vector<Claimant> trees;
  for (int n = 1; n <= 9; ++n) trees.push_back(tree(n, {12, 17}, 6, 10));
  EXPECT_TRUE(divide_space(trees, flat(30), o));  // 3 x 3 columns
  trees.push_back(tree(10, {12, 17}, 6, 10));
  const auto refused = divide_space(trees, flat(30), o);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("10 trees do not fit"), std::string::npos);
}

TEST(CrownSpace, CancellingEndsWithoutAResult) {
  Progress progress;
  progress.cancel();
  const auto result = divide_space(clustered(1, 20, 30.0f, 7.0f, 12.0f, 4.0f), flat(30), {}, &progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::cannot_finish);
}

TEST(CrownSpace, ProgressCountsItsLayers) {
  Progress progress;
  EXPECT_TRUE(divide_space(clustered(1, 20, 30.0f, 7.0f, 12.0f, 4.0f), flat(30), {}, &progress));
  EXPECT_GT(progress.total(), 5u);
  EXPECT_EQ(progress.done(), progress.total());
}

}  // namespace
}  // namespace bosquet::crowns
