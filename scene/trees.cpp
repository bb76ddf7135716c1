#include "scene/trees.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace bosquet::scene {
namespace {

// A block smaller than this that an edit makes is joined with its neighbour.
constexpr std::size_t kSmall = Trees::kBlock / 4;

}  // namespace

Trees::Trees(std::vector<Tree> trees) {
  assert(std::adjacent_find(trees.begin(), trees.end(), [](const Tree& a, const Tree& b) { return a.id >= b.id; }) ==
         trees.end());
  append(trees, true);
}

void Trees::append(std::shared_ptr<const Block> block) {
  first_.push_back(size_);
  size_ += block->size();
  blocks_.push_back(std::move(block));
}

// Blocks are filled up, so that what is planted later finds room in the last one; one in the middle that would be small
// is evened out with the one before it.
void Trees::append(std::vector<Tree>& trees, bool last) {
  for (std::size_t first = 0; first < trees.size();) {
    const std::size_t left = trees.size() - first;
    std::size_t take = std::min(left, kBlock);
    if (!last && left > kBlock && left < kBlock + kSmall) take = left / 2;
    const auto from = trees.begin() + static_cast<std::ptrdiff_t>(first);
    append(std::make_shared<const Block>(std::make_move_iterator(from),
                                         std::make_move_iterator(from + static_cast<std::ptrdiff_t>(take))));
    first += take;
  }
  trees.clear();
}

Trees Trees::edited(std::vector<Tree> put, std::span<const std::int32_t> gone) const {
  Trees out;
  std::vector<Tree> pending;  // of blocks that are made anew
  std::size_t p = 0, g = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    // A block reaches up to where the next one begins, the last one, while it has room, to the end of all ids.
    const bool last = b + 1 == blocks_.size();
    const auto within = [&](std::int32_t id) {
      if (!last) return id < blocks_[b + 1]->front().id;
      return id <= blocks_[b]->back().id || blocks_[b]->size() < kBlock;
    };
    const bool touched = (p < put.size() && within(put[p].id)) || (g < gone.size() && within(gone[g]));
    if (!touched && (pending.empty() || pending.size() >= kSmall)) {
      out.append(pending, false);
      out.append(blocks_[b]);
      continue;
    }
    for (const Tree& tree : *blocks_[b]) {
      while (p < put.size() && put[p].id < tree.id) pending.push_back(std::move(put[p++]));
      while (g < gone.size() && gone[g] < tree.id) ++g;
      if (p < put.size() && put[p].id == tree.id)
        pending.push_back(std::move(put[p++]));
      else if (g == gone.size() || gone[g] != tree.id)
        pending.push_back(tree);
    }
    while (p < put.size() && within(put[p].id)) pending.push_back(std::move(put[p++]));
    while (g < gone.size() && within(gone[g])) ++g;
  }
  while (p < put.size()) pending.push_back(std::move(put[p++]));
  out.append(pending, true);
  return out;
}

const Tree& Trees::operator[](std::size_t index) const {
  assert(index < size_);
  const auto block =
      static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), index) - first_.begin()) - 1;
  return (*blocks_[block])[index - first_[block]];
}

const Tree* Trees::find(std::int32_t id) const {
  const auto block =
      std::partition_point(blocks_.begin(), blocks_.end(), [&](const auto& b) { return b->back().id < id; });
  if (block == blocks_.end()) return nullptr;
  const auto tree = std::partition_point((*block)->begin(), (*block)->end(), [&](const Tree& t) { return t.id < id; });
  return tree->id == id ? &*tree : nullptr;
}

std::vector<Tree> Trees::to_vector() const {
  std::vector<Tree> trees;
  trees.reserve(size_);
  for (const Tree& tree : *this) trees.push_back(tree);
  return trees;
}

}  // namespace bosquet::scene
