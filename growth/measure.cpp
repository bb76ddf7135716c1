#include "growth/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scalar.h"
#include "growth/radii.h"

namespace bosquet::growth {
namespace {

constexpr float kLowShare = 0.02f;   ///< of the branch wood stands below the crown base
constexpr int kLimbInternodes = 10;  ///< as grown
constexpr int kSlices = 12;          ///< of the crown, for its widest point
constexpr std::array<Vec2, 8> kAzimuths{{{1.0f, 0.0f},
                                         {0.9238795f, 0.3826834f},
                                         {0.7071068f, 0.7071068f},
                                         {0.3826834f, 0.9238795f},
                                         {0.0f, 1.0f},
                                         {-0.3826834f, 0.9238795f},
                                         {-0.7071068f, 0.7071068f},
                                         {-0.9238795f, 0.3826834f}}};

float mean_extent(const std::vector<Vec2>& points) {
  if (points.empty()) return 0.0f;
  float sum = 0.0f;
  for (const Vec2& a : kAzimuths) {
    float low = glm::dot(points[0], a), high = low;
    for (const Vec2& p : points) {
      const float along = glm::dot(p, a);
      low = std::min(low, along), high = std::max(high, along);
    }
    sum += high - low;
  }
  return sum / static_cast<float>(kAzimuths.size());
}

}  // namespace

Measures measure(const Skeleton& s, int season) {
  Measures m;
  const int last = season < 0 ? s.seasons : season;
  const auto standing = [&](std::size_t i) { return s.alive_at(i, last); };

  std::vector<Vec2> ends;
  std::vector<float> heights;
  Vec2 sum{0.0f};
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!standing(i)) continue;
    ++m.internodes;
    m.height_m = std::max(m.height_m, s.distal[i].y);
    if (s.order[i] == 0) continue;
    // A point for each internode as grown, so that pieces and merged internodes measure the same.
    const int points = s.own_pipes(i);
    const Vec3 run = s.distal[i] - s.proximal(i);
    for (int k = points; k-- > 0;) {
      const Vec3 at = s.distal[i] - run * (static_cast<float>(k) / static_cast<float>(points));
      ends.push_back(to_plan(at));
      heights.push_back(at.y);
      sum += ends.back();
    }
  }
  m.crown_diameter_m = mean_extent(ends);
  if (!ends.empty()) {
    m.crown_centroid = sum / static_cast<float>(ends.size());
    const auto low = heights.begin() + static_cast<std::ptrdiff_t>(kLowShare * static_cast<float>(heights.size()));
    std::vector<float> sorted = heights;
    std::nth_element(sorted.begin(), sorted.begin() + (low - heights.begin()), sorted.end());
    m.crown_base_m = std::max(0.0f, sorted[static_cast<std::size_t>(low - heights.begin())]);
  }

  // The clear bole: branches of the trunk by their size.
  std::vector<int> carried(s.size(), 0);
  m.lowest_limb_m = m.height_m;
  for (std::size_t i = s.size(); i-- > 0;) {
    if (!standing(i)) continue;
    carried[i] += s.own_pipes(i);
    if (s.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(s.parent[i]);
    carried[p] += carried[i];
    if (s.order[i] == 1 && s.order[p] == 0 && carried[i] >= kLimbInternodes) {
      m.lowest_limb_m = std::min(m.lowest_limb_m, s.distal[p].y);
    }
  }

  if (const int at = breast_height_internode(s); at >= 0) {
    m.trunk_diameter_m = 2.0f * (season < 0 ? s.radius : radii(s, season))[static_cast<std::size_t>(at)];
  }

  // Widest slice of the crown.
  const float length = m.height_m - m.crown_base_m;
  if (length > 0.0f) {
    std::array<std::vector<Vec2>, kSlices> slices;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const float share = (heights[i] - m.crown_base_m) / length;
      if (share < 0.0f) continue;
      slices[static_cast<std::size_t>(std::min(kSlices - 1, static_cast<int>(share * kSlices)))].push_back(ends[i]);
    }
    float widest = 0.0f;
    for (int k = 0; k < kSlices; ++k) {
      const float extent = mean_extent(slices[static_cast<std::size_t>(k)]);
      if (extent > widest) {
        widest = extent;
        m.widest_point = (static_cast<float>(k) + 0.5f) / kSlices;
      }
    }
  }
  return m;
}

}  // namespace bosquet::growth
