#include "scene/clearance.h"

#include <gtest/gtest.h>

#include "geometry/prism.h"
#include "scene/document.h"
#include "terrain/exclusion.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

Document with_status(Document document, std::size_t index, TreeStatus status) {
  std::vector<Tree> trees = document.trees->to_vector();
  trees[index].status = status;
  document.trees = std::make_shared<const Trees>(std::move(trees));
  return document;
}

Document with_house(Document document, bool as_mesh) {
  Obstacle house;
  house.name = "house";
  Polygon outline{{{10, 10}, {20, 10}, {20, 16}, {10, 16}}, {}};
  house.mesh = std::make_shared<const TriangleMesh>(geometry::prism(outline, 0.0f, 6.0f));
  if (!as_mesh) house.outline = std::make_shared<const Polygon>(outline);
  std::vector<Obstacle> all{house};
  document.obstacles = std::move(all);
  return document;
}

TEST(Clearance, RulesOfZeroAskForNothing) {
  EXPECT_TRUE(clearance_breaches(with_house(sample_document("silver_birch", {{9, 9}, {9.1f, 9}}, {30, 30}), false), {})
                  .empty());
}

TEST(Clearance, DistancesToABuildingAreThoseToItsPlanAsOutlineOrAsMesh) {
  for (const bool mesh : {false, true}) {
    // Beside a wall, off a corner, inside, and just far enough.
    const Document document =
        with_house(sample_document("silver_birch", {{15, 8}, {7, 6}, {15, 12}, {6, 12}}, {40, 40}), mesh);
    const auto all = clearance_breaches(document, {.building_m = 5.0f});
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].tree, 1);
    EXPECT_NEAR(all[0].distance_m, 2.0f, 1e-4f);
    EXPECT_EQ(all[1].tree, 3);
    EXPECT_NEAR(all[1].distance_m, 0.0f, 1e-4f);
    EXPECT_EQ(all[2].tree, 4);
    EXPECT_NEAR(all[2].distance_m, 4.0f, 1e-4f);
    EXPECT_EQ(words(all[0], document),
              "tree 1 (silver_birch) at (15.0, 8.0): 2.00 m from building 'house'; the rule is 5 m");
    // (7, 6) is 5 m from the corner (10, 10), which keeps the rule.
    EXPECT_EQ(clearance_breaches(document, {.building_m = 5.01f}).size(), 4u);
  }
}

TEST(Clearance, PathsAreMeasuredToTheirEdge) {
  Document document = sample_document("silver_birch", {{10, 13}, {30, 16}, {20, 10.4f}}, {40, 40});
  // 2 m wide along y = 10: its edge lies at y = 11.
  document.terrain = std::make_shared<const terrain::Terrain>(
      terrain::exclude_path(*document.terrain, std::vector<Vec2>{{-2, 10}, {42, 10}}, 2.0f));
  const auto all = clearance_breaches(document, {.path_m = 3.0f});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].tree, 1);
  EXPECT_NEAR(all[0].distance_m, 2.0f, 0.1f);  // a mask's edge is true to a fraction of its cell of 0.5 m
  EXPECT_EQ(all[1].tree, 3);
  EXPECT_EQ(all[1].distance_m, 0.0f);
}

TEST(Clearance, TwoTreesTooNearAreToldOnceAndOnlyOfAProposedOne) {
  const Document both = sample_document("silver_birch", {{10, 10}, {12, 10}, {30, 30}}, {40, 40});
  const ClearanceRules rules{.tree_m = 3.0f};
  auto all = clearance_breaches(both, rules);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].tree, 2);
  EXPECT_EQ(all[0].other, 1);
  EXPECT_FLOAT_EQ(all[0].distance_m, 2.0f);

  all = clearance_breaches(with_status(both, 1, TreeStatus::existing), rules);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].tree, 1);
  EXPECT_TRUE(clearance_breaches(with_status(both, 1, TreeStatus::to_remove), rules).empty());
  EXPECT_TRUE(
      clearance_breaches(with_status(with_status(both, 0, TreeStatus::existing), 1, TreeStatus::to_protect), rules)
          .empty());
}

TEST(Clearance, APairOfClippedTreesIsAHedge) {
  Document hedge = sample_document("european_beech", {{10, 10}, {10.5f, 10}}, {40, 40});
  std::vector<Tree> trees = hedge.trees->to_vector();
  for (Tree& tree : trees) tree.form = {crowns::FormKind::box, 1.0f, 1.0f, 2.0f};
  hedge.trees = std::make_shared<const Trees>(trees);
  EXPECT_TRUE(clearance_breaches(hedge, {.tree_m = 3.0f}).empty());
}

TEST(Clearance, TheEdgeOfTheSiteIsTheNearestOfFour) {
  const auto all = clearance_breaches(
      sample_document("silver_birch", {{1, 20}, {20, 39}, {38.5f, 20}, {20, 20}}, {40, 40}), {.edge_m = 2.0f});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_FLOAT_EQ(all[0].distance_m, 1.0f);
  EXPECT_FLOAT_EQ(all[1].distance_m, 1.0f);
  EXPECT_FLOAT_EQ(all[2].distance_m, 1.5f);
}

}  // namespace
}  // namespace bosquet::scene
