#include "crowns/bucket_queue.h"

#include <gtest/gtest.h>

#include <queue>
#include <set>

#include "core/random.h"

namespace bosquet::crowns {
namespace {

TEST(BucketQueue, EntriesComeOutByRisingTickForStepsOfAnyLength) {
  for (int shift : {0, 7, 20}) {
    BucketQueue queue(shift);
    std::multiset<std::pair<std::uint64_t, std::uint32_t>> oracle;
    RandomStream draw(1, static_cast<std::uint64_t>(shift), Purpose::statistics);
    std::uint64_t now = 0;
    for (int n = 0; n < 50'000; ++n) {
      if (!oracle.empty() && draw.below(100) < 49) {
        const auto got = queue.pop();
        ASSERT_EQ((std::pair{got.tick, got.cell}), *oracle.begin());
        oracle.erase(oracle.begin());
        now = got.tick;
      } else {
        // Steps from 1 tick to 2^40, as fronts of the smallest and the largest tree make.
        const std::uint64_t tick = now + 1 + (draw.bits() >> (24 + draw.below(40)));
        const std::uint32_t cell = draw.below(1000);
        queue.push(tick, cell);
        oracle.insert({tick, cell});
      }
      ASSERT_EQ(queue.empty(), oracle.empty());
    }
  }
}

}  // namespace
}  // namespace bosquet::crowns
