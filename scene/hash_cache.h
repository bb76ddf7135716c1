// Cache: shared values by the hash of what they were made from, the ones used longest ago given up first.
//
// Decision  64-bit hashes are taken as equal inputs, as in skeleton_cache.h
// Holds     at most most_bytes of values; one larger than all that is not kept, and one in use outlives its place here
// Threads   any number at once
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace bosquet::scene {

template <class T>
class HashCache {
 public:
  explicit HashCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  std::shared_ptr<const T> find(std::uint64_t key) {
    const std::lock_guard lock(mutex_);
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
  }

  void insert(std::uint64_t key, std::shared_ptr<const T> value, std::size_t bytes) {
    if (bytes > most_bytes_) return;
    const std::lock_guard lock(mutex_);
    if (by_key_.contains(key)) return;
    while (bytes_ + bytes > most_bytes_) {
      bytes_ -= entries_.back().bytes;
      by_key_.erase(entries_.back().key);
      entries_.pop_back();
    }
    entries_.push_front({key, std::move(value), bytes});
    by_key_.emplace(key, entries_.begin());
    bytes_ += bytes;
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    entries_.clear(), by_key_.clear();
    bytes_ = 0;
  }

  std::size_t most_bytes() const { return most_bytes_; }
  std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::shared_ptr<const T> value;
    std::size_t bytes;
  };
  mutable std::mutex mutex_;
  const std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_;  ///< the one used last stands first
  std::unordered_map<std::uint64_t, typename std::list<Entry>::iterator> by_key_;
};

}  // namespace bosquet::scene
