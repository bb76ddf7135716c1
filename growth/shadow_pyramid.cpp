#include "growth/shadow_pyramid.h"

#include "core/wide.h"
#include "growth/lanes.h"

namespace bosquet::growth {
namespace {

/// Adds to the rows of layer q below a cell, four at once: what is past a row's end gets nothing.
template <int q>
[[gnu::always_inline]] inline void add_layer(std::int32_t* row, std::size_t stride, std::int32_t amount) {
  constexpr int kSide = 2 * q + 1, kWhole = kSide / 4;
  const Int4 whole{amount, amount, amount, amount};
  const Int4 end = kSide % 4 == 1 ? Int4{amount, 0, 0, 0} : Int4{amount, amount, amount, 0};
  for (int k = 0; k < kSide; ++k, row += stride) {
    for (int i = 0; i < kWhole; ++i) store4(row + 4 * i, load4(row + 4 * i) + whole);
    store4(row + 4 * kWhole, load4(row + 4 * kWhole) + end);
  }
}

/// Layers q and below; `first` is the corner of layer q.
template <int q>
[[gnu::always_inline]] inline void add_layers(const ShadowPyramid& p, std::int32_t* first, int times) {
  add_layer<q>(first, p.stride, times * p.amount[q]);
  if constexpr (q < kMostShadowDepth) {
    if (q < p.last) add_layers<q + 1>(p, first - p.layer - p.stride - 1, times);
  }
}

#if BOSQUET_WIDE
/// The same with eight at once.
template <int q>
[[gnu::target("avx2"), gnu::always_inline]] inline void add_layer_wide(std::int32_t* row, std::size_t stride,
                                                                       std::int32_t amount) {
  constexpr int kSide = 2 * q + 1, kWhole = kSide / 8, kRest = kSide % 8;
  const __m256i whole = _mm256_set1_epi32(amount);
  const __m256i place = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i end = _mm256_and_si256(whole, _mm256_cmpgt_epi32(_mm256_set1_epi32(kRest), place));
  for (int k = 0; k < kSide; ++k, row += stride) {
    for (int i = 0; i < kWhole; ++i) {
      auto* const at = reinterpret_cast<__m256i*>(row + 8 * i);
      _mm256_storeu_si256(at, _mm256_add_epi32(_mm256_loadu_si256(at), whole));
    }
    if constexpr (kRest > 4) {
      auto* const at = reinterpret_cast<__m256i*>(row + 8 * kWhole);
      _mm256_storeu_si256(at, _mm256_add_epi32(_mm256_loadu_si256(at), end));
    } else {
      auto* const at = reinterpret_cast<__m128i*>(row + 8 * kWhole);
      _mm_storeu_si128(at, _mm_add_epi32(_mm_loadu_si128(at), _mm256_castsi256_si128(end)));
    }
  }
}
template <int q>
[[gnu::target("avx2"), gnu::always_inline]] inline void add_layers_wide(const ShadowPyramid& p, std::int32_t* first,
                                                                        int times) {
  add_layer_wide<q>(first, p.stride, times * p.amount[q]);
  if constexpr (q < kMostShadowDepth) {
    if (q < p.last) add_layers_wide<q + 1>(p, first - p.layer - p.stride - 1, times);
  }
}
[[gnu::target("avx2")]] void add_pyramid_wide(const ShadowPyramid& p, std::int32_t* first, int times) {
  add_layers_wide<0>(p, first, times);
}
#endif

}  // namespace

void add_pyramid(const ShadowPyramid& pyramid, std::int32_t* cell, int times) {
#if BOSQUET_WIDE
  static const bool wide = wide_here();
  if (wide) return add_pyramid_wide(pyramid, cell, times);
#endif
  add_pyramid_plainly(pyramid, cell, times);
}

void add_pyramid_plainly(const ShadowPyramid& pyramid, std::int32_t* cell, int times) {
  add_layers<0>(pyramid, cell, times);
}

}  // namespace bosquet::growth
