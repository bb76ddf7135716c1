#include "growth/radii.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

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

TEST(Radii, OneWidthAtTheFootIsTheTreesOwnExponent) {
  const Parameters p = sample_parameters();
  Skeleton trunk = grow(sample_input(p, 3)), widths = trunk;
  const GivenWidth foot{0, 0.4f};
  ASSERT_TRUE(constrain_widths(widths, {&foot, 1}));
  double pipes = 0.0;
  for (std::size_t i = 0; i < trunk.size(); ++i) pipes += trunk.own_pipes(i);
  const std::array<Widths, 1> tips{{{static_cast<double>(trunk.tip_diameter_m), pipes}}};
  trunk.pipe_exponent = static_cast<float>(*solve_exponent(tips, 0.4));
  const std::vector<float> expected = radii(trunk);
  for (std::size_t i = 0; i < trunk.size(); ++i) EXPECT_NEAR(widths.radius[i] / expected[i], 1.0f, 1e-5f);
}

/// Given widths that a sculptor might set: the tree's own, times a factor, on internodes that carry some wood.
std::vector<GivenWidth> some_widths(const Skeleton& s, const std::vector<std::size_t>& internodes, float factor) {
  std::vector<GivenWidth> widths;
  for (const std::size_t i : internodes) {
    if (s.radius[i] > 2.0f * s.tip_diameter_m) widths.push_back({i, 2.0f * factor * s.radius[i]});
  }
  return widths;
}

RC_GTEST_PROP(Radii, GivenWidthsAreMetAndThePipeEquationHoldsInEveryPart, ()) {
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.1f;
  GrowthInput input = sample_input(p, 3, 8.0f);
  input.detail = *rc::gen::element(0.5f, 1.0f, 2.0f);
  Skeleton s = grow(input);
  std::vector<std::size_t> chosen;
  const int count = *rc::gen::inRange(0, 12);
  while (static_cast<int>(chosen.size()) < count) {
    // Thick wood stands at the front of the arrays.
    const auto i = *rc::gen::inRange<std::size_t>(0, s.size() / 4);
    if (std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
  }
  const std::vector<GivenWidth> widths = some_widths(s, chosen, static_cast<float>(*rc::gen::inRange(60, 160)) * 0.01f);
  RC_ASSERT(static_cast<bool>(constrain_widths(s, widths)));

  std::vector<int> part(s.size(), -1);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    RC_ASSERT(std::abs(2.0f * s.radius[widths[k].internode] / widths[k].diameter_m - 1.0f) < 1e-6f);
    part[widths[k].internode] = static_cast<int>(k);
  }
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (part[i] < 0 && s.parent[i] >= 0) part[i] = part[static_cast<std::size_t>(s.parent[i])];
  }
  // A slow oracle for the exponents: bisect what the pipes and the widths above leave of the width at the foot.
  std::vector<double> exponent(widths.size() + 1, static_cast<double>(s.pipe_exponent));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const auto excess = [&](double n) {
      double sum = -1.0;
      for (std::size_t i = 0; i < s.size(); ++i) {
        if (part[i] == static_cast<int>(k))
          sum += s.own_pipes(i) * std::pow(s.tip_diameter_m / widths[k].diameter_m, n);
      }
      for (const GivenWidth& above : widths) {
        const std::int32_t parent = s.parent[above.internode];
        if (parent >= 0 && part[static_cast<std::size_t>(parent)] == static_cast<int>(k)) {
          sum += std::pow(static_cast<double>(above.diameter_m / widths[k].diameter_m), n);
        }
      }
      return sum;
    };
    if (excess(1.0) == 0.0 && excess(2.0) == 0.0) continue;  // one piece of an internode on another: any will do
    double low = 0.0, high = 1.0;
    while (excess(high) > 0.0) high *= 2.0;
    for (int step = 0; step < 60; ++step) (excess(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    exponent[k + 1] = low;
  }
  // The equation at every fork, told as the width that it gives back: widths are known to 1e-7, logarithms too.
  std::vector<double> sum(s.size(), 0.0);
  std::vector<bool> fork(s.size(), false);
  for (std::size_t i = s.size(); i-- > 0;) {
    const auto power_below = [&](std::size_t of, std::size_t at) {
      return std::pow(2.0 * static_cast<double>(s.radius[of]), exponent[static_cast<std::size_t>(part[at] + 1)]);
    };
    const double n = exponent[static_cast<std::size_t>(part[i] + 1)];
    const double all = sum[i] + s.own_pipes(i) * std::pow(static_cast<double>(s.tip_diameter_m), n);
    if (fork[i]) RC_ASSERT(std::abs(std::log(power_below(i, i) / all)) / n < 1e-5);
    if (s.parent[i] < 0) continue;
    const auto parent = static_cast<std::size_t>(s.parent[i]);
    sum[parent] += power_below(i, parent), fork[parent] = true;
    RC_ASSERT(s.radius[i] <= s.radius[parent] * (1.0f + 1e-6f));
  }
}

TEST(Radii, AWidthThatNoExponentGivesIsRefusedWithItsInternodeAndChangesNothing) {
  const Parameters p = sample_parameters();
  Skeleton s = grow(sample_input(p, 3));
  const std::vector<float> before = s.radius;
  std::size_t limb = 10;
  while (s.parent[limb] < 5) ++limb;
  const auto below = static_cast<std::size_t>(s.parent[limb]);
  const std::array<GivenWidth, 2> thinner_below{{{below, 0.05f}, {limb, 0.06f}}};
  const Result<void> refused = constrain_widths(s, thinner_below);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("internode " + std::to_string(below) + ": no pipe exponent gives a width of"),
            std::string::npos)
      << refused.error().message;
  EXPECT_EQ(s.radius, before);
  const GivenWidth tip{s.size() - 1, 0.02f};  // a single pipe is as wide as it is
  EXPECT_FALSE(constrain_widths(s, {&tip, 1}));
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
