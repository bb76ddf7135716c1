#include "distribution/rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/brush.h"

namespace bosquet::distribution {
namespace {

Planting clearing() {
  const auto site = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({100, 100})));
  return *Planting::make(terrain::exclude_path(site, std::vector<Vec2>{{50, 0}, {50, 100}}, 5), {{"lime", 0.5f, {}}},
                         {});
}

TEST(Rows, ARowStandsOnItsLineAtItsSpacing) {
  const auto places = *row_places(std::vector<Vec2>{{10, 20}, {50, 20}}, {.spacing_m = 8});
  ASSERT_EQ(places.size(), 6u);  // both ends
  for (std::size_t n = 0; n < 6; ++n)
    EXPECT_LT(glm::distance(places[n], Vec2{10 + 8.0f * static_cast<float>(n), 20}), 1e-3f);
}

TEST(Rows, AnAvenueStandsOnBothSidesOfALineThatBends) {
  const std::vector<Vec2> line{{0, 0}, {60, 0}, {60, 60}};
  const auto places = *row_places(line, {.spacing_m = 5, .sides = RowSides::both, .offset_m = 4});
  int left = 0, right = 0;
  for (const Vec2 p : places) {
    // Every tree is 4 m from one leg of the line, beside or before the corner.
    const float to_first = std::abs(p.y), to_second = std::abs(p.x - 60);
    EXPECT_LT(std::min(std::abs(to_first - 4), std::abs(to_second - 4)), 1e-3f);
    (p.y > 0 && p.x < 60 ? left : right)++;
  }
  EXPECT_EQ(left, 1 + 112 / 5);   // the inner line is 56 + 56 m long
  EXPECT_EQ(right, 1 + 128 / 5);  // the outer one 64 + 64
}

TEST(Rows, AHedgeIsTwoStaggeredRowsAboutItsLine) {
  const auto places = *row_places(std::vector<Vec2>{{0, 0}, {10, 0}}, hedge_rules());
  ASSERT_EQ(places.size(), 41u);
  EXPECT_NEAR(places[0].y, -0.2f, 1e-5f);
  EXPECT_NEAR(places[21].x, 0.25f, 1e-5f);
  EXPECT_NEAR(places[21].y, 0.2f, 1e-5f);
}

TEST(Rows, AGridFillsItsRegionAndTurnsAboutItsMiddle) {
  const Region field = Box2{{10, 10}, {50, 40}};
  EXPECT_EQ(grid_places(field, {.spacing_m = 5, .row_gap_m = 10})->size(), 9u * 4u);
  const auto turned = *grid_places(field, {.spacing_m = 5, .row_gap_m = 10, .rotation_deg = 30});
  EXPECT_NEAR(static_cast<double>(turned.size()), 1200.0 / 50.0, 5);
  for (const Vec2 p : turned) EXPECT_TRUE(contains(field, p));
  bool middle = false, along = false;
  for (const Vec2 p : turned) {
    middle = middle || glm::distance(p, {30, 25}) < 1e-3f;
    along = along || glm::distance(p, {30 + 5 * std::sqrt(0.75f), 27.5f}) < 1e-3f;
  }
  EXPECT_TRUE(middle && along);
}

TEST(Rows, ARowOfFewerThanTwoPointsIsAnError) {
  for (const std::vector<Vec2>& line : {std::vector<Vec2>{}, {{3, 4}}, {{3, 4}, {3, 4}, {3, 4}}}) {
    const auto places = row_places(line, {});
    ASSERT_FALSE(places);
    EXPECT_EQ(places.error().message, "a row needs at least two different points");
  }
}

TEST(Rows, ARowEndsInATreeWhereItsLengthIsAMultipleOfItsSpacing) {
  for (const float spacing : {0.1f, 0.3f, 0.7f, 8.0f}) {
    const Vec2 end = Vec2{3, 4} + 60.0f * spacing * Vec2{0.6f, 0.8f};
    const auto places =
        *row_places(std::vector<Vec2>{{3, 4}, {3 + 6 * spacing, 4 + 8 * spacing}, end}, {.spacing_m = spacing});
    ASSERT_EQ(places.size(), 61u) << spacing;
    EXPECT_LT(glm::distance(places.back(), end), 0.01f * spacing);
  }
}

TEST(Rows, PatternsOfAbsurdNumberAreRefused) {
  EXPECT_FALSE(grid_places(Box2{{0, 0}, {200'000, 200'000}}, {.spacing_m = 0.1f, .row_gap_m = 0.1f}));
  EXPECT_FALSE(row_places(std::vector<Vec2>{{0, 0}, {200'000, 0}}, {.spacing_m = 0.1f}));
}

TEST(Rows, PlacesOnAPathOffTheSiteOrOnATrunkAreLeftOutAndReported) {
  Planting p = clearing();
  const Sowing what{.seed = 1, .block = 1, .mix = {{0}}};
  const std::vector<Vec2> places{{10, 10}, {50, 10}, {120, 10}, {10.1f, 10}, {20, 10}};
  const Planted planted = plant_at(p, what, places);
  ASSERT_EQ(planted.trees.size(), 2u);
  EXPECT_EQ(planted.trees[1].at, Vec2(20, 10));
  ASSERT_EQ(planted.left_out.size(), 3u);
  EXPECT_EQ(planted.left_out[0].why, Refusal::excluded);
  EXPECT_EQ(planted.left_out[1].why, Refusal::outside_site);
  EXPECT_EQ(planted.left_out[2].why, Refusal::too_near);
  EXPECT_EQ(planted.left_out[2].index, 3u);
}

TEST(Rows, JitterMovesEachTreeWithinItsRadiusAndLeavesOutNoNumber) {
  Planting p = clearing(), q = clearing();
  const Sowing what{.seed = 1, .block = 1, .mix = {{0}}};
  std::vector<Vec2> places;
  for (int n = 0; n < 40; ++n)
    places.push_back({5.0f + static_cast<float>(n % 8) * 5, 5.0f + static_cast<float>(n / 8) * 5});
  const Planted straight = plant_at(p, what, places), moved = plant_at(q, what, places, 1.5f);
  ASSERT_EQ(moved.trees.size(), 40u);
  float sum = 0;
  for (std::size_t n = 0; n < 40; ++n) {
    const float d = glm::distance(moved.trees[n].at, places[n]);
    EXPECT_LE(d, 1.5f);
    sum += d;
    EXPECT_EQ(moved.trees[n].key, straight.trees[n].key);
    EXPECT_EQ(moved.trees[n].scale, straight.trees[n].scale);
  }
  EXPECT_NEAR(sum / 40, 1.0f, 0.25f);  // mean distance in a disc is two thirds of its radius
}

TEST(Rows, OneTreeIsPlantedWhereSomebodyPointsOrTheReasonIsGiven) {
  Planting p = clearing();
  EXPECT_EQ(plant_one(p, 1, 0, {10, 10}, 1.0f), Refusal::none);
  EXPECT_EQ(plant_one(p, 2, 0, {10.3f, 10}, 1.0f), Refusal::too_near);
  EXPECT_EQ(plant_one(p, 3, 0, {10.6f, 10}, 1.0f), Refusal::none);
  EXPECT_EQ(plant_one(p, 4, 0, {-1, 10}, 1.0f), Refusal::outside_site);
  EXPECT_EQ(p.trees().size(), 2u);
}

}  // namespace
}  // namespace bosquet::distribution
