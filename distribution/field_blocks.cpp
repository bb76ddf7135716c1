#include "distribution/field_blocks.h"

#include <algorithm>
#include <cmath>

#include "core/scalar.h"
#include "core/wide.h"

namespace bosquet::distribution {
namespace {

constexpr std::uint32_t kFraction = (1u << kLogBits) - 1;
constexpr auto kLastStep = static_cast<float>(kKernelSteps);

// 2^(n / 1024) as the 23 bits of a float's mantissa, its exponent being 0.
struct Fractions {
  alignas(64) std::array<std::uint32_t, 1 << kLogBits> table{};
  Fractions() {
    for (std::size_t n = 0; n < table.size(); ++n)
      table[n] = static_cast<std::uint32_t>(exp2(static_cast<float>(n) / (1 << kLogBits)) * 0x1p23f);
  }
};
const std::uint32_t* fractions() {
  static const Fractions fractions;
  return fractions.table.data();
}

[[gnu::always_inline]] inline std::uint64_t fixed_exp2(const std::uint32_t* fraction, std::uint32_t up,
                                                       std::uint32_t down, std::uint32_t most) {
  const std::uint32_t x = kLogRange + std::min(up, most) - std::min(down, kLogRange);
  return (static_cast<std::uint64_t>(fraction[x & kFraction]) << (x >> kLogBits)) >> 23;
}

// What the cells of a stamp have in common.
struct Disc {
  float trunk, to_steps, active2, covered2;
  const std::uint32_t* table;
  explicit Disc(const BlockStamp& stamp)
      : trunk(stamp.trunk),
        to_steps(stamp.active >= 0.0f ? kKernelSteps / (stamp.active - stamp.trunk) : 0.0f),
        active2(stamp.active >= 0.0f ? stamp.active * stamp.active : -1.0f),
        covered2(stamp.covered * stamp.covered),
        table(stamp.active >= 0.0f ? stamp.log2_kernel->steps.data() : nullptr) {}
};

// What a stamp does to a block.
struct Touch {
  float x0, y0;  // its first cell's centre, from the tree
  bool kernel, closes;
};
[[gnu::always_inline]] inline Touch touch(const BlockStamp& stamp, const Disc& disc, int bx, int by) {
  const float x0 = static_cast<float>(bx * kBlock) + 0.5f - stamp.at.x;
  const float y0 = static_cast<float>(by * kBlock) + 0.5f - stamp.at.y;
  const float nearest_x = std::max({x0, -x0 - (kBlock - 1), 0.0f});
  const float nearest_y = std::max({y0, -y0 - (kBlock - 1), 0.0f});
  const float nearest2 = nearest_x * nearest_x + nearest_y * nearest_y;
  return {x0, y0, nearest2 <= disc.active2, nearest2 <= disc.covered2};
}

std::size_t number(const FieldBlocks& field, int bx, int by) {
  return static_cast<std::size_t>(by) * static_cast<std::size_t>(field.count.x) + static_cast<std::size_t>(bx);
}

// Closes or opens the cells that lie within the covered radius with all their corners.
void change_cover(BlockCover& cover, float x0, float y0, float covered2, int sign) {
  for (int k = 0; k < kBlockCells; ++k) {
    const float x = std::abs(x0 + static_cast<float>(k % kBlock)) + 0.5f;
    const float y = std::abs(y0 + static_cast<float>(k / kBlock)) + 0.5f;
    if (x * x + y * y <= covered2) {
      std::uint16_t& count = cover[static_cast<std::size_t>(k)];
      count = static_cast<std::uint16_t>(count + sign);
    }
  }
}

#if BOSQUET_WIDE

// Weights of eight cells; they fit 31 bits as long as `most` is at most 2^10.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i wide_exp2(const std::uint32_t* fraction, __m256i up,
                                                                     __m256i down, __m256i most) {
  const __m256i range = _mm256_set1_epi32(static_cast<int>(kLogRange));
  const __m256i x =
      _mm256_sub_epi32(_mm256_add_epi32(range, _mm256_min_epu32(up, most)), _mm256_min_epu32(down, range));
  const __m256i low_bits = _mm256_and_si256(x, _mm256_set1_epi32(static_cast<int>(kFraction)));
  const __m256i one_to_two = _mm256_i32gather_epi32(reinterpret_cast<const int*>(fraction), low_bits, 4);
  // The table's 2^23 adds one to the exponent, so its bias here is 126.
  const __m256i exponent =
      _mm256_slli_epi32(_mm256_add_epi32(_mm256_srli_epi32(x, kLogBits), _mm256_set1_epi32(126)), 23);
  return _mm256_cvttps_epi32(_mm256_castsi256_ps(_mm256_add_epi32(one_to_two, exponent)));
}

struct WideStamp {
  __m256 trunk, to_steps;
  __m256i most;
  const std::uint32_t *table, *fraction;
  bool adds;

  // Adds or takes away the logarithms of two rows of cells at (x, y) from the tree.
  [[gnu::target("avx2"), gnu::always_inline]] inline void change(__m256i* two_rows, __m256 x, __m256 y) const {
    const __m256 d = _mm256_sqrt_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)));
    const __m256 s = _mm256_max_ps(_mm256_mul_ps(_mm256_sub_ps(d, trunk), to_steps), _mm256_setzero_ps());
    const __m256i step = _mm256_cvttps_epi32(_mm256_min_ps(s, _mm256_set1_ps(kLastStep)));
    const __m256i log = _mm256_i32gather_epi32(reinterpret_cast<const int*>(table), step, 4);
    *two_rows = adds ? _mm256_add_epi32(*two_rows, log) : _mm256_sub_epi32(*two_rows, log);
  }

  [[gnu::target("avx2"), gnu::always_inline]] inline WeightPair sum(const FieldBlocks& field, std::size_t block) const {
    const auto* up = reinterpret_cast<const __m256i*>(field.logs[block].up.data());
    const auto* down = reinterpret_cast<const __m256i*>(field.logs[block].down.data());
    const __m256i cover = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(field.cover[block].data()));
    const __m256i is_open = _mm256_cmpeq_epi16(cover, _mm256_setzero_si256());
    const __m256i open0 = _mm256_cvtepi16_epi32(_mm256_castsi256_si128(is_open));
    const __m256i open1 = _mm256_cvtepi16_epi32(_mm256_extracti128_si256(is_open, 1));
    const __m256i weight0 = _mm256_and_si256(wide_exp2(fraction, up[0], down[0], most), open0);
    const __m256i weight1 = _mm256_and_si256(wide_exp2(fraction, up[1], down[1], most), open1);
    const __m256i two = _mm256_add_epi32(weight0, weight1);  // below 2^32
    const __m256i four =
        _mm256_add_epi64(_mm256_and_si256(two, _mm256_set1_epi64x(0xffffffff)), _mm256_srli_epi64(two, 32));
    const __m128i eight = _mm_add_epi64(_mm256_castsi256_si128(four), _mm256_extracti128_si256(four, 1));
    WeightPair sum;
    sum.open =
        static_cast<std::uint64_t>(_mm_cvtsi128_si64(eight)) + static_cast<std::uint64_t>(_mm_extract_epi64(eight, 1));
    sum.suited = sum.open;
    if (!field.partly.empty() && field.partly[block]) {
      alignas(32) std::array<std::uint32_t, kBlockCells> weights;
      _mm256_store_si256(reinterpret_cast<__m256i*>(weights.data()), weight0);
      _mm256_store_si256(reinterpret_cast<__m256i*>(weights.data() + kBlockCells / 2), weight1);
      sum.suited = 0;
      for (std::size_t k = 0; k < kBlockCells; ++k) sum.suited += suited_weight(weights[k], field.suits[block][k]);
    }
    return sum;
  }
};

[[gnu::target("avx2")]] void stamp_wide(FieldBlocks& field, const BlockStamp& stamp, int sign, IVec2 low, IVec2 high) {
  const Disc disc(stamp);
  const WideStamp wide{_mm256_set1_ps(disc.trunk),
                       _mm256_set1_ps(disc.to_steps),
                       _mm256_set1_epi32(static_cast<int>(field.most_steps)),
                       disc.table,
                       fractions(),
                       sign > 0};
  const __m256 across = _mm256_setr_ps(0, 1, 2, 3, 0, 1, 2, 3);
  const __m256 rows0 = _mm256_setr_ps(0, 0, 0, 0, 1, 1, 1, 1), rows1 = _mm256_setr_ps(2, 2, 2, 2, 3, 3, 3, 3);
  const bool clusters = disc.table && stamp.log2_kernel->clustering;
  for (int by = low.y; by <= high.y; ++by) {
    for (int bx = low.x; bx <= high.x; ++bx) {
      const Touch t = touch(stamp, disc, bx, by);
      if (!t.kernel && !t.closes) continue;
      const std::size_t block = number(field, bx, by);
      if (t.closes) change_cover(field.cover[block], t.x0, t.y0, disc.covered2, sign);
      if (t.kernel) {
        BlockLogs& logs = field.logs[block];
        auto* sums = reinterpret_cast<__m256i*>((clusters ? logs.up : logs.down).data());
        const __m256 x = _mm256_add_ps(_mm256_set1_ps(t.x0), across);
        wide.change(sums, x, _mm256_add_ps(_mm256_set1_ps(t.y0), rows0));
        wide.change(sums + 1, x, _mm256_add_ps(_mm256_set1_ps(t.y0), rows1));
      }
      field.sums[block] = wide.sum(field, block);
    }
  }
}

#endif

}  // namespace

std::uint64_t open_weight(std::uint32_t up, std::uint32_t down, std::uint32_t most_steps) {
  return fixed_exp2(fractions(), up, down, most_steps);
}

WeightPair block_sum(const FieldBlocks& field, std::size_t block) {
  const std::uint32_t* fraction = fractions();
  const BlockLogs& logs = field.logs[block];
  const BlockCover& cover = field.cover[block];
  const bool partly = !field.partly.empty() && field.partly[block];
  WeightPair sum;
  for (std::size_t k = 0; k < kBlockCells; ++k) {
    const std::uint64_t weight =
        cover[k] == 0 ? fixed_exp2(fraction, logs.up[k], logs.down[k], field.most_steps) : std::uint64_t{0};
    sum.open += weight;
    if (partly) sum.suited += suited_weight(weight, field.suits[block][k]);
  }
  if (!partly) sum.suited = sum.open;
  return sum;
}

void fetch_blocks(const FieldBlocks& field, IVec2 low, IVec2 high) {
#if defined(__GNUC__)
  constexpr int kToWrite = 1;
  for (int by = low.y; by <= high.y; ++by) {
    for (int bx = low.x; bx <= high.x; ++bx) {
      const std::size_t block = number(field, bx, by);
      __builtin_prefetch(&field.logs[block].up, kToWrite);
      __builtin_prefetch(&field.logs[block].down, kToWrite);
      if (bx % 2 == 0 || bx == low.x) __builtin_prefetch(&field.cover[block], kToWrite);
      if (bx % 4 == 0 || bx == low.x) __builtin_prefetch(&field.sums[block], kToWrite);
    }
  }
#endif
}

void stamp_blocks_plainly(FieldBlocks& field, const BlockStamp& stamp, int sign, IVec2 low, IVec2 high) {
  const Disc disc(stamp);
  for (int by = low.y; by <= high.y; ++by) {
    for (int bx = low.x; bx <= high.x; ++bx) {
      const Touch t = touch(stamp, disc, bx, by);
      if (!t.kernel && !t.closes) continue;
      const std::size_t block = number(field, bx, by);
      if (t.closes) change_cover(field.cover[block], t.x0, t.y0, disc.covered2, sign);
      if (t.kernel) {
        BlockLogs& logs = field.logs[block];
        auto& sums = stamp.log2_kernel->clustering ? logs.up : logs.down;
        std::array<int, kBlockCells> step;
        for (int k = 0; k < kBlockCells; ++k) {
          const float x = t.x0 + static_cast<float>(k % kBlock), y = t.y0 + static_cast<float>(k / kBlock);
          float s = (std::sqrt(x * x + y * y) - disc.trunk) * disc.to_steps;
          s = s > 0.0f ? s : 0.0f;
          step[static_cast<std::size_t>(k)] = static_cast<int>(s < kLastStep ? s : kLastStep);
        }
        for (std::size_t k = 0; k < kBlockCells; ++k)
          sums[k] += sign > 0 ? disc.table[step[k]] : 0u - disc.table[step[k]];
      }
      field.sums[block] = block_sum(field, block);
    }
  }
}

void stamp_blocks(FieldBlocks& field, const BlockStamp& stamp, int sign, IVec2 low, IVec2 high) {
#if BOSQUET_WIDE
  constexpr std::uint32_t kWidest = 10u << kLogBits;  // weights that fit 31 bits
  static const bool wide = wide_here();
  if (wide && field.most_steps <= kWidest) return stamp_wide(field, stamp, sign, low, high);
#endif
  stamp_blocks_plainly(field, stamp, sign, low, high);
}

}  // namespace bosquet::distribution
