#include "scene/grass.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "geometry/prism.h"
#include "scene/model_builder.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

Document meadow(Vec2 size = {24, 24}) { return sample_document("silver_birch", {}, size); }

std::vector<geometry::Tuft> all_grass(const GrassSite& site) {
  std::vector<geometry::Tuft> all;
  for (int j = 0; j < site.tiles().y; ++j)
    for (int i = 0; i < site.tiles().x; ++i)
      for (const geometry::Tuft& tuft : site.patch({i, j}, 1.0f).tufts) all.push_back(tuft);
  return all;
}

TEST(Grass, KeepsOffTrunksBuildingsAndTheFeetOfMeshes) {
  Document document = meadow();
  Obstacle house, shed;
  const Polygon outline{{{2, 2}, {8, 2}, {8, 8}, {2, 8}}, {}};
  house.outline = std::make_shared<const Polygon>(outline);
  house.mesh = std::make_shared<const TriangleMesh>(geometry::prism(outline, -1, 6));
  shed.id = -2;
  shed.mesh =
      std::make_shared<const TriangleMesh>(geometry::prism({{{12, 12}, {16, 12}, {16, 16}, {12, 16}}, {}}, -1, 3));
  document.obstacles = {house, shed};
  GrassSiteOptions options;
  options.trunks = {{{20, 5}, 0.5f}};
  const GrassSite site(document, options);
  std::size_t found = 0;
  for (const geometry::Tuft& tuft : all_grass(site)) {
    const Vec2 at = to_plan(tuft.at);
    EXPECT_FALSE(outline.contains(at));
    EXPECT_FALSE(at.x > 12.3f && at.x < 15.7f && at.y > 12.3f && at.y < 15.7f);
    EXPECT_GE(glm::length(at - Vec2(20, 5)), 0.6f);
    ++found;
  }
  EXPECT_GT(found, 5'000u);
}

TEST(Grass, IsDrawnNearTheEyeAndThinsOutWithDistance) {
  const GrassSite site(meadow({150, 30}), {});
  Camera camera;
  camera.eye = to_world({2, 15}, 1.7f), camera.target = to_world({60, 15}, 1.0f);
  std::array<std::size_t, 15> by_distance{};
  for (const GrassPatch& patch : grass_before(site, camera, 1.0f))
    for (const geometry::Tuft& tuft : patch.tufts)
      ++by_distance[static_cast<std::size_t>(std::min(149.0f, tuft.at.x) / 10.0f)];
  EXPECT_GT(by_distance[1], 4 * by_distance[4]);
  EXPECT_GT(by_distance[4], 0u);
  EXPECT_EQ(by_distance[8], 0u);
  // From high above none can be told.
  camera.eye.y = 200.0f;
  EXPECT_TRUE(grass_before(site, camera, 1.0f).empty());
}

TEST(Grass, OfAFileIsWithinItsBudgetNearTheCamerasFirst) {
  const GrassSite site(meadow({60, 60}), {});
  Camera camera;
  camera.eye = to_world({5, 5}, 1.7f), camera.target = to_world({20, 20}, 1.0f);
  const BakedGrass all = bake_grass(site, std::span(&camera, 1), 0, 0),
                   some = bake_grass(site, std::span(&camera, 1), 0, 9'000);
  EXPECT_LE(some.triangles, 9'000u);
  EXPECT_GT(some.triangles, 8'900u);
  EXPECT_GT(all.triangles, 10 * some.triangles);
  // Without cameras they are spread evenly.
  const BakedGrass even = bake_grass(site, {}, 0, 9'000);
  EXPECT_LE(even.triangles, 9'000u);
  std::array<std::size_t, 2> halves{};
  for (const Node& node : even.nodes)
    for (const Vec3& p : node.parts[0].mesh->positions) ++halves[node.translation.x + p.x < 30.0f ? 0 : 1];
  EXPECT_NEAR(static_cast<double>(halves[0]) / static_cast<double>(halves[1]), 1.0, 0.25);
}

TEST(Grass, OfAModelIsMadeWhenAskedForAndCounted) {
  Document document = sample_document("silver_birch", {{4, 4}, {8, 5}}, {30, 30}, 0.4f);
  auto scene = grow_scene(document, {}, nullptr);
  ASSERT_TRUE(scene);
  const auto grass_in = [](const Model& model) {
    std::size_t triangles = 0;
    for (const Node& node : model.nodes)
      for (const Part& part : node.parts)
        if (model.materials[part.material].surface == Surface::grass) triangles += part.mesh->triangles();
    return triangles;
  };
  for (const std::size_t budget : {std::size_t{0}, std::size_t{40'000}, std::size_t{3'000}}) {
    const auto without = build_model(*scene, {.max_triangles = budget}, nullptr);
    const auto with = build_model(*scene, {.max_triangles = budget, .grass = true}, nullptr);
    ASSERT_TRUE(without && with);
    EXPECT_EQ(grass_in(without->model), 0u);
    EXPECT_GT(grass_in(with->model), 0u);
    std::size_t counted = 0;
    for (const Node& node : with->model.nodes)
      for (const Part& part : node.parts) counted += part.mesh->triangles();
    EXPECT_EQ(counted, with->triangles);
    if (budget > 0) {
      EXPECT_LE(with->triangles, budget);
    }
    EXPECT_GT(with->mesh_bytes, without->mesh_bytes / 2);
  }
}

TEST(Grass, IsTheSameForAnyNumberOfThreads) {
  const GrassSite site(meadow({40, 40}), {});
  const auto baked = [&](int threads) {
    BakedGrass out;
    run_with_threads(threads, [&] { out = bake_grass(site, {}, 0, 30'000); });
    return out;
  };
  const BakedGrass one = baked(1), three = baked(3);
  ASSERT_EQ(one.nodes.size(), three.nodes.size());
  for (std::size_t n = 0; n < one.nodes.size(); ++n) {
    EXPECT_EQ(one.nodes[n].parts[0].mesh->positions, three.nodes[n].parts[0].mesh->positions);
    EXPECT_EQ(one.nodes[n].parts[0].mesh->colours, three.nodes[n].parts[0].mesh->colours);
  }
}

}  // namespace
}  // namespace bosquet::scene
