#include "distribution/planting.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "distribution/inventory.h"
#include "distribution/sowing.h"
#include "terrain/brush.h"

namespace bosquet::distribution {
namespace {

terrain::Terrain flat(Vec2 size_m) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(size_m)));
}

constexpr std::span<const Interaction> kNone;

Species species(const char* name, PlantingRules rules = {}) { return {name, 0.4f, rules}; }

const std::vector<Interaction> kInteractions{{"a", "a", KernelKind::clustering, 4.0f, 8.0f},
                                             {"a", "b", KernelKind::inhibition, 3.0f, 5.0f},
                                             {"b", "b", KernelKind::clustering, 6.0f, 2.0f}};

Planting planting(const terrain::Terrain& site, std::vector<Species> list = {species("a"), species("b")},
                  std::span<const Interaction> interactions = kInteractions, float cell_m = 0.0f) {
  auto made = Planting::make(site, std::move(list), interactions, cell_m);
  EXPECT_TRUE(made);
  return *std::move(made);
}

Box2 whole(const Planting& p) { return {Vec2{0}, p.terrain().size_m()}; }

RC_GTEST_PROP(Planting, FieldsAfterAnyPlacingRemovingMovingAndReplacingEqualFieldsMadeAnew, ()) {
  Planting p = planting(flat({20, 15}));
  p.field(0), p.field(1);  // both exist from the start
  std::vector<std::uint64_t> keys;
  for (int n = 0; n < 40; ++n) {
    const int what = *rc::gen::inRange(0, 5);
    if (what <= 1 || keys.empty()) {
      const Sown sown =
          sow(p, {.seed = 3, .block = 9, .first_index = static_cast<std::uint64_t>(n), .mix = {{0}, {1}}}, whole(p), 1);
      for (const StandingTree& tree : sown.trees) keys.push_back(tree.key);
      continue;
    }
    const auto which = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(keys.size())));
    if (what == 2) {
      RC_ASSERT(p.remove(keys[which]));
      keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(which));
    } else if (what == 3) {
      StandingTree tree = *p.find(keys[which]);
      tree.species = 1 - tree.species, tree.scale *= 1.3f, tree.trunk_radius_m *= 1.3f, tree.spacing_m += 0.2f;
      RC_ASSERT(p.replace(tree));
    } else {
      RC_ASSERT(p.move(keys[which], {static_cast<float>(*rc::gen::inRange(0, 200)) / 10.0f,
                                     static_cast<float>(*rc::gen::inRange(0, 150)) / 10.0f}));
    }
  }
  Planting again = planting(flat({20, 15}));
  std::vector<StandingTree> trees(p.trees().begin(), p.trees().end());
  std::sort(trees.begin(), trees.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  for (const StandingTree& tree : trees) again.add(tree);
  RC_ASSERT(p.field(0) == again.field(0));
  RC_ASSERT(p.field(1) == again.field(1));
}

TEST(Planting, EveryTreeKeepsItsDistanceHoweverCoarseTheFieldIs) {
  for (const float cell : {0.1f, 0.5f, 2.0f}) {
    Planting p = planting(flat({30, 30}), {species("a", {.min_spacing_m = 1.2f}), species("b", {.min_spacing_m = 0})},
                          kInteractions, cell);
    const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0}, {1}}}, whole(p), 250);
    ASSERT_EQ(sown.trees.size(), 250u) << cell;
    for (std::size_t i = 0; i < sown.trees.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_GE(glm::distance(sown.trees[i].at, sown.trees[j].at), least_distance_m(sown.trees[i], sown.trees[j]));
  }
}

TEST(Planting, NothingIsSownOffTheSiteInExclusionsWaterOrAgainstTheSpeciesLimits) {
  terrain::Terrain site = terrain::make_terrain(terrain::Heightfield(
      *terrain::make_lattice({60, 40}), [](Vec2 p) { return p.x < 40 ? 0.1f * p.x : 4.0f + 1.5f * (p.x - 40); }));
  site.water_level_m = 1.0f;  // west of 10 m
  site = terrain::exclude_path(site, std::vector<Vec2>{{0, 20}, {60, 20}}, 6.0f);
  Planting p = planting(site, {species("a", {.max_slope_deg = 30}), species("b", {.max_altitude_m = 2.5f})});
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0}, {1}}}, Box2{Vec2{-50}, Vec2{100}}, 500);
  ASSERT_EQ(sown.trees.size(), 500u);
  for (const StandingTree& tree : sown.trees) {
    EXPECT_GE(tree.at.x, 9.99f);
    EXPECT_LE(tree.at.x, tree.species == 0 ? 40.6f : 25.01f);  // the slope's edge is a cell wide
    EXPECT_TRUE(tree.at.y >= 0 && tree.at.y <= 40);
    EXPECT_GT(std::abs(tree.at.y - 20), 2.95f);
  }
}

TEST(Planting, TheDensityMaskThinsWhatIsSown) {
  terrain::Terrain site = flat({80, 40});
  site = terrain::apply(site, {.kind = terrain::BrushKind::density,
                               .points = {{20, -50}, {20, 90}},
                               .radius_m = 20,
                               .hardness = 1.0f,
                               .density = 0.25f});
  // So few and thin trees that they hardly stand in each other's way.
  Planting p = planting(site, {{"a", 0.02f, {.min_spacing_m = 0}}}, {});
  const Sown sown = sow(p, {.seed = 5, .block = 1, .mix = {{0}}}, whole(p), 1000);
  const auto west = std::count_if(sown.trees.begin(), sown.trees.end(), [](const auto& t) { return t.at.x < 40; });
  EXPECT_NEAR(static_cast<double>(west), 200, 4 * std::sqrt(1000 * 0.2 * 0.8));  // 1/4 to 1: a fifth
}

TEST(Sowing, StopsAndSaysSoWhenNoRoomIsLeft) {
  Planting p = planting(flat({10, 10}), {species("a", {.min_spacing_m = 2.0f})}, {});
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0}}}, whole(p), 1000);
  EXPECT_TRUE(sown.no_room);
  EXPECT_EQ(sown.asked, 1000u);
  EXPECT_GT(sown.trees.size(),
            15u);  // random sequential packing covers 0.547: some 17 discs of radius 1, more at edges
  EXPECT_LT(sown.trees.size(), 36u);
  // What it closed on the way is open again, or the field would have drifted from its trees.
  Planting again = planting(flat({10, 10}), {species("a", {.min_spacing_m = 2.0f})}, {});
  for (const StandingTree& tree : sown.trees) again.add(tree);
  EXPECT_EQ(p.field(0), again.field(0));
}

TEST(Sowing, ATypeWithoutRoomLeavesThePlaceToTheOthers) {
  terrain::Terrain site = flat({30, 30});
  Planting p = planting(site, {species("a", {.min_altitude_m = 100}), species("b")}, {});
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0, 9}, {1, 1}}}, whole(p), 50);
  EXPECT_EQ(sown.trees.size(), 50u);
  EXPECT_FALSE(sown.no_room);
  for (const StandingTree& tree : sown.trees) EXPECT_EQ(tree.species, 1u);
}

TEST(Sowing, TypesAndScalesFollowTheMix) {
  Planting p = planting(flat({200, 200}), {species("a", {.scale_min = 0.5f, .scale_max = 1.0f}), species("b")}, {});
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0, 3}, {1, 1, 2.0f, 3.0f}}}, whole(p), 2000);
  double first = 0, scale = 0;
  for (const StandingTree& tree : sown.trees) {
    first += tree.species == 0;
    EXPECT_TRUE(tree.species == 0 ? tree.scale >= 0.5f && tree.scale < 1 : tree.scale >= 2 && tree.scale < 3);
    EXPECT_FLOAT_EQ(tree.trunk_radius_m, 0.2f * tree.scale);
    if (tree.species == 0) scale += tree.scale;
  }
  EXPECT_NEAR(first, 1500, 4 * std::sqrt(2000 * 0.75 * 0.25));
  EXPECT_NEAR(scale / first, 0.75, 4 * 0.5 / std::sqrt(12.0 * first));
}

TEST(Sowing, TheSameSeedAndBlockGiveTheSameTreesAndAnotherSeedOthers) {
  const auto trees = [](std::uint64_t seed) {
    Planting p = planting(flat({40, 40}));
    return sow(p, {.seed = seed, .block = 1, .mix = {{0}, {1}}}, whole(p), 100).trees;
  };
  EXPECT_EQ(trees(1), trees(1));
  EXPECT_NE(trees(1), trees(2));
}

// How many of the trees outside `changed` stand elsewhere when the site is another.
double share_moved(const terrain::Terrain& before, const terrain::Terrain& after,
                   const std::vector<Interaction>& interactions, const Region& changed, int count) {
  std::map<std::uint64_t, Vec2> places;
  Planting p = planting(before, {species("a"), species("b")}, interactions);
  const Sowing what{.seed = 4, .block = 1, .mix = {{0}, {1}}};
  for (const StandingTree& tree : sow(p, what, whole(p), static_cast<std::size_t>(count)).trees)
    places[tree.key] = tree.at;
  Planting q = planting(after, {species("a"), species("b")}, interactions);
  double others = 0, moved = 0;
  for (const StandingTree& tree : sow(q, what, whole(q), static_cast<std::size_t>(count)).trees) {
    if (contains(changed, places[tree.key])) continue;
    ++others;
    moved += places[tree.key] != tree.at;
  }
  return moved / others;
}

TEST(Sowing, ExcludingFivePercentOfTheSiteMovesFewOfTheOtherTrees) {
  const terrain::Terrain before = flat({100, 100});
  const std::vector<Interaction> mild{{"a", "a", KernelKind::clustering, 4, 3},
                                      {"a", "b", KernelKind::inhibition, 4, 3},
                                      {"b", "a", KernelKind::inhibition, 4, 3}};
  for (const Box2 box : {Box2{{0, 0}, {22.36f, 22.36f}}, Box2{{40, 55}, {62.36f, 77.36f}}, Box2{{0, 30}, {100, 35}}}) {
    Polygon area{{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}, {}};
    const terrain::Terrain after = terrain::exclude(before, area);
    EXPECT_LT(share_moved(before, after, {}, box, 400), 0.01) << box.low.x << ' ' << box.low.y;
    // Through kernels a moved tree also changes the draws of those sown later near its old and new place.
    EXPECT_LT(share_moved(before, after, mild, box, 400), 0.10) << box.low.x << ' ' << box.low.y;
  }
}

TEST(Sowing, AFilledPolygonComesToTheDensityAskedForWhereTreesMayStand) {
  Planting p = planting(flat({100, 100}), {species("a"), species("b")}, {});
  const Region hectare_half = Polygon{{{10, 10}, {90, 10}, {90, 72.5f}, {10, 72.5f}}, {}};  // 5000 m2
  const Sowing what{.seed = 1, .block = 1, .mix = {{0}}};
  EXPECT_EQ(count_to_density(p, what, hectare_half, 400), 200u);
  EXPECT_EQ(sow(p, what, hectare_half, 150).trees.size(), 150u);
  EXPECT_EQ(count_to_density(p, what, hectare_half, 400), 50u);
  EXPECT_EQ(count_to_density(p, what, hectare_half, 100), 0u);
  EXPECT_EQ(count_to_density(p, {.mix = {{1}}}, hectare_half, 400), 200u);  // the other species' trees do not count

  const terrain::Terrain half = terrain::exclude(flat({100, 100}), Polygon{{{0, 0}, {50, 0}, {50, 100}, {0, 100}}, {}});
  Planting q = planting(half, {species("a")}, {});
  EXPECT_NEAR(static_cast<double>(count_to_density(q, what, hectare_half, 400)), 100, 2);
}

TEST(Brush, TreesComeAtARateOfStrengthTimesSquaredRadiusTimesTime) {
  const std::vector<Vec2> line{{20, 20}, {80, 80}};
  for (const auto& [radius, strength, seconds] :
       {std::tuple{5.0f, 0.5f, 4.0f}, {10.0f, 0.25f, 4.0f}, {5.0f, 1.0f, 8.0f}}) {
    Planting p = planting(flat({100, 100}), {species("a")}, {});
    const Sown sown =
        sow_stroke(p, {.seed = 1, .block = 1, .mix = {{0}}}, {radius, strength, 0.2f}, steady_stroke(line, seconds));
    EXPECT_EQ(sown.trees.size(), static_cast<std::size_t>(1 + 0.2f * strength * radius * radius * seconds));
    for (const StandingTree& tree : sown.trees)
      EXPECT_LE(std::abs(tree.at.x - tree.at.y) / std::sqrt(2.0f), radius + 0.01f);
  }
}

TEST(Brush, AStrokeDoesNotDependOnHowManyEventsRecordedIt) {
  std::vector<BrushEvent> sparse{{{20, 30}, 0}, {{80, 60}, 240}}, dense;
  for (int n = 0; n <= 240; ++n) dense.push_back({Vec2{20, 30} + Vec2{60, 30} * (static_cast<float>(n) / 240.0f), n});
  const auto trees = [](std::span<const BrushEvent> events) {
    Planting p = planting(flat({100, 100}));
    return sow_stroke(p, {.seed = 1, .block = 1, .mix = {{0}, {1}}}, {8, 1, 0.4f}, events).trees;
  };
  EXPECT_EQ(trees(sparse), trees(dense));
  EXPECT_EQ(trees(sparse).size(), 103u);
}

TEST(Brush, AClickPlantsOneTreeUnderTheBrush) {
  Planting p = planting(flat({100, 100}));
  const BrushEvent click{{30, 40}, 0};
  const Sown sown = sow_stroke(p, {.seed = 1, .block = 1, .mix = {{0}}}, {0.5f, 1, 0.2f}, {&click, 1});
  ASSERT_EQ(sown.trees.size(), 1u);
  EXPECT_LE(glm::distance(sown.trees[0].at, Vec2(30, 40)), 0.5f);
}

TEST(Brush, WhereThereIsNoRoomTreesAreLeftOutAndTheStrokeGoesOn) {
  const terrain::Terrain site = terrain::exclude(flat({100, 20}), Polygon{{{30, 0}, {70, 0}, {70, 20}, {30, 20}}, {}});
  Planting p = planting(site, {species("a")}, {});
  const Sown sown = sow_stroke(p, {.seed = 1, .block = 1, .mix = {{0}}}, {3, 1, 1},
                               steady_stroke(std::vector<Vec2>{{10, 10}, {90, 10}}, 10));
  EXPECT_TRUE(sown.no_room);
  EXPECT_LT(sown.trees.size(), sown.asked);
  EXPECT_GT(sown.trees.back().at.x, 80);
}

TEST(Planting, InputThatContradictsItselfIsRefusedWithItsNames) {
  const auto error = [](std::vector<Species> list, std::vector<Interaction> interactions) {
    const auto made = Planting::make(flat({10, 10}), std::move(list), interactions);
    return made ? std::string() : made.error().message;
  };
  EXPECT_NE(error({species("oak")}, {{"oak", "ash", KernelKind::clustering, 3, 3}}).find("'ash'"), std::string::npos);
  EXPECT_NE(error({species("oak"), species("oak")}, {}).find("'oak'"), std::string::npos);
  EXPECT_NE(error({species("oak", {.scale_min = 2, .scale_max = 1})}, {}).find("scale_min"), std::string::npos);
  const Interaction twice{"oak", "oak", KernelKind::clustering, 3, 3};
  EXPECT_NE(error({species("oak")}, {twice, twice}).find("two interactions"), std::string::npos);
}

TEST(Planting, TreesUnderANewExclusionStayAndAreListed) {
  Planting p = planting(flat({30, 30}), {species("a")}, {});
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0}}}, whole(p), 100);
  const terrain::Terrain path = terrain::exclude_path(p.terrain(), std::vector<Vec2>{{0, 15}, {30, 15}}, 4);
  std::vector<std::uint64_t> expected;
  for (const StandingTree& tree : sown.trees)
    if (path.excluded(tree.at)) expected.push_back(tree.key);
  std::sort(expected.begin(), expected.end());
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(displaced(path, p.trees()), expected);
  EXPECT_TRUE(displaced(p.terrain(), p.trees()).empty());
}

TEST(Planting, NothingIsSownIntoBuildingsUnderMeshesOrAgainstTheirWalls) {
  Barriers barriers({40, 40});
  barriers.add(Polygon{{{5, 5}, {15, 5}, {15, 12}}, {}});
  barriers.add(Disc{{30, 10}, 4});
  barriers.add_triangle({Vec2{22, 22}, {39, 24}, {25, 39}});
  barriers.add_triangle({Vec2{3, 30}, {12, 36.5f}, {3, 30}});  // an upright wall: a line in plan
  const Polygon roof{{{22, 22}, {39, 24}, {25, 39}}, {}};
  auto made = Planting::make(flat({40, 40}), {species("a")}, kNone, 0, barriers);
  Planting& p = *made;
  const Sown sown = sow(p, {.seed = 1, .block = 1, .mix = {{0}}}, whole(p), 600);
  ASSERT_EQ(sown.trees.size(), 600u);
  const auto from_line = [](Vec2 at, Vec2 a, Vec2 b) {
    const Vec2 along = glm::normalize(b - a);
    const float share = glm::clamp(glm::dot(at - a, along), 0.0f, glm::distance(a, b));
    return glm::distance(at, a + share * along);
  };
  for (const StandingTree& tree : sown.trees) {
    EXPECT_FALSE((Polygon{{{5, 5}, {15, 5}, {15, 12}}, {}}).contains(tree.at));
    EXPECT_GE(from_line(tree.at, {5, 5}, {15, 5}), tree.trunk_radius_m);
    EXPECT_GE(glm::distance(tree.at, {30, 10}), 4 + tree.trunk_radius_m);
    EXPECT_FALSE(roof.contains(tree.at));
    EXPECT_GE(from_line(tree.at, {3, 30}, {12, 36.5f}), tree.trunk_radius_m);
  }
  // What no barrier touches stays open: about as dense right beside them as anywhere.
  EXPECT_EQ(p.refusal_by_hand(standing_tree(1, 0, species("a"), {10, 5.2f}, 1)), Refusal::built_over);
  EXPECT_EQ(p.refusal_by_hand(standing_tree(1, 0, species("a"), {39.7f, 23.2f}, 1)), Refusal::none);
  EXPECT_EQ(p.refusal_by_hand(standing_tree(1, 0, species("a"), {10, 30}, 1)), Refusal::none);
}

TEST(Planting, ATreeMadeLargerOrOfAnotherSpeciesIsAsIfItHadBeenPlantedSo) {
  Planting p = planting(flat({20, 20})), q = planting(flat({20, 20}));
  p.field(0), p.field(1);
  sow(p, {.seed = 3, .block = 9, .mix = {{0}, {1}}}, whole(p), 20);
  StandingTree tree = p.trees()[7];
  tree.species = 1 - tree.species, tree.scale *= 2, tree.trunk_radius_m *= 2;
  EXPECT_TRUE(p.replace(tree));
  EXPECT_FALSE(p.replace(standing_tree(99, 0, species("a"), {1, 1}, 1)));
  for (const StandingTree& t : p.trees()) q.add(t);
  EXPECT_EQ(p.field(0), q.field(0));
  EXPECT_EQ(p.field(1), q.field(1));
}

TEST(Planting, KeysInARegionAreThoseOfTheTreesThere) {
  Planting p = planting(flat({20, 20}));
  sow(p, {.seed = 3, .block = 9, .mix = {{0}, {1}}}, whole(p), 60);
  const Region lasso = Polygon{{{2, 2}, {18, 4}, {9, 17}}, {}};
  const auto keys = p.keys_in(lasso);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  std::size_t inside = 0;
  for (const StandingTree& tree : p.trees()) {
    inside += contains(lasso, tree.at);
    EXPECT_EQ(std::binary_search(keys.begin(), keys.end(), tree.key), contains(lasso, tree.at));
  }
  EXPECT_EQ(keys.size(), inside);
  EXPECT_GT(inside, 0u);
}

TEST(Sowing, AMixThatPlantsNothingIsAnErrorThatSaysWhy) {
  const Planting p = planting(flat({20, 20}));
  const auto message = [&](std::vector<MixEntry> mix) {
    const auto done = check(p, {.mix = std::move(mix)});
    return done ? std::string() : done.error().message;
  };
  EXPECT_EQ(message({{0, 1}, {1, 0}}), "");
  EXPECT_NE(message({}).find("no species"), std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}}).find("all species are 0"), std::string::npos);
  EXPECT_NE(message({{0, -1}}).find("share of a is -1"), std::string::npos);
  EXPECT_NE(message({{0, std::numeric_limits<float>::quiet_NaN()}}).find("share of a"), std::string::npos);
  EXPECT_NE(message({{7, 1}}).find("there are 2"), std::string::npos);
  EXPECT_NE(message({{0, 1, 2.0f, 1.0f}}).find("scales of a"), std::string::npos);
}

TEST(Sowing, UndoingAStrokeOrPaintingItOtherwiseLeavesTheTreesOfAllOthers) {
  // Each use of a tool has a block of its own. Trees stand once they are planted, so only keys and the strokes that
  // come later could be reshuffled, and these keep their keys, types and scales whatever went before.
  const auto stroke = [](Planting& p, std::uint64_t number, Vec2 from, Vec2 to) {
    return sow_stroke(p, {.seed = 1, .block = block_of_use(number), .mix = {{0}, {1}}}, {6, 1, 0.4f},
                      steady_stroke(std::vector<Vec2>{from, to}, 3))
        .trees;
  };
  Planting all = planting(flat({100, 100})), without = planting(flat({100, 100}));
  const auto first = stroke(all, 1, {20, 20}, {80, 20}), second = stroke(all, 2, {20, 26}, {80, 26});
  const auto third = stroke(all, 3, {20, 80}, {80, 80});
  EXPECT_EQ(stroke(without, 1, {20, 20}, {80, 20}), first);
  EXPECT_EQ(stroke(without, 3, {20, 80}, {80, 80}), third);  // far from the second: the same trees to the bit

  Planting later = planting(flat({100, 100}));
  const auto alone = stroke(later, 2, {20, 26}, {80, 26});  // without the first, whose kernels reach it
  ASSERT_EQ(alone.size(), second.size());
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_EQ(alone[n].key, second[n].key);
    EXPECT_EQ(alone[n].species, second[n].species);
    EXPECT_EQ(alone[n].scale, second[n].scale);
  }
  for (const StandingTree& tree : first) EXPECT_EQ(*all.find(tree.key), tree);  // nothing moved under later strokes

  std::vector<std::uint64_t> keys;
  for (std::uint64_t use = 0; use < 300; ++use)
    for (std::uint64_t n = 0; n < 300; ++n) keys.push_back(tree_key(block_of_use(use), n));
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(Inventory, DuplicatesAreMovedApartByTheSumOfTheirTrunksAndNothingElseIsMoved) {
  std::vector<StandingTree> trees;
  for (std::uint64_t n = 0; n < 50; ++n)
    trees.push_back({.key = n, .at = {static_cast<float>(n), 10.0f}, .trunk_radius_m = 0.3f});
  trees[7].at = trees[3].at;
  trees[20].at = trees[3].at;
  trees[49].at = trees[48].at = Vec2{50, 50};  // in the site's corner
  const std::vector<StandingTree> before = trees;
  const auto moved = move_duplicates_apart(trees, {50, 50});
  ASSERT_EQ(moved.size(), 3u);
  EXPECT_EQ(moved[0].index, 7u);
  EXPECT_EQ(moved[0].twin, 3u);
  for (const MovedApart& m : moved) {
    EXPECT_NEAR(glm::distance(m.from, m.to), 0.6f, 1e-5f);
    EXPECT_EQ(trees[m.index].at, m.to);
    EXPECT_TRUE(m.to.x <= 50 && m.to.y <= 50);
  }
  EXPECT_GT(glm::distance(trees[7].at, trees[20].at), kSamePlace_m);
  int changed = 0;
  for (std::size_t n = 0; n < trees.size(); ++n) changed += trees[n].at != before[n].at;
  EXPECT_EQ(changed, 3);
  std::vector<StandingTree> again = before;
  move_duplicates_apart(again, {50, 50});
  EXPECT_EQ(again, trees);
}

}  // namespace
}  // namespace bosquet::distribution
