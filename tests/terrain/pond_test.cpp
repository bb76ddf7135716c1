#include "terrain/pond.h"

#include <gtest/gtest.h>

#include "terrain/brush.h"

namespace bosquet::terrain {
namespace {

Polygon disc(Vec2 centre, float radius) {
  Polygon out;
  const Vec2 unit[8] = {{1, 0},  {0.70711f, 0.70711f},   {0, 1},  {-0.70711f, 0.70711f},
                        {-1, 0}, {-0.70711f, -0.70711f}, {0, -1}, {0.70711f, -0.70711f}};
  for (const Vec2& u : unit) out.ring.push_back(centre + radius * u);
  return out;
}

Terrain level_ground(float height) { return make_terrain(Heightfield(*make_lattice({60, 60}), height)); }

TEST(Pond, OnLevelGroundWaterStandsInItsOutlineAndNowhereElse) {
  const Polygon outline = disc({30, 30}, 15);
  const DugPond pond = dig_pond(level_ground(7), "mere", outline);
  EXPECT_FLOAT_EQ(pond.level_m, 7 - kFreeboard_m);
  EXPECT_FALSE(pond.lowered);
  const Terrain& site = pond.edit.terrain;
  int wrong = 0, asked = 0;
  for (float y = 0.1f; y < 60; y += 0.2f)
    for (float x = 0.1f; x < 60; x += 0.2f, ++asked) wrong += site.under_water({x, y}) != outline.contains({x, y});
  // The edge is 92 m long and true to a tenth of a metre.
  EXPECT_LT(0.04f * static_cast<float>(wrong), 9.2f);
  EXPECT_FLOAT_EQ(site.ground({30, 30}), pond.level_m - 1.0f);
  EXPECT_EQ(site.ground({2, 2}), 7);
  EXPECT_FALSE(site.water_level_m);
  EXPECT_EQ(*site.water_level({30, 30}), pond.level_m);
  EXPECT_FALSE(site.water_level({2, 2}));
  EXPECT_EQ(site.area_at({30, 30})->name, "mere");
  EXPECT_EQ(site.area_at({30, 30})->kind, AreaKind::water);
}

TEST(Pond, ItsBankHasTheSlopeThatIsSaid) {
  // A straight shore at x = 20: the bed falls by a metre in three.
  const Terrain site = dig_pond(level_ground(0), "basin", {{{20, -50}, {200, -50}, {200, 100}, {20, 100}}, {}}, {},
                                {.depth_m = 2, .bank = 3})
                           .edit.terrain;
  for (float x = 20; x < 25.5f; x += 0.5f) EXPECT_NEAR(site.ground({x, 30}), -kFreeboard_m - (x - 20) / 3, 1e-4f);
  EXPECT_NEAR(site.ground({40, 30}), -kFreeboard_m - 2, 1e-4f);
}

TEST(Pond, OnASlopeItsLevelIsThatOfTheLowestPlaceOnItsRimAndTheHillIsCutBack) {
  const Terrain hill =
      make_terrain(Heightfield(*make_lattice({60, 60}), [](Vec2 p) { return 0.1f * p.y; }));  // rises to the north
  const Polygon outline{{{20, 20}, {40, 20}, {40, 40}, {20, 40}}, {}};
  const DugPond pond = dig_pond(hill, "tarn", outline);
  EXPECT_NEAR(pond.level_m, 2.0f - kFreeboard_m, 0.001f);
  const Terrain& site = pond.edit.terrain;
  for (float y = 21; y < 40; y += 1) EXPECT_TRUE(site.under_water({30, y})) << y;
  EXPECT_FALSE(site.under_water({30, 41}));
  // North of the outline a bank of 1:2 up to the old slope: 2 m higher, so it comes out after 2.1 / (1/2 - 1/10) m.
  EXPECT_NEAR(site.ground({30, 42}), pond.level_m + 1.0f, 0.01f);
  EXPECT_EQ(site.ground({30, 47}), hill.ground({30, 47}));
  // Ground below the level to the south of it stays dry.
  EXPECT_LT(site.ground({30, 15}), pond.level_m);
  EXPECT_FALSE(site.under_water({30, 15}));
}

TEST(Pond, ALevelAboveItsRimIsLoweredToIt) {
  const DugPond pond = dig_pond(level_ground(3), "full", disc({30, 30}, 10), 5.0f);
  EXPECT_TRUE(pond.lowered);
  EXPECT_FLOAT_EQ(pond.level_m, 3 - kFreeboard_m);
  EXPECT_FLOAT_EQ(dig_pond(level_ground(3), "low", disc({30, 30}, 10), 2.0f).level_m, 2.0f);
}

TEST(Pond, TwoPondsKeepTheirLevelsAndTheSitesLevelIsBesideThem) {
  const Terrain hill = make_terrain(Heightfield(*make_lattice({60, 60}), [](Vec2 p) { return 0.2f * p.x; }));
  Terrain site = dig_pond(hill, "lower", disc({15, 30}, 5)).edit.terrain;
  site = dig_pond(site, "upper", disc({45, 30}, 5)).edit.terrain;
  EXPECT_LT(*site.water_level({15, 30}), 2.1f);
  EXPECT_GT(*site.water_level({45, 30}), 7.5f);
  site.water_level_m = 1.0f;
  EXPECT_TRUE(site.under_water({2, 5}));
  EXPECT_FALSE(site.under_water({20.5f, 5}));
  EXPECT_TRUE(site.under_water({45, 30}));
  EXPECT_GT(*site.water_level({45, 30}), 7.5f);
}

TEST(Pond, AnIslandStaysDry) {
  Polygon outline = disc({30, 30}, 20);
  outline.holes.push_back(disc({30, 30}, 6).ring);
  const Terrain site = dig_pond(level_ground(0), "moat", outline).edit.terrain;
  EXPECT_FALSE(site.under_water({30, 30}));
  EXPECT_EQ(site.ground({30, 30}), 0);
  EXPECT_TRUE(site.under_water({42, 30}));
  EXPECT_EQ(site.area_at({30, 30}), nullptr);
}

TEST(Pond, OffTheSiteNothingIsDug) {
  const Terrain before = level_ground(1);
  const DugPond pond = dig_pond(before, "far", disc({300, 30}, 10));
  EXPECT_TRUE(pond.edit.touched.empty());
  EXPECT_FALSE(pond.edit.terrain.has_water());
}

TEST(Pond, APathOverItKeepsTheWaterUnderIt) {
  Terrain site = dig_pond(level_ground(2), "mere", disc({30, 30}, 15)).edit.terrain;
  site = exclude_path(site, std::vector<Vec2>{{0, 30}, {60, 30}}, 2, {"bridge", AreaKind::path, Cover::paving});
  EXPECT_EQ(site.area_at({30, 30})->name, "bridge");
  EXPECT_TRUE(site.under_water({30, 30}));
}

}  // namespace
}  // namespace bosquet::terrain
