#include "scene/model_builder.h"

#include <gtest/gtest.h>

#include <numeric>

#include "scene/view_models.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

GrownScene small_scene() {
  auto grown = grow_scene(sample_document("silver_birch", {{4, 4}, {8, 5}, {6, 9}}, {12, 12}, 0.4f), {}, nullptr);
  EXPECT_TRUE(grown);
  return std::move(*grown);
}

TEST(DivideBudget, ABudgetThatSufficesGivesEveryTreeWhatItNeeds) {
  EXPECT_EQ(divide_budget({100, 200}, {1, 1}, 1000), (std::vector<std::size_t>{100, 200}));
}

TEST(DivideBudget, AShortBudgetIsKeptAndSharedEvenlyInPartAndThenByWeight) {
  const std::vector<std::size_t> need{100'000, 100'000, 5'000};
  const auto shares = divide_budget(need, {4, 1, 4}, 50'000);
  EXPECT_LE(std::accumulate(shares.begin(), shares.end(), std::size_t{0}), 50'000u);
  EXPECT_GE(std::accumulate(shares.begin(), shares.end(), std::size_t{0}), 49'900u);
  EXPECT_EQ(shares[2], 5'000u);
  // Beyond the even part, four times the weight is four times the triangles.
  const double even = 0.35 * 50'000 / 3;
  EXPECT_NEAR((static_cast<double>(shares[0]) - even) / (static_cast<double>(shares[1]) - even), 4.0, 0.01);
}

TEST(ModelBuilder, AModelHasANodeForEachTreeWithItsFacts) {
  const GrownScene scene = small_scene();
  auto built = build_model(scene, {}, nullptr);
  ASSERT_TRUE(built);
  std::size_t trees = 0;
  for (const Node& node : built->model.nodes) {
    if (node.name.rfind("silver_birch-", 0) != 0) continue;
    ++trees;
    EXPECT_EQ(node.parts.size(), 2u);
    EXPECT_EQ(std::get<std::string>(node.extras.front().second), "silver_birch");
  }
  EXPECT_EQ(trees, 3u);
}

TEST(ModelBuilder, TheTriangleBudgetIsKept) {
  const GrownScene scene = small_scene();
  for (std::size_t budget : {3'000u, 20'000u, 60'000u}) {
    auto built = build_model(scene, {.max_triangles = budget}, nullptr);
    ASSERT_TRUE(built);
    EXPECT_LE(built->triangles, budget);
    std::size_t counted = 0;
    for (const Node& node : built->model.nodes)
      for (const Part& part : node.parts) counted += part.mesh->triangles();
    EXPECT_EQ(counted, built->triangles);
  }
}

TEST(ViewModels, EveryViewHasMeshes) {
  const GrownScene scene = small_scene();
  for (const auto& model : {shapes_model(scene), regions_model(scene, {}), plan_model(scene), arrows_model(scene)}) {
    ASSERT_TRUE(model);
    std::size_t triangles = 0;
    for (const Node& node : model->nodes)
      for (const Part& part : node.parts) {
        triangles += part.mesh->triangles();
        EXPECT_EQ(part.mesh->normals.size(), part.mesh->positions.size());
        EXPECT_EQ(part.mesh->colours.size(), part.mesh->positions.size());
      }
    EXPECT_GT(triangles, 50u);
  }
}

}  // namespace
}  // namespace bosquet::scene
