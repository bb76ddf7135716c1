#include "scene/model_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>

#include "core/parallel.h"
#include "scene/view_models.h"
#include "terrain/exclusion.h"
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

TEST(ModelBuilder, SkeletonsMayBeGivenUpAsTheirTreesAreMeshed) {
  GrownScene scene = small_scene();
  const auto whole = build_model(scene, {.max_triangles = 20'000, .levels = true}, nullptr);
  const auto leaner = build_model(
      scene,
      {.max_triangles = 20'000, .levels = true, .meshed = [&](std::size_t i) { scene.trees[i].skeleton.reset(); }},
      nullptr);
  ASSERT_TRUE(whole && leaner);
  for (const GrownTree& tree : scene.trees) EXPECT_EQ(tree.skeleton, nullptr);
  EXPECT_EQ(leaner->mesh_bytes, whole->mesh_bytes);
  ASSERT_EQ(leaner->model.nodes.size(), whole->model.nodes.size());
  for (std::size_t n = 0; n < whole->model.nodes.size(); ++n) {
    const Node &a = leaner->model.nodes[n], &b = whole->model.nodes[n];
    EXPECT_EQ(a.coarser.size(), b.coarser.size());
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t p = 0; p < a.parts.size(); ++p) EXPECT_EQ(a.parts[p].mesh->positions, b.parts[p].mesh->positions);
  }
}

TEST(ModelBuilder, ASceneGrownForMeshesAloneHasTheSameMeshesAndNoFallenWood) {
  const Document document = sample_document("silver_birch", {{4, 4}, {8, 5}, {6, 9}}, {12, 12}, 0.5f);
  for (const std::optional<float> year : {std::optional<float>(), std::optional<float>(15.0f)}) {
    const auto whole = grow_scene(document, {.year = year}, nullptr);
    const auto lean = grow_scene(document, {.year = year, .only_meshes = true}, nullptr);
    ASSERT_TRUE(whole && lean);
    EXPECT_EQ(lean->skeleton_digest, whole->skeleton_digest);
    EXPECT_EQ(lean->claimed_voxels, whole->claimed_voxels);
    EXPECT_EQ(lean->space.claimed_voxels(), 0u);
    EXPECT_EQ(lean->internodes(), whole->internodes());
    std::size_t kept = 0, all = 0;
    for (std::size_t i = 0; i < lean->trees.size(); ++i)
      kept += lean->trees[i].skeleton->size(), all += whole->trees[i].skeleton->size();
    EXPECT_EQ(kept, lean->internodes());
    EXPECT_LT(kept, all);
    for (const geometry::FoliageLevel foliage : {geometry::FoliageLevel::leaves, geometry::FoliageLevel::clusters}) {
      const ModelOptions options{.foliage = foliage, .max_triangles = 30'000, .levels = true, .wind = true};
      const auto a = build_model(*lean, options, nullptr), b = build_model(*whole, options, nullptr);
      ASSERT_TRUE(a && b);
      ASSERT_EQ(a->model.nodes.size(), b->model.nodes.size());
      for (std::size_t n = 0; n < b->model.nodes.size(); ++n) {
        const std::vector<Part>&parts = a->model.nodes[n].parts, &others = b->model.nodes[n].parts;
        ASSERT_EQ(parts.size(), others.size());
        for (std::size_t p = 0; p < parts.size(); ++p) {
          const TriangleMesh &one = *parts[p].mesh, &other = *others[p].mesh;
          EXPECT_EQ(one.positions, other.positions);
          EXPECT_EQ(one.colours, other.colours);
          EXPECT_EQ(one.uvs, other.uvs);
          EXPECT_EQ(one.wind, other.wind);
        }
      }
    }
  }
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

TEST(ModelBuilder, ABudgetTooSmallSaysTheLeastPossibleWhichSuffices) {
  const GrownScene scene = small_scene();
  const auto refused = build_model(scene, {.max_triangles = 3}, nullptr);
  ASSERT_FALSE(refused);
  const std::string& message = refused.error().message;
  const std::string words = "the least possible here is ";
  ASSERT_NE(message.find(words), std::string::npos) << message;
  const std::size_t least = std::stoul(message.substr(message.find(words) + words.size()));
  EXPECT_FALSE(build_model(scene, {.max_triangles = least - 1}, nullptr));
  const auto built = build_model(scene, {.max_triangles = least}, nullptr);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_LE(built->triangles, least);
  EXPECT_EQ(built->forms[static_cast<std::size_t>(geometry::TreeForm::two_cards)], 3u);
}

TEST(ModelBuilder, TreesBecomeShellsThenCardsWithPicturesAsTheBudgetFalls) {
  const GrownScene scene = small_scene();
  std::array<std::size_t, 4> most{};
  for (std::size_t budget : {9'000u, 350u, 150u, 60u, 16u}) {
    const auto built = build_model(scene, {.max_triangles = budget}, nullptr);
    ASSERT_TRUE(built) << built.error().message;
    EXPECT_LE(built->triangles, budget);
    for (std::size_t form = 0; form < most.size(); ++form) most[form] = std::max(most[form], built->forms[form]);
    std::size_t cards = 0;
    for (const Node& node : built->model.nodes)
      for (const Part& part : node.parts) {
        ASSERT_LT(part.material, built->model.materials.size());
        if (built->model.materials[part.material].name.rfind("impostors-", 0) != 0) continue;
        EXPECT_TRUE(part.mesh->triangles() == 4 || part.mesh->triangles() == 10) << part.mesh->triangles();
        ++cards;
      }
    EXPECT_EQ(cards, built->forms[static_cast<std::size_t>(geometry::TreeForm::four_cards)] +
                         built->forms[static_cast<std::size_t>(geometry::TreeForm::two_cards)]);
  }
  for (std::size_t form = 0; form < most.size(); ++form) EXPECT_GT(most[form], 0u) << geometry::kTreeFormNames[form];
}

TEST(ModelBuilder, LevelsFallInTrianglesAndCoverageDownToFourCards) {
  const GrownScene scene = small_scene();
  EXPECT_TRUE(build_model(scene, {}, nullptr)->model.nodes.back().coarser.empty());
  const auto built = build_model(scene, {.levels = true}, nullptr);
  ASSERT_TRUE(built);
  const auto triangles = [](const std::vector<Part>& parts) {
    std::size_t sum = 0;
    for (const Part& part : parts) sum += part.mesh->triangles();
    return sum;
  };
  for (const Node& node : built->model.nodes) {
    if (node.name.rfind("silver_birch-", 0) != 0) continue;
    ASSERT_GE(node.coarser.size(), 2u);
    std::size_t before = triangles(node.parts);
    float coverage = node.coverage;
    for (const Level& level : node.coarser) {
      EXPECT_LT(2 * triangles(level.parts), before + 1);
      EXPECT_LT(level.coverage, coverage);
      before = triangles(level.parts), coverage = level.coverage;
    }
    EXPECT_EQ(before, geometry::kFourCardTriangles);
    EXPECT_EQ(coverage, 0.0f);
  }
}

TEST(ModelBuilder, CardsAndPicturesAreTheSameForAnyNumberOfThreads) {
  const GrownScene scene = small_scene();
  std::vector<std::uint8_t> pixels[2];
  std::vector<Vec3> positions[2];
  for (int k = 0; k < 2; ++k)
    run_with_threads(k == 0 ? 1 : 5, [&, k] {
      const auto built = build_model(scene, {.max_triangles = 60}, nullptr);
      ASSERT_TRUE(built);
      pixels[k] = built->model.materials.back().base_colour->pixels;
      for (const Node& node : built->model.nodes)
        for (const Part& part : node.parts)
          positions[k].insert(positions[k].end(), part.mesh->positions.begin(), part.mesh->positions.end());
    });
  EXPECT_EQ(pixels[0], pixels[1]);
  EXPECT_TRUE(positions[0] == positions[1]);
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

TEST(ViewModels, ThePlanShowsAreasAndWater) {
  GrownScene scene = small_scene();
  terrain::Terrain ground = *scene.document.terrain;
  const auto without = plan_model(scene);
  ground = terrain::exclude(ground, {{{2, 2}, {8, 2}, {8, 6}, {2, 6}}, {}},
                            {"green", terrain::AreaKind::lawn, terrain::Cover::grass});
  scene.document.terrain = std::make_shared<const terrain::Terrain>(ground);
  const auto areas_of = [](const Model& model) {
    double square_m = 0;
    for (const Node& node : model.nodes)
      if (node.name == "areas")
        for (std::size_t t = 0; t < node.parts[0].mesh->indices.size(); t += 3) {
          const auto& mesh = *node.parts[0].mesh;
          const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[t + k]]; };
          square_m += 0.5 * static_cast<double>(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).y);
        }
    return square_m;
  };
  EXPECT_EQ(areas_of(*without), 0.0);
  EXPECT_NEAR(areas_of(*plan_model(scene)), 24.0, 3.0);
  ground.water_level_m = ground.height.range().high + 1.0f;
  scene.document.terrain = std::make_shared<const terrain::Terrain>(ground);
  EXPECT_NEAR(areas_of(*plan_model(scene)), 144.0, 1e-3) << "water over all";
}

}  // namespace
}  // namespace bosquet::scene
