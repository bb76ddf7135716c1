#include "distribution/tree_index.h"

#include <algorithm>
#include <cassert>

namespace bosquet::distribution {

TreeIndex::TreeIndex(Vec2 size_m, float bucket_m) : bucket_m_(bucket_m) {
  buckets_ = {static_cast<int>(size_m.x / bucket_m) + 1, static_cast<int>(size_m.y / bucket_m) + 1};
  head_.assign(static_cast<std::size_t>(buckets_.x) * static_cast<std::size_t>(buckets_.y), -1);
}

IVec2 TreeIndex::bucket(Vec2 at) const {
  const auto along = [&](float x, int n) {
    return static_cast<int>(std::clamp(x / bucket_m_, 0.0f, static_cast<float>(n - 1)));
  };
  return {along(at.x, buckets_.x), along(at.y, buckets_.y)};
}

void TreeIndex::add(std::uint32_t slot, Vec2 at) {
  if (slot >= next_.size()) next_.resize(slot + 1, -1);
  std::int32_t& head = head_[index(bucket(at))];
  next_[slot] = head;
  head = static_cast<std::int32_t>(slot);
}

void TreeIndex::remove(std::uint32_t slot, Vec2 at) {
  std::int32_t* link = &head_[index(bucket(at))];
  while (*link != static_cast<std::int32_t>(slot)) {
    assert(*link >= 0);
    link = &next_[static_cast<std::size_t>(*link)];
  }
  *link = next_[slot];
}

void TreeIndex::rename(std::uint32_t from, std::uint32_t to, Vec2 at) {
  remove(from, at);
  add(to, at);
}

}  // namespace bosquet::distribution
