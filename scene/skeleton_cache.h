// Skeleton cache: trees already grown, so that after an edit only those grow whose inputs changed.
//
// Model     a skeleton is a pure function of its growth input, so it is found again by that input's hash (growth/grow.h)
//           and the trunk diameter that it was given
// Decision  64-bit hashes are taken as equal inputs: among a million trees two different ones share a hash with a chance
//           of 3e-8
// Holds     at most most_bytes() of skeletons; the ones used longest ago go first, one larger than all that is not kept.
//           A skeleton in use outlives its place here. What is found is what growing would give, so a scene is the same
//           with and without a cache
// Threads   any number at once
// Cost      a look-up is a lock and a hash map access
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "growth/skeleton.h"
#include "scene/hash_cache.h"

namespace bosquet::scene {

class SkeletonCache {
 public:
  static constexpr std::size_t kDefaultBytes = std::size_t{512} << 20;  ///< some 10 million internodes

  explicit SkeletonCache(std::size_t most_bytes = kDefaultBytes) : skeletons_(most_bytes) {}

  /// The skeleton with this key, or null. It counts as used now.
  std::shared_ptr<const growth::Skeleton> find(std::uint64_t key) { return skeletons_.find(key); }

  /// Keeps a skeleton under its key; one that is there already stays.
  void insert(std::uint64_t key, std::shared_ptr<const growth::Skeleton> skeleton);

  void clear() { skeletons_.clear(); }

  std::size_t most_bytes() const { return skeletons_.most_bytes(); }
  std::size_t bytes() const { return skeletons_.bytes(); }
  std::size_t size() const { return skeletons_.size(); }

 private:
  HashCache<growth::Skeleton> skeletons_;
};

}  // namespace bosquet::scene
