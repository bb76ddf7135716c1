#include "scene/model_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "geometry/ground_mesh.h"
#include "geometry/water_mesh.h"
#include "growth/radii.h"
#include "scene/crown_cover.h"
#include "scene/grass.h"
#include "scene/materials.h"
#include "scene/tree_parts.h"

namespace bosquet::scene {
namespace {

constexpr std::size_t kMostGroundTriangles = 200'000;
// The least a tree's weight may divide by: a camera inside a crown must not take the whole budget.
constexpr float kNearest_m = 8.0f;
// Half diagonal over half height of a 16:9 picture.
constexpr float kPictureDiagonal = 2.04f;
// Share of the budget that goes to all trees alike, so that one near tree does not starve a forest.
constexpr double kEvenShare = 0.35;
// A tree behind the camera still throws shadows and is seen when the viewer turns.
constexpr float kOutOfPicture = 0.35f;
// From so many pixels across on a leaf shows its shape: a twig drawn on a card is seen to be flat.
constexpr float kLeafPixels = 2.0f;

// How large a tree appears to the camera that shows it largest: height over distance, less where it is out of the
// picture.
float apparent_size(std::span<const Camera> cameras, const Vec3& base, float height) {
  if (cameras.empty()) return height;
  const Vec3 middle = base + 0.5f * height * kUp;
  float largest = 0.0f;
  for (const Camera& camera : cameras) {
    const Vec3 to = middle - camera.eye, view = camera.target - camera.eye;
    const float distance = std::max(glm::length(to), kNearest_m), radius = 0.5f * height;
    // The cone around the picture's corners, widened by the tree's own size.
    const SinCos half = sin_cos(0.5f * radians(camera.vertical_fov_deg));
    const float corner = kPictureDiagonal * half.sin / half.cos;
    const float along = glm::dot(to, view) / std::max(glm::length(view), 1e-3f);
    const float aside = std::sqrt(std::max(0.0f, glm::dot(to, to) - along * along));
    const bool shown = along > -radius && aside < corner * std::max(along, 0.0f) + 2.0f * radius;
    largest = std::max(largest, (shown ? 1.0f : kOutOfPicture) * height / distance);
  }
  return largest;
}

// What leaves `leaf_m` wide are built as for one picture. Needles and other narrow ones stay on their twigs' cards longest,
// which show more of them than stand singly.
geometry::FoliageLevel level_for(const ModelOptions& options, float leaf_m, const Vec3& base, float height,
                                 float crown) {
  if (!options.picture || options.foliage != geometry::FoliageLevel::clusters) return options.foliage;
  const Camera& camera = *options.picture;
  // From the eye to the crown, upright as a box.
  const Vec3 half(0.5f * crown, 0.5f * height, 0.5f * crown);
  const Vec3 beyond = glm::max(glm::abs(camera.eye - (base + half.y * kUp)) - half, Vec3(0.0f));
  const SinCos view = sin_cos(0.5f * radians(camera.vertical_fov_deg));
  const float pixels_at_1m = 0.5f * static_cast<float>(options.picture_height) * view.cos / view.sin;
  return leaf_m * pixels_at_1m > kLeafPixels * glm::length(beyond) ? geometry::FoliageLevel::leaves : options.foliage;
}

Extras tree_extras(const Document& document, const Tree& tree, const GrownTree& grown) {
  const Species& species = document.species_of(tree);
  Extras extras{{"species", species.name},
                {"botanical_name", species.botanical_name},
                {"id", static_cast<double>(tree.id)},
                {"east_m", static_cast<double>(tree.at.x)},
                {"north_m", static_cast<double>(tree.at.y)},
                {"height_m", static_cast<double>(grown.measures.height_m)},
                {"trunk_diameter_m", static_cast<double>(grown.measures.trunk_diameter_m)},
                {"crown_diameter_m", static_cast<double>(grown.measures.crown_diameter_m)},
                {"crown_base_m", static_cast<double>(grown.measures.crown_base_m)},
                {"age_years", static_cast<double>(grown.age_years)}};
  if (!tree.inventory_name.empty()) extras.emplace_back("inventory_name", tree.inventory_name);
  if (!tree.inventory_id.empty()) extras.emplace_back("inventory_id", tree.inventory_id);
  return extras;
}

// What a tree's meshes are made from.
struct Drawn {
  std::string name;
  const growth::Skeleton* skeleton = nullptr;
  int season = -1;
  std::size_t species = 0;
  std::uint64_t key = 0;
  Vec3 base{0.0f};
  float height_m = 0, crown_m = 0;
  Extras extras;
};

std::vector<Drawn> drawn_trees(const GrownScene& scene) {
  const Document& document = scene.document;
  std::vector<Drawn> all;
  const auto base = [&](Vec2 at) { return to_world(at, document.terrain->ground(at)); };
  for (std::size_t i = 0; i < scene.trees.size(); ++i) {
    const Tree& tree = (*document.trees)[i];
    const GrownTree& grown = scene.trees[i];
    all.push_back({fmt::format("{}-{}", document.species_of(tree).name, tree.id), grown.skeleton.get(), grown.season,
                   tree.species, tree.key, base(tree.at), grown.measures.height_m, grown.measures.crown_diameter_m,
                   tree_extras(document, tree, grown)});
  }
  for (const HeroTree& hero : document.heroes) {
    Box3 box;
    for (const Vec3& p : hero.skeleton->distal) box.add(p);
    const float height = std::max(0.0f, box.high.y);
    const Species& species = *document.species[hero.species];
    all.push_back({hero.name,
                   hero.skeleton.get(),
                   -1,
                   hero.species,
                   hero.key,
                   base(hero.at),
                   height,
                   0.5f * (box.size().x + box.size().z),
                   {{"species", species.name},
                    {"botanical_name", species.botanical_name},
                    {"hero_tree", hero.name},
                    {"id", static_cast<double>(hero.id)},
                    {"east_m", static_cast<double>(hero.at.x)},
                    {"north_m", static_cast<double>(hero.at.y)},
                    {"height_m", static_cast<double>(height)}}});
  }
  return all;
}

Extras scene_extras(const Document& document) {
  const Vec2 size = document.terrain->size_m();
  Extras extras{{"site_east_m", static_cast<double>(size.x)},  {"site_north_m", static_cast<double>(size.y)},
                {"seed", std::to_string(document.seed)},       {"trees", static_cast<double>(document.trees->size())},
                {"south_west_x", document.place.south_west.x}, {"south_west_y", document.place.south_west.y}};
  if (!document.place.crs_wkt.empty()) extras.emplace_back("crs_wkt", document.place.crs_wkt);
  return extras;
}

std::size_t triangles(const std::vector<geometry::GroundPiece>& ground) {
  std::size_t sum = 0;
  for (const geometry::GroundPiece& piece : ground) sum += piece.mesh.triangles();
  return sum;
}

std::size_t mesh_bytes(const std::vector<Part>& parts) {
  std::size_t sum = 0;
  const auto add = [&](const auto& list) { sum += list.size() * sizeof(list[0]); };
  for (const Part& part : parts) {
    const TriangleMesh& mesh = *part.mesh;
    add(mesh.positions), add(mesh.normals), add(mesh.uvs), add(mesh.colours), add(mesh.indices);
    add(mesh.wind);
  }
  return sum;
}

Node mesh_node(std::string name, TriangleMesh mesh, std::size_t material) {
  Node node;
  node.name = std::move(name);
  node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), material});
  return node;
}

}  // namespace

std::vector<std::size_t> divide_budget(const std::vector<std::size_t>& need, const std::vector<float>& weight,
                                       std::size_t budget) {
  const std::size_t all = std::accumulate(need.begin(), need.end(), std::size_t{0});
  if (all <= budget) return need;
  const double even = kEvenShare * static_cast<double>(budget) / static_cast<double>(need.size());
  auto share = [&](double c, std::size_t i) {
    const auto triangles = static_cast<std::size_t>(even + c * static_cast<double>(weight[i]));
    return std::min(need[i], std::max(geometry::kTwoCardTriangles, triangles));
  };
  auto sum = [&](double c) {
    std::size_t total = 0;
    for (std::size_t i = 0; i < need.size(); ++i) total += share(c, i);
    return total;
  };
  // sum() never falls with c: bisect for the largest c that keeps to the budget.
  double low = 0.0, high = 1.0;
  while (sum(high) <= budget && high < 1e18) high *= 4.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (sum(middle) <= budget ? low : high) = middle;
  }
  std::vector<std::size_t> shares(need.size());
  for (std::size_t i = 0; i < need.size(); ++i) shares[i] = share(low, i);
  return shares;
}

Result<BuiltModel> build_model(const GrownScene& scene, const ModelOptions& options, Progress* progress) {
  const Document& document = scene.document;
  BuiltModel built;
  Model& model = built.model;

  Stopwatch watch;
  if (progress) progress->begin("textures", 0);
  model.materials = make_materials(document, options.season, options.paintings);
  built.seconds["textures"] = watch.restart();

  geometry::GroundOptions ground_options;
  ground_options.max_triangles = kMostGroundTriangles;
  if (options.max_triangles > 0)
    ground_options.max_triangles = std::clamp<std::size_t>(
        static_cast<std::size_t>(kGroundShare * static_cast<float>(options.max_triangles)), 2, kMostGroundTriangles);
  ground_options.shade = crown_cover(scene);
  ground_options.season = options.season;
  std::vector<geometry::GroundPiece> ground = geometry::mesh_ground(*document.terrain, ground_options);
  TriangleMesh water = geometry::mesh_water(*document.terrain, ground_options.max_triangles);
  const std::size_t tree_count = scene.trees.size() + document.heroes.size();
  if (options.max_triangles > 0) {
    std::size_t obstacles = 0;
    for (const Obstacle& obstacle : document.obstacles) obstacles += obstacle.mesh->triangles();
    const auto least = [&] {
      return triangles(ground) + water.triangles() + obstacles + geometry::kTwoCardTriangles * tree_count;
    };
    if (least() > options.max_triangles) {
      // The coarsest ground there is.
      ground_options.max_triangles = 2;
      ground = geometry::mesh_ground(*document.terrain, ground_options);
      water = geometry::mesh_water(*document.terrain, ground_options.max_triangles);
    }
    if (least() > options.max_triangles)
      return Error{fmt::format(
          "--max-triangles {}: the least possible here is {}: {} of the ground{}{}, and {} for each of {} trees",
          options.max_triangles, least(), triangles(ground),
          water.empty() ? "" : fmt::format(", {} of the water", water.triangles()),
          obstacles == 0 ? "" : fmt::format(", {} of obstacles", obstacles), geometry::kTwoCardTriangles, tree_count)};
  }
  built.triangles += triangles(ground);
  built.ground_triangles = ground_options.max_triangles;
  const bool one_chunk = ground.back().chunk == 0;
  for (std::size_t p = 0; p < ground.size(); ++p) {
    geometry::GroundPiece& piece = ground[p];
    if (p == 0 || piece.chunk != ground[p - 1].chunk) {
      model.nodes.emplace_back();
      model.nodes.back().name = one_chunk ? "ground" : fmt::format("ground-{}", piece.chunk + 1);
    }
    model.nodes.back().parts.push_back({std::make_shared<const TriangleMesh>(std::move(piece.mesh)),
                                        site_material(document, ground_part(piece.cover))});
  }
  if (!water.empty()) {
    built.triangles += water.triangles();
    model.nodes.push_back(mesh_node("water", std::move(water), site_material(document, kWaterPart)));
  }

  if (options.grass) {
    std::size_t spare = 0;
    if (options.max_triangles > 0) {
      std::size_t others = built.triangles + geometry::kTwoCardTriangles * tree_count;
      for (const Obstacle& obstacle : document.obstacles) others += obstacle.mesh->triangles();
      spare = std::min(static_cast<std::size_t>(kGrassShare * static_cast<float>(options.max_triangles)),
                       options.max_triangles - others);
    }
    if (spare > 0 || options.max_triangles == 0) {
      const GrassSite site(document, grass_options(scene, options.season, built.ground_triangles));
      BakedGrass grass = bake_grass(site, document.cameras, model.materials.size(), spare);
      if (!grass.nodes.empty()) model.materials.push_back(grass_material(options.season));
      built.triangles += grass.triangles;
      std::move(grass.nodes.begin(), grass.nodes.end(), std::back_inserter(model.nodes));
    }
  }

  for (const Obstacle& obstacle : document.obstacles) {
    Node node;
    node.name = obstacle.name;
    node.parts.push_back({obstacle.mesh, site_material(document, kObstaclePart)});
    built.triangles += obstacle.mesh->triangles();
    model.nodes.push_back(std::move(node));
  }

  std::vector<Camera> cameras(document.cameras.begin(), document.cameras.end());
  if (options.picture) cameras = {*options.picture};
  // What each tree is drawn with, and what its full mesh needs.
  std::vector<Drawn> trees = drawn_trees(scene);
  std::vector<std::vector<float>> radii(trees.size());
  std::vector<TreeOrder> orders(trees.size());
  std::vector<std::size_t> need(trees.size());
  std::vector<float> weight(trees.size());
  parallel_for(trees.size(), [&](std::size_t i) {
    const Drawn& tree = trees[i];
    const Species& species = *document.species[tree.species];
    if (tree.season >= 0) radii[i] = growth::radii(*tree.skeleton, tree.season);
    const std::span<const float> radius = tree.season < 0 ? tree.skeleton->radius : radii[i];
    TreeOrder& order = orders[i];
    order.input = {tree.skeleton,
                   radius,
                   &species.look,
                   &species.foliage,
                   {tree.season, options.season,
                    level_for(options, 1e-3f * species.look.leaf.width_mm, tree.base, tree.height_m, tree.crown_m), 0,
                    document.seed, tree.key, options.wind}};
    order.species = tree.species;
    order.size = Vec2(tree.crown_m, tree.height_m);
    order.need = need[i] =
        geometry::estimate_triangles(*tree.skeleton, radius, species.look, species.foliage, order.input.options) * 3 /
        2;
    const float apparent = apparent_size(cameras, tree.base, tree.height_m);
    weight[i] = apparent * apparent * apparent;
  });
  if (options.max_triangles > 0) {
    const auto budget = divide_budget(need, weight, options.max_triangles - built.triangles);
    for (std::size_t i = 0; i < orders.size(); ++i) orders[i].budget = budget[i];
  }

  if (progress) progress->begin("meshes", trees.size());
  std::vector<TreeParts> parts =
      build_tree_parts(orders, options.levels, model.materials, progress, [&](std::size_t i) {
        radii[i] = {};
        if (options.meshed && i < scene.trees.size()) options.meshed(i);
      });
  if (progress && progress->cancelled()) return cannot_finish("cancelled; nothing was written");
  for (std::size_t i = 0; i < trees.size(); ++i) {
    built.leaf_cards += parts[i].leaf_cards;
    ++built.forms[static_cast<std::size_t>(parts[i].form)];
    for (const Part& part : parts[i].parts) built.triangles += part.mesh->triangles();
    Node node;
    node.name = std::move(trees[i].name);
    node.translation = trees[i].base;
    node.extras = std::move(trees[i].extras);
    if (options.wind) node.extras.emplace_back("wind_m", static_cast<double>(parts[i].wind_m));
    node.parts = std::move(parts[i].parts);
    node.coarser = std::move(parts[i].coarser);
    node.coverage = parts[i].coverage;
    model.nodes.push_back(std::move(node));
  }
  for (const Node& node : model.nodes) {
    built.mesh_bytes += mesh_bytes(node.parts);
    for (const Level& level : node.coarser) built.mesh_bytes += mesh_bytes(level.parts);
  }
  model.cameras = document.cameras;
  model.sun = document.sun;
  model.extras = scene_extras(document);
  built.seconds["geometry"] = watch.restart();
  return built;
}

}  // namespace bosquet::scene
