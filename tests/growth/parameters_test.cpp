#include "growth/parameters.h"

#include <gtest/gtest.h>

#include <limits>

namespace bosquet::growth {
namespace {

std::string refusal(const Parameters& p) {
  const Result<void> result = check(p, "species elm");
  return result ? "accepted" : result.error().message;
}

TEST(GrowthParameters, DefaultsAreAccepted) { EXPECT_EQ(refusal(Parameters{}), "accepted"); }

TEST(GrowthParameters, ANumberOutOfRangeIsRefusedWithOwnerNameValueAndRange) {
  Parameters p;
  p.branching_angle_deg = 130.0f;
  EXPECT_EQ(refusal(p), "species elm: branching_angle_deg = 130 is out of range, allowed is 10 to 120 deg");
  p = {};
  p.max_shoot_length = 1;
  EXPECT_EQ(refusal(p), "species elm: max_shoot_length = 1 is out of range, allowed is 2 to 12");
}

TEST(GrowthParameters, NotANumberIsRefused) {
  Parameters p;
  p.space = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal(p).find("space = nan is out of range"), std::string::npos) << refusal(p);
}

TEST(GrowthParameters, BothEndsOfARangeAreAllowed) {
  for (const float lambda : {0.4f, 0.6f}) {
    Parameters p;
    p.apical_dominance = lambda;
    EXPECT_EQ(refusal(p), "accepted");
  }
}

TEST(GrowthParameters, WeightsOfDirectionMustSumToOne) {
  Parameters p;
  p.straightness = 0.5f, p.tropism = 0.5f, p.space = 0.5f;
  EXPECT_NE(refusal(p).find("straightness 0.5 + tropism 0.5 + space 0.5 = 1.5, the sum must be 1"), std::string::npos)
      << refusal(p);
}

TEST(GrowthParameters, WeightsMustSumToOneInEveryOrderAndPhase) {
  Parameters p;
  p.orders.push_back({1, {}});
  p.orders[0].change.tropism = 0.9f;
  EXPECT_NE(refusal(p).find("order 1"), std::string::npos) << refusal(p);
  p = {};
  p.phases.push_back({0.5f, 2, 12, {}});
  p.phases[0].change.space = 0.0f;
  EXPECT_NE(refusal(p).find("order 2, phase 1"), std::string::npos) << refusal(p);
}

TEST(GrowthParameters, TheAxisMustLieInsideTheBudEllipse) {
  Parameters p;
  p.gravimorphism_vertical = 0.5f, p.gravimorphism_offset = -0.5f;
  EXPECT_NE(refusal(p).find("gravimorphism_offset = -0.5 puts the axis outside the bud ellipse"), std::string::npos)
      << refusal(p);
}

TEST(GrowthParameters, AnOrdersNumbersAreCheckedToo) {
  Parameters p;
  p.orders.push_back({1, {}});
  p.orders[0].change.max_shoot_length = 40;
  EXPECT_EQ(refusal(p), "species elm, order 1: max_shoot_length = 40 is out of range, allowed is 2 to 12");
}

TEST(GrowthParameters, MoreThanFourPhasesAreRefused) {
  Parameters p;
  p.phases.resize(5);
  EXPECT_EQ(refusal(p), "species elm: 5 phases, allowed are at most 4");
}

TEST(GrowthParameters, AMistakeIsFoundWithItsKeyAndTable) {
  Parameters p;
  EXPECT_FALSE(find_mistake(p));
  p.orders.resize(2);
  p.orders[1].change.gravimorphism_offset = 2.0f;
  const auto mistake = find_mistake(p, "elm");
  ASSERT_TRUE(mistake);
  EXPECT_EQ(mistake->key, "gravimorphism_offset");
  EXPECT_EQ(mistake->table, "order");
  EXPECT_EQ(mistake->index, 1u);
  p = {};
  p.phases.push_back({0.5f, 4, 2, {}});
  EXPECT_EQ(refusal(p), "species elm: phase 1 changes no axes: from_order = 4 is above to_order = 2");
}

TEST(GrowthParameters, PhasesComeInTheOrderOfTheirHeights) {
  Parameters p;
  p.phases.resize(2);
  p.phases[0].from = 0.6f, p.phases[1].from = 0.3f;
  EXPECT_NE(refusal(p).find("phase 2 begins at 0.3, before phase 1 at 0.6"), std::string::npos) << refusal(p);
}

}  // namespace
}  // namespace bosquet::growth
