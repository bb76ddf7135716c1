// Crowns stand more evenly than trunks: the claim of Longay 2014, 6.8, as sign tests over twenty clustered stands.
#include <gtest/gtest.h>

#include "core/random.h"
#include "distribution/pattern.h"
#include "scene/grown_scene.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

constexpr float kSide = 30.0f;
constexpr int kSeeds = 20, kNeeded = 16;  // 16 of 20: p = 0.006 if neither were more even

// 60 trees in five clusters; no two trunks nearer than half a metre.
Document clustered(std::uint64_t seed) {
  std::vector<Vec2> places, middles;
  RandomStream draw(seed, 1, Purpose::statistics);
  for (int c = 0; c < 5; ++c) {
    const float east = draw.uniform(5.0f, kSide - 5.0f);
    middles.push_back({east, draw.uniform(5.0f, kSide - 5.0f)});
  }
  while (places.size() < 60) {
    const float east = draw.uniform(-4.0f, 4.0f);
    const Vec2 at = middles[places.size() % middles.size()] + Vec2(east, draw.uniform(-4.0f, 4.0f));
    bool free = true;
    for (const Vec2& other : places) free = free && glm::distance(at, other) > 0.5f;
    if (free) places.push_back(at);
  }
  Document document = sample_document("silver_birch", places, {kSide, kSide}, 0.5f);
  std::vector<Tree> trees = document.trees->to_vector();
  for (Tree& tree : trees) tree.scale_height = tree.scale_width = draw.uniform(0.3f, 0.8f);
  document.trees = std::make_shared<const Trees>(std::move(trees));
  document.space.overhang_m = 0.0f;
  return document;
}

double k_within_5_m(const std::vector<Vec2>& points) {
  return distribution::ripley_k_plain(points, Box2{Vec2(0.0f), Vec2(kSide)}, std::vector<double>{5.0})[0];
}

TEST(CrownPattern, CrownsAreMoreUniformThanBasesAndMoreSoWithAsymmetry) {
  int parted = 0, further = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Document document = clustered(seed);
    const auto crowns = [&](bool asymmetry) {
      GrowOptions options;
      options.asymmetry = asymmetry;
      options.light = false;
      auto grown = grow_scene(document, options, nullptr);
      EXPECT_TRUE(grown);
      std::vector<Vec2> centroids;
      for (std::size_t i = 0; i < grown->trees.size(); ++i)
        centroids.push_back((*document.trees)[i].at + grown->trees[i].measures.crown_centroid);
      return k_within_5_m(centroids);
    };
    std::vector<Vec2> bases;
    for (const Tree& tree : *document.trees) bases.push_back(tree.at);
    const double constrained = crowns(false);
    parted += constrained < k_within_5_m(bases);
    further += crowns(true) < constrained;
  }
  EXPECT_GE(parted, kNeeded);
  EXPECT_GE(further, kNeeded);
}

}  // namespace
}  // namespace bosquet::scene
