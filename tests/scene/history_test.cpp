#include "scene/history.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "scene/changes.h"
#include "scene/document_digest.h"
#include "scene/site_edits.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

Document grove() {
  std::vector<Vec2> places;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) places.push_back({2 + 3 * i, 2 + 3 * j});
  Document document = sample_document("silver_birch", places, {40, 40});
  settle_counters(document);
  return document;
}

Edited random_edit(const Document& document, RandomStream& random) {
  const auto some = [&] {
    std::vector<std::int32_t> ids;
    for (std::uint32_t n = 1 + random.below(5); n-- > 0;)
      ids.push_back(1 + static_cast<std::int32_t>(random.below(100)));
    return ids;
  };
  switch (random.below(5)) {
    case 0:
      return *move_trees(document, some(), {random.uniform(-2, 2), random.uniform(-2, 2)});
    case 1:
      return remove_trees(document, some());
    case 2:
      return *scale_trees(document, some(), random.uniform(0.8f, 1.2f), 1.1f);
    case 3:
      return set_status(document, some(), TreeStatus::existing);
    default: {
      terrain::Stroke stroke;
      stroke.points = {{random.uniform(0, 40), random.uniform(0, 40)}};
      return shape_ground(document, stroke);
    }
  }
}

TEST(History, UndoAndRedoGiveBackEveryDocument) {
  RandomStream random(3, 1, Purpose::statistics);
  History history(grove());
  std::vector<SectionDigests> digests{digest(*history.current())};
  for (int n = 0; n < 200; ++n) {
    history.add(random_edit(*history.current(), random));
    digests.push_back(digest(*history.current()));
  }
  for (std::size_t n = digests.size(); n-- > 1;) {
    ASSERT_EQ(digest(*history.current()), digests[n]);
    history.undo();
  }
  ASSERT_FALSE(history.can_undo());
  for (std::size_t n = 1; n < digests.size(); ++n) {
    ASSERT_EQ(digest(*history.current()), digests[n - 1]);
    history.redo();
  }
  EXPECT_FALSE(history.can_redo());
}

TEST(History, AnEditAfterUndoTakesTheOthersPlace) {
  History history(grove());
  history.add(remove_trees(*history.current(), std::vector<std::int32_t>{1}));
  history.add(remove_trees(*history.current(), std::vector<std::int32_t>{2, 3}));
  EXPECT_EQ(history.undo_name(), "Remove 2 trees");
  const std::uint64_t revision = history.revision();
  history.undo();
  EXPECT_NE(history.revision(), revision);
  EXPECT_EQ(history.undo_name(), "Remove a tree");
  EXPECT_EQ(history.redo_name(), "Remove 2 trees");
  history.add(remove_trees(*history.current(), std::vector<std::int32_t>{7, 8, 9}));
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.steps(), 3u);
  EXPECT_EQ(history.current()->trees->size(), 96u);
}

TEST(History, ADragIsOneStep) {
  History history(grove());
  const std::vector<std::int32_t> tree{5};
  for (int n = 1; n <= 50; ++n) {
    const auto moved = move_trees(*history.before_drag(1), tree, {0.1f * static_cast<float>(n), 0});
    history.add(*moved, 1);
  }
  EXPECT_EQ(history.steps(), 2u);
  const float after = history.current()->trees->find(5)->at.x;
  history.add(*move_trees(*history.before_drag(2), tree, {1, 0}), 2);
  EXPECT_EQ(history.steps(), 3u);
  history.undo();
  EXPECT_EQ(history.current()->trees->find(5)->at.x, after);
  history.undo();
  EXPECT_EQ(history.current()->trees->find(5)->at.x, grove().trees->find(5)->at.x);
}

TEST(History, KeepsToItsStepsAndBytes) {
  RandomStream random(4, 1, Purpose::statistics);
  History few(grove(), "Open", 20);
  for (int n = 0; n < 60; ++n) few.add(random_edit(*few.current(), random));
  EXPECT_EQ(few.steps(), 21u);

  constexpr std::size_t kBytes = 200'000;
  History small(grove(), "Open", 1000, kBytes);
  for (int n = 0; n < 300; ++n) {
    small.add(random_edit(*small.current(), random));
    ASSERT_LE(small.bytes(), kBytes);
  }
  EXPECT_GT(small.steps(), 3u);
}

TEST(History, WhatAStepKeepsFollowsWhatItChanged) {
  std::vector<Vec2> places;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) places.push_back({i, j});
  History history(sample_document("silver_birch", places, {300, 300}));
  for (std::int32_t n = 1; n <= 100; ++n)
    history.add(*move_trees(*history.current(), std::vector<std::int32_t>{n * 97}, {0.5f, 0}));
  EXPECT_LT(history.bytes() / 100, 32u << 10);
}

TEST(DocumentDigest, EverySectionShowsItsOwnChanges) {
  const Document before = grove();
  const SectionDigests old = digest(before);
  const auto differs = [&](const Document& after, Section section) {
    const SectionDigests now = digest(after);
    EXPECT_NE(now.all(), old.all());
    for (std::size_t s = 0; s < kSectionNames.size(); ++s)
      EXPECT_EQ(now.of[s] != old.of[s], s == static_cast<std::size_t>(section)) << kSectionNames[s];
  };
  Document d = before;
  d.seed = 12, differs(d, Section::site);
  d = before, d.sun.azimuth_deg = 1, differs(d, Section::settings);
  d = before, d.clearance.path_m = 1, differs(d, Section::settings);
  d = before, d.ground_cover.density = 2, differs(d, Section::settings);
  d = before, d.plan.title = "Sheet", differs(d, Section::settings);
  d = before, d.underlay.file = "plan.png", differs(d, Section::settings);
  d = before, d.interactions.push_back({"silver_birch", "silver_birch"}), differs(d, Section::planting);
  d = before, d.species.push_back(d.species[0]), differs(d, Section::species);
  differs(move_trees(before, std::vector<std::int32_t>{3}, {0.001f, 0})->document, Section::trees);
  differs(set_water_level(before, -5.0f).document, Section::ground);
  terrain::Stroke stroke;
  stroke.points = {{3, 3}};
  differs(shape_ground(before, stroke).document, Section::ground);
}

TEST(DocumentDigest, EveryFieldOfATreeCounts) {
  const Tree plain = grove().trees->front();
  std::vector<Tree> trees(15, plain);
  trees[1].key = 1, trees[2].species = 1, trees[3].at.x += 1, trees[4].scale_height += 1, trees[5].scale_width += 1;
  trees[6].trunk_diameter_m = 0.0f, trees[7].measured = true, trees[8].status = TreeStatus::existing;
  trees[9].inventory_name = "x", trees[10].inventory_id = "x", trees[11].locked = true;
  trees[12].overrides = {{"growth.planar", true}}, trees[13].studio_edits = {"bend"}, trees[14].clear_stem_m = 1;
  std::vector<SectionDigests> all;
  for (const Tree& tree : trees) {
    Document document = grove();
    document.trees = std::make_shared<const Trees>(std::vector<Tree>{tree});
    all.push_back(digest(document));
    for (std::size_t n = 0; n + 1 < all.size(); ++n) ASSERT_NE(all[n], all.back()) << n << " " << all.size();
  }
}

TEST(DocumentDigest, IsTheSameKeptOrMadeAnewAndHoweverTreesLieInBlocks) {
  RandomStream random(9, 1, Purpose::statistics);
  Document document = grove();
  DigestKeeper keeper;
  for (int n = 0; n < 100; ++n) {
    document = random_edit(document, random).document;
    const SectionDigests kept = keeper.of(document);
    ASSERT_EQ(kept, digest(document));
    Document packed = document;
    packed.trees = std::make_shared<const Trees>(document.trees->to_vector());
    ASSERT_EQ(kept, digest(packed));
  }
}

}  // namespace
}  // namespace bosquet::scene
