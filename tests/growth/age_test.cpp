#include "growth/age.h"

#include <gtest/gtest.h>

#include <cmath>

#include "growth/digest.h"
#include "growth/grow.h"
#include "growth/measure.h"
#include "growth/radii.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

Parameters shedding_parameters() {
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.15f;
  return p;
}

TEST(Age, ATreeAtItsAgeIsTheWholeTreeWhateverItsScale) {
  const Parameters p = sample_parameters();
  const float full = 12.0f;
  for (const float height : {1.0f, 3.0f, 6.0f, 10.0f, 12.0f}) {
    const Skeleton s = grow(sample_input(p, 1, height));
    const float age = age_at_height(p, full, height);
    EXPECT_EQ(season_at_age(p, s, full, height, age), s.seasons - 1) << height;
    EXPECT_EQ(season_at_age(p, s, full, height, age + 100.0f), s.seasons - 1) << "time takes no tree forward";
    // At a younger age it is as high as every tree of its kind at that age, within the internodes of a season.
    const float years = 0.5f * age;
    const float then = measure(s, season_at_age(p, s, full, height, years)).height_m;
    const float expected = height_share_at_age(p, years) * full;
    EXPECT_GE(then, expected);
    EXPECT_LE(then, expected + static_cast<float>(p.max_shoot_length) * s.internode_length_m);
  }
}

TEST(Age, ASmallTreeOnAFullCurveIsYoungAndOneOnItsOwnCurveIsOld) {
  const Parameters p = sample_parameters();
  EXPECT_LT(age_at_height(p, 12.0f, 3.0f), 0.4f * age_at_height(p, 3.0f, 3.0f));
  EXPECT_FLOAT_EQ(age_at_height(p, 3.0f, 3.0f), age_at_height(p, 12.0f, 12.0f));
}

TEST(Age, TheYoungerTreeIsTheTreeThatHadStoppedThen) {
  // Grown anew to the season and not further: the same wood, the same falls, the same radii to the bit.
  for (const float detail : {1.0f, 2.0f, 0.5f}) {
    const Parameters p = shedding_parameters();
    GrowthInput input = sample_input(p, 3);
    input.detail = detail;
    const Skeleton whole = grow(input);
    for (const int seasons : {10, 12, 13}) {
      ASSERT_LT(seasons, whole.seasons);
      Parameters stopped = p;
      stopped.max_seasons = seasons;
      input.parameters = &stopped;
      const Skeleton then = grow(input), young = tree_at_season(whole, seasons - 1);
      EXPECT_EQ(young.seasons, then.seasons);
      if (detail < 1.0f) {
        // What is merged depends on what the branches carry at the end, so only the silhouette is the same.
        EXPECT_NEAR(measure(young).height_m, measure(then).height_m, 2.0f * whole.internode_length_m);
        continue;
      }
      EXPECT_EQ(young.parent, then.parent);
      EXPECT_EQ(young.axis, then.axis);
      EXPECT_EQ(young.order, then.order);
      EXPECT_EQ(young.born, then.born);
      EXPECT_EQ(young.shed, then.shed);
      EXPECT_EQ(young.radius, then.radius);
      EXPECT_EQ(young.pipes, then.pipes);
      // A smooth axis bends a little at what was its tip.
      for (std::size_t i = 0; i < then.size(); ++i) {
        EXPECT_LE(glm::length(young.distal[i] - then.distal[i]), detail == 1.0f ? 0.0f : 0.3f * p.internode_length_m);
      }
    }
  }
}

TEST(Age, TheYoungerTreesRadiiFulfilThePipeEquationWithFallenWoodRemembered) {
  const Parameters p = shedding_parameters();
  const Skeleton whole = grow(sample_input(p, 5));
  int fallen_behind = 0;
  for (int season = 0; season < whole.seasons; ++season) {
    const Skeleton young = tree_at_season(whole, season);
    const std::vector<float> same = radii(whole, season);
    const double n = young.pipe_exponent, own = std::pow(young.tip_diameter_m, n);
    std::vector<double> children(young.size(), 0.0);
    for (std::size_t i = young.size(); i-- > 0;) {
      ASSERT_EQ(young.radius[i], same[i]);
      ASSERT_EQ(young.alive(i), whole.alive_at(i, season));
      const double carried = std::pow(2.0 * young.radius[i], n);
      ASSERT_NEAR(carried / (children[i] > 0.0 ? children[i] + own : own), 1.0, 1e-5) << season << ", " << i;
      if (young.parent[i] < 0) continue;
      const auto parent = static_cast<std::size_t>(young.parent[i]);
      children[parent] += carried;
      fallen_behind += !young.alive(i) && young.alive(parent);
    }
  }
  EXPECT_GT(fallen_behind, 10) << "branches that fell must count in the wood that stands";
}

TEST(Age, TheLastSeasonIsTheWholeTreeAndTheFirstItsFirstShoot) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 1));
  EXPECT_EQ(digest(tree_at_season(s, s.seasons - 1)), digest(s));
  EXPECT_EQ(digest(tree_at_season(s, -1)), digest(s));
  const Skeleton first = tree_at_season(s, 0);
  EXPECT_EQ(first.size(), static_cast<std::size_t>(p.max_shoot_length));
  for (const std::uint16_t born : first.born) EXPECT_EQ(born, 0);
}

}  // namespace
}  // namespace bosquet::growth
