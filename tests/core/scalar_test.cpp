#include "core/scalar.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

namespace bosquet {
namespace {

// Distance in units of the last place of the correctly rounded value.
double ulps(float got, double exact) {
  const float rounded = static_cast<float>(exact);
  const float spacing = std::nextafterf(std::fabs(rounded), INFINITY) - std::fabs(rounded);
  return std::fabs(static_cast<double>(got) - exact) / static_cast<double>(spacing);
}

float any_in(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 1 << 24)) * 0x1p-24f;
}

RC_GTEST_PROP(Scalar, SineAndCosineAreWithinFourUlpOfTheExactValue, ()) {
  const float x = any_in(-1000.0f, 1000.0f);
  // Near a root the error is bounded absolutely: one ulp of 1.
  RC_ASSERT(ulps(sin_cos(x).sin, std::sin(static_cast<double>(x))) <= 4.0 ||
            std::fabs(sin_cos(x).sin - std::sin(static_cast<double>(x))) < 1e-12);
  RC_ASSERT(ulps(sin_cos(x).cos, std::cos(static_cast<double>(x))) <= 4.0 ||
            std::fabs(sin_cos(x).cos - std::cos(static_cast<double>(x))) < 1e-12);
}

RC_GTEST_PROP(Scalar, ArcFunctionsAreWithinFourUlp, ()) {
  const float x = any_in(-1.0f, 1.0f), y = any_in(-50.0f, 50.0f), z = any_in(-50.0f, 50.0f);
  RC_ASSERT(ulps(acos(x), std::acos(static_cast<double>(x))) <= 4.0);
  RC_ASSERT(ulps(atan2(y, z), std::atan2(static_cast<double>(y), static_cast<double>(z))) <= 4.0);
}

RC_GTEST_PROP(Scalar, PowersAndLogarithmsAreWithinFourUlp, ()) {
  const float x = any_in(1e-4f, 100.0f), y = any_in(-8.0f, 8.0f);
  RC_ASSERT(ulps(exp2(y), std::exp2(static_cast<double>(y))) <= 4.0);
  RC_ASSERT(ulps(exp(y), std::exp(static_cast<double>(y))) <= 4.0);
  RC_ASSERT(ulps(pow(x, y), std::pow(static_cast<double>(x), static_cast<double>(y))) <= 4.0);
  if (std::fabs(x - 1.0f) > 1e-3f) {
    RC_ASSERT(ulps(log2(x), std::log2(static_cast<double>(x))) <= 4.0);
    RC_ASSERT(ulps(log(x), std::log(static_cast<double>(x))) <= 4.0);
  }
}

TEST(Scalar, EdgesOfTheDomainsHaveTheirLimits) {
  EXPECT_EQ(acos(2.0f), 0.0f);
  EXPECT_FLOAT_EQ(acos(-2.0f), kPi);
  EXPECT_EQ(atan2(0.0f, 0.0f), 0.0f);
  EXPECT_FLOAT_EQ(atan2(0.0f, -1.0f), kPi);
  EXPECT_EQ(exp2(-2000.0f), 0.0f);
  EXPECT_EQ(exp2(200.0f), INFINITY);
  EXPECT_EQ(log2(0.0f), -INFINITY);
  EXPECT_EQ(pow(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(pow(0.0f, 2.0f), 0.0f);
}

// These bits are the promise itself: any build on any CPU must give them.
TEST(Scalar, BitsAreTheSameInEveryBuild) {
  std::uint64_t sum = 0;
  for (int i = 1; i < 2000; ++i) {
    const float x = 0.01f * static_cast<float>(i);
    for (float v :
         {sin_cos(x).sin, sin_cos(x).cos, acos(x / 20.0f), atan2(x, 3.0f), exp2(x - 10.0f), log2(x), pow(x, 1.7f)})
      sum = sum * 31 + std::bit_cast<std::uint32_t>(v);
  }
  EXPECT_EQ(sum, 10283168718160509406ull);
}

}  // namespace
}  // namespace bosquet
