#include "scene/trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/random.h"

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

std::set<const void*> blocks_of(const Trees& trees) {
  std::set<const void*> blocks;
  for (const auto& block : trees.blocks()) blocks.insert(block.get());
  return blocks;
}

std::size_t not_shared(const Trees& after, const Trees& before) {
  const auto old = blocks_of(before);
  return static_cast<std::size_t>(std::count_if(after.blocks().begin(), after.blocks().end(),
                                                [&](const auto& block) { return !old.contains(block.get()); }));
}

TEST(Trees, EditsInAnyOrderGiveWhatAMapGives) {
  RandomStream random(5, 1, Purpose::statistics);
  Trees trees;
  std::map<std::int32_t, Tree> expected;
  for (int edit = 0; edit < 400; ++edit) {
    std::map<std::int32_t, Tree> put;
    std::set<std::int32_t> gone;
    for (std::uint32_t n = random.below(40); n-- > 0;) {
      Tree tree;
      tree.id = 1 + static_cast<std::int32_t>(random.below(700));
      tree.key = random.bits();
      put[tree.id] = tree;
    }
    for (std::uint32_t n = random.below(edit % 7 ? 30 : 600); n-- > 0;) {
      const std::int32_t id = 1 + static_cast<std::int32_t>(random.below(700));
      if (!put.contains(id)) gone.insert(id);
    }
    std::vector<Tree> list;
    for (const auto& [id, tree] : put) list.push_back(tree);
    const std::vector<std::int32_t> ids(gone.begin(), gone.end());
    const Trees before = trees;
    const std::vector<Tree> before_list = trees.to_vector();
    trees = trees.edited(list, ids);
    EXPECT_EQ(before.to_vector(), before_list);

    for (const auto& [id, tree] : put) expected[id] = tree;
    for (std::int32_t id : gone) expected.erase(id);
    ASSERT_EQ(trees.size(), expected.size());
    std::size_t i = 0;
    for (const auto& [id, tree] : expected) ASSERT_EQ(trees[i++], tree);
    for (const auto& block : trees.blocks()) {
      ASSERT_FALSE(block->empty());
      ASSERT_LE(block->size(), Trees::kBlock);
    }
    // Small blocks do not pile up.
    ASSERT_LE(trees.blocks().size(), 2 + 6 * trees.size() / Trees::kBlock);
  }
}

TEST(Trees, AnEditSharesTheBlocksThatItDoesNotTouch) {
  const Trees trees(even_ids(40 * Trees::kBlock));
  Tree changed = trees[7 * Trees::kBlock + 3];
  changed.key = 1;
  const std::vector<std::int32_t> gone{trees[20 * Trees::kBlock].id};
  EXPECT_EQ(not_shared(trees.edited({changed}, gone), trees), 2u);

  // What is planted goes to the end: a block at most is made anew for what does not fill one.
  Tree planted;
  planted.id = trees.back().id + 1;
  const Trees more = trees.edited({planted});
  EXPECT_LE(not_shared(more, trees), 1u);
  EXPECT_EQ(more.back(), planted);
}

}  // namespace
}  // namespace bosquet::scene
