#include "growth/markers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scalar.h"
#include "core/wide.h"
#include "growth/lanes.h"

namespace bosquet::growth {
namespace {

constexpr int kLanes = 4;
constexpr std::size_t kPastEnd = 8;
constexpr float kFarAway = 1e15f;
constexpr float kWidth = 1.0f, kFlat = 0.25f;  ///< cells, in what buds reach
constexpr std::size_t kBudsEach = 16;          ///< column, at least, in the mean
constexpr std::size_t kCellsEach = 4;          ///< bud, at most

}  // namespace

void PerceptionSamples::reset(float depth, float cos_half_angle, bool planar) {
  const auto same = [&](const Points& p) {
    return p.depth == depth && p.cos_half_angle == cos_half_angle && p.planar == planar;
  };
  auto points = std::find_if(kept_.begin(), kept_.end(), same);
  if (points == kept_.end()) {
    if (kept_.size() < kKept) {
      points = kept_.emplace(kept_.end());
    } else {
      points = kept_.begin() + static_cast<std::ptrdiff_t>(oldest_++ % kKept);
    }
    points->depth = depth, points->cos_half_angle = cos_half_angle, points->planar = planar;
    make(*points);
  }
  x_ = points->x.data(), y_ = points->y.data(), z_ = points->z.data();
}

void PerceptionSamples::make(Points& p) {
  p.x.resize(kCount + kMost), p.y.resize(kCount + kMost), p.z.resize(kCount + kMost);
  const float outer = 1.0f + p.depth;
  const float half_angle = acos(p.cos_half_angle);
  for (std::uint32_t n = 0; n < kCount + kMost; ++n) {
    const std::uint32_t i = n % kCount;
    // Multiples of 1/g, 1/g^2, 1/g^3 without their whole parts, g^4 = g + 1, in units of 2^-32.
    const auto even = [&](std::uint32_t step) { return static_cast<float>((0x80000000u + i * step) >> 8) * 0x1p-24f; };
    const float a = even(0xd1b54a33u), b = even(0xabc98389u), c = even(0x8cb92ba7u);
    // In a plane the basis' first direction lies in it and areas count instead of volumes.
    if (p.planar) {
      const float radius = std::sqrt(1.0f + a * (outer * outer - 1.0f));
      const SinCos angle = sin_cos(half_angle * (2.0f * b - 1.0f));
      p.x[n] = radius * angle.sin, p.y[n] = 0.0f, p.z[n] = radius * angle.cos;
      continue;
    }
    const float radius = pow(1.0f + a * (outer * outer * outer - 1.0f), 1.0f / 3.0f);
    const float cos = 1.0f - b * (1.0f - p.cos_half_angle);
    const float sin = std::sqrt(std::max(0.0f, 1.0f - cos * cos));
    const SinCos azimuth = sin_cos(2.0f * kPi * c);
    p.x[n] = radius * sin * azimuth.cos, p.y[n] = radius * sin * azimuth.sin, p.z[n] = radius * cos;
  }
}

void CompetitorIndex::build(std::span<const Competitor> competitors, float reach_m, float cos_half_angle) {
  cos_ = cos_half_angle, wide_ = wide_here();
  const std::size_t n = competitors.size();
  if (x_.size() < n + kPastEnd) {
    for (std::vector<float>* list : {&x_, &y_, &z_, &along_x_, &along_y_, &along_z_}) list->resize(n + kPastEnd);
    bud_.resize(n + kPastEnd), cell_of_.resize(n);
  }
  cells_ = IVec3(0);
  if (n == 0) return;
  Box3 box;
  for (const Competitor& c : competitors) box.add(c.at);

  // Columns as wide as buds look, or so wide that several buds stand in each; flat cells in them.
  low_ = box.low;
  const Vec3 size = box.high - box.low;
  float width_m = kWidth * reach_m;
  std::size_t columns = 0;
  do {
    inverse_.x = inverse_.z = 1.0f / width_m;
    cells_.x = static_cast<int>(size.x * inverse_.x) + 1, cells_.z = static_cast<int>(size.z * inverse_.z) + 1;
    columns = static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.z);
    width_m *= 1.5f;
  } while (columns * kBudsEach > std::max(n, kBudsEach));
  inverse_.y =
      std::min(1.0f / (kFlat * reach_m), static_cast<float>(kCellsEach * n / columns) / std::max(size.y, reach_m));
  cells_.y = static_cast<int>(size.y * inverse_.y) + 1;
  const std::size_t cells = columns * static_cast<std::size_t>(cells_.y);

  // Counting sort by cell; within a cell the order given (by bud) stays.
  start_.assign(cells + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const IVec3 c = glm::min(IVec3((competitors[i].at - low_) * inverse_), cells_ - 1);
    cell_of_[i] = (c.x * cells_.z + c.z) * cells_.y + c.y;
    ++start_[static_cast<std::size_t>(cell_of_[i]) + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  for (std::size_t i = n; i-- > 0;) {
    // From the back: start_[cell + 1] is the end of what is still to be placed.
    const auto place = static_cast<std::size_t>(--start_[static_cast<std::size_t>(cell_of_[i]) + 1]);
    const Competitor& c = competitors[i];
    x_[place] = c.at.x, y_[place] = c.at.y, z_[place] = c.at.z;
    along_x_[place] = c.direction.x, along_y_[place] = c.direction.y, along_z_[place] = c.direction.z;
    bud_[place] = c.bud;
  }
  for (std::size_t i = n; i < n + kPastEnd; ++i) x_[i] = y_[i] = z_[i] = kFarAway;
  // Each entry c + 1 now holds the start of cell c: move them down by one.
  for (std::size_t c = 0; c < cells; ++c) start_[c] = start_[c + 1];
  start_[cells] = static_cast<std::int32_t>(n);
}

std::int32_t CompetitorIndex::nearest_plainly(const Vec3& p, float within_m, std::int32_t fallback) const {
  const Vec3 q = p - low_;
  const IVec3 from = glm::max(IVec3((q - within_m) * inverse_), IVec3(0));
  const IVec3 to = glm::min(IVec3((q + within_m) * inverse_), cells_ - 1);
  const Float4 px = all4(p.x), py = all4(p.y), pz = all4(p.z), cos = all4(cos_);
  // Each lane keeps the best that it met; a branch for each bud that is nearer would be guessed wrong too often.
  Float4 least = all4(within_m * within_m);
  Int4 best{fallback, fallback, fallback, fallback};
  if (from.y > to.y) return fallback;
  for (int x = from.x; x <= to.x; ++x) {
    for (int z = from.z; z <= to.z; ++z) {
      const std::size_t column = static_cast<std::size_t>((x * cells_.z + z) * cells_.y);
      const auto begin = static_cast<std::size_t>(start_[column + static_cast<std::size_t>(from.y)]);
      const auto end = static_cast<std::size_t>(start_[column + static_cast<std::size_t>(to.y) + 1]);
      for (std::size_t i = begin; i < end; i += kLanes) {
        // Lanes past the end are buds of other cells: as good as any.
        const Float4 x4 = px - load4(&x_[i]), y4 = py - load4(&y_[i]), z4 = pz - load4(&z_[i]);
        const Float4 squares = x4 * x4 + y4 * y4 + z4 * z4;
        const Float4 along = x4 * load4(&along_x_[i]) + y4 * load4(&along_y_[i]) + z4 * load4(&along_z_[i]);
        const Int4 bud = load4(&bud_[i]);
        const Int4 better = ((squares < least) | ((squares == least) & (bud < best))) & (along >= cos * root(squares));
        least = better ? squares : least;
        best = better ? bud : best;
      }
    }
  }
  int nearest = 0;
  for (int lane = 1; lane < kLanes; ++lane) {
    if (least[lane] < least[nearest] || (least[lane] == least[nearest] && best[lane] < best[nearest])) nearest = lane;
  }
  return best[nearest];
}

#if BOSQUET_WIDE

[[gnu::target("avx2")]] std::int32_t CompetitorIndex::nearest_wide(const Vec3& p, float within_m,
                                                                   std::int32_t fallback) const {
  const Vec3 q = p - low_;
  const IVec3 from = glm::max(IVec3((q - within_m) * inverse_), IVec3(0));
  const IVec3 to = glm::min(IVec3((q + within_m) * inverse_), cells_ - 1);
  if (from.y > to.y) return fallback;
  const __m256 px = _mm256_set1_ps(p.x), py = _mm256_set1_ps(p.y), pz = _mm256_set1_ps(p.z);
  const __m256 cos = _mm256_set1_ps(cos_);
  __m256 least = _mm256_set1_ps(within_m * within_m);
  __m256i best = _mm256_set1_epi32(fallback);
  for (int x = from.x; x <= to.x; ++x) {
    for (int z = from.z; z <= to.z; ++z) {
      const std::size_t column = static_cast<std::size_t>((x * cells_.z + z) * cells_.y);
      const auto begin = static_cast<std::size_t>(start_[column + static_cast<std::size_t>(from.y)]);
      const auto end = static_cast<std::size_t>(start_[column + static_cast<std::size_t>(to.y) + 1]);
      for (std::size_t i = begin; i < end; i += 8) {
        const __m256 x8 = _mm256_sub_ps(px, _mm256_loadu_ps(&x_[i]));
        const __m256 y8 = _mm256_sub_ps(py, _mm256_loadu_ps(&y_[i]));
        const __m256 z8 = _mm256_sub_ps(pz, _mm256_loadu_ps(&z_[i]));
        const __m256 squares =
            _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x8, x8), _mm256_mul_ps(y8, y8)), _mm256_mul_ps(z8, z8));
        const __m256 along = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x8, _mm256_loadu_ps(&along_x_[i])),
                                                         _mm256_mul_ps(y8, _mm256_loadu_ps(&along_y_[i]))),
                                           _mm256_mul_ps(z8, _mm256_loadu_ps(&along_z_[i])));
        const __m256i bud = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&bud_[i]));
        const __m256 perceives = _mm256_cmp_ps(along, _mm256_mul_ps(cos, _mm256_sqrt_ps(squares)), _CMP_GE_OQ);
        const __m256 older = _mm256_castsi256_ps(_mm256_cmpgt_epi32(best, bud));
        const __m256 nearer = _mm256_cmp_ps(squares, least, _CMP_LT_OQ);
        const __m256 as_near = _mm256_and_ps(_mm256_cmp_ps(squares, least, _CMP_EQ_OQ), older);
        const __m256 better = _mm256_and_ps(_mm256_or_ps(nearer, as_near), perceives);
        least = _mm256_blendv_ps(least, squares, better);
        best = _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(best), _mm256_castsi256_ps(bud), better));
      }
    }
  }
  // The least of eight, and the oldest of those that are as near.
  __m128 four = _mm_min_ps(_mm256_castps256_ps128(least), _mm256_extractf128_ps(least, 1));
  four = _mm_min_ps(four, _mm_movehl_ps(four, four));
  four = _mm_min_ps(four, _mm_shuffle_ps(four, four, 1));
  const __m256 nearest = _mm256_cmp_ps(least, _mm256_broadcastss_ps(four), _CMP_EQ_OQ);
  const __m256i last = _mm256_set1_epi32(std::numeric_limits<std::int32_t>::max());
  best = _mm256_blendv_epi8(last, best, _mm256_castps_si256(nearest));
  __m128i bud = _mm_min_epi32(_mm256_castsi256_si128(best), _mm256_extracti128_si256(best, 1));
  bud = _mm_min_epi32(bud, _mm_shuffle_epi32(bud, 0x4e));
  bud = _mm_min_epi32(bud, _mm_shuffle_epi32(bud, 0xb1));
  return _mm_cvtsi128_si32(bud);
}

#else
std::int32_t CompetitorIndex::nearest_wide(const Vec3& p, float within_m, std::int32_t fallback) const {
  return nearest_plainly(p, within_m, fallback);
}
#endif

}  // namespace bosquet::growth
