#include "growth/age.h"

#include <algorithm>

#include "core/scalar.h"
#include "growth/radii.h"

namespace bosquet::growth {
namespace {

constexpr float kWhole = 0.95f;  ///< share of the full height at which a tree counts as grown

}  // namespace

float height_share_at_age(const Parameters& p, float years) {
  if (years <= 0.0f) return 0.0f;
  return pow(1.0f - exp(-p.age_rate_per_year * years), p.age_shape);
}

float age_at_height_share(const Parameters& p, float share) {
  constexpr float kOldest = 1000.0f;
  if (share <= 0.0f) return 0.0f;
  const float left = 1.0f - pow(std::min(share, 1.0f), 1.0f / p.age_shape);
  if (left <= 0.0f) return kOldest;
  return std::min(kOldest, -log(left) / p.age_rate_per_year);
}

float age_at_height(const Parameters& p, float full_height_m, float height_m) {
  return age_at_height_share(p, std::min(kWhole, height_m / full_height_m));
}

int season_at_height(const Skeleton& s, float height_m) {
  int first = std::max(0, s.seasons - 1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.distal[i].y >= height_m) first = std::min(first, static_cast<int>(s.born[i]));
  }
  return first;
}

int season_at_age(const Parameters& p, const Skeleton& s, float full_height_m, float height_m, float years) {
  if (years >= age_at_height(p, full_height_m, height_m)) return std::max(0, s.seasons - 1);
  return season_at_height(s, height_share_at_age(p, years) * full_height_m);
}

Skeleton tree_at_season(const Skeleton& s, int season) {
  if (season < 0 || season >= s.seasons - 1) return s;
  Skeleton young = s;
  // Internodes stand in birth order, so the younger tree is a beginning of the arrays.
  const auto count = static_cast<std::size_t>(
      std::upper_bound(s.born.begin(), s.born.end(), season, [](int a, std::uint16_t b) { return a < b; }) -
      s.born.begin());
  young.parent.resize(count), young.axis.resize(count), young.order.resize(count), young.distal.resize(count);
  young.born.resize(count), young.shed.resize(count), young.light.resize(count), young.vigor.resize(count);
  if (!s.pipes.empty()) young.pipes.resize(count);
  for (std::uint16_t& fell : young.shed) {
    if (fell > season) fell = kNever;
  }
  young.seasons = season + 1;
  young.radius = radii(young);
  return young;
}

}  // namespace bosquet::growth
