#include "scene/materials.h"

#include <iterator>

#include "core/hash.h"
#include "core/parallel.h"
#include "geometry/bark_texture.h"
#include "geometry/foliage_mass.h"
#include "geometry/ground_texture.h"
#include "geometry/leaf_atlas.h"

namespace bosquet::scene {
namespace {

// Below one half, since most viewers let the alpha of distant leaves fade in their mipmaps.
constexpr float kLeafCutoff = 0.35f;
constexpr int kBarkPixels = 512, kAtlasPixels = 1024, kGroundPixels = 512;
// Obstacles are volumes in a plain light render.
constexpr Vec3 kObstacleGrey{0.40f, 0.385f, 0.36f};
// Seed of the textures: a species looks the same in every document.
constexpr std::uint64_t kTextureSeed = 1;

std::shared_ptr<const Image> shared(Image image) { return std::make_shared<const Image>(std::move(image)); }

Material leaf_material(std::string name, const Species& species, geometry::LeafAtlas atlas) {
  Material material;
  material.name = std::move(name);
  material.surface = Surface::leaf;
  material.base_colour = shared(std::move(atlas.base_colour));
  if (!atlas.normal.empty()) material.normal = shared(std::move(atlas.normal));
  material.roughness = 0.7f;
  material.translucency = species.look.leaf.translucency;
  material.alpha_cutoff = kLeafCutoff;
  material.mask = material.double_sided = true;
  return material;
}

// Bark for job 0, all that has leaves for job 1.
void make_part(const Species& species, geometry::Season season, std::size_t job, Material* parts) {
  const std::uint64_t seed = kTextureSeed + hash_text(species.name);
  if (job == 0) {
    auto textures = geometry::make_bark(species.look, seed, kBarkPixels);
    Material& bark = parts[kBarkPart];
    bark.name = species.name + "-bark";
    bark.surface = Surface::bark;
    bark.base_colour = shared(std::move(textures.base_colour));
    bark.normal = shared(std::move(textures.normal));
    bark.roughness = 0.9f;
  } else {
    geometry::LeafAtlas atlas = geometry::make_leaf_atlas(species.look.leaf, season, seed, kAtlasPixels);
    parts[kMassPart] = leaf_material(species.name + "-foliage", species, geometry::make_foliage_mass(atlas, seed));
    parts[kLeafPart] = leaf_material(species.name + "-leaf", species, std::move(atlas));
  }
}

Material ground_look() {
  auto textures = geometry::make_ground(kTextureSeed, kGroundPixels);
  Material ground;
  ground.name = "ground";
  ground.surface = Surface::ground;
  ground.base_colour = shared(std::move(textures.base_colour));
  ground.normal = shared(std::move(textures.normal));
  return ground;
}

}  // namespace

std::vector<Material> species_materials(const Species& species, geometry::Season season) {
  std::vector<Material> parts(kOfSpecies);
  parallel_for(2, [&](std::size_t job) { make_part(species, season, job, parts.data()); });
  return parts;
}

std::vector<Material> site_materials() {
  Material water;
  water.name = "water";
  water.surface = Surface::water;
  water.base_factor = {0.06f, 0.10f, 0.11f, 1.0f};
  water.roughness = 0.08f;
  Material obstacle;
  obstacle.name = "obstacle";
  obstacle.surface = Surface::obstacle;
  obstacle.base_factor = Vec4(kObstacleGrey, 1.0f);
  obstacle.double_sided = true;  // meshes of others face any way
  return {ground_look(), std::move(water), std::move(obstacle)};
}

std::vector<Material> make_materials(const Document& document, geometry::Season season) {
  const std::size_t n = document.species.size();
  std::vector<Material> materials(kOfSpecies * n);
  std::vector<bool> used(n, false);
  for (const Tree& tree : *document.trees) used[tree.species] = true;
  for (const HeroTree& hero : document.heroes) used[hero.species] = true;
  std::vector<Material> site;
  parallel_for(2 * n + 1, [&](std::size_t job) {
    const std::size_t s = job / 2;
    if (s == n)
      site = site_materials();
    else if (used[s])
      make_part(*document.species[s], season, job % 2, &materials[material_of(s, kBarkPart)]);
  });
  materials.insert(materials.end(), std::make_move_iterator(site.begin()), std::make_move_iterator(site.end()));
  return materials;
}

}  // namespace bosquet::scene
