#include "terrain/brush.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "terrain/perlin.h"

namespace bosquet::terrain {
namespace {

Terrain flat(Vec2 size_m, float height = 0.0f) { return make_terrain(Heightfield(*make_lattice(size_m), height)); }

Terrain rough_ground(Vec2 size_m) {
  return make_terrain(with_noise(Heightfield(*make_lattice(size_m)), PerlinNoise{2.0f, 6.0f, 4}, 5));
}

int tiles_not_shared(const TiledGrid<float>& a, const TiledGrid<float>& b) {
  int count = 0;
  for (int y = 0; y < a.tiles().y; ++y)
    for (int x = 0; x < a.tiles().x; ++x) count += !a.shares_tile(b, {x, y});
  return count;
}

TEST(Brush, LoweringByTwoMetresIsTwoMetresDeepAlongTheStrokeAndEndsAtItsRadius) {
  Stroke river{.kind = BrushKind::lower, .points = {{10, 20}, {90, 20}}, .radius_m = 6, .amount_m = 2};
  const Terrain after = apply(flat({100, 40}), river);
  for (float x = 12; x < 90; x += 3) EXPECT_NEAR(after.ground({x, 20}), -2.0f, 1e-5f);
  EXPECT_NEAR(after.ground({50, 23}), -1.0f, 1e-3f);  // half the effect at half the radius
  for (const Vec2 p : {Vec2{50, 26.5f}, Vec2{50, 13.5f}, Vec2{3.5f, 20}}) EXPECT_EQ(after.ground(p), 0.0f);
}

TEST(Brush, RaisingAndLoweringAlikeCancel) {
  Stroke stroke{.kind = BrushKind::raise, .points = {{5, 5}, {20, 25}}, .radius_m = 7, .strength = 0.6f};
  const Terrain before = rough_ground({30, 30});
  Terrain after = apply(before, stroke);
  EXPECT_GT(after.ground({12, 14}), before.ground({12, 14}) + 0.3f);
  stroke.kind = BrushKind::lower;
  after = apply(after, stroke);
  for (int j = 0; j <= 60; ++j)
    for (int i = 0; i <= 60; ++i) EXPECT_NEAR(after.height.sample(i, j), before.height.sample(i, j), 1e-6f);
}

TEST(Brush, FlatteningLeadsToTheHeightFirstTouched) {
  const Terrain before = rough_ground({40, 40});
  const float first = before.ground({12.25f, 20});
  const Terrain after =
      apply(before, {.kind = BrushKind::flatten, .points = {{12.25f, 20}, {28, 20}}, .radius_m = 8, .hardness = 0.5f});
  for (float x = 12; x < 28; x += 1.3f)
    for (float y = 17; y < 23; y += 1.1f) EXPECT_NEAR(after.ground({x, y}), first, 1e-5f);
}

RC_GTEST_PROP(Brush, SmoothingLeavesEveryPlaneAsItIs, ()) {
  const float east = static_cast<float>(*rc::gen::inRange(-100, 100)) / 100.0f;
  const float north = static_cast<float>(*rc::gen::inRange(-100, 100)) / 100.0f;
  const Terrain before =
      make_terrain(Heightfield(*make_lattice({20, 20}), [&](Vec2 p) { return east * p.x + north * p.y; }));
  // Across the site's corner, where there is nothing beyond the edge to take a mean of.
  const Terrain after = apply(before, {.kind = BrushKind::smooth, .points = {{0, 0}, {20, 15}}, .radius_m = 5});
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) RC_ASSERT(std::abs(after.height.sample(i, j) - before.height.sample(i, j)) < 1e-4f);
}

TEST(Brush, SmoothingTakesMostOfTheRoughnessAway) {
  const Terrain before = rough_ground({60, 60});
  const Terrain after =
      apply(before, {.kind = BrushKind::smooth, .points = {{30, 30}}, .radius_m = 25, .hardness = 0.8f});
  const auto roughness = [](const Terrain& t) {  // squared second differences
    double sum = 0.0;
    for (int j = 30; j < 90; ++j)
      for (int i = 30; i < 90; ++i) {
        const double d = t.height.sample(i - 1, j) - 2.0 * t.height.sample(i, j) + t.height.sample(i + 1, j);
        sum += d * d;
      }
    return sum;
  };
  EXPECT_LT(roughness(after), 0.05 * roughness(before));
}

TEST(Brush, AStrokeDoesNotDependOnHowManyEventsRecordedIt) {
  const Terrain before = rough_ground({50, 50});
  for (const BrushKind kind : {BrushKind::raise, BrushKind::lower, BrushKind::smooth, BrushKind::flatten,
                               BrushKind::noise, BrushKind::exclude, BrushKind::density}) {
    const Stroke sparse{.kind = kind, .points = {{10, 12}, {42, 28}}, .radius_m = 5, .strength = 0.7f};
    Stroke dense = sparse;
    dense.points.clear();
    for (int n = 0; n <= 500; ++n)
      dense.points.push_back(Vec2{10, 12} + Vec2{32, 16} * (static_cast<float>(n) / 500.0f));
    const Terrain a = apply(before, sparse), b = apply(before, dense);
    for (float y = 0.3f; y < 50; y += 0.71f)
      for (float x = 0.3f; x < 50; x += 0.71f) {
        ASSERT_NEAR(a.ground({x, y}), b.ground({x, y}), 1e-4f) << static_cast<int>(kind);
        ASSERT_NEAR(a.exclusion.at({x, y}), b.exclusion.at({x, y}), 1.01f / 255) << static_cast<int>(kind);
        ASSERT_NEAR(a.density.at({x, y}), b.density.at({x, y}), 1.01f / 255) << static_cast<int>(kind);
      }
  }
}

TEST(Brush, AStrokeCopiesOnlyTheTilesItTouches) {
  const Terrain before = flat({1000, 1000});  // 32 x 32 tiles of 32 m
  const Terrain after = apply(before, {.kind = BrushKind::raise, .points = {{500, 500}, {540, 540}}, .radius_m = 5});
  const int copied = tiles_not_shared(before.height.grid(), after.height.grid());
  EXPECT_GE(copied, 2);
  EXPECT_LE(copied, 9);
  EXPECT_EQ(before.ground({520, 520}), 0.0f);  // the earlier value is untouched: undo is keeping it
  EXPECT_GT(after.ground({520, 520}), 0.9f);
}

TEST(Brush, StrokesBesideTheSiteOrWithoutPointsChangeNothing) {
  const Terrain before = flat({100, 100});
  for (const Stroke& stroke :
       {Stroke{.points = {}}, Stroke{.points = {{-50, -50}}}, Stroke{.points = {{300, 20}, {300, 90}}}})
    EXPECT_EQ(tiles_not_shared(before.height.grid(), apply(before, stroke).height.grid()), 0);
}

TEST(Brush, ExcludingBarsAPlaceAndIncludingFreesItAgain) {
  const Terrain excluded = apply(flat({50, 50}), {.kind = BrushKind::exclude, .points = {{20, 25}}, .radius_m = 4});
  for (float y = 0.1f; y < 50; y += 0.37f)
    for (float x = 0.1f; x < 50; x += 0.37f) {
      const float d = glm::distance(Vec2{x, y}, Vec2{20, 25});
      if (std::abs(d - 4.0f) < 0.1f) continue;
      EXPECT_EQ(excluded.excluded({x, y}), d < 4.0f) << x << ' ' << y;
    }
  const Terrain freed = apply(excluded, {.kind = BrushKind::include, .points = {{20, 25}}, .radius_m = 6});
  for (float x = 14; x < 26; x += 0.3f) EXPECT_FALSE(freed.excluded({x, 25}));
}

TEST(Brush, DensityIsPaintedTowardsItsTarget) {
  const Terrain after =
      apply(flat({50, 50}),
            {.kind = BrushKind::density, .points = {{25, 25}}, .radius_m = 10, .hardness = 0.5f, .density = 0.2f});
  EXPECT_NEAR(after.density.at({25, 25}), 0.2f, 0.003f);
  EXPECT_EQ(after.density.at({40, 40}), 1.0f);
}

TEST(Exclusion, APathIsAsWideAsItIsSaid) {
  const std::vector<Vec2> path{{5, 10}, {45, 30}};
  for (const float width : {1.0f, 1.5f, 3.0f}) {
    const Terrain after = exclude_path(flat({50, 50}), path, width);
    const Vec2 across = glm::normalize(Vec2{-20, 40}), middle{25, 20};
    float barred = 0.0f;
    for (float s = -4; s < 4; s += 0.01f) barred += after.excluded(middle + s * across) ? 0.01f : 0.0f;
    EXPECT_NEAR(barred, width, 0.1f);
  }
}

TEST(Exclusion, APathNarrowerThanACellHasNoGaps) {
  const std::vector<Vec2> path{{5.01f, 10.24f}, {45, 30}, {45, 10}};
  const Terrain after = exclude_path(flat({50, 50}), path, 0.1f);
  for (float s = 0; s <= 1; s += 0.001f) {
    EXPECT_TRUE(after.excluded(glm::mix(path[0], path[1], s)));
    EXPECT_TRUE(after.excluded(glm::mix(path[1], path[2], s)));
  }
}

TEST(Exclusion, APolygonIsExcludedToATenthOfAMetreAndItsHoleIsNot) {
  Polygon lawn{{{5.2f, 5.3f}, {40.1f, 8.2f}, {30.4f, 41.7f}}, {{{20, 15}, {27, 15}, {27, 20}, {20, 20}}}};
  const Terrain after = exclude(flat({50, 50}), lawn);
  int wrong = 0, asked = 0;
  for (float y = 0.05f; y < 50; y += 0.1f)
    for (float x = 0.05f; x < 50; x += 0.1f, ++asked) wrong += after.excluded({x, y}) != lawn.contains({x, y});
  // The edges are 124 m long in all; corners within a cell are rounded off.
  EXPECT_LT(static_cast<float>(wrong) / static_cast<float>(asked) * 2500.0f, 0.1f * 130.0f);
  EXPECT_FALSE(after.excluded({23, 17}));
  EXPECT_TRUE(after.excluded({15, 10}));
}

TEST(Water, StandsWhereTheGroundIsLowerThanItsLevel) {
  Terrain site = apply(flat({40, 40}), {.kind = BrushKind::lower, .points = {{0, 20}, {40, 20}}, .radius_m = 6});
  EXPECT_FALSE(site.under_water({20, 20}));
  site.water_level_m = -0.4f;
  EXPECT_TRUE(site.under_water({20, 20}));
  EXPECT_FALSE(site.under_water({20, 30}));
}

}  // namespace
}  // namespace bosquet::terrain
