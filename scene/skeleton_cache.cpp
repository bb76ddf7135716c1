#include "scene/skeleton_cache.h"

#include <utility>
#include <vector>

namespace bosquet::scene {
namespace {

template <class T>
std::size_t held(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::size_t bytes_of(const growth::Skeleton& s) {
  return sizeof s + held(s.parent) + held(s.axis) + held(s.order) + held(s.distal) + held(s.radius) + held(s.born) +
         held(s.shed) + held(s.light) + held(s.vigor) + held(s.pipes);
}

}  // namespace

std::shared_ptr<const growth::Skeleton> SkeletonCache::find(std::uint64_t key) {
  const std::lock_guard lock(mutex_);
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->skeleton;
}

void SkeletonCache::insert(std::uint64_t key, std::shared_ptr<const growth::Skeleton> skeleton) {
  const std::size_t bytes = bytes_of(*skeleton);
  if (bytes > most_bytes_) return;
  const std::lock_guard lock(mutex_);
  if (by_key_.contains(key)) return;
  while (bytes_ + bytes > most_bytes_) {
    bytes_ -= entries_.back().bytes;
    by_key_.erase(entries_.back().key);
    entries_.pop_back();
  }
  entries_.push_front({key, std::move(skeleton), bytes});
  by_key_.emplace(key, entries_.begin());
  bytes_ += bytes;
}

void SkeletonCache::clear() {
  const std::lock_guard lock(mutex_);
  entries_.clear(), by_key_.clear();
  bytes_ = 0;
}

std::size_t SkeletonCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::size_t SkeletonCache::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

}  // namespace bosquet::scene
