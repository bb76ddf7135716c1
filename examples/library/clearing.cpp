// Three trees in a clearing, grown by the library: clearing OUT.glb
//
// The way of the data is that of docs/architecture.md: a document says what stands where, grow_scene() grows it,
// build_model() makes meshes, write_gltf() a file. Each step is a function of values, and a Result is tested before use.
#include <cstdio>

#include "exchange/gltf_writer.h"
#include "scene/model_builder.h"
#include "scene/planting_edits.h"
#include "terrain/lattice.h"

using namespace bosquet;

namespace {

struct Plant {
  std::size_t species;  // its number in the document
  Vec2 at;              // metres east and north of the site's south-west corner
  float scale;          // height as a share of the mature one
};
const Plant kPlants[]{{0, {10, 10}, 0.6f}, {1, {17, 8}, 0.8f}, {1, {18, 13}, 0.7f}};

Result<void> make_clearing(const char* file) {
  scene::Document document;
  document.seed = 7;  // the same seed, the same trees to the last bit

  // A flat site of 30 m x 20 m.
  const auto lattice = terrain::make_lattice({30.0f, 20.0f});
  if (!lattice) return lattice.error();
  document.terrain = std::make_shared<const terrain::Terrain>(terrain::make_terrain(terrain::Heightfield(*lattice)));
  document.trees = std::make_shared<const scene::Trees>();

  // Species by their names in recipes (`bosquet species list`), or from a file of yours by scene::read_species_file().
  for (const char* name : {"english_oak", "silver_birch"}) {
    auto species = scene::builtin_species(name);
    if (!species) return species.error();
    document.species.push_back(std::make_shared<const scene::Species>(std::move(*species)));
  }

  // Planting is an edit: a function from a document to the one after it.
  scene::PlantingGround ground;
  for (const Plant& plant : kPlants) {
    auto planted = scene::plant_tree(document, ground, plant.species, plant.at, plant.scale);
    if (!planted) return planted.error();
    document = std::move(planted->document);
  }

  // The space is divided among the trees first, so that each crown is what its neighbours leave it.
  const auto grown = scene::grow_scene(document, scene::GrowOptions{}, nullptr);
  if (!grown) return grown.error();
  for (std::size_t i = 0; i < grown->trees.size(); ++i) {
    const growth::Measures& tree = grown->trees[i].measures;
    std::printf("%s: %.1f m high, crown %.1f m, %d internodes\n",
                document.species_of((*document.trees)[i]).name.c_str(), tree.height_m, tree.crown_diameter_m,
                tree.internodes);
  }

  scene::ModelOptions options;
  options.season = geometry::Season::summer;
  options.max_triangles = 150'000;
  const auto built = scene::build_model(*grown, options, nullptr);
  if (!built) return built.error();
  const auto written = exchange::write_gltf(built->model, file);
  if (!written) return written.error();
  return {};
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return std::fprintf(stderr, "usage: clearing OUT.glb\n"), 1;
  const Result<void> done = make_clearing(words[1]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
