// Tree index: which trees stand near a place, in a grid of square buckets over the site.
//
// Cost      adding and asking are proportional to the trees in the buckets touched; no allocation after the first
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::distribution {

class TreeIndex {
 public:
  TreeIndex() = default;
  TreeIndex(Vec2 size_m, float bucket_m);

  void add(std::uint32_t slot, Vec2 at);
  void remove(std::uint32_t slot, Vec2 at);
  /// The tree known as `from` is now `to`.
  void rename(std::uint32_t from, std::uint32_t to, Vec2 at);

  /// Whether test(slot) holds for a tree in the buckets within `radius_m` of a place (some lie farther away).
  template <class Test>
  bool any_near(Vec2 at, float radius_m, const Test& test) const {
    const IVec2 low = bucket(at - Vec2{radius_m}), high = bucket(at + Vec2{radius_m});
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        for (std::int32_t s = head_[index({i, j})]; s >= 0; s = next_[static_cast<std::size_t>(s)])
          if (test(static_cast<std::uint32_t>(s))) return true;
    return false;
  }

 private:
  IVec2 bucket(Vec2 at) const;
  std::size_t index(IVec2 b) const {
    return static_cast<std::size_t>(b.y) * static_cast<std::size_t>(buckets_.x) + static_cast<std::size_t>(b.x);
  }

  IVec2 buckets_{1};
  float bucket_m_ = 1.0f;
  std::vector<std::int32_t> head_{-1};  // first tree of each bucket
  std::vector<std::int32_t> next_;      // of each tree
};

}  // namespace bosquet::distribution
