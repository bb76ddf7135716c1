#include "crowns/canopy_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/parallel.h"
#include "crowns/region_runs.h"
#include "crowns/sky.h"
#include "tests/crowns/stands.h"

namespace bosquet::crowns {
namespace {

SpaceOptions quarter_metres() {
  SpaceOptions o;
  o.voxel_m = 0.25f;
  o.layer_m = 1.0f;
  return o;
}

// Level at a point in the tree frame, as growth reads it.
int level_at(const TreeLight& light, const Vec3& p) {
  const Vec3 q = glm::floor(p - light.low);
  const IVec3 c(q);
  if (glm::any(glm::lessThan(c, IVec3(0))) || glm::any(glm::greaterThanEqual(c, light.cells))) return 15;
  return light.level[static_cast<std::size_t>((c.y * light.cells.z + c.z) * light.cells.x + c.x)];
}

std::vector<TreeLight> lights(const CanopyLight& light) {
  std::vector<TreeLight> out;
  for (std::size_t i = 0; i < light.size(); ++i) out.push_back(light.of(i));
  return out;
}

// A grove of equal trees on a square grid, the middle one last.
std::vector<Claimant> grove(int rows, float spacing_m, float first_m) {
  std::vector<Claimant> trees;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < rows; ++c)
      trees.push_back(tree(r * rows + c + 1,
                           {first_m + spacing_m * static_cast<float>(c), first_m + spacing_m * static_cast<float>(r)},
                           8, 20));
  return trees;
}

TEST(Sky, WeightsAreSharesOfTheWholeSky) {
  const auto rays = sky_rays(15.0f, 40);
  ASSERT_EQ(rays.size(), 13u);
  std::uint32_t sum = 0;
  for (const SkyRay& ray : rays) sum += ray.weight;
  EXPECT_EQ(sum, 65536u);
  EXPECT_EQ(Attenuation::level(std::uint64_t{sum} * Attenuation().passed(0)), 15);
}

TEST(Sky, RaysRiseAndEndAtTheirReach) {
  for (const float reach : {1.0f, 15.0f, 40.0f})
    for (const SkyRay& ray : sky_rays(reach, 60))
      for (std::size_t n = 0; n < ray.steps.size(); ++n) {
        const IVec3 s = ray.steps[n];
        EXPECT_GE(s.y, n == 0 ? 0 : ray.steps[n - 1].y);
        EXPECT_LE(s.y, 60);
        // A sample lies half a cell's diagonal at most from its cell's centre.
        EXPECT_LE(std::sqrt(static_cast<float>(s.x * s.x + s.z * s.z)), reach + std::numbers::sqrt2_v<float> / 2);
      }
}

TEST(Sky, LightFallsByBeersLaw) {
  const Attenuation a;
  for (const double p : {0.0, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 30.0}) {
    const auto doubled = static_cast<std::uint32_t>(2.0 * p * (1 << kLeafBits) + 0.5);
    EXPECT_NEAR(a.passed(doubled) / 65536.0, std::exp(-0.5 * p), 0.5 / 512.0 + 1e-5) << "leaf area index " << p;
  }
}

TEST(Sky, LevelsAreTheNearestSixteenth) {
  EXPECT_EQ(Attenuation::level(std::uint64_t{1} << 32), 15);
  EXPECT_EQ(Attenuation::level((std::uint64_t{31} << 32) / 32), 15);      // 15.5 sixteenths round up
  EXPECT_EQ(Attenuation::level((std::uint64_t{31} << 32) / 32 - 1), 14);  // and a little less down
  EXPECT_EQ(Attenuation::level((std::uint64_t{1} << 32) / 2), 7);
  EXPECT_EQ(Attenuation::level(0), 0);
}

// Leaf area is density times the ellipsoid's volume, whatever the voxels are. A voxel counts by its centre, which errs
// either way at the ellipsoid's surface.
TEST(CanopyLight, FoliageFillsTheEllipsoidOfALoneTree) {
  for (const Vec2 edges : {Vec2{0.25f, 0.5f}, Vec2{0.3f, 0.7f}, Vec2{0.234375f, 1.0f}, Vec2{1.7f, 1.3f}}) {
    SpaceOptions o;
    o.voxel_m = edges.x;
    o.layer_m = edges.y;
    std::vector<Claimant> trees{tree(1, {15.3f, 14.8f}, 9, 21)};
    trees[0].shape.leaf_area_density = 0.7f;
    const auto space = divide_space(trees, flat(30), o);
    ASSERT_TRUE(space);
    const CanopyLight light = canopy_light(*space, {});
    double sum = 0;
    for (int y = 0; y < 25; ++y)
      for (int z = 0; z < 30; ++z)
        for (int x = 0; x < 30; ++x) {
          const double leaf = light.leaf_area_m2({x, y, z});
          EXPECT_EQ(leaf, light.leaf_area_m2({x, y, z}, 0));
          EXPECT_LE(leaf, 0.7 + 1e-3);
          const bool within = y >= 5 && y < 20 && std::hypot(x + 0.5 - 15.3, z + 0.5 - 14.8) < 0.5;
          if (within && edges.x < 1) {
            EXPECT_NEAR(leaf, 0.7, 1e-3);
          }
          sum += leaf;
        }
    const double ellipsoid = 4.0 / 3.0 * std::numbers::pi * 4.5 * 4.5 * (0.5 * 0.8 * 21);
    EXPECT_NEAR(sum / (0.7 * ellipsoid), 1.0, edges.x > 1 ? 0.08 : 0.02) << edges.x << " x " << edges.y;
    EXPECT_TRUE(light.of(0).level.empty()) << "nothing shades a lone tree, not even itself";
  }
}

TEST(CanopyLight, TheSumOfAllSharesIsTheWhole) {
  const auto trees = clustered(3, 40, 30, 8, 18, 6);
  const auto space = divide_space(trees, flat(30), quarter_metres());
  ASSERT_TRUE(space);
  const CanopyLight light = canopy_light(*space, {});
  for (int y = -1; y < 20; ++y)
    for (int z = -8; z < 38; ++z)
      for (int x = -8; x < 38; ++x) {
        double sum = 0;
        for (std::size_t i = 0; i < trees.size(); ++i) sum += light.leaf_area_m2({x, y, z}, i);
        ASSERT_EQ(sum, light.leaf_area_m2({x, y, z}));
      }
}

// The definition again, slow and obvious: floating-point sums over the samples of every direction.
TEST(CanopyLight, AgreesWithTheDefinition) {
  const auto trees = clustered(11, 25, 24, 9, 16, 5);
  const auto space = divide_space(trees, ground(24, [](Vec2 p) { return 0.1f * p.x; }), quarter_metres());
  ASSERT_TRUE(space);
  LightOptions options;
  options.light_reach_m = 9.0f;
  const CanopyLight light = canopy_light(*space, options);
  const auto rays = sky_rays(options.light_reach_m, 40);
  std::size_t compared = 0, off_by_one = 0, shaded = 0;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    std::set<std::array<int, 3>> cells;
    for_each_run(*space, i, [&](const LayerShare& share, std::int32_t j, std::int32_t first, std::int32_t last) {
      for (int v = first; v <= last; ++v) cells.insert({v >> 2, share.layer, j >> 2});  // four voxels a cell
    });
    for (const auto& [x, y, z] : cells) {
      double t = 0;
      for (const SkyRay& ray : rays) {
        const auto others = [&](IVec3 c) { return light.leaf_area_m2(c) - light.leaf_area_m2(c, i); };
        double path = 0.5 * others({x, y, z});
        for (const IVec3& s : ray.steps) path += others(IVec3{x, y, z} + s);
        t += ray.weight / 65536.0 * std::exp(-0.5 * path);
      }
      const int level = std::max(0, static_cast<int>(std::floor(16.0 * t + 0.5)) - 1);
      const Vec3 centre{static_cast<float>(x) + 0.5f - trees[i].base.x,
                        static_cast<float>(y) + 0.5f - trees[i].ground_y,
                        trees[i].base.y - static_cast<float>(z) - 0.5f};
      const int got = level_at(light.of(i), centre);
      ASSERT_NEAR(got, level, 1) << "tree " << i << " cell " << x << ' ' << y << ' ' << z;
      ++compared, off_by_one += got != level, shaded += level < 12;
    }
  }
  EXPECT_GT(shaded, compared / 10) << "a test in the open would show little";
  EXPECT_LT(off_by_one, compared / 100) << "paths are rounded to 1/256, which seldom crosses a level's edge";
}

TEST(CanopyLight, InsideAGroveItIsDarkerTheDeeperAndAtItsEdgeItIsLight) {
  const auto trees = grove(7, 5.0f, 20.0f);
  const auto space = divide_space(trees, flat(70), quarter_metres());
  ASSERT_TRUE(space);
  const CanopyLight light = canopy_light(*space, {});
  const TreeLight &inner = light.of(3 * 7 + 3), &edge = light.of(3);  // middle, and middle of the southern rank
  int last = 0;
  for (const float y : {1.5f, 6.5f, 11.5f, 15.5f, 18.5f}) {
    const int level = level_at(inner, {0.0f, y, 0.0f});
    EXPECT_GE(level, last) << "at " << y;
    last = level;
    // Two metres south of the trunk, towards the open side of the edge tree.
    EXPECT_GT(level_at(edge, {0, y, 2}), level_at(inner, {0, y, 2}) - (y > 16 ? 1 : 0)) << "at " << y;
  }
  EXPECT_LT(level_at(inner, {0, 3.5f, 0}), 5) << "a third of the sky at most at the foot of a closed grove";
  EXPECT_GE(level_at(inner, {0, 19.5f, 0}), 13) << "tops are free";
}

TEST(CanopyLight, ATreeBeyondReachChangesNothing) {
  LightOptions options;
  options.light_reach_m = 6.0f;
  auto trees = grove(3, 5.0f, 20.0f);
  const auto terrain = flat(60);
  const auto before = divide_space(trees, terrain, quarter_metres());
  // Crowns reach 6 m (1.5 radii) beside their bases: rims are 6 m + 2 cells apart from 20 m between bases on.
  trees.push_back(tree(100, {20 - 20.1f, 20}, 8, 20));
  const auto after = divide_space(trees, terrain, quarter_metres());
  ASSERT_TRUE(before && after);
  const auto was = lights(canopy_light(*before, options));
  const auto now = lights(canopy_light(*after, options));
  for (std::size_t i = 0; i < was.size(); ++i) EXPECT_EQ(was[i], now[i]);
  EXPECT_TRUE(now.back().level.empty());
}

TEST(CanopyLight, MirroredStandsHaveMirroredLight) {
  auto trees = clustered(5, 12, 20, 8, 15, 4);
  // Bases on a grid of whole cells, so that the mirror maps cells on cells.
  for (Claimant& t : trees) t.base = glm::floor(t.base) + 0.5f;
  auto mirrored = trees;
  for (Claimant& t : mirrored) t.base.x = 20.0f - t.base.x;
  const auto terrain = flat(20);
  const auto space = divide_space(trees, terrain, quarter_metres());
  const auto mirror = divide_space(mirrored, terrain, quarter_metres());
  ASSERT_TRUE(space && mirror);
  const CanopyLight a = canopy_light(*space, {}), b = canopy_light(*mirror, {});
  std::size_t compared = 0, differ = 0;
  for (std::size_t i = 0; i < trees.size(); ++i)
    for (float y = 0.5f; y < 15.0f; y += 1.0f)
      for (float z = -3.0f; z <= 3.0f; z += 1.0f)
        for (float x = -3.0f; x <= 3.0f; x += 1.0f) {
          const int l = level_at(a.of(i), {x, y, z}), m = level_at(b.of(i), {-x, y, z});
          EXPECT_NEAR(l, m, 1);
          ++compared, differ += l != m;
        }
  // Voxels on a border between two trees go by key and do not mirror.
  EXPECT_LT(differ, compared / 50);
}

TEST(CanopyLight, IsTheSameForAnyNumberOfThreadsAndAnyOrderOfTrees) {
  const auto trees = clustered(17, 80, 40, 7, 18, 8);
  const auto terrain = flat(40);
  std::vector<TreeLight> first;
  for (const int threads : {1, 2, 3, 8, 16}) {
    std::vector<TreeLight> now;
    run_with_threads(threads, [&] {
      const auto space = divide_space(trees, terrain, quarter_metres());
      now = lights(canopy_light(*space, {}));
    });
    if (first.empty()) first = now;
    EXPECT_EQ(first, now) << threads << " threads";
  }
  auto reversed = trees;
  std::reverse(reversed.begin(), reversed.end());
  auto back = lights(canopy_light(*divide_space(reversed, terrain, quarter_metres()), {}));
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(first, back);
}

// Random edits of a stand: moved, removed, added and rescaled trees, one to three at a time.
TEST(CanopyLight, AnUpdateEqualsAWholeComputation) {
  const auto terrain = ground(45, [](Vec2 p) { return 0.05f * p.x + 0.5f * std::sin(0.3f * p.y); });
  LightOptions options;
  options.light_reach_m = 8.0f;
  auto trees = clustered(23, 40, 45, 6, 14, 6);
  auto space = divide_space(trees, terrain, quarter_metres());
  ASSERT_TRUE(space);
  CanopyLight light = canopy_light(*space, options);
  std::int32_t next_id = 1000;
  std::size_t unchanged = 0;
  for (std::uint64_t edit = 0; edit < 60; ++edit) {
    RandomStream draw(99, edit, Purpose::statistics);
    const auto was = trees;
    for (std::uint32_t n = 0; n <= draw.below(3); ++n) {
      const std::size_t i = draw.below(static_cast<std::uint32_t>(trees.size()));
      const Vec2 at{draw.uniform(0.0f, 45.0f), draw.uniform(0.0f, 45.0f)};
      switch (draw.below(4)) {
        case 0:
          trees[i].base = at;
          break;
        case 1:
          trees[i].scale_width = trees[i].scale_height = draw.uniform(0.3f, 1.0f);
          break;
        case 2:
          trees.erase(trees.begin() + static_cast<std::ptrdiff_t>(i));
          break;
        default:
          trees.insert(trees.begin() + static_cast<std::ptrdiff_t>(i), tree(next_id++, at, 6, 14));
      }
    }
    for (Claimant& t : trees) t.ground_y = terrain.ground(t.base);
    auto edited = divide_space(trees, terrain, quarter_metres());
    ASSERT_TRUE(edited);

    // Who differs from before: size, place or region.
    std::vector<std::size_t> regions_changed;
    std::vector<std::size_t> expected;
    const auto whole = lights(canopy_light(*edited, options));
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const auto old = std::find_if(was.begin(), was.end(), [&](const Claimant& t) { return t.key == trees[i].key; });
      if (old == was.end()) {
        expected.push_back(i);
        continue;
      }
      const auto o = static_cast<std::size_t>(old - was.begin());
      const CrownRegion a = region(*space, o), b = region(*edited, i);
      if (a.low != b.low || a.cells != b.cells || a.bits != b.bits || old->scale_width != trees[i].scale_width)
        regions_changed.push_back(i);
      if (light.of(o) != whole[i]) expected.push_back(i);
    }
    const LightUpdate update = update_canopy_light(light, *edited, regions_changed);
    ASSERT_EQ(lights(update.light), whole) << "edit " << edit;
    ASSERT_EQ(update.changed, expected) << "edit " << edit;
    unchanged += trees.size() - expected.size();
    light = update.light;
    space = std::move(edited);
  }
  EXPECT_GT(unchanged, 60u * 10u) << "edits must stay local for this to show anything";
}

TEST(CanopyLight, OneAndNoTree) {
  EXPECT_EQ(canopy_light(*divide_space({}, flat(10), {}), {}).size(), 0u);
  const auto one = divide_space(std::vector{tree(1, {5, 5}, 6, 12)}, flat(10), {});
  const CanopyLight light = canopy_light(*one, {});
  EXPECT_TRUE(light.of(0).level.empty());
  const LightUpdate gone = update_canopy_light(light, *divide_space({}, flat(10), {}), {});
  EXPECT_EQ(gone.light.size(), 0u);
  EXPECT_EQ(gone.light.leaf_area_m2({5, 6, 5}), 0.0);
}

}  // namespace
}  // namespace bosquet::crowns
