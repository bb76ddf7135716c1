#include "scene/edits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/changes.h"
#include "scene/planting_edits.h"
#include "scene/settings_edits.h"
#include "scene/site_edits.h"
#include "scene/tree_parameters.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

Document meadow() {
  Document document = sample_document("silver_birch", {{5, 5}, {10, 5}, {15, 5}, {5, 15}, {25, 25}}, {40, 40});
  document.species.push_back(std::make_shared<const Species>(*builtin_species("english_oak")));
  settle_counters(document);
  return document;
}

using Ids = std::vector<std::int32_t>;

TEST(Edits, ChangeWhatTheySayAndNothingElse) {
  const Document before = meadow();
  const Ids two{2, 4};
  const auto moved = move_trees(before, two, {1, 2});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->name, "Move 2 trees");
  EXPECT_EQ(moved->document.trees->find(2)->at, Vec2(11, 7));
  EXPECT_EQ(before.trees->find(2)->at, Vec2(10, 5)) << "the document before stays as it was";
  const Changes by = changes(before, moved->document);
  EXPECT_EQ(by.changed, two);
  EXPECT_TRUE(by.added.empty() && by.removed.empty() && by.ground.none() && by.species.empty());

  const Edited removed = remove_trees(before, two);
  EXPECT_EQ(changes(before, removed.document).removed, two);
  EXPECT_EQ(removed.document.next_tree_id, before.next_tree_id) << "ids are not given again";
  const auto scaled = scale_trees(before, two, 2.0f, 0.5f);
  ASSERT_TRUE(scaled);
  EXPECT_EQ(scaled->document.trees->find(4)->scale_height, 0.6f);
  EXPECT_EQ(scaled->document.trees->find(4)->scale_width, 0.15f);
  EXPECT_EQ(changes(before, set_status(before, two, TreeStatus::existing).document).changed, two);
}

TEST(Edits, LockedTreesAreNeitherMovedNorErased) {
  const Document before = lock_trees(meadow(), Ids{1, 3}, true).document;
  const Ids all{1, 2, 3, 4, 5}, locked{1, 3};
  const auto moved = move_trees(before, all, {1, 1});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->skipped, locked);
  EXPECT_EQ(*moved->document.trees->find(1), *before.trees->find(1));
  const Edited removed = remove_trees(before, all);
  EXPECT_EQ(removed.document.trees->size(), 2u);
  EXPECT_EQ(removed.skipped, locked);
  const std::vector<Vec2> stroke{{0, 5}, {40, 5}};
  EXPECT_EQ(erase_stroke(before, stroke, 2.0f).trees, (Ids{2}));
  EXPECT_EQ(remove_trees(lock_trees(before, all, false).document, all).document.trees->size(), 0u);
}

TEST(Edits, TreesThatWouldLeaveTheSiteStay) {
  const Document before = meadow();
  const auto moved = move_trees(before, Ids{4, 5}, {20, 0});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->skipped, (Ids{5}));
  EXPECT_EQ(moved->trees, (Ids{4}));
  EXPECT_FALSE(move_trees(before, Ids{4}, {std::numeric_limits<float>::quiet_NaN(), 0}));
}

TEST(Edits, TreesUnderANewExclusionStayAndAreListedOrGo) {
  const Document before = lock_trees(meadow(), Ids{2}, true).document;
  const Polygon area{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {}};
  const Edited kept = exclude_area(before, area);
  EXPECT_EQ(kept.displaced, (Ids{1, 2, 3}));
  EXPECT_EQ(kept.document.trees, before.trees);
  const Edited cleared = exclude_area(before, area, {}, Displaced::remove);
  EXPECT_EQ(cleared.trees, (Ids{1, 3}));
  EXPECT_EQ(cleared.displaced, (Ids{2})) << "locked trees stay";
  EXPECT_EQ(set_water_level(before, 1.0f).displaced.size(), 5u);
  const auto built = add_building(before, "barn", {{{4, 14}, {6, 14}, {6, 16}, {4, 16}}, {}}, 5.0f);
  ASSERT_TRUE(built);
  EXPECT_EQ(built->displaced, (Ids{4}));
  EXPECT_EQ(built->document.obstacles[0].id, -1);
  EXPECT_EQ(built->document.next_standing_id, -2);
}

TEST(Edits, AStrokeOnTheGroundTouchesItsTilesAlone) {
  const Document before = sample_document("silver_birch", {{5, 5}}, {300, 300});
  terrain::Stroke stroke;
  stroke.points = {{10, 10}, {15, 10}};
  const Edited raised = shape_ground(before, stroke);
  EXPECT_EQ(raised.name, "Raise ground");
  const Changes by = changes(before, raised.document);
  EXPECT_FALSE(by.ground.height.empty());
  EXPECT_LT(by.ground.height.size(), 5u);
  EXPECT_TRUE(by.ground.exclusion.empty());
  EXPECT_FALSE(by.trees());
  EXPECT_GT(raised.document.terrain->ground({12, 10}), 0.5f);
}

TEST(Edits, PaintingTheSameTwiceGivesTheSameTreesWhateverTheGroundWasAskedBefore) {
  const Document before = meadow();
  const std::vector<Vec2> line{{5, 30}, {35, 30}};
  const auto events = distribution::steady_stroke(line, 2.0f);
  const distribution::PlantBrush brush;
  PlantingGround fresh, used;
  const auto one = plant_stroke(before, fresh, brush, events);
  ASSERT_TRUE(one);
  ASSERT_GT(one->trees.size(), 5u);
  EXPECT_EQ(one->name, "Plant " + trees_in_words(one->trees.size()));

  // Something else is planted, moved and taken away in between.
  const auto other = plant_area(before, used, Box2{{0, 0}, {40, 40}}, 20);
  ASSERT_TRUE(other);
  const auto moved = move_trees(other->document, Ids{1, 2}, {3, 3});
  ASSERT_TRUE(moved && plant_stroke(moved->document, used, brush, events));
  const auto again = plant_stroke(before, used, brush, events);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->document.trees->to_vector(), one->document.trees->to_vector());
  EXPECT_EQ(again->document.next_tree_id, 6 + static_cast<std::int32_t>(one->trees.size()));

  // The next stroke over the same ground is another.
  const auto next = plant_stroke(one->document, used, brush, events);
  ASSERT_TRUE(next && !next->trees.empty());
  EXPECT_NE(next->document.trees->find(next->trees[0])->key, one->document.trees->find(one->trees[0])->key);
}

TEST(Edits, AStrokePaintedFrameByFrameIsTheStrokePaintedAtOnce) {
  const Document before = meadow();
  const auto events = distribution::steady_stroke(std::vector<Vec2>{{5, 30}, {35, 30}, {35, 10}, {20, 20}}, 4.0f);
  const distribution::PlantBrush brush;
  PlantingGround ground;
  const auto whole = plant_stroke(before, ground, brush, events);
  ASSERT_TRUE(whole);
  auto live = LivePlanting::begin(before, ground, brush);
  ASSERT_TRUE(live);
  std::size_t shown = 0;
  for (const distribution::BrushEvent& event : events) {
    const Edited so_far = live->extend({&event, 1});
    EXPECT_GE(so_far.trees.size(), shown);
    shown = so_far.trees.size();
  }
  EXPECT_EQ(live->finish().document.trees->to_vector(), whole->document.trees->to_vector());
}

TEST(Edits, OneTreeIsPlantedWhereItMayStand) {
  const Document before = meadow();
  PlantingGround ground;
  const auto planted = plant_tree(before, ground, 1, {20, 20}, 0.5f);
  ASSERT_TRUE(planted);
  EXPECT_EQ(planted->document.trees->back().at, Vec2(20, 20));
  EXPECT_EQ(planted->document.trees->back().species, 1u);
  const auto refused = plant_tree(planted->document, ground, 1, {20, 20}, 0.5f);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("(20.0, 20.0)"), std::string::npos);
  EXPECT_FALSE(plant_tree(before, ground, 7, {20, 20}, 0.5f));
}

TEST(Edits, ATreesOwnParametersAreOnlyWhatDiffersFromItsSpecies) {
  const Document before = meadow();
  const growth::Parameters& species = before.species[0]->growth;
  growth::Parameters edited = species;
  edited.shadow_strength += 0.01f;
  edited.planar = true;
  edited.phyllotaxis = growth::Phyllotaxis::decussate;
  const auto own = overrides_between(species, edited);
  ASSERT_EQ(own.size(), 3u);
  EXPECT_EQ(own[0].key, "growth.shadow_strength");
  const auto set = set_overrides(before, Ids{2}, own);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->trees, (Ids{2}));
  const auto full = with_overrides(species, set->document.trees->find(2)->overrides);
  ASSERT_TRUE(full);
  EXPECT_TRUE(overrides_between(edited, *full).empty());

  EXPECT_FALSE(set_overrides(before, Ids{2}, {{"growth.no_such", 1.0}}));
  EXPECT_FALSE(set_overrides(before, Ids{2}, {{"growth.straightness", true}}));
  const auto sum = set_overrides(before, Ids{2}, {{"growth.straightness", 0.99}});
  ASSERT_FALSE(sum);
  EXPECT_NE(sum.error().message.find("tree 2"), std::string::npos) << sum.error().message;

  const auto other = replace_species(set->document, Ids{1, 2}, 1);
  ASSERT_TRUE(other);
  EXPECT_TRUE(other->document.trees->find(2)->overrides.empty());
  EXPECT_EQ(other->notes.size(), 1u);
}

TEST(Edits, ATreeIsKeptAsHeroInItsPlace) {
  const Document before = meadow();
  growth::Skeleton skeleton;
  skeleton.parent = {-1};
  skeleton.distal = {{0, 1, 0}};
  const auto kept = keep_as_hero(before, 3, std::make_shared<const growth::Skeleton>(skeleton), "old one");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->document.trees->find(3), nullptr);
  ASSERT_EQ(kept->document.heroes.size(), 1u);
  EXPECT_EQ(kept->document.heroes[0].at, before.trees->find(3)->at);
  EXPECT_FALSE(keep_as_hero(before, 99, nullptr, ""));
  EXPECT_FALSE(keep_as_hero(before, 3, nullptr, ""));
}

TEST(Edits, SpeciesInUseCannotGoAndTheOthersKeepTheirTrees) {
  Document document = replace_species(meadow(), Ids{4, 5}, 1)->document;
  EXPECT_FALSE(remove_species(document, 0));
  document = remove_trees(document, Ids{1, 2, 3}).document;
  const auto removed = remove_species(document, 0);
  ASSERT_TRUE(removed);
  ASSERT_EQ(removed->document.species.size(), 1u);
  for (const Tree& tree : *removed->document.trees) EXPECT_EQ(removed->document.species_of(tree).name, "english_oak");
  EXPECT_FALSE(add_species(document, *builtin_species("english_oak")));
  crowns::SpaceOptions space = document.space;
  space.voxel_m = -1;
  EXPECT_FALSE(set_space(document, space));
}

// A house, a canopy on posts that are not drawn, and a mesh, on ground that is reshaped.
TEST(Edits, AnObstacleGoesWithTheGroundWhenMostOfItDoes) {
  Document before = meadow();
  const Polygon square{{{10, 10}, {20, 10}, {20, 20}, {10, 20}}, {}};
  before = add_building(before, "house", square, 6.0f)->document;
  before = add_obstacle(before, extruded_between("canopy", square, 3.0f, 3.2f))->document;
  Obstacle shed = extruded_between("shed", square, 0.0f, 2.0f);
  shed.outline = nullptr;
  before = add_obstacle(before, shed)->document;
  const auto heights = [](const Obstacle& o) { return Vec2{o.low_y, o.high_y}; };
  ASSERT_EQ(heights(before.obstacles[0]), Vec2(-0.3f, 6.0f));

  // Earth heaped against one wall.
  terrain::Stroke stroke;
  stroke.points = {{10, 10}, {10, 20}}, stroke.radius_m = 3, stroke.amount_m = 1;
  const Edited heaped = shape_ground(before, stroke);
  EXPECT_EQ(heights(heaped.document.obstacles[0]), Vec2(-0.3f, 6.0f));
  EXPECT_TRUE(heaped.document.obstacles.shares(before.obstacles));
  EXPECT_TRUE(heaped.notes.empty());

  // The same earth taken away: the wall goes down to what is left, the roof stays.
  stroke.kind = terrain::BrushKind::lower;
  const Document dug = shape_ground(before, stroke).document;
  EXPECT_LT(dug.obstacles[0].low_y, -0.8f);
  EXPECT_EQ(dug.obstacles[0].high_y, 6.0f);
  EXPECT_EQ(heights(dug.obstacles[1]), Vec2(3.0f, 3.2f)) << "it never reached the ground";
  float lowest = 0;
  for (const Vec3& p : dug.obstacles[0].mesh->positions) lowest = std::min(lowest, p.y);
  EXPECT_EQ(lowest, dug.obstacles[0].low_y);
  EXPECT_EQ(dug.obstacles[0].id, before.obstacles[0].id);

  // Real heights beneath everything.
  terrain::Terrain high = *before.terrain;
  high.height = terrain::Heightfield(high.height.lattice(), [](Vec2 p) { return 400.0f + 0.25f * p.x; });
  const Edited lifted = set_ground(before, high, "Import ground");
  const float rise = lifted.document.obstacles[0].high_y - 6.0f;
  EXPECT_NEAR(rise, 403.75f, 0.25f) << "the middle of the slope";
  EXPECT_EQ(lifted.document.obstacles[0].low_y, 402.5f - 0.3f);
  EXPECT_EQ(heights(lifted.document.obstacles[1]), Vec2(3.0f + rise, 3.2f + rise));
  float least = 1e9f;
  for (const Vec3& p : lifted.document.obstacles[2].mesh->positions) least = std::min(least, p.y);
  EXPECT_EQ(least, rise);
  EXPECT_EQ(lifted.notes, std::vector<std::string>{"3 obstacles go with the ground"});
}

}  // namespace
}  // namespace bosquet::scene
