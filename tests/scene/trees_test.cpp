#include "scene/trees.h"

#include <gtest/gtest.h>

namespace bosquet::scene {
namespace {

// Ids 2, 4, 6, ...
std::vector<Tree> even_ids(std::size_t count) {
  std::vector<Tree> trees(count);
  for (std::size_t i = 0; i < count; ++i) {
    trees[i].id = 2 * static_cast<std::int32_t>(i + 1);
    trees[i].key = 77 * i;
  }
  return trees;
}

TEST(Trees, GiveBackWhatTheyWereMadeFrom) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, Trees::kBlock, Trees::kBlock + 1, 5 * Trees::kBlock}) {
    const std::vector<Tree> trees = even_ids(count);
    const Trees kept(trees);
    EXPECT_EQ(kept.size(), count);
    EXPECT_EQ(kept.to_vector(), trees);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(kept[i], trees[i]);
  }
}

TEST(Trees, AreFoundByTheirIdsAndByNoOther) {
  const Trees trees(even_ids(3 * Trees::kBlock + 7));
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const std::int32_t id = trees[i].id;
    EXPECT_EQ(trees.find(id), &trees[i]);
    EXPECT_EQ(trees.find(id - 1), nullptr);
  }
  EXPECT_EQ(trees.find(trees.back().id + 1), nullptr);
  EXPECT_EQ(Trees().find(1), nullptr);
}

}  // namespace
}  // namespace bosquet::scene
