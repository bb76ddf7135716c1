#include "geometry/thickest_path.h"

#include <cassert>

namespace bosquet::geometry {

std::vector<std::uint8_t> standing(const growth::Skeleton& skeleton, int season) {
  std::vector<std::uint8_t> stands(skeleton.size());
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    const bool alive = season < 0 ? skeleton.alive(i) : skeleton.alive_at(i, season);
    const std::int32_t below = skeleton.parent[i];
    stands[i] = alive && (below < 0 || stands[static_cast<std::size_t>(below)]);
  }
  return stands;
}

ThickestPaths thickest_paths(const growth::Skeleton& skeleton, std::span<const float> radius,
                             std::span<const std::uint8_t> standing) {
  assert(radius.size() == skeleton.size() && standing.size() == skeleton.size());
  constexpr std::int32_t kNone = -1;

  // Of the internodes that spring from one, which continues its path? Ascending order lets the first born win ties.
  std::vector<std::int32_t> next(skeleton.size(), kNone);
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (!standing[i] || skeleton.parent[i] < 0) continue;
    const auto below = static_cast<std::size_t>(skeleton.parent[i]);
    const std::int32_t rival = next[below];
    const bool thicker = rival == kNone || radius[i] > radius[static_cast<std::size_t>(rival)];
    const bool same_axis = rival != kNone && radius[i] == radius[static_cast<std::size_t>(rival)] &&
                           skeleton.axis[i] == skeleton.axis[below] &&
                           skeleton.axis[static_cast<std::size_t>(rival)] != skeleton.axis[below];
    if (thicker || same_axis) next[below] = static_cast<std::int32_t>(i);
  }

  // A path begins at every standing internode that continues none. Its parent begins lower, so earlier in this loop.
  ThickestPaths result;
  result.internodes.reserve(skeleton.size());
  std::vector<std::int32_t> path_of(skeleton.size(), -1);
  std::vector<std::uint32_t> place(skeleton.size());
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (!standing[i]) continue;
    const std::int32_t below = skeleton.parent[i];
    if (below >= 0 && next[static_cast<std::size_t>(below)] == static_cast<std::int32_t>(i)) continue;
    ThickestPaths::Path path;
    path.first = static_cast<std::uint32_t>(result.internodes.size());
    if (below >= 0) {
      path.parent = path_of[static_cast<std::size_t>(below)];
      path.node = place[static_cast<std::size_t>(below)];
    }
    const auto index = static_cast<std::int32_t>(result.paths.size());
    for (std::int32_t j = static_cast<std::int32_t>(i); j != kNone; j = next[static_cast<std::size_t>(j)]) {
      path_of[static_cast<std::size_t>(j)] = index;
      place[static_cast<std::size_t>(j)] = static_cast<std::uint32_t>(result.internodes.size());
      result.internodes.push_back(static_cast<std::uint32_t>(j));
    }
    path.count = static_cast<std::uint32_t>(result.internodes.size()) - path.first;
    result.paths.push_back(path);
  }
  return result;
}

}  // namespace bosquet::geometry
