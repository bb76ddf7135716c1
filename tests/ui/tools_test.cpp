#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "growth/grow.h"
#include "scene/history.h"
#include "scene/site_edits.h"
#include "tests/scene/sample_document.h"
#include "ui/pick.h"
#include "ui/tools/standing_edits.h"
#include "ui/tools/tool.h"

namespace bosquet::ui {
namespace {

/// A hand that works on a document with one tool at a time, seen from above.
class Hand {
 public:
  explicit Hand(scene::Document document) : history_(std::move(document)) {
    rig_.frame({{0, 0, -60}, {60, 1, 0}}, 1.0f);
    rig_.show_plan(true);
  }

  void take(ToolKind kind) { tool_ = make_tool(kind); }

  ToolAnswer send(Event::Kind kind, Vec2 plan, Modifiers modifiers = {}, Button button = Button::left, int key = 0,
                  float scroll = 0) {
    ToolEvent event;
    event.event.kind = kind;
    event.event.button = button;
    event.event.key = key;
    event.event.scroll = scroll;
    event.event.modifiers = modifiers;
    event.event.time_s = time_s;
    event.event.at = *rig_.project(to_world(plan, ground(plan)), kView);
    const SightRay ray = rig_.ray(event.event.at, kView);
    event.ground = ground_hit(*document().terrain, ray);
    event.tree = tree_hit(document(), ray);
    return use(tool_->handle(event, scene()));
  }
  ToolAnswer tick() { return use(tool_->tick(time_s, scene())); }
  ToolAnswer confirm() { return use(tool_->confirm(scene())); }

  void click(Vec2 plan, Modifiers modifiers = {}) {
    send(Event::Kind::press, plan, modifiers);
    time_s += 0.05;
    send(Event::Kind::release, plan, modifiers);
    time_s += 1;
  }
  ToolAnswer drag(Vec2 from, Vec2 to, Modifiers modifiers = {}, int steps = 8) {
    send(Event::Kind::press, from, modifiers);
    for (int i = 1; i <= steps; ++i) {
      time_s += 0.1;
      send(Event::Kind::move, glm::mix(from, to, static_cast<float>(i) / static_cast<float>(steps)), modifiers);
      tick();
    }
    return send(Event::Kind::release, to, modifiers);
  }
  void key(int key) { send(Event::Kind::key_press, {1, 1}, {}, Button::none, key); }

  const scene::Document& document() const { return *history_.current(); }
  std::size_t trees() const { return document().trees->size(); }
  float ground(Vec2 plan) const { return document().terrain->ground(plan); }

  static constexpr Vec2 kView{600, 600};
  double time_s = 0;
  ToolSettings settings;
  std::vector<std::int32_t> selection;
  scene::History& history() { return history_; }
  Tool& tool() { return *tool_; }
  ToolScene scene() { return {history_.current(), selection, rig_, kView, &settings, &planting_}; }

 private:
  ToolAnswer use(ToolAnswer answer) {
    if (answer.edit) history_.add(*answer.edit, answer.drag);
    if (answer.selection) selection = *answer.selection;
    return answer;
  }

  scene::History history_;
  CameraRig rig_;
  scene::PlantingGround planting_;
  std::unique_ptr<Tool> tool_;
};

Hand on_meadow(std::vector<Vec2> trees = {}) { return Hand(scene::sample_document("silver_birch", trees, {60, 60})); }

TEST(Tools, EachHasANameAHintAndAKeyOfItsOwn) {
  std::set<int> keys;
  for (int k = 0; k < kToolCount; ++k) {
    const ToolInfo& info = tool_info(static_cast<ToolKind>(k));
    EXPECT_EQ(static_cast<int>(info.kind), k);
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.hint.empty());
    EXPECT_TRUE(keys.insert(info.key).second) << info.name;
    EXPECT_NE(make_tool(info.kind), nullptr);
  }
}

TEST(Tools, AStrokeOfTheLowerBrushIsOneStepOfUndo) {
  Hand hand = on_meadow();
  hand.take(ToolKind::lower);
  hand.settings.radius_m = 5;
  hand.settings.ground.strength = 1;
  hand.drag({10, 30}, {50, 30});
  EXPECT_NEAR(hand.ground({30, 30}), -1, 0.05f);
  EXPECT_NEAR(hand.ground({30, 50}), 0, 1e-4f);
  EXPECT_EQ(hand.history().steps(), 2u);
  EXPECT_EQ(hand.history().undo_name(), "Lower ground");
  hand.history().undo();
  EXPECT_EQ(hand.ground({30, 30}), 0);
}

TEST(Tools, TerrainStrokesDoNotHangOnTheRateOfEvents) {
  Hand slow = on_meadow(), fast = on_meadow();
  for (Hand* hand : {&slow, &fast}) {
    hand->take(ToolKind::raise);
    hand->settings.radius_m = 8;
  }
  slow.drag({10, 20}, {50, 20}, {}, 10);
  fast.drag({10, 20}, {50, 20}, {}, 40);
  for (float x = 5; x < 55; x += 2.5f)
    for (float y = 10; y < 30; y += 2.5f) EXPECT_NEAR(slow.ground({x, y}), fast.ground({x, y}), 0.02f);
}

TEST(Tools, ShiftTurnsAShapingBrushIntoSmoothing) {
  Hand hand = on_meadow();
  hand.settings.radius_m = 6;
  hand.settings.ground.strength = 1;
  hand.take(ToolKind::raise);
  hand.drag({30, 30}, {30, 30.5f});
  const float top = hand.ground({30, 30});
  hand.drag({30, 30}, {31, 30}, {.shift = true});
  EXPECT_LT(hand.ground({30, 30}), top);
  EXPECT_EQ(hand.history().undo_name(), "Smooth ground");
}

TEST(Tools, TheBrushPlantsWhileItIsHeldAndErasesWithShift) {
  Hand hand = on_meadow();
  hand.take(ToolKind::plant_brush);
  hand.settings.radius_m = 10;
  hand.settings.plant.strength = 1;
  hand.settings.plant.rate = 0.3f;
  hand.send(Event::Kind::press, {30, 30});
  const std::size_t first = hand.trees();
  EXPECT_GE(first, 1u);
  for (int i = 0; i < 20; ++i) hand.time_s += 0.05, hand.tick();
  EXPECT_GT(hand.trees(), first + 5);
  hand.send(Event::Kind::release, {30, 30});
  for (const scene::Tree& tree : *hand.document().trees) EXPECT_LE(glm::length(tree.at - Vec2(30, 30)), 10.01f);
  EXPECT_EQ(hand.history().steps(), 2u);
  EXPECT_FALSE(hand.tool().busy());
  hand.time_s += 1;
  hand.drag({20, 30}, {40, 30}, {.shift = true});
  EXPECT_EQ(hand.trees(), 0u);
}

TEST(Tools, PlantingOnALawnTellsWhatBarsItAndTheToolThatFreesIt) {
  const Polygon west{{{0, 0}, {30, 0}, {30, 60}, {0, 60}}, {}};
  const scene::Document meadow = scene::sample_document("silver_birch", {}, {60, 60});
  const auto stroke = [&](const terrain::Area& area, Vec2 from, Vec2 to) {
    Hand hand(scene::exclude_area(meadow, west, area).document);
    hand.take(ToolKind::plant_brush);
    hand.settings.radius_m = 3;
    return hand.drag(from, to).message;
  };
  const terrain::Area lawn{"", terrain::AreaKind::lawn};
  EXPECT_NE(stroke(lawn, {10, 10}, {20, 40}).find("; the lawn is kept free of trees, the tool Let plant (7) frees it"),
            std::string::npos)
      << stroke(lawn, {10, 10}, {20, 40});
  EXPECT_NE(stroke({"Long walk", terrain::AreaKind::path}, {10, 10}, {20, 40}).find("; 'Long walk' is kept free"),
            std::string::npos);
  EXPECT_NE(stroke({}, {10, 10}, {20, 40}).find("; this ground is kept free"), std::string::npos);
  // Where most of the stroke is free, and where letting plant helps nobody, there is no such word.
  EXPECT_EQ(stroke(lawn, {40, 10}, {50, 40}).find("kept free"), std::string::npos);
  EXPECT_EQ(stroke({"", terrain::AreaKind::building}, {10, 10}, {20, 40}).find("kept free"), std::string::npos);

  Hand hand(scene::exclude_area(meadow, west, lawn).document);
  hand.take(ToolKind::single);
  EXPECT_NE(hand.send(Event::Kind::press, {10, 10}).message.find("Let plant (7)"), std::string::npos);
  hand.take(ToolKind::row);
  hand.click({10, 10}), hand.click({10, 50});
  EXPECT_NE(hand.send(Event::Kind::key_press, {1, 1}, {}, Button::none, kKeyEnter).message.find("Let plant (7)"),
            std::string::npos);
  hand.take(ToolKind::fill);
  for (const Vec2 corner : {Vec2{5, 5}, Vec2{25, 5}, Vec2{25, 55}}) hand.click(corner);
  EXPECT_NE(hand.send(Event::Kind::key_press, {1, 1}, {}, Button::none, kKeyEnter).message.find("Let plant (7)"),
            std::string::npos);
}

TEST(Tools, AnotherStrokeLeavesTheTreesOfTheFirstAlone) {
  Hand hand = on_meadow();
  hand.take(ToolKind::plant_brush);
  hand.settings.radius_m = 8;
  hand.drag({15, 15}, {25, 15});
  const std::vector<scene::Tree> before = hand.document().trees->to_vector();
  ASSERT_FALSE(before.empty());
  hand.time_s += 2;
  hand.drag({40, 45}, {50, 45});
  ASSERT_GT(hand.trees(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ((*hand.document().trees)[i], before[i]);
}

TEST(Tools, HundredThousandTreesAreAskedAboutFirst) {
  Hand hand = on_meadow();
  hand.take(ToolKind::plant_brush);
  hand.settings.radius_m = 300;
  hand.settings.plant.strength = 1;
  hand.settings.plant.rate = 10;
  hand.send(Event::Kind::press, {30, 30});
  hand.time_s += 1;
  const ToolAnswer answer = hand.tick();
  EXPECT_GT(answer.asks_for_trees, kManyTrees);
  EXPECT_FALSE(answer.edit);
  // Until somebody agrees nothing more happens; Escape drops it.
  hand.time_s += 1;
  EXPECT_EQ(hand.tick().asks_for_trees, 0u);
  hand.tool().cancel();
  EXPECT_FALSE(hand.tool().busy());

  hand.take(ToolKind::fill);
  hand.settings.per_hectare = 1e6f;
  for (const Vec2 corner : {Vec2(5, 5), Vec2(55, 5), Vec2(55, 55), Vec2(5, 55)}) hand.click(corner);
  hand.time_s += 1;
  const std::size_t before = hand.trees();
  hand.key(kKeyEnter);
  EXPECT_EQ(hand.trees(), before);
  hand.confirm();
  EXPECT_GT(hand.trees(), before + 1000);
}

TEST(Tools, ARowEndsWithEnterAndAnAvenueHasTwoSides) {
  Hand hand = on_meadow();
  hand.take(ToolKind::row);
  hand.settings.row = {.spacing_m = 10, .sides = distribution::RowSides::both, .offset_m = 4};
  hand.click({10, 30});
  hand.click({50, 30});
  EXPECT_EQ(hand.trees(), 0u);
  EXPECT_FALSE(hand.tool().preview(hand.scene()).places.empty());
  hand.key(kKeyEnter);
  EXPECT_EQ(hand.trees(), 10u);
  for (const scene::Tree& tree : *hand.document().trees) EXPECT_NEAR(std::abs(tree.at.y - 30), 4, 0.05f);
}

TEST(Tools, ALineOfOnePointSaysWhatItNeeds) {
  Hand hand = on_meadow();
  hand.take(ToolKind::row);
  hand.click({10, 30});
  const ToolAnswer answer = hand.send(Event::Kind::key_press, {1, 1}, {}, Button::none, kKeyEnter);
  EXPECT_EQ(answer.message, "A line needs at least 2 points");
  EXPECT_EQ(hand.trees(), 0u);
  EXPECT_FALSE(hand.tool().busy());
}

TEST(Tools, AnOutlineEndsOnItsFirstPoint) {
  Hand hand = on_meadow();
  hand.take(ToolKind::grid);
  hand.settings.grid.spacing_m = hand.settings.grid.row_gap_m = 10;
  for (const Vec2 corner : {Vec2(10, 10), Vec2(50, 10), Vec2(50, 50), Vec2(10, 50), Vec2(10, 10)}) hand.click(corner);
  EXPECT_GE(hand.trees(), 9u);
  EXPECT_FALSE(hand.tool().busy());
}

TEST(Tools, SelectingTakesByClickBoxAndLassoAndAddsWithShift) {
  Hand hand = on_meadow({{10, 10}, {30, 30}, {50, 50}});
  hand.take(ToolKind::select);
  hand.click({30, 30});
  EXPECT_EQ(hand.selection, (std::vector<std::int32_t>{2}));
  hand.click({10, 10}, {.shift = true});
  EXPECT_EQ(hand.selection, (std::vector<std::int32_t>{1, 2}));
  hand.click({10, 10}, {.shift = true});
  EXPECT_EQ(hand.selection, (std::vector<std::int32_t>{2}));
  hand.drag({20, 20}, {58, 58});
  EXPECT_EQ(hand.selection, (std::vector<std::int32_t>{2, 3}));
  hand.click({20, 45});
  EXPECT_TRUE(hand.selection.empty());
  EXPECT_EQ(hand.history().steps(), 1u);
}

TEST(Tools, DraggingATreeMovesItAndNothingElse) {
  Hand hand = on_meadow({{10, 10}, {30, 30}});
  hand.take(ToolKind::select);
  hand.drag({30, 30}, {40, 20});
  EXPECT_LT(glm::length((*hand.document().trees)[1].at - Vec2(40, 20)), 0.1f);
  EXPECT_EQ((*hand.document().trees)[0].at, Vec2(10, 10));
  EXPECT_EQ(hand.history().steps(), 2u);
  EXPECT_EQ(hand.selection, (std::vector<std::int32_t>{2}));
}

TEST(Tools, LockedTreesStay) {
  Hand hand = on_meadow({{10, 10}, {30, 30}});
  const std::vector<std::int32_t> second{2};
  hand.history().add(scene::lock_trees(hand.document(), second, true));
  hand.take(ToolKind::select);
  hand.selection = {1, 2};
  const ToolAnswer answer = hand.send(Event::Kind::key_press, {1, 1}, {}, Button::none, kKeyDelete);
  EXPECT_NE(answer.message.find("locked"), std::string::npos);
  ASSERT_EQ(hand.trees(), 1u);
  EXPECT_EQ(hand.document().trees->front().id, 2);
}

TEST(Tools, WaterFollowsTheHandAndGoesWithDelete) {
  Hand hand = on_meadow();
  hand.take(ToolKind::water);
  hand.send(Event::Kind::press, {30, 30});
  ASSERT_TRUE(hand.document().terrain->water_level_m);
  EXPECT_NEAR(*hand.document().terrain->water_level_m, 0.05f, 0.01f);
  hand.send(Event::Kind::move, {30, 50});
  EXPECT_GT(*hand.document().terrain->water_level_m, 0.2f);
  hand.send(Event::Kind::release, {30, 50});
  EXPECT_EQ(hand.history().steps(), 2u);
  hand.key(kKeyDelete);
  EXPECT_FALSE(hand.document().terrain->water_level_m);
}

TEST(Tools, WhereDensityIsPaintedThinFewerTreesAreFilledIn) {
  Hand hand = on_meadow();
  hand.settings.radius_m = 100;  // more than the site
  hand.settings.ground.strength = 1;
  hand.settings.ground.density = 0;
  hand.take(ToolKind::density);
  hand.click({10, 30});
  EXPECT_EQ(hand.history().undo_name(), "Paint density");
  EXPECT_LT(hand.document().terrain->density.at({10, 30}), 0.01f);
  hand.click({10, 30}, {.shift = true});
  EXPECT_GT(hand.document().terrain->density.at({10, 30}), 0.99f);
}

TEST(Tools, ABrushLargerThanTheSiteWorksOnAllOfIt) {
  Hand hand = on_meadow({{10, 10}, {30, 30}, {50, 50}});
  hand.settings.radius_m = kMostRadius_m;
  hand.settings.ground.strength = 1;
  hand.settings.ground.hardness = 1;
  hand.take(ToolKind::raise);
  hand.click({30, 30});
  for (const Vec2 at : {Vec2(1, 1), Vec2(59, 59), Vec2(30, 30)}) EXPECT_NEAR(hand.ground(at), 1, 0.01f);
  hand.take(ToolKind::plant_brush);
  hand.drag({30, 30}, {31, 31});
  EXPECT_GT(hand.trees(), 3u);
  for (const scene::Tree& tree : *hand.document().trees)
    EXPECT_TRUE(terrain::on_site(*hand.document().terrain, tree.at));
  hand.take(ToolKind::erase);
  hand.click({30, 30});
  EXPECT_EQ(hand.trees(), 0u);
}

// A small birch.
HeroInHand small_hero(const scene::Document& document) {
  growth::GrowthInput input;
  growth::Parameters small = document.species[0]->growth;
  small.max_seasons = 12;
  input.parameters = &small;
  input.max_height_m = 4;
  input.seed = 1, input.key = 1;
  return {"old birch", document.species[0], 7, std::make_shared<const growth::Skeleton>(growth::grow(input))};
}

TEST(Tools, AHeroTreeIsSetByAClickMovedTurnedAndTakenAway) {
  Hand hand = on_meadow({{10, 10}});
  hand.take(ToolKind::hero);
  hand.click({30, 30});
  EXPECT_TRUE(hand.document().heroes.empty());  // none in hand
  hand.settings.hero = small_hero(hand.document());
  hand.click({30, 30});
  hand.click({45, 15});
  ASSERT_EQ(hand.document().heroes.size(), 2u);
  EXPECT_EQ(hand.history().undo_name(), "Place 'old birch'");
  const std::int32_t id = hand.document().heroes[0].id;
  EXPECT_LT(id, 0);
  EXPECT_EQ(hand.document().heroes[0].skeleton, hand.document().heroes[1].skeleton);  // shared

  hand.take(ToolKind::select);
  hand.click({30, 30});
  EXPECT_EQ(hand.selection, std::vector<std::int32_t>{id});
  hand.drag({30, 30}, {20, 40});
  EXPECT_NEAR(glm::distance(find_hero(hand.document(), id)->at, Vec2(20, 40)), 0, 0.1f);
  EXPECT_EQ(hand.document().trees->find(1)->at, Vec2(10, 10));

  // Trees and hero trees go together.
  hand.selection = {id, 1};
  hand.drag({20, 40}, {23, 40});
  EXPECT_NEAR(find_hero(hand.document(), id)->at.x, 23, 0.1f);
  EXPECT_NEAR(hand.document().trees->find(1)->at.x, 13, 0.1f);
  hand.key(kKeyDelete);
  EXPECT_EQ(hand.document().heroes.size(), 1u);
  EXPECT_EQ(hand.trees(), 0u);
  hand.history().undo();
  EXPECT_EQ(hand.document().heroes.size(), 2u);
  EXPECT_EQ(hand.trees(), 1u);
}

TEST(Tools, AHeroTreeTurnsAboutItsFoot) {
  Hand hand = on_meadow();
  const HeroInHand hero = small_hero(hand.document());
  const auto placed = place_hero(hand.document(), hero, {30, 30}, 90);
  ASSERT_TRUE(placed);
  const Vec3 was = hero.skeleton->distal.back(), is = placed->document.heroes[0].skeleton->distal.back();
  EXPECT_NEAR(is.x, was.z, 1e-4f);  // east comes to north
  EXPECT_NEAR(is.z, -was.x, 1e-4f);
  EXPECT_EQ(is.y, was.y);
  const auto larger = scene::turn_hero(placed->document, placed->document.heroes[0].id, 2, 0);
  ASSERT_TRUE(larger);
  EXPECT_NEAR(extent_of(*larger->document.heroes[0].skeleton).height_m, 2 * extent_of(*hero.skeleton).height_m, 1e-3f);
  EXPECT_FALSE(place_hero(hand.document(), hero, {-5, 30}, 0));
}

TEST(Tools, AStrokeOffTheSiteOrOfNoLengthDoesNoHarm) {
  for (int k = 0; k < kToolCount; ++k) {
    Hand hand = on_meadow({{30, 30}});
    hand.take(static_cast<ToolKind>(k));
    hand.settings.radius_m = kMostRadius_m;  // larger than the site
    hand.send(Event::Kind::press, {-40, -40});
    hand.send(Event::Kind::move, {-40, -40});
    hand.send(Event::Kind::release, {-40, -40});
    hand.key(kKeyEnter);
    hand.key(kKeyBackspace);
    hand.tool().cancel();
    EXPECT_FALSE(hand.tool().busy()) << tool_info(static_cast<ToolKind>(k)).name;
    for (const scene::Tree& tree : *hand.document().trees)
      EXPECT_TRUE(terrain::on_site(*hand.document().terrain, tree.at));
  }
}

}  // namespace
}  // namespace bosquet::ui
