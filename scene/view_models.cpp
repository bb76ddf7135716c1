#include "scene/view_models.h"

#include <algorithm>

#include "core/hash.h"
#include "geometry/ground_mesh.h"
#include "geometry/ground_texture.h"
#include "geometry/water_mesh.h"

namespace bosquet::scene {
namespace {

constexpr int kDiscSides = 32;
constexpr float kArrowWidth_m = 0.35f;
// An asymmetry of length 1 is drawn as long as the tree's crown radius times this.
constexpr float kArrowScale = 1.5f;
constexpr Vec3 kObstacleTint{0.22f, 0.21f, 0.20f};

Rgba8 colour(const Vec3& linear) {
  return Rgba8(glm::vec<3, std::uint8_t>(glm::clamp(linear, 0.0f, 1.0f) * 255.0f + 0.5f), 255);
}

// Well separated hues from a hash, at even brightness.
Vec3 hashed_colour(std::uint64_t key) {
  const float h = static_cast<float>(mix_bits(key) >> 40) * 0x1p-24f * 6.0f;
  const Vec3 rgb =
      glm::clamp(Vec3(glm::abs(h - 3.0f) - 1.0f, 2.0f - glm::abs(h - 2.0f), 2.0f - glm::abs(h - 4.0f)), 0.0f, 1.0f);
  return 0.15f + 0.55f * rgb;
}

void add_triangle_fan(TriangleMesh& mesh, const Vec3& centre, float radius, Rgba8 tint) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(centre);
  for (int s = 0; s < kDiscSides; ++s) {
    const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(s) / kDiscSides);
    mesh.positions.push_back(centre + radius * Vec3(a.cos, 0.0f, -a.sin));
    const std::uint32_t next = first + 1 + static_cast<std::uint32_t>((s + 1) % kDiscSides);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1 + static_cast<std::uint32_t>(s), next});
  }
  mesh.normals.resize(mesh.positions.size(), kUp);
  mesh.colours.resize(mesh.positions.size(), tint);
}

// Corners counter-clockwise seen from above.
void add_quad(TriangleMesh& mesh, const std::array<Vec3, 4>& corners, Rgba8 tint) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.normals.resize(mesh.positions.size(), kUp);
  mesh.colours.resize(mesh.positions.size(), tint);
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

// A surface of revolution about the vertical through `foot`, from (radius, height) pairs upward.
void add_lathe(TriangleMesh& mesh, const Vec3& foot, const std::vector<Vec2>& profile, int sides, Rgba8 tint) {
  const auto n = static_cast<std::uint32_t>(sides);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t r = 0; r < profile.size(); ++r) {
    const Vec2 along = profile[std::min(r + 1, profile.size() - 1)] - profile[r ? r - 1 : 0];
    for (int s = 0; s < sides; ++s) {
      const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(s) / static_cast<float>(sides));
      const Vec3 out(a.cos, 0.0f, -a.sin);
      mesh.positions.push_back(foot + profile[r].x * out + Vec3(0.0f, profile[r].y, 0.0f));
      const Vec3 normal = along.y * out - along.x * kUp;
      mesh.normals.push_back(glm::dot(normal, normal) > 0.0f ? glm::normalize(normal) : kUp);
      mesh.colours.push_back(tint);
    }
  }
  for (std::uint32_t r = 0; r + 1 < profile.size(); ++r)
    for (std::uint32_t s = 0; s < n; ++s) {
      const std::uint32_t t = (s + 1) % n, a = first + r * n;
      mesh.indices.insert(mesh.indices.end(), {a + s, a + t, a + n + t, a + s, a + n + t, a + n + s});
    }
}

std::size_t add_material(Model& model, std::string name, Surface surface) {
  Material material;
  material.name = std::move(name);
  material.surface = surface;
  model.materials.push_back(std::move(material));
  return model.materials.size() - 1;
}

void add_node(Model& model, std::string name, TriangleMesh mesh, std::size_t material) {
  if (mesh.empty()) return;
  Node node;
  node.name = std::move(name);
  node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), material});
  model.nodes.push_back(std::move(node));
}

void add_ground(Model& model, const GrownScene& scene) {
  Material ground;
  ground.name = "ground";
  ground.surface = Surface::ground;
  ground.base_factor = Vec4(geometry::kGroundMean, 1.0f);  // the tints are relative to the texture's mean
  model.materials.push_back(std::move(ground));
  const std::size_t ground_material = model.materials.size() - 1;
  const geometry::GroundOptions options;
  for (geometry::GroundPiece& piece : geometry::mesh_ground(*scene.document.terrain, options))
    add_node(model, "ground", std::move(piece.mesh), ground_material);
  const std::size_t water = add_material(model, "water", Surface::water);
  model.materials[water].base_factor = {0.06f, 0.10f, 0.11f, 1.0f};
  add_node(model, "water", geometry::mesh_water(*scene.document.terrain, options.max_triangles), water);
}

// The site as a sheet, for views from above.
TriangleMesh sheet(const GrownScene& scene, float y) {
  const Vec2 size = scene.document.terrain->size_m();
  TriangleMesh mesh;
  add_quad(mesh, {to_world({0, 0}, y), to_world({size.x, 0}, y), to_world(size, y), to_world({0, size.y}, y)},
           colour(Vec3(0.88f)));
  return mesh;
}

float tallest_m(const GrownScene& scene) {
  float tallest = 0;
  for (const GrownTree& tree : scene.trees) tallest = std::max(tallest, tree.measures.height_m);
  return tallest;
}

// Obstacles laid flat, for views from above.
void add_footprints(Model& model, const GrownScene& scene, float y, std::size_t material) {
  for (const Obstacle& obstacle : scene.document.obstacles) {
    TriangleMesh flat;
    flat.positions = obstacle.mesh->positions;
    for (Vec3& p : flat.positions) p.y = y;
    flat.indices = obstacle.mesh->indices;
    // Both ways up, as undersides lie flat too.
    for (std::size_t t = 0; t < obstacle.mesh->indices.size(); t += 3)
      flat.indices.insert(flat.indices.end(), {flat.indices[t], flat.indices[t + 2], flat.indices[t + 1]});
    flat.normals.assign(flat.positions.size(), kUp);
    flat.colours.assign(flat.positions.size(), colour(kObstacleTint));
    add_node(model, obstacle.name, std::move(flat), material);
  }
}

// Linear tints by kind of area, water last.
constexpr std::array<Vec3, 6> kAreaTints{{{0.72f, 0.70f, 0.64f},
                                          {0.66f, 0.56f, 0.40f},
                                          {0.58f, 0.76f, 0.42f},
                                          {0.52f, 0.36f, 0.24f},
                                          {0.45f, 0.44f, 0.43f},
                                          {0.30f, 0.52f, 0.72f}}};

// What is barred from planting, by its kind, and water, cell by cell of the ground: a quad for each run along a row.
void add_areas(Model& model, const GrownScene& scene, float y, std::size_t material) {
  const terrain::Terrain& ground = *scene.document.terrain;
  const IVec2 cells = ground.height.cells();
  const float cell = ground.height.cell_m();
  const Vec2 size = ground.size_m();
  constexpr int kNone = -1;
  const auto kind = [&](int i, int j) {
    const Vec2 at = cell * (Vec2(i, j) + 0.5f);
    if (ground.under_water(at)) return static_cast<int>(terrain::AreaKind::water);
    const terrain::Area* area = ground.area_at(at);
    // A pond's area is its outline, also where it is dry.
    return area && area->kind != terrain::AreaKind::water ? static_cast<int>(area->kind) : kNone;
  };
  TriangleMesh mesh;
  for (int j = 0; j < cells.y; ++j)
    for (int i = 0; i < cells.x;) {
      const int k = kind(i, j);
      int end = i + 1;
      while (end < cells.x && kind(end, j) == k) ++end;
      if (k != kNone) {
        const Vec2 low = cell * Vec2(i, j), high = glm::min(cell * Vec2(end, j + 1), size);
        add_quad(mesh,
                 {to_world(low, y), to_world({high.x, low.y}, y), to_world(high, y), to_world({low.x, high.y}, y)},
                 colour(kAreaTints[static_cast<std::size_t>(k)]));
      }
      i = end;
    }
  add_node(model, "areas", std::move(mesh), material);
}

void add_crown_discs(Model& model, const GrownScene& scene, float y) {
  const std::size_t flat = add_material(model, "plan", Surface::obstacle);
  add_node(model, "site", sheet(scene, y), flat);
  add_areas(model, scene, y + 0.02f, flat);
  add_footprints(model, scene, y + 0.03f, flat);
  // Taller crowns over lower ones, each a little higher so that none flickers.
  std::vector<std::size_t> order(scene.trees.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return scene.trees[a].measures.height_m < scene.trees[b].measures.height_m;
  });
  TriangleMesh discs;
  float lift = 0.05f;
  for (std::size_t i : order) {
    const Tree& tree = (*scene.document.trees)[i];
    const growth::Measures& m = scene.trees[i].measures;
    const Vec3 tint = hashed_colour(hash_text(scene.document.species_of(tree).name));
    add_triangle_fan(discs, to_world(tree.at + m.crown_centroid, y + lift), 0.5f * m.crown_diameter_m,
                     colour(0.35f * tint));
    add_triangle_fan(discs, to_world(tree.at + m.crown_centroid, y + lift + 0.02f), 0.47f * m.crown_diameter_m,
                     colour(tint));
    add_triangle_fan(discs, to_world(tree.at, y + lift + 0.04f), std::max(0.12f, 0.5f * m.trunk_diameter_m),
                     colour(Vec3(0.02f)));
    lift += 0.06f;
  }
  add_node(model, "crowns", std::move(discs), flat);
}

}  // namespace

void add_shape(TriangleMesh& mesh, const Vec3& foot, const crowns::RepresentativeShape& shape, float scale_height,
               float scale_width, const ShapeLook& look) {
  const float half = 0.5f * scale_height * shape.crown_height_m(), middle = scale_height * shape.trunk_height_m + half;
  const float trunk = 0.5f * scale_width * shape.trunk_width_m, crown = 0.5f * scale_width * shape.crown_width_m;
  add_lathe(mesh, foot, {{trunk, 0.0f}, {trunk, middle}}, look.sides, look.trunk);
  std::vector<Vec2> profile;
  for (int r = 0; r <= look.rings; ++r) {
    const SinCos a = sin_cos(kPi * static_cast<float>(r) / static_cast<float>(look.rings));
    profile.emplace_back(crown * a.sin, middle - half * a.cos);
  }
  add_lathe(mesh, foot, profile, look.sides, look.crown);
}

Result<Model> shapes_model(const GrownScene& scene) {
  Model model;
  model.cameras = scene.document.cameras;
  model.sun = scene.document.sun;
  add_ground(model, scene);
  const std::size_t material = add_material(model, "shapes", Surface::obstacle);
  TriangleMesh mesh;
  const std::vector<crowns::Claimant> claims = claimants(scene.document);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const crowns::Claimant& claim = claims[i];
    const Tree& tree = (*scene.document.trees)[i];
    const Vec3 foot = to_world(claim.base, claim.ground_y);
    add_shape(mesh, foot, claim.shape, claim.scale_height, claim.scale_width,
              {.trunk = colour({0.18f, 0.13f, 0.09f}),
               .crown = colour(0.7f * hashed_colour(hash_text(scene.document.species_of(tree).name)))});
  }
  add_node(model, "shapes", std::move(mesh), material);
  for (const Obstacle& obstacle : scene.document.obstacles) add_node(model, obstacle.name, *obstacle.mesh, material);
  return model;
}

Result<Model> regions_model(const GrownScene& scene, std::optional<float> height_m) {
  if (scene.space.claimed_voxels() == 0)
    return Error{"--view regions needs crown regions; they are off (--regions off) or no tree stands"};
  const float ground = scene.document.terrain->height.range().low;
  const float y = ground + height_m.value_or(tallest_m(scene) / 3.0f);
  const Vec2 size = scene.document.terrain->size_m();
  const Vec2 margin = 0.25f * size;
  const crowns::SpaceSlice cut = crowns::slice(scene.space, y, Box2{-margin, size + margin});
  Model model;
  const std::size_t flat = add_material(model, "regions", Surface::obstacle);
  add_node(model, "site", sheet(scene, y - 0.1f), flat);
  TriangleMesh mesh;
  for (std::int32_t j = 0; j < cut.height; ++j)
    for (std::int32_t i = 0; i < cut.width;) {
      // One quad for each run of a tree along a row.
      auto id = [&](std::int32_t column) {
        return cut
            .ids[static_cast<std::size_t>(j) * static_cast<std::size_t>(cut.width) + static_cast<std::size_t>(column)];
      };
      std::int32_t end = i + 1;
      while (end < cut.width && id(end) == id(i)) ++end;
      if (id(i) != 0) {
        const Vec2 low = cut.low + cut.voxel_m * Vec2(i, j), high = cut.low + cut.voxel_m * Vec2(end, j + 1);
        add_quad(mesh,
                 {to_world(low, y), to_world({high.x, low.y}, y), to_world(high, y), to_world({low.x, high.y}, y)},
                 colour(id(i) < 0 ? kObstacleTint : hashed_colour(static_cast<std::uint64_t>(id(i)))));
      }
      i = end;
    }
  for (const Tree& tree : *scene.document.trees)
    add_triangle_fan(mesh, to_world(tree.at, y + 0.1f), 0.2f, colour(Vec3(0.01f)));
  add_node(model, "regions", std::move(mesh), flat);
  return model;
}

Result<Model> plan_model(const GrownScene& scene) {
  Model model;
  add_crown_discs(model, scene, scene.document.terrain->height.range().high);
  return model;
}

Result<Model> arrows_model(const GrownScene& scene) {
  Model model;
  const float y = scene.document.terrain->height.range().high;
  add_crown_discs(model, scene, y);
  const float top = y + 1.0f + 0.06f * static_cast<float>(scene.trees.size());
  TriangleMesh arrows;
  for (std::size_t i = 0; i < scene.trees.size(); ++i) {
    const Vec3 v = scene.trees[i].asymmetry;
    const float length = glm::length(v);
    if (length < 1.0f / 64.0f) continue;
    const Vec3 from = to_world((*scene.document.trees)[i].at, top), along = v / length;
    const Vec3 left = kArrowWidth_m * Vec3(along.z, 0.0f, -along.x);  // along turned counter-clockwise seen from above
    const Vec3 tip = from + kArrowScale * length * 0.5f * scene.trees[i].measures.crown_diameter_m * along;
    const Rgba8 red = colour({0.75f, 0.03f, 0.02f});
    add_quad(arrows, {from - 0.4f * left, tip - 0.4f * left, tip + 0.4f * left, from + 0.4f * left}, red);
    add_quad(arrows, {tip - left, tip + 3.0f * kArrowWidth_m * along, tip + 3.0f * kArrowWidth_m * along, tip + left},
             red);
  }
  add_node(model, "arrows", std::move(arrows), 0);
  return model;
}

}  // namespace bosquet::scene
