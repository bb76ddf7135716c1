#include "distribution/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/parallel.h"
#include "terrain/brush.h"
#include "terrain/exclusion.h"

namespace bosquet::distribution {
namespace {

const std::vector<Species> kSpecies{{"oak", 0.5f, {.min_spacing_m = 0}}, {"birch", 0.3f, {.min_spacing_m = 0}}};
const std::vector<Stature> kStatures{{6.0f, 0.02f, 1.3f}, {3.0f, 0.05f, 1.5f}};
const Sowing kMix{.seed = 1, .block = 5, .first_index = 0, .mix = {{0, 1}, {1, 1}}};

Planting bare_ground(Vec2 size = {100, 100}) {
  const auto site = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(size)));
  return *Planting::make(site, kSpecies, {});
}

Box2 whole_site(const Planting& p) { return {Vec2{0}, p.terrain().size_m()}; }

Thinned stand(ThinningRules rules, const Sowing& what = kMix) {
  Planting p = bare_ground();
  return fill_by_thinning(p, what, whole_site(p), rules, kStatures);
}

float radius(const StandingTree& tree, const ThinningRules& rules) {
  return rules.crowding * tree.scale * kStatures[tree.species].crown_radius_m;
}

TEST(Thinning, NoTwoCirclesOfTheTreesLeftMeet) {
  for (const float regeneration : {0.0f, 200.0f}) {
    const ThinningRules rules{.regeneration_per_ha = regeneration, .years = 70, .least_scale = 0.02f};
    const Thinned left = stand(rules);
    ASSERT_GT(left.trees.size(), 100u);
    EXPECT_GT(left.dominated, left.trees.size());
    for (std::size_t i = 0; i < left.trees.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(glm::distance(left.trees[i].at, left.trees[j].at),
                  (radius(left.trees[i], rules) + radius(left.trees[j], rules)) * 0.99999f);
  }
}

TEST(Thinning, VolumeRisesAsNumbersToThePowerOfMinusThreeHalves) {
  // Yoda's rule for stands of one age: once circles meet, log mean volume falls along a line of slope -3/2 over log
  // number. Four stands of one species, every five years from 20, when their wide circles have met all over, to 80.
  Sowing oaks = kMix;
  oaks.mix = {{0, 1}};
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    oaks.seed = seed;
    double before = 1e9;
    for (int years = 20; years <= 80; years += 5) {
      const ThinningRules rules{
          .seedlings_per_ha = 5000, .regeneration_per_ha = 0, .years = years, .crowding = 0.7f, .least_scale = 0.02f};
      const Thinned left = stand(rules, oaks);
      double volume = 0;
      for (const StandingTree& tree : left.trees)
        volume += std::pow(radius(tree, rules), 3) / static_cast<double>(left.trees.size());
      EXPECT_LT(static_cast<double>(left.trees.size()), before) << seed << ' ' << years;
      before = static_cast<double>(left.trees.size());
      const double lx = std::log(before), ly = std::log(volume);
      n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
    }
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  EXPECT_NEAR(slope, -1.5, 0.1);
}

TEST(Thinning, FewerYearsGiveTheStandAsItWasThen) {
  // Nobody who is missing early comes back: the trees left after 60 years that were born by then were there after 30.
  const ThinningRules early{.years = 30, .least_scale = 0.02f}, late{.years = 60, .least_scale = 0.02f};
  std::map<std::uint64_t, StandingTree> then;
  for (const StandingTree& tree : stand(early).trees) then[tree.key] = tree;
  const Thinned left = stand(late);
  int old = 0;
  for (std::size_t n = 0; n < left.trees.size(); ++n) {
    if (left.ages[n] < 50) continue;  // a younger one may have been below least_scale
    ++old;
    ASSERT_TRUE(then.contains(left.trees[n].key));
    EXPECT_EQ(then[left.trees[n].key].at, left.trees[n].at);
    EXPECT_LT(then[left.trees[n].key].scale, left.trees[n].scale);
  }
  EXPECT_GT(old, 20);
}

TEST(Thinning, RegenerationMixesTheAges) {
  const Thinned even = stand({.regeneration_per_ha = 0, .years = 90});
  EXPECT_EQ(std::count(even.ages.begin(), even.ages.end(), 90), std::ssize(even.ages));
  const Thinned mixed = stand({.regeneration_per_ha = 100, .years = 90});
  const auto young = std::count_if(mixed.ages.begin(), mixed.ages.end(), [](int age) { return age < 45; });
  EXPECT_GT(young, 20);
  EXPECT_GT(std::ssize(mixed.ages) - young, 20);
}

TEST(Thinning, OldTreesDieAndLeaveGapsForOthers) {
  const Thinned left = stand({.regeneration_per_ha = 100, .years = 200, .lifespan_years = 80});
  EXPECT_GT(left.aged, 50u);
  for (const int age : left.ages) EXPECT_LE(age, 96);
  EXPECT_GT(left.trees.size(), 50u);
}

TEST(Thinning, AnyNumberOfThreadsGivesTheSameTrees) {
  const auto at = [](int threads) {
    Thinned left;
    run_with_threads(threads, [&] { left = stand({.regeneration_per_ha = 100, .years = 50}); });
    return left.trees;
  };
  EXPECT_EQ(at(1), at(3));
}

TEST(Thinning, AnotherAreaOrMoreSeedlingsLaterLeaveFarTreesAsTheyAre) {
  const ThinningRules rules{.years = 50};
  Planting p = bare_ground(), q = bare_ground();
  const Polygon all{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {}};
  Polygon bitten = all;
  bitten.holes = {{{5, 5}, {30, 5}, {30, 30}, {5, 30}}};
  const auto a = fill_by_thinning(p, kMix, all, rules, kStatures).trees;
  const auto b = fill_by_thinning(q, kMix, bitten, rules, kStatures).trees;
  // Round the hole trees that were dominated live and dominate others; that must fade out.
  std::map<std::uint64_t, StandingTree> before;
  for (const StandingTree& tree : a) before[tree.key] = tree;
  int far = 0, changed = 0;
  for (const StandingTree& tree : b) {
    EXPECT_FALSE(contains(Box2{{5.01f, 5.01f}, {29.99f, 29.99f}}, tree.at));
    if (tree.at.x < 50 && tree.at.y < 50) continue;
    ++far;
    changed += !before.contains(tree.key) || before[tree.key] != tree;
  }
  EXPECT_GT(far, 150);
  EXPECT_LT(changed, far / 50);
}

TEST(Thinning, NothingGrowsOnPathsInWaterOrIntoTreesThatStoodBefore) {
  terrain::Terrain site = terrain::make_terrain(
      terrain::Heightfield(*terrain::make_lattice({100, 100}), [](Vec2 p) { return 0.1f * p.x; }));
  site.water_level_m = 1.0f;  // west of 10 m
  site = terrain::exclude_path(site, std::vector<Vec2>{{0, 50}, {100, 50}}, 6);
  Planting p = *Planting::make(site, kSpecies, {});
  const StandingTree old = standing_tree(77, 0, kSpecies[0], {60, 80}, 1.2f);
  p.add(old);
  const ThinningRules rules{.years = 40};
  const Thinned left = fill_by_thinning(p, kMix, whole_site(p), rules, kStatures);
  ASSERT_GT(left.trees.size(), 50u);
  EXPECT_EQ(p.trees().size(), left.trees.size() + 1);
  for (const StandingTree& tree : left.trees) {
    EXPECT_GE(tree.at.x, 9.99f);
    EXPECT_GT(std::abs(tree.at.y - 50), 2.9f);
    EXPECT_GE(glm::distance(tree.at, old.at), (radius(tree, rules) + radius(old, rules)) * 0.99999f);
  }
}

TEST(Thinning, SeedlingsAreAsManyAsAskedForAndThinnedByTheDensityMask) {
  terrain::Terrain site = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({100, 100})));
  const ThinningRules rules{.seedlings_per_ha = 10'000, .years = 1};
  Planting p = *Planting::make(site, kSpecies, {});
  EXPECT_EQ(fill_by_thinning(p, kMix, whole_site(p), rules, kStatures).seedlings, 10'000u);
  site = terrain::apply(site, {.kind = terrain::BrushKind::density,
                               .points = {{20, -50}, {20, 150}},
                               .radius_m = 20,
                               .hardness = 1.0f,
                               .density = 0.25f});
  Planting q = *Planting::make(site, kSpecies, {});
  const auto thinned = fill_by_thinning(q, kMix, whole_site(q), rules, kStatures).seedlings;
  EXPECT_NEAR(static_cast<double>(thinned), 7'000, 4 * std::sqrt(4'000 * 0.25 * 0.75) + 100);  // 40 m of a quarter
}

TEST(Thinning, NoSeedlingsLeaveNothing) {
  EXPECT_TRUE(stand({.seedlings_per_ha = 0, .regeneration_per_ha = 0}).trees.empty());
  Planting p = bare_ground();
  EXPECT_TRUE(fill_by_thinning(p, kMix, Box2{{200, 200}, {300, 300}}, {}, kStatures).trees.empty());
}

}  // namespace
}  // namespace bosquet::distribution
