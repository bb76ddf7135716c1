#include <gtest/gtest.h>

#include "exchange/gltf_instances.h"
#include "exchange/gltf_writer.h"
#include "geometry/grass_tuft.h"
#include "scene/grass.h"
#include "scratch_folder.h"
#include "terrain/exclusion.h"
#include "tests/scene/sample_document.h"

namespace bosquet::exchange {
namespace {

TEST(GltfInstances, GrassIsFoundAgainAsCopiesOfAFewTufts) {
  scene::Document document = scene::sample_document("silver_birch", {}, {40, 40});
  const auto lattice = terrain::make_lattice({40, 40}, 1.0f);
  document.terrain = std::make_shared<const terrain::Terrain>(terrain::exclude(
      terrain::make_terrain(terrain::Heightfield(*lattice, [](Vec2 p) { return 0.1f * p.x + 0.02f * p.x * p.y; })),
      {{{0, 0}, {20, 0}, {20, 40}, {0, 40}}, {}}, {"lawn", terrain::AreaKind::lawn, terrain::Cover::grass}));
  const scene::BakedGrass baked = scene::bake_grass(scene::GrassSite(document, {}), {}, 0, 60'000);
  ASSERT_FALSE(baked.nodes.empty());
  for (const scene::Node& node : baked.nodes) {
    const TriangleMesh& mesh = *node.parts[0].mesh;
    const auto cards = find_instances(mesh);
    ASSERT_TRUE(cards) << node.name;
    EXPECT_LE(cards->size(), static_cast<std::size_t>(geometry::kTuftShapes));
    std::size_t vertices = 0;
    for (const auto& card : *cards) vertices += card.card->positions.size() * card.instances.size();
    EXPECT_EQ(vertices, mesh.positions.size());
  }
}

TEST(GltfWriter, InstancedGrassTakesATenthOfBakedGrass) {
  scene::Model model;
  const scene::GrassSite site(scene::sample_document("silver_birch", {}, {40, 40}), {});
  model.nodes = scene::bake_grass(site, {}, 0, 100'000).nodes;
  model.materials.push_back(scene::grass_material(geometry::Season::summer));
  const ScratchFolder folder;
  GltfOptions instanced;
  instanced.instancing = true;
  const auto baked = write_gltf(model, folder / "baked.glb"),
             copies = write_gltf(model, folder / "copies.glb", instanced);
  ASSERT_TRUE(baked && copies);
  EXPECT_LT(10 * copies->bytes, baked->bytes + 200'000);
  EXPECT_EQ(copies->required_extensions.size(), 1u);
}

}  // namespace
}  // namespace bosquet::exchange
