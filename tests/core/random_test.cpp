#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace bosquet {
namespace {

TEST(RandomStream, IsAFunctionOfSeedKeyAndPurposeAlone) {
  RandomStream a(1, 2, Purpose::growth), b(1, 2, Purpose::growth);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
  RandomStream other_seed(2, 2, Purpose::growth), other_key(1, 3, Purpose::growth), other_use(1, 2, Purpose::planting);
  const std::uint64_t first = RandomStream(1, 2, Purpose::growth).bits();
  EXPECT_NE(first, other_seed.bits());
  EXPECT_NE(first, other_key.bits());
  EXPECT_NE(first, other_use.bits());
}

TEST(RandomStream, UniformStaysInItsHalfOpenIntervalWithTheRightMoments) {
  RandomStream stream(7, 7, Purpose::statistics);
  constexpr int kDraws = 200'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const float u = stream.uniform();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    sum += u, squares += u * u;
  }
  // Standard errors: 0.289/sqrt(n) for the mean, 0.298/sqrt(n) for the mean square; five of them.
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * 0.289 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0 / 3.0, 5 * 0.298 / std::sqrt(kDraws));
}

TEST(RandomStream, NeighbouringKeysAreUncorrelated) {
  constexpr int kKeys = 100'000;
  double product = 0;
  for (int k = 0; k < kKeys; ++k) {
    RandomStream a(3, static_cast<std::uint64_t>(k), Purpose::growth),
        b(3, static_cast<std::uint64_t>(k) + 1, Purpose::growth);
    product += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  }
  EXPECT_NEAR(product / kKeys, 0.0, 5.0 / 12.0 / std::sqrt(kKeys));
}

TEST(RandomStream, BelowReachesEveryValueAboutEqually) {
  RandomStream stream(5, 1, Purpose::planting);
  std::vector<int> counts(7);
  for (int i = 0; i < 70'000; ++i) ++counts[stream.below(7)];
  for (int c : counts) EXPECT_NEAR(c, 10'000, 5 * std::sqrt(10'000 * 6.0 / 7.0));
}

}  // namespace
}  // namespace bosquet
