#include "scene/skeleton_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/parallel.h"
#include "growth/digest.h"
#include "scene/grown_scene.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

std::shared_ptr<const growth::Skeleton> of_size(std::size_t internodes) {
  auto s = std::make_shared<growth::Skeleton>();
  s->parent.resize(internodes), s->distal.resize(internodes);
  return s;
}

std::size_t grown_anew(const GrownScene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.trees.begin(), scene.trees.end(), [](const GrownTree& t) { return !t.from_cache; }));
}

GrownScene grow(const Document& document, SkeletonCache* cache, float detail = 1.0f) {
  GrowOptions options;
  options.skeletons = cache, options.detail = detail;
  return *grow_scene(document, options, nullptr);
}

template <class Edit>
Document edited(const Document& document, std::size_t tree, const Edit& edit) {
  std::vector<Tree> trees = document.trees->to_vector();
  edit(trees[tree]);
  Document after = document;
  after.trees = std::make_shared<const Trees>(std::move(trees));
  return after;
}

// Far enough apart that a tree's region ends before the next one's begins, but for the last two.
const std::vector<Vec2> kApart{{10, 10}, {30, 10}, {50, 10}, {10, 30}, {30, 30}, {50, 30}, {52, 31}};

TEST(SkeletonCache, WhatWasUsedLongestAgoGoesFirst) {
  const std::size_t each = sizeof(growth::Skeleton) + 100 * (sizeof(std::int32_t) + sizeof(Vec3));
  SkeletonCache cache(3 * each);
  for (std::uint64_t key = 1; key <= 3; ++key) cache.insert(key, of_size(100));
  EXPECT_EQ(cache.bytes(), 3 * each);
  EXPECT_NE(cache.find(1), nullptr);  // 2 is now the one used longest ago
  cache.insert(4, of_size(100));
  EXPECT_EQ(cache.find(2), nullptr);
  for (const std::uint64_t key : {1u, 3u, 4u}) EXPECT_NE(cache.find(key), nullptr) << key;
  EXPECT_EQ(cache.size(), 3u);
}

TEST(SkeletonCache, NeverHoldsMoreThanItMay) {
  SkeletonCache cache(50'000);
  for (std::uint64_t key = 0; key < 200; ++key) {
    cache.insert(key, of_size(key * 37 % 1000));
    EXPECT_LE(cache.bytes(), cache.most_bytes());
  }
  const std::size_t before = cache.size();
  cache.insert(1000, of_size(100'000));
  EXPECT_EQ(cache.find(1000), nullptr) << "larger than all the room there is";
  EXPECT_EQ(cache.size(), before) << "and no reason to throw out the others";
  cache.clear();
  EXPECT_EQ(cache.bytes(), 0u);
}

TEST(SkeletonCache, ASkeletonInUseOutlivesItsPlace) {
  SkeletonCache cache(10'000);
  cache.insert(1, of_size(500));
  const auto held = cache.find(1);
  cache.insert(2, of_size(500));
  EXPECT_EQ(cache.find(1), nullptr);
  EXPECT_EQ(held->size(), 500u);
}

TEST(SkeletonCache, ManyThreadsFindWhatTheyPutIn) {
  SkeletonCache cache(1'000'000);
  run_with_threads(8, [&] {
    parallel_for(2000, [&](std::size_t i) {
      const std::uint64_t key = i % 97;
      if (const auto found = cache.find(key)) {
        EXPECT_EQ(found->size(), key);
      } else {
        cache.insert(key, of_size(key));
      }
    });
  });
  EXPECT_EQ(cache.size(), 97u);
}

TEST(SkeletonCache, AfterOneTreesEditOnlyThatTreeGrows) {
  SkeletonCache cache;
  const Document document = sample_document("silver_birch", kApart, {60, 40});
  EXPECT_EQ(grown_anew(grow(document, &cache)), kApart.size());
  EXPECT_EQ(grown_anew(grow(document, &cache)), 0u);

  const GrownScene reseeded = grow(edited(document, 2, [](Tree& t) { t.key += 1000; }), &cache);
  EXPECT_EQ(grown_anew(reseeded), 1u);
  EXPECT_FALSE(reseeded.trees[2].from_cache);
  EXPECT_EQ(grown_anew(grow(edited(document, 2, [](Tree& t) { t.trunk_diameter_m = 0.2f; }), &cache)), 1u);
  EXPECT_EQ(grown_anew(grow(edited(document, 0, [](Tree& t) { t.scale_height = 0.35f; }), &cache)), 1u);
  // Moved a little, a tree that is alone is the same tree elsewhere, up to where it stands in its voxel.
  EXPECT_LE(grown_anew(grow(edited(document, 3, [](Tree& t) { t.at += Vec2(0.3f, 0.2f); }), &cache)), 1u);
  // Of two trees that press each other both grow when one becomes higher.
  EXPECT_EQ(grown_anew(grow(edited(document, 6, [](Tree& t) { t.scale_height = t.scale_width = 0.36f; }), &cache)), 2u);
  EXPECT_EQ(grown_anew(grow(document, &cache)), 0u) << "taken back, nothing grows";
}

TEST(SkeletonCache, ASpeciesEditGrowsTheTreesOfThatSpecies) {
  SkeletonCache cache;
  Document document = sample_document("silver_birch", kApart, {60, 40});
  document.species.push_back(std::make_shared<const Species>(*builtin_species("english_oak")));
  document = edited(document, 0, [](Tree& t) { t.species = 1; });
  document = edited(document, 4, [](Tree& t) { t.species = 1; });
  grow(document, &cache);
  Species changed = *document.species[1];
  changed.growth.straightness -= 0.05f, changed.growth.space += 0.05f;
  document.species.replace(1, std::make_shared<const Species>(changed));
  EXPECT_EQ(grown_anew(grow(document, &cache)), 2u);
}

TEST(SkeletonCache, AnotherYearGrowsNothingAndAnotherDetailGrowsAll) {
  SkeletonCache cache;
  const Document document = sample_document("silver_birch", kApart, {60, 40});
  grow(document, &cache);
  GrowOptions options;
  options.skeletons = &cache, options.year = 5.0f;
  EXPECT_EQ(grown_anew(*grow_scene(document, options, nullptr)), 0u);
  EXPECT_EQ(grown_anew(grow(document, &cache, 2.0f)), kApart.size());
}

TEST(SkeletonCache, ASceneIsTheSameWithAndWithoutIt) {
  const Document document =
      edited(sample_document("english_oak", kApart, {60, 40}), 1, [](Tree& t) { t.trunk_diameter_m = 0.15f; });
  const std::uint64_t plain = grow(document, nullptr).skeleton_digest;
  SkeletonCache cache;
  for (int round = 0; round < 2; ++round) EXPECT_EQ(grow(document, &cache).skeleton_digest, plain);
  SkeletonCache small(20'000);  // hardly a tree fits
  for (int round = 0; round < 2; ++round) EXPECT_EQ(grow(document, &small).skeleton_digest, plain);
}

TEST(SkeletonCache, AnImpossibleTrunkIsToldEveryTime) {
  SkeletonCache cache;
  const Document document =
      edited(sample_document("silver_birch", {{5, 5}}, {10, 10}), 0, [](Tree& t) { t.trunk_diameter_m = 0.0001f; });
  for (int round = 0; round < 2; ++round) {
    const GrownScene scene = grow(document, &cache);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("tree 1 (silver_birch): no pipe exponent gives"), std::string::npos)
        << scene.warnings[0];
  }
}

}  // namespace
}  // namespace bosquet::scene
