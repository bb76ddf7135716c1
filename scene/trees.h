// Trees: all trees of a document, as blocks that documents share.
//
// Model     blocks of up to kBlock trees, never changed once made: an edit makes the blocks that it touches anew and
//           shares the others, so that a step of undo keeps what changed and little more
// Holds     ids ascend strictly from the first tree to the last; no block is empty
// Cost      [] and find() a binary search over the blocks, walking the range none of that
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "scene/tree.h"

namespace bosquet::scene {

class Trees {
 public:
  /// An edit copies its blocks of some 200 bytes a tree and the list of all blocks: at 10,000 trees that are scattered in
  /// the order of planting, blocks of this size cost least.
  static constexpr std::size_t kBlock = 32;
  using Block = std::vector<Tree>;

  Trees() = default;
  /// Trees in ascending order of id.
  explicit Trees(std::vector<Tree> trees);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Tree& operator[](std::size_t index) const;
  const Tree& front() const { return blocks_.front()->front(); }
  const Tree& back() const { return blocks_.back()->back(); }

  /// The tree with an id, or null.
  const Tree* find(std::int32_t id) const;

  /// The trees after an edit: `put` (by rising id) are added, or replace those of the same ids, and those of the ids
  /// `gone` (rising, not among `put`) are left out. Blocks that no such id falls into are shared.
  Trees edited(std::vector<Tree> put, std::span<const std::int32_t> gone = {}) const;

  std::vector<Tree> to_vector() const;
  std::span<const std::shared_ptr<const Block>> blocks() const { return blocks_; }

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Tree;
    using difference_type = std::ptrdiff_t;
    using pointer = const Tree*;
    using reference = const Tree&;

    Iterator() = default;
    reference operator*() const { return (**block_)[place_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      if (++place_ == (*block_)->size()) ++block_, place_ = 0;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator&) const = default;

   private:
    friend class Trees;
    explicit Iterator(const std::shared_ptr<const Block>* block) : block_(block) {}
    const std::shared_ptr<const Block>* block_ = nullptr;
    std::size_t place_ = 0;
  };

  Iterator begin() const { return Iterator(blocks_.data()); }
  Iterator end() const { return Iterator(blocks_.data() + blocks_.size()); }

 private:
  void append(std::shared_ptr<const Block> block);
  void append(std::vector<Tree>& trees, bool last);

  std::vector<std::shared_ptr<const Block>> blocks_;
  std::vector<std::size_t> first_;  ///< of each block: index of its first tree
  std::size_t size_ = 0;
};

}  // namespace bosquet::scene
