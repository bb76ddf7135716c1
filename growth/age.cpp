#include "growth/age.h"

#include <algorithm>

#include "core/scalar.h"

namespace bosquet::growth {

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

int season_at_height(const Skeleton& s, float height_m) {
  int first = std::max(0, s.seasons - 1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.distal[i].y >= height_m) first = std::min(first, static_cast<int>(s.born[i]));
  }
  return first;
}

}  // namespace bosquet::growth
