#include "scene/skeleton_cache.h"

#include <utility>
#include <vector>

namespace bosquet::scene {
namespace {

template <class T>
std::size_t held(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::size_t memory_of(const growth::Skeleton& s) {
  return sizeof s + held(s.parent) + held(s.axis) + held(s.order) + held(s.distal) + held(s.radius) + held(s.born) +
         held(s.shed) + held(s.light) + held(s.vigor) + held(s.pipes);
}

}  // namespace

void SkeletonCache::insert(std::uint64_t key, std::shared_ptr<const growth::Skeleton> skeleton) {
  const std::size_t bytes = memory_of(*skeleton);
  skeletons_.insert(key, std::move(skeleton), bytes);
}

}  // namespace bosquet::scene
