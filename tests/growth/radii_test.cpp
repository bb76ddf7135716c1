#include "growth/radii.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "sample_trees.h"

namespace bosquet::growth {
namespace {

TEST(Radii, ThePipeEquationHoldsAtEveryFork) {
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.1f;  // fallen wood must count too
  for (const float detail : {0.5f, 1.0f, 2.0f}) {
    GrowthInput input = sample_input(p, 3);
    input.detail = detail;
    const Skeleton s = grow(input);
    const double n = s.pipe_exponent, own = std::pow(s.tip_diameter_m, n);
    std::vector<double> children(s.size(), 0.0);
    for (std::size_t i = s.size(); i-- > 0;) {
      const double carried = std::pow(2.0 * s.radius[i], n);
      if (children[i] > 0.0) {
        EXPECT_NEAR(carried / (children[i] + s.own_pipes(i) * own), 1.0, 1e-5) << "internode " << i;
      }
      if (s.parent[i] >= 0) children[static_cast<std::size_t>(s.parent[i])] += carried;
    }
  }
}

TEST(Radii, TipsAreAsWideAsTheParameterSays) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 3));
  float thinnest = 1.0f;
  for (const float r : s.radius) thinnest = std::min(thinnest, r);
  EXPECT_FLOAT_EQ(2.0f * thinnest, s.tip_diameter_m);
}

TEST(Radii, AnEarlierSeasonIsThinnerAndHasNoWoodThatIsNotBorn) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 3));
  const std::vector<float> before = radii(s, s.seasons / 2);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.born[i] > s.seasons / 2) {
      EXPECT_EQ(before[i], 0.0f);
    } else {
      EXPECT_LE(before[i], s.radius[i]);
    }
  }
  EXPECT_LT(before[0], s.radius[0]);
}

TEST(Radii, AConstrainedTrunkHasItsDiameterAtBreastHeight) {
  const Parameters p = sample_parameters();
  Skeleton s = grow(sample_input(p, 3));
  for (const float diameter : {0.1f, 0.3f, 0.9f}) {
    ASSERT_TRUE(constrain_trunk(s, diameter));
    const auto at = static_cast<std::size_t>(breast_height_internode(s));
    EXPECT_NEAR(2.0f * s.radius[at] / diameter, 1.0f, 1e-5f);
    EXPECT_GE(s.distal[at].y, 1.3f);
  }
}

TEST(Radii, ATrunkThinnerThanItsTwigsIsRefused) {
  const Parameters p = sample_parameters();
  Skeleton s = grow(sample_input(p, 3));
  const Result<void> result = constrain_trunk(s, 0.5f * s.tip_diameter_m);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("no pipe exponent gives a width of"), std::string::npos);
}

TEST(Radii, MurraysAndLeonardosForksGiveTheirExponents) {
  const std::array<Widths, 1> leonardo{{{1.0 / std::sqrt(2.0), 2.0}}};
  EXPECT_NEAR(*solve_exponent(leonardo, 1.0), 2.0, 3e-6);
  const std::array<Widths, 1> murray{{{std::cbrt(0.5), 2.0}}};
  EXPECT_NEAR(*solve_exponent(murray, 1.0), 3.0, 3e-6);
}

TEST(Radii, AWidthNotAboveItsWidestChildHasNoExponent) {
  const std::array<Widths, 2> widths{{{0.1, 1.0}, {0.05, 3.0}}};
  EXPECT_FALSE(solve_exponent(widths, 0.1));
  EXPECT_TRUE(solve_exponent(widths, 0.11));
}

RC_GTEST_PROP(Radii, TheSolvedExponentFulfilsThePipeEquation, ()) {
  const int kinds = *rc::gen::inRange(1, 5);
  std::vector<Widths> widths;
  double widest = 0.0, count = 0.0;
  for (int i = 0; i < kinds; ++i) {
    const double d = *rc::gen::inRange(1, 500) * 0.001;
    const double c = *rc::gen::inRange(1, 2000);
    widths.push_back({d, c});
    widest = std::max(widest, d), count += c;
  }
  RC_PRE(count > 1.0);
  const double base = widest * (1.0 + *rc::gen::inRange(1, 4000) * 0.001);
  const Result<double> n = solve_exponent(widths, base);
  RC_ASSERT(static_cast<bool>(n));
  double sum = 0.0;
  for (const Widths& w : widths) sum += w.count * std::pow(w.diameter_m / base, *n);
  // Told as the base width that the exponent gives back, base * sum^(1/n): logarithms are known to float's 6e-8.
  RC_ASSERT(std::abs(sum - 1.0) / *n < 1e-6);
}

}  // namespace
}  // namespace bosquet::growth
