// Bucket queue: cells in the order of their arrival times, for fronts whose speeds differ a thousandfold.
//
// Source    Denardo and Fox 1979 (multi-level buckets); Dial 1969 for one level
// Model     ticks are cut into units of 2^shift. An entry lies in the bucket named by the highest 8-bit digit in which
//           its unit differs from the present one, so level 0 holds the next 256 units, level 1 the next 256 * 256, ...
//           When a level runs out, the first bucket of the next is dealt out over the levels below it. The entries of
//           the present unit, a few, are kept sorted.
// Holds     pop() returns entries by rising tick, entries of one tick by cell; push() may not go back in time
// Cost      an entry moves at most once a level, in practice twice: no comparisons but those within a unit
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace bosquet::crowns {

class BucketQueue {
 public:
  struct Entry {
    std::uint64_t tick = 0;
    std::uint32_t cell = 0;
  };

  explicit BucketQueue(int shift) : shift_(shift) { heads_.fill(kNone); }

  bool empty() const { return size_ == 0; }

  void push(std::uint64_t tick, std::uint32_t cell) {
    ++size_;
    const std::uint64_t unit = tick >> shift_;
    assert(unit >= now_);
    if (unit == now_) return insert_now({tick, cell});
    put({tick, cell}, unit);
  }

  /// The next entry; the queue must not be empty.
  Entry pop() {
    assert(size_ > 0);
    --size_;
    if (cursor_ == present_.size()) advance();
    return present_[cursor_++];
  }

  /// An entry that is popped soon, unless one is pushed before it, or null: to fetch its memory ahead.
  const Entry* ahead(std::size_t entries) const {
    return cursor_ + entries < present_.size() ? &present_[cursor_ + entries] : nullptr;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::size_t kDigits = 256, kLevels = 8;
  // Entries of a bucket lie side by side, so that dealing them out reads memory in order.
  static constexpr std::uint32_t kChunk = 15;
  struct Chunk {
    std::array<Entry, kChunk> entries;
    std::uint32_t count, next;
  };

  static bool before(const Entry& a, const Entry& b) {
    return a.tick < b.tick || (a.tick == b.tick && a.cell < b.cell);
  }

  void insert_now(Entry entry) {
    present_.push_back(entry);
    std::size_t i = present_.size() - 1;
    for (; i > cursor_ && before(entry, present_[i - 1]); --i) present_[i] = present_[i - 1];
    present_[i] = entry;
  }

  void put(const Entry& entry, std::uint64_t unit) {
    const std::uint64_t differs = unit ^ now_;
    const std::size_t level = differs == 0 ? 0 : (static_cast<std::size_t>(std::bit_width(differs)) - 1) / 8;
    const auto digit = static_cast<std::size_t>((unit >> (8 * level)) & (kDigits - 1));
    std::uint32_t& head = heads_[level * kDigits + digit];
    if (head == kNone || chunks_[head].count == kChunk) head = fresh(head);
    Chunk& chunk = chunks_[head];
    chunk.entries[chunk.count++] = entry;
    filled_[level * 4 + digit / 64] |= std::uint64_t{1} << (digit % 64);
  }

  // An empty chunk in front of `next`.
  std::uint32_t fresh(std::uint32_t next) {
    std::uint32_t n = free_;
    if (n == kNone) {
      n = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      free_ = chunks_[n].next;
    }
    chunks_[n].count = 0;
    chunks_[n].next = next;
    return n;
  }

  // Takes the first bucket of a level off its place; kNone when the level is empty.
  std::uint32_t take_first(std::size_t level, std::size_t& digit) {
    for (std::size_t w = 0; w < 4; ++w) {
      std::uint64_t& word = filled_[level * 4 + w];
      if (word == 0) continue;
      digit = w * 64 + static_cast<std::size_t>(std::countr_zero(word));
      word &= word - 1;
      return std::exchange(heads_[level * kDigits + digit], kNone);
    }
    return kNone;
  }

  void advance() {
    present_.clear();
    cursor_ = 0;
    for (std::size_t level = 0; level < kLevels;) {
      std::size_t digit = 0;
      std::uint32_t n = take_first(level, digit);
      if (n == kNone) {
        ++level;
        continue;
      }
      // The present becomes the start of this bucket.
      const std::uint64_t below = (std::uint64_t{1} << (8 * level)) - 1,
                          here = std::uint64_t{kDigits - 1} << (8 * level);
      now_ = (now_ & ~(below | here)) | (std::uint64_t{digit} << (8 * level));
      while (n != kNone) {
        const std::uint32_t count = chunks_[n].count, next = chunks_[n].next;
        if (level == 0) {
          const Entry* first = chunks_[n].entries.data();
          present_.insert(present_.end(), first, first + count);
        } else {
          // By index, as putting entries may move the chunks.
          for (std::uint32_t e = 0; e < count; ++e) {
            const Entry entry = chunks_[n].entries[e];
            put(entry, entry.tick >> shift_);
          }
        }
        chunks_[n].next = free_, free_ = n;
        n = next;
      }
      if (level == 0) {
        std::sort(present_.begin(), present_.end(), before);
        return;
      }
      level = 0;
    }
    assert(!"an empty queue was popped");
  }

  int shift_;
  std::uint64_t now_ = 0;
  std::size_t size_ = 0, cursor_ = 0;
  std::vector<Entry> present_;
  std::vector<Chunk> chunks_;
  std::uint32_t free_ = kNone;
  std::array<std::uint32_t, kDigits * kLevels> heads_;
  std::array<std::uint64_t, 4 * kLevels> filled_{};
};

}  // namespace bosquet::crowns
