#include "distribution/field_blocks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace bosquet::distribution {
namespace {

FieldBlocks blocks(IVec2 count, std::uint32_t most_steps) {
  FieldBlocks field;
  field.count = count;
  field.most_steps = most_steps;
  const auto n = static_cast<std::size_t>(count.x * count.y);
  field.logs.resize(n);
  field.cover.resize(n);
  field.suits.resize(n, BlockSuits{255, 255, 255, 0, 17, 128, 254, 255, 255, 1, 2, 3, 255, 255, 99, 255});
  field.partly.resize(n);
  field.sums.resize(n);
  for (std::size_t b = 0; b < n; ++b) field.partly[b] = b % 2 == 0;
  for (std::size_t b = 0; b < n; ++b) field.sums[b] = block_sum(field, b);
  return field;
}

RC_GTEST_PROP(FieldBlocks, WiderInstructionsGiveTheSameBits, ()) {
  const KernelTable tables[] = {log2_kernel_table(KernelKind::clustering, 1000.0f),
                                log2_kernel_table(KernelKind::inhibition, 9.0f)};
  const auto most = static_cast<std::uint32_t>(*rc::gen::inRange(0, (10 << kLogBits) + 1));
  const IVec2 count{9, 7};
  FieldBlocks wide = blocks(count, most), plain = wide;
  const auto real = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) / 97.0f; };
  for (int n = 0; n < 30; ++n) {
    const float trunk = real(1, 300);
    const bool acts = *rc::gen::inRange(0, 5) > 0;
    const BlockStamp stamp{{real(-400, 4000), real(-400, 3000)},
                           trunk,
                           acts ? trunk + real(1, 2000) : -1.0f,
                           real(0, 600),
                           acts ? &tables[*rc::gen::inRange(0, 2)] : nullptr};
    const int sign = *rc::gen::inRange(0, 3) == 0 ? -1 : 1;
    stamp_blocks(wide, stamp, sign, {0, 0}, count - 1);
    stamp_blocks_plainly(plain, stamp, sign, {0, 0}, count - 1);
    RC_ASSERT(wide == plain);
  }
  for (std::size_t b = 0; b < wide.sums.size(); ++b) RC_ASSERT(wide.sums[b] == block_sum(wide, b));
}

TEST(FieldBlocks, AWeightIsTwoToItsSumsBetweenItsLimits) {
  for (const std::uint32_t up : {0u, 1u, 700u, 1024u, 9999u})
    for (const std::uint32_t down : {0u, 3u, 1500u, 8000u}) {
      const double exact = std::exp2(20.0 + (static_cast<double>(up) - down) / (1 << kLogBits));
      EXPECT_NEAR(static_cast<double>(open_weight(up, down, kLogRange - 1)), exact, 1.0 + 1e-7 * exact);
    }
  EXPECT_EQ(open_weight(1u << 30, 0, 5u << kLogBits), std::uint64_t{1} << 25);
  EXPECT_EQ(open_weight(0, 1u << 30, 5u << kLogBits), 1u);
}

}  // namespace
}  // namespace bosquet::distribution
