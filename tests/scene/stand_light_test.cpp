// What canopy light does to grown stands: the claims that it is there for.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/grown_scene.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

constexpr int kRows = 10;
constexpr float kSpacing = 3.2f, kMargin = 12.0f;
const Vec2 kMiddle(kMargin + 0.5f * (kRows - 1) * kSpacing);

// A square stand with open land around it; `gap` leaves its middle sixteen places empty.
Document stand(const std::string& species, float scale, bool gap = false) {
  std::vector<Vec2> places;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kRows; ++i) {
      const bool middle = std::min(i, j) >= kRows / 2 - 2 && std::max(i, j) <= kRows / 2 + 1;
      if (!(gap && middle)) places.push_back(Vec2(i, j) * kSpacing + kMargin);
    }
  const float side = (kRows - 1) * kSpacing + 2 * kMargin;
  return sample_document(species, places, {side, side}, scale);
}

GrownScene grow(const Document& document, bool light) {
  GrowOptions options;
  options.light = light;
  auto grown = grow_scene(document, options, nullptr);
  EXPECT_TRUE(grown);
  return std::move(*grown);
}

// How many rows of trees stand between a tree and the nearest edge.
int rows_outside(Vec2 at) {
  const Vec2 place = (at - kMargin) / kSpacing + 0.5f;
  const int i = static_cast<int>(place.x), j = static_cast<int>(place.y);
  return std::min({i, j, kRows - 1 - i, kRows - 1 - j});
}

float mean_crown_base(const GrownScene& scene, int least_rows, int most_rows) {
  float sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < scene.trees.size(); ++i) {
    const int rows = rows_outside((*scene.document.trees)[i].at);
    if (rows < least_rows || rows > most_rows) continue;
    sum += scene.trees[i].measures.crown_base_m, ++n;
  }
  return sum / static_cast<float>(n);
}

// Living branch wood of the lower half of a tree that stands on its side towards a place (or away from it), internodes.
int low_wood(const GrownScene& scene, std::size_t tree, Vec2 place, bool towards) {
  const growth::Skeleton& s = *scene.trees[tree].skeleton;
  const Vec2 way = glm::normalize(place - (*scene.document.trees)[tree].at) * (towards ? 1.0f : -1.0f);
  int count = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    count += s.alive(i) && s.order[i] > 0 && s.distal[i].y < 0.5f * scene.trees[tree].measures.height_m &&
             glm::dot(to_plan(s.distal[i]), way) > 0.3f;
  return count;
}

TEST(StandLight, InnerTreesLoseTheirLowBranchesAndEdgeTreesKeepThem) {
  for (const auto& [species, scale] : {std::pair{"silver_birch", 1.2f}, {"norway_spruce", 0.8f}}) {
    const Document document = stand(species, scale);
    const GrownScene lit = grow(document, true), source = grow(document, false);
    const float inner = mean_crown_base(lit, 3, 4), edge = mean_crown_base(lit, 0, 0);
    const float inner_off = mean_crown_base(source, 3, 4), height = document.mature_height_m((*document.trees)[0]);
    EXPECT_GT(inner, inner_off + 0.15f * height) << species;
    EXPECT_GT(inner, edge + 0.1f * height) << species;
    EXPECT_LT(edge, 0.2f * height) << species;
  }
}

TEST(StandLight, EdgeTreesAreClothedLowerOnTheirOpenSide) {
  const GrownScene lit = grow(stand("silver_birch", 1.2f), true);
  int open = 0, shaded = 0;
  for (std::size_t i = 0; i < lit.trees.size(); ++i) {
    if (rows_outside((*lit.document.trees)[i].at) != 0) continue;
    open += low_wood(lit, i, kMiddle, false), shaded += low_wood(lit, i, kMiddle, true);
  }
  EXPECT_GT(open, 3 * shaded);
}

TEST(StandLight, TreesAroundAGapFillItAndKeepLowBranchesTowardsIt) {
  const GrownScene closed = grow(stand("silver_birch", 1.2f), true),
                   open = grow(stand("silver_birch", 1.2f, true), true);
  struct Around {
    int trees = 0, low = 0;
    float shift = 0;
  };
  const auto around = [&](const GrownScene& scene) {
    Around sum;
    for (std::size_t i = 0; i < scene.trees.size(); ++i) {
      const Vec2 at = (*scene.document.trees)[i].at;
      if (rows_outside(at) != kRows / 2 - 3) continue;
      ++sum.trees, sum.low += low_wood(scene, i, kMiddle, true);
      sum.shift += glm::dot(scene.trees[i].measures.crown_centroid, glm::normalize(kMiddle - at));
    }
    return sum;
  };
  const Around with = around(open), without = around(closed);
  ASSERT_EQ(with.trees, 20);
  ASSERT_EQ(without.trees, 20);
  EXPECT_GT(with.low, 2 * without.low);
  EXPECT_GT(with.shift - without.shift, 20 * 0.3f) << "0.3 m each on average";
}

TEST(StandLight, ALoneTreeIsTheSameWithAndWithout) {
  const Document alone = sample_document("english_oak", {{10, 10}}, {20, 20}, 0.4f);
  EXPECT_EQ(grow(alone, true).skeleton_digest, grow(alone, false).skeleton_digest);
}

TEST(StandLight, WithoutRegionsThereIsNone) {
  GrowOptions options;
  options.regions = false;
  const Document document = sample_document("silver_birch", {{8, 8}, {10, 8}, {9, 10}}, {18, 18}, 0.3f);
  auto scene = grow_scene(document, options, nullptr);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->light.size(), 0u);
}

}  // namespace
}  // namespace bosquet::scene
