#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace bosquet {
namespace {

TEST(Parallel, EveryIndexIsVisitedExactlyOnce) {
  for (std::size_t n : {0u, 1u, 7u, 1000u}) {
    for (std::size_t grain : {1u, 3u, 4096u}) {
      std::vector<std::atomic<int>> visits(n);
      parallel_for(
          n, [&](std::size_t i) { ++visits[i]; }, grain);
      for (auto& v : visits) EXPECT_EQ(v, 1);
    }
  }
}

TEST(Parallel, AReductionGivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<float> values(100'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0f / static_cast<float>(i + 1);
  auto total = [&](int threads) {
    float sum = 0;
    run_with_threads(threads, [&] {
      sum = deterministic_reduce(
          values.size(), 1000, 0.0f,
          [&](std::size_t b, std::size_t e) {
            float s = 0;
            for (std::size_t i = b; i < e; ++i) s += values[i];
            return s;
          },
          [](float a, float b) { return a + b; });
    });
    return sum;
  };
  const float one = total(1);
  for (int threads : {2, 3, 8, 16}) EXPECT_EQ(total(threads), one);
}

TEST(Parallel, MoreThreadsThanCoresReallyWork) {
  // Bodies sleep so that every worker gets its turn even on one core.
  run_with_threads(8, [] {
    parallel_for(64, [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(5)); });
    EXPECT_GT(working_threads(), 2);
  });
  run_with_threads(1, [] {
    parallel_for(64, [](std::size_t) {});
    EXPECT_EQ(working_threads(), 1);
  });
}

TEST(Parallel, TheDearestBodyStartsFirst) {
  const std::vector<float> costs{1, 5, 3, 5, 2};
  std::vector<std::size_t> order;
  run_with_threads(1, [&] { parallel_dearest_first(costs, [&](std::size_t i) { order.push_back(i); }); });
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 3, 2, 4, 0}));
}

TEST(Parallel, AnExceptionReachesTheCaller) {
  EXPECT_THROW(parallel_for(10,
                            [](std::size_t i) {
                              if (i == 5) throw std::runtime_error("five");
                            }),
               std::runtime_error);
}

}  // namespace
}  // namespace bosquet
