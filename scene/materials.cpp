#include "scene/materials.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <type_traits>

#include "core/hash.h"
#include "core/parallel.h"
#include "geometry/bark_texture.h"
#include "geometry/foliage_mass.h"
#include "geometry/ground_covers.h"
#include "geometry/ground_texture.h"
#include "geometry/leaf_atlas.h"

namespace bosquet::scene {
namespace {

// Below one half, since most viewers let the alpha of distant leaves fade in their mipmaps.
constexpr float kLeafCutoff = 0.35f;
constexpr int kBarkPixels = 512, kAtlasPixels = 1024, kGroundPixels = 512, kHardPixels = 1024;
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

/// Hash of described values.
struct LookHash {
  Hasher& hasher;
  template <class Info, class Value>
  void operator()(const Info&, const Value& v) {
    if constexpr (std::is_enum_v<Value>)
      hasher.add(static_cast<int>(v));
    else
      hasher.add(v);
  }
};

// What the paintings of a kind are made from.
Hasher key_of(const char* kind, std::uint64_t seed, int pixels) {
  Hasher key;
  key.add(painter_version()).add(std::string_view(kind)).add(seed).add(pixels);
  return key;
}

/// The `count` images with this key, painted when there are none.
template <class Paint>
std::vector<Image> painted(const PaintingCache* paintings, std::uint64_t key, std::size_t count, const Paint& paint) {
  if (paintings)
    if (auto found = paintings->find(key); found && found->size() == count) return *std::move(found);
  std::vector<Image> images = paint();
  if (paintings) paintings->store(key, images);
  return images;
}

std::vector<Image> list_of(Image a, Image b) {
  std::vector<Image> list;
  list.push_back(std::move(a)), list.push_back(std::move(b));
  return list;
}

void paint_bark(const Species& species, std::uint64_t seed, const PaintingCache* paintings, Material& bark) {
  Hasher key = key_of("bark", seed, kBarkPixels);
  LookHash visit{key};
  describe(species.look, visit);  // twigs lend their colour
  auto images = painted(paintings, key.digest(), 2, [&] {
    auto textures = geometry::make_bark(species.look, seed, kBarkPixels);
    return list_of(std::move(textures.base_colour), std::move(textures.normal));
  });
  bark.name = species.name + "-bark";
  bark.surface = Surface::bark;
  bark.base_colour = shared(std::move(images[0]));
  bark.normal = shared(std::move(images[1]));
  bark.roughness = 0.9f;
}

void paint_leaves(const Species& species, geometry::Season season, std::uint64_t seed, const PaintingCache* paintings,
                  Material* parts) {
  Hasher key = key_of("leaves", seed, kAtlasPixels).add(static_cast<int>(season));
  LookHash visit{key};
  geometry::describe_leaf(species.look.leaf, visit);
  auto images = painted(paintings, key.digest(), 4, [&] {
    geometry::LeafAtlas atlas = geometry::make_leaf_atlas(species.look.leaf, season, seed, kAtlasPixels);
    geometry::LeafAtlas mass = geometry::make_foliage_mass(atlas, species.look.leaf.cluster, seed);
    std::vector<Image> list = list_of(std::move(atlas.base_colour), std::move(atlas.normal));
    list.push_back(std::move(mass.base_colour)), list.push_back(std::move(mass.normal));
    return list;
  });
  parts[kLeafPart] = leaf_material(species.name + "-leaf", species, {std::move(images[0]), std::move(images[1])});
  parts[kMassPart] = leaf_material(species.name + "-foliage", species, {std::move(images[2]), std::move(images[3])});
}

// Bark for job 0, all that has leaves for job 1.
void make_part(const Species& species, geometry::Season season, std::size_t job, const PaintingCache* paintings,
               Material* parts) {
  const std::uint64_t seed = kTextureSeed + hash_text(species.name);
  if (job == 0)
    paint_bark(species, seed, paintings, parts[kBarkPart]);
  else
    paint_leaves(species, season, seed, paintings, parts);
}

using PaintGround = geometry::GroundTextures (*)(std::uint64_t seed, int size);

Material ground_look(const char* name, PaintGround paint, int pixels, const PaintingCache* paintings) {
  auto images = painted(paintings, key_of(name, kTextureSeed, pixels).digest(), 2, [&] {
    auto textures = paint(kTextureSeed, pixels);
    return list_of(std::move(textures.base_colour), std::move(textures.normal));
  });
  Material ground;
  ground.name = name;
  ground.surface = Surface::ground;
  ground.base_colour = shared(std::move(images[0]));
  ground.normal = shared(std::move(images[1]));
  return ground;
}

}  // namespace

std::vector<Material> species_materials(const Species& species, geometry::Season season,
                                        const PaintingCache* paintings) {
  std::vector<Material> parts(kOfSpecies);
  parallel_for(2, [&](std::size_t job) { make_part(species, season, job, paintings, parts.data()); });
  return parts;
}

SitePart ground_part(terrain::Cover cover) {
  switch (cover) {
    case terrain::Cover::gravel:
      return kGravelPart;
    case terrain::Cover::paving:
      return kPavingPart;
    case terrain::Cover::grass:
      return kLawnPart;
    case terrain::Cover::soil:
      return kSoilPart;
    case terrain::Cover::natural:
      break;
  }
  return kGroundPart;
}

std::vector<Material> site_materials(const PaintingCache* paintings, const std::function<bool(terrain::Cover)>& shown) {
  std::vector<Material> site(kOfSite);
  struct Hard {
    terrain::Cover cover;
    const char* name;
    PaintGround paint;
    float patchiness;
  };
  const std::array<Hard, 3> hard{{{terrain::Cover::gravel, "gravel", geometry::make_gravel, 0.25f},
                                  {terrain::Cover::paving, "paving", geometry::make_paving, 0.15f},
                                  {terrain::Cover::soil, "soil", geometry::make_soil, 0.4f}}};
  parallel_for(hard.size() + 1, [&](std::size_t job) {
    if (job == hard.size()) {
      site[kGroundPart] = ground_look("ground", geometry::make_ground, kGroundPixels, paintings);
      return;
    }
    const Hard& h = hard[job];
    if (shown && !shown(h.cover)) return;
    Material& made = site[ground_part(h.cover)] = ground_look(h.name, h.paint, kHardPixels, paintings);
    made.patchiness = h.patchiness;
    made.laid = h.cover == terrain::Cover::paving;
  });
  // A lawn is mown grass.
  site[kLawnPart] = site[kGroundPart];
  site[kLawnPart].name = "lawn";
  site[kLawnPart].patchiness = 0.35f;
  Material& water = site[kWaterPart];
  water.name = "water";
  water.surface = Surface::water;
  water.base_factor = {0.06f, 0.10f, 0.11f, 1.0f};
  water.roughness = 0.08f;
  Material& obstacle = site[kObstaclePart];
  obstacle.name = "obstacle";
  obstacle.surface = Surface::obstacle;
  obstacle.base_factor = Vec4(kObstacleGrey, 1.0f);
  obstacle.double_sided = true;  // meshes of others face any way
  return site;
}

std::vector<Material> make_materials(const Document& document, geometry::Season season,
                                     const PaintingCache* paintings) {
  const std::size_t n = document.species.size();
  std::vector<Material> materials(kOfSpecies * n);
  std::vector<bool> used(n, false);
  for (const Tree& tree : *document.trees) used[tree.species] = true;
  for (const HeroTree& hero : document.heroes) used[hero.species] = true;
  const terrain::Terrain& terrain = *document.terrain;
  const bool barred = geometry::bars_anything(terrain);
  const auto shown = [&](terrain::Cover cover) {
    const auto& areas = terrain.areas.all();
    return barred && std::any_of(areas.begin(), areas.end(), [&](const terrain::Area& a) { return a.cover == cover; });
  };
  std::vector<Material> site;
  parallel_for(2 * n + 1, [&](std::size_t job) {
    const std::size_t s = job / 2;
    if (s == n)
      site = site_materials(paintings, shown);
    else if (used[s])
      make_part(*document.species[s], season, job % 2, paintings, &materials[material_of(s, kBarkPart)]);
  });
  materials.insert(materials.end(), std::make_move_iterator(site.begin()), std::make_move_iterator(site.end()));
  return materials;
}

}  // namespace bosquet::scene
