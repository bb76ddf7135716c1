#include "scene/trees.h"

#include <algorithm>
#include <cassert>

namespace bosquet::scene {

Trees::Trees(std::vector<Tree> trees) : size_(trees.size()) {
  assert(std::adjacent_find(trees.begin(), trees.end(), [](const Tree& a, const Tree& b) { return a.id >= b.id; }) ==
         trees.end());
  for (std::size_t first = 0; first < trees.size(); first += kBlock) {
    const auto from = trees.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = trees.begin() + static_cast<std::ptrdiff_t>(std::min(trees.size(), first + kBlock));
    blocks_.push_back(std::make_shared<const Block>(std::make_move_iterator(from), std::make_move_iterator(to)));
    first_.push_back(first);
  }
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
