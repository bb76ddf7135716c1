#include "growth/dropping.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

#include "core/wide.h"
#include "growth/directions.h"
#include "growth/lanes.h"

namespace bosquet::growth {

Dropping::Dropping(Tree& tree)
    : buds_(tree.buds.each.data()),
      dropped_(tree.dropped),
      random_(tree.random),
      samples_(tree.samples.reader()),
      cell_of_(tree.occupancy.cell_finder()),
      occupied_m_(tree.occupied_m),
      rate_(tree.parameters->marker_rate),
      greatest_(tree.greatest_vigor),
      planar_(tree.parameters->planar),
      wide_(wide_here()) {
  dropped_.make_room(kAtOnce * (1 + static_cast<std::size_t>(rate_)) + PerceptionSamples::kMost);
}

/// What the markers of a bud are made of.
struct Dropping::Frame {
  Vec3 at, to_x, to_y, to_z;
  int markers;
  std::uint32_t sample;  ///< the first of them
};

[[gnu::always_inline]] inline Dropping::Frame Dropping::frame(std::int32_t bud, RandomStream& random) const {
  Bud& b = buds_[bud];
  b.claims = 0;
  const int markers = 1 + static_cast<int>(rate_ * share_of(b.flow, greatest_));
  const Vec3 along = b.direction;
  const Basis basis = planar_
                          ? Basis{normalised_or({along.y, -along.x, 0.0f}, {1.0f, 0.0f, 0.0f}), Vec3{0.0f, 0.0f, 1.0f}}
                          : basis_around(along);
  const auto sample = static_cast<std::uint32_t>(random.bits()) % PerceptionSamples::kCount;
  return {b.at, occupied_m_ * basis.x, occupied_m_ * basis.y, occupied_m_ * along, markers, sample};
}

[[gnu::always_inline]] inline void Dropping::list(std::int32_t bud, std::size_t first, std::size_t end) {
  const Bud& b = buds_[bud];
  if (b.order == 0 && b.state == BudState::terminal) dropped_.of_trunks.push_back({bud, first, end});
}

void Dropping::drop(std::span<const std::int32_t> buds) {
  assert(buds.size() <= kAtOnce);
  count_ = 0;
  dropped_.of_trunks.clear();
  if (wide_) {
    drop_wide(buds.first(buds.size() & ~std::size_t{1}));
    buds = buds.subspan(buds.size() & ~std::size_t{1});
  }
  drop_plainly(buds);
}

void Dropping::drop_plainly(std::span<const std::int32_t> buds) {
  float *const px = dropped_.x.data(), *const py = dropped_.y.data(), *const pz = dropped_.z.data();
  std::int32_t *const cell = dropped_.cell.data(), *const of = dropped_.bud.data();
  RandomStream random = random_;
  std::size_t count = count_;
  for (const std::int32_t bud : buds) {
    const Frame f = frame(bud, random);
    const std::size_t first = count, end = first + static_cast<std::size_t>(f.markers);
    const Int4 bud4{bud, bud, bud, bud};
    for (std::uint32_t n = f.sample; count < end; count += 4, n += 4) {
      // Four at once; what is too many of them the next ones overwrite.
      const Float4 sx = samples_.x(n), sy = samples_.y(n), sz = samples_.z(n);
      const Float4 x = all4(f.at.x) + (sx * all4(f.to_x.x) + sy * all4(f.to_y.x) + sz * all4(f.to_z.x));
      const Float4 y = all4(f.at.y) + (sx * all4(f.to_x.y) + sy * all4(f.to_y.y) + sz * all4(f.to_z.y));
      const Float4 z = all4(f.at.z) + (sx * all4(f.to_x.z) + sy * all4(f.to_y.z) + sz * all4(f.to_z.z));
      store4(px + count, x), store4(py + count, y), store4(pz + count, z);
      store4(cell + count, cell_of_(x, y, z)), store4(of + count, bud4);
    }
    count = end;
    list(bud, first, end);
  }
  random_ = random, count_ = count;
}

#if BOSQUET_WIDE
namespace {

/// Four lanes of each of two buds.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256 both(float a, float b) {
  return _mm256_blend_ps(_mm256_set1_ps(a), _mm256_set1_ps(b), 0xf0);
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256 both(Float4 v) { return _mm256_set_m128(v, v); }
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i both(Int4 v) {
  return _mm256_castps_si256(both(reinterpret_cast<Float4>(v)));
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256 load(const float* a, const float* b) {
  return _mm256_set_m128(_mm_loadu_ps(b), _mm_loadu_ps(a));
}

/// The numbers of cells along one axis.
struct Cells {
  __m256 inverse, origin;
  __m256i first;
};
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i cells(const Cells& axis, __m256 at) {
  const __m256 cell = _mm256_add_ps(_mm256_mul_ps(at, axis.inverse), axis.origin);
  return _mm256_sub_epi32(_mm256_cvttps_epi32(cell), axis.first);
}

}  // namespace

[[gnu::target("avx2")]] void Dropping::drop_wide(std::span<const std::int32_t> buds) {
  float *const px = dropped_.x.data(), *const py = dropped_.y.data(), *const pz = dropped_.z.data();
  std::int32_t *const cell = dropped_.cell.data(), *const of = dropped_.bud.data();
  const PerceptionSamples::Reader samples = samples_;
  const __m256 inverse = both(cell_of_.inverse), origin = both(cell_of_.origin);
  const Cells along_x{inverse, origin, both(cell_of_.first[0])}, along_y{inverse, origin, both(cell_of_.first[1])},
      along_z{inverse, origin, both(cell_of_.first[2])};
  const __m256i width = both(cell_of_.width), depth = both(cell_of_.depth);
  RandomStream random = random_;
  std::size_t count = count_;
  for (std::size_t i = 0; i < buds.size(); i += 2) {
    const std::int32_t bud_a = buds[i], bud_b = buds[i + 1];
    const Frame a = frame(bud_a, random), b = frame(bud_b, random);
    const std::size_t first = count, second = first + static_cast<std::size_t>(a.markers);
    count = second + static_cast<std::size_t>(b.markers);
    const int most = std::max(a.markers, b.markers);
    for (int m = (most - 1) / 4 * 4; m >= 0; m -= 4) {
      const std::uint32_t na = a.sample + static_cast<std::uint32_t>(m), nb = b.sample + static_cast<std::uint32_t>(m);
      const __m256 sx = load(samples.xs + na, samples.xs + nb), sy = load(samples.ys + na, samples.ys + nb),
                   sz = load(samples.zs + na, samples.zs + nb);
      const auto place = [&](int c) __attribute__((target("avx2"), always_inline)) {
        const __m256 in_x = _mm256_mul_ps(sx, both(a.to_x[c], b.to_x[c]));
        const __m256 in_y = _mm256_mul_ps(sy, both(a.to_y[c], b.to_y[c]));
        const __m256 in_z = _mm256_mul_ps(sz, both(a.to_z[c], b.to_z[c]));
        return _mm256_add_ps(both(a.at[c], b.at[c]), _mm256_add_ps(_mm256_add_ps(in_x, in_y), in_z));
      };
      const __m256 x = place(0), y = place(1), z = place(2);
      const __m256i row = _mm256_add_epi32(_mm256_mullo_epi32(cells(along_y, y), depth), cells(along_z, z));
      const __m256i number = _mm256_add_epi32(_mm256_mullo_epi32(row, width), cells(along_x, x));
      const auto store = [&](std::size_t n, std::int32_t bud, auto half)
          __attribute__((target("avx2"), always_inline)) {
        constexpr int kHalf = decltype(half)::value;
        _mm_storeu_ps(px + n, _mm256_extractf128_ps(x, kHalf)), _mm_storeu_ps(py + n, _mm256_extractf128_ps(y, kHalf));
        _mm_storeu_ps(pz + n, _mm256_extractf128_ps(z, kHalf));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(cell + n), _mm256_extracti128_si256(number, kHalf));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(of + n), _mm_set1_epi32(bud));
      };
      // What is too many of four is overwritten, of the first bud by the second one: so the last four come first.
      if (m < a.markers) store(first + static_cast<std::size_t>(m), bud_a, std::integral_constant<int, 0>{});
      store(second + static_cast<std::size_t>(m), bud_b, std::integral_constant<int, 1>{});
    }
    list(bud_a, first, second), list(bud_b, second, count);
  }
  random_ = random, count_ = count;
}
#else
void Dropping::drop_wide(std::span<const std::int32_t> buds) { drop_plainly(buds); }
#endif

}  // namespace bosquet::growth
