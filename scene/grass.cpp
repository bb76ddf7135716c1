#include "scene/grass.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/parallel.h"
#include "geometry/grass_tuft.h"
#include "scene/crown_cover.h"

namespace bosquet::scene {
namespace {

using geometry::kFarthestGrassM;
using geometry::kGrassTileM;

constexpr float kFootCell_m = 2.0f;
// A trunk's flare keeps grass off so much farther than its trunk's own radius.
constexpr float kFlare = 1.25f;
// What of a mesh reaches down to so much above the ground bars it.
constexpr float kLow_m = 0.4f, kFootprintCell_m = 0.25f;
constexpr int kMostFootprintCells = 2048;  // a side
constexpr int kTilesOfNode = 4;            // a side, more at the site's far edges
// Without cameras a file shows at most so much of the grass.
constexpr float kEvenRank = 0.05f;

std::uint64_t cell_key(IVec2 c) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.x)) << 32 | static_cast<std::uint32_t>(c.y);
}

/// What a mesh covers of the ground that it stands on.
struct MeshFootprint {
  Box2 box;
  float cell = kFootprintCell_m;
  IVec2 cells{0};
  std::vector<std::uint8_t> covered;

  MeshFootprint(const TriangleMesh& mesh, const terrain::Terrain& terrain) {
    for (const Vec3& p : mesh.positions) box.add(to_plan(p));
    box.low = glm::max(box.low, Vec2(0.0f)), box.high = glm::min(box.high, terrain.size_m());
    if (!(box.low.x < box.high.x && box.low.y < box.high.y)) return;
    const Vec2 size = box.high - box.low;
    cell = std::max(cell, std::max(size.x, size.y) / static_cast<float>(kMostFootprintCells));
    cells = IVec2(size / cell) + 1;
    covered.assign(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y), 0);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const Vec3 &a = mesh.positions[mesh.indices[t]], &b = mesh.positions[mesh.indices[t + 1]],
                 &c = mesh.positions[mesh.indices[t + 2]];
      if (std::min({a.y, b.y, c.y}) > terrain.ground(to_plan((a + b + c) / 3.0f)) + kLow_m) continue;
      fill(to_plan(a), to_plan(b), to_plan(c));
    }
  }
  bool covers(Vec2 plan) const {
    if (covered.empty() || plan.x < box.low.x || plan.y < box.low.y || plan.x > box.high.x || plan.y > box.high.y)
      return false;
    const IVec2 c = glm::min(IVec2((plan - box.low) / cell), cells - 1);
    return covered[index(c)] != 0;
  }

 private:
  std::size_t index(IVec2 c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(cells.x) + static_cast<std::size_t>(c.x);
  }
  void fill(Vec2 a, Vec2 b, Vec2 c) {
    const auto cross = [](Vec2 u, Vec2 v) { return u.x * v.y - u.y * v.x; };
    if (cross(b - a, c - a) < 0.0f) std::swap(b, c);
    const IVec2 low = glm::max(IVec2((glm::min(glm::min(a, b), c) - box.low) / cell), IVec2(0)),
                high = glm::min(IVec2((glm::max(glm::max(a, b), c) - box.low) / cell), cells - 1);
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) {
        const Vec2 p = box.low + cell * (Vec2(i, j) + 0.5f);
        if (cross(b - a, p - a) >= 0.0f && cross(c - b, p - b) >= 0.0f && cross(a - c, p - c) >= 0.0f)
          covered[index({i, j})] = 1;
      }
  }
};

}  // namespace

struct GrassSite::Taken {
  std::unordered_map<std::uint64_t, std::vector<TrunkFoot>> trunks;  ///< by cells that they touch
  std::vector<std::pair<Box2, std::shared_ptr<const Polygon>>> outlines;
  std::vector<MeshFootprint> meshes;

  bool at(Vec2 plan) const {
    if (const auto cell = trunks.find(cell_key(IVec2(glm::floor(plan / kFootCell_m)))); cell != trunks.end())
      for (const TrunkFoot& foot : cell->second)
        if (glm::dot(plan - foot.at, plan - foot.at) < foot.radius_m * foot.radius_m) return true;
    for (const auto& [box, outline] : outlines)
      if (plan.x >= box.low.x && plan.y >= box.low.y && plan.x <= box.high.x && plan.y <= box.high.y &&
          outline->contains(plan))
        return true;
    return std::any_of(meshes.begin(), meshes.end(), [&](const MeshFootprint& m) { return m.covers(plan); });
  }
};

GrassSite::GrassSite(const Document& document, GrassSiteOptions options)
    : terrain_(document.terrain), grid_(geometry::make_ground_grid(*document.terrain, options.ground_triangles)) {
  auto taken = std::make_shared<Taken>();
  for (TrunkFoot foot : options.trunks) {
    foot.radius_m *= kFlare;
    const IVec2 low(glm::floor((foot.at - foot.radius_m) / kFootCell_m)),
        high(glm::floor((foot.at + foot.radius_m) / kFootCell_m));
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) taken->trunks[cell_key({i, j})].push_back(foot);
  }
  for (const Obstacle& obstacle : document.obstacles)
    if (obstacle.outline)
      taken->outlines.emplace_back(obstacle.outline->bounds(), obstacle.outline);
    else if (obstacle.mesh)
      taken->meshes.emplace_back(*obstacle.mesh, *terrain_);
  taken_ = std::move(taken);
  highest_m_ = document.terrain->height.range().high;
  const GroundCover& cover = document.ground_cover;
  options_ = {cover.density,
              cover.lawn_height_m,
              cover.meadow_height_m,
              options.season,
              document.seed,
              nullptr,
              std::move(options.shade),
              [held = taken_](Vec2 plan) { return held->at(plan); }};
}

GrassPatch GrassSite::patch(IVec2 tile, float rank) const {
  geometry::GrassOptions options = options_;
  options.grid = &grid_;
  return {tile, geometry::grass_in(*terrain_, options, tile, rank)};
}

IVec2 GrassSite::tiles() const { return IVec2(glm::ceil(terrain_->size_m() / kGrassTileM)); }

GrassSiteOptions grass_options(const GrownScene& scene, geometry::Season season, std::size_t ground_triangles) {
  GrassSiteOptions options{season, ground_triangles, crown_cover(scene), {}};
  for (std::size_t i = 0; i < scene.trees.size(); ++i)
    options.trunks.push_back({(*scene.document.trees)[i].at, 0.5f * scene.trees[i].measures.trunk_diameter_m});
  return options;
}

float grass_reach(const Camera& camera, int picture_height) {
  constexpr float kUsualLens = 0.364f;  // the tangent of half of 40 degrees
  const SinCos half = sin_cos(0.5f * radians(camera.vertical_fov_deg));
  const float lens = kUsualLens * half.cos / std::max(half.sin, 1e-3f);
  return std::clamp(lens, 0.6f, 4.0f) * std::clamp(static_cast<float>(picture_height) / 1080.0f, 0.5f, 1.6f);
}

namespace {

/// Distance from an eye to a tile, as near as the site's ground may come.
float tile_distance(const GrassSite& site, IVec2 tile, const Vec3& eye) {
  const Vec2 low = kGrassTileM * Vec2(tile), high = low + kGrassTileM, plan = to_plan(eye);
  const Vec2 aside = glm::max(glm::max(low - plan, plan - high), Vec2(0.0f));
  return glm::length(Vec3(aside, std::max(0.0f, eye.y - site.highest_m())));
}

}  // namespace

std::vector<GrassTile> grass_tiles(const GrassSite& site, const Vec3& eye, float within_m) {
  const Vec2 plan = to_plan(eye);
  const IVec2 low = glm::max(IVec2(glm::floor((plan - within_m) / kGrassTileM)), IVec2(0)),
              high = glm::min(IVec2(glm::floor((plan + within_m) / kGrassTileM)), site.tiles() - 1);
  std::vector<GrassTile> tiles;
  for (int j = low.y; j <= high.y; ++j)
    for (int i = low.x; i <= high.x; ++i)
      if (const float distance = tile_distance(site, {i, j}, eye); distance < within_m)
        tiles.push_back({{i, j}, distance});
  return tiles;
}

std::vector<GrassPatch> grass_before(const GrassSite& site, const Camera& camera, float reach) {
  if (site.empty()) return {};
  const Vec2 eye = to_plan(camera.eye);
  const Vec3 view = camera.target - camera.eye;
  std::vector<GrassTile> tiles = grass_tiles(site, camera.eye, reach * kFarthestGrassM);
  // What lies behind is not seen, however wide the lens; what lies below one that looks down is.
  const Vec2 ahead(view.x, -view.z);
  const float level = glm::length(ahead);
  if (level > 0.5f * glm::length(view))
    std::erase_if(tiles, [&](const GrassTile& t) {
      const Vec2 middle = kGrassTileM * (Vec2(t.tile) + 0.5f);
      return glm::dot(middle - eye, ahead) < -kGrassTileM * level;
    });
  std::vector<GrassPatch> patches(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t t) {
    patches[t] = site.patch(tiles[t].tile, geometry::full_rank(tiles[t].distance_m / reach));
  });
  std::erase_if(patches, [](const GrassPatch& p) { return p.tufts.empty(); });
  return patches;
}

Material grass_material(geometry::Season season) {
  Material grass;
  grass.name = "grass";
  grass.surface = Surface::grass;
  grass.base_colour = std::make_shared<const Image>(geometry::grass_picture(season));
  grass.roughness = 0.8f;
  grass.translucency = 0.2f;
  grass.double_sided = true;
  return grass;
}

namespace {

/// A tuft that a file may have, the more worth it the smaller the number.
struct Candidate {
  float number;
  geometry::Tuft tuft;
};

std::vector<Candidate> candidates(const GrassSite& site, std::span<const Camera> cameras, float even_rank) {
  std::vector<IVec2> tiles;
  if (cameras.empty()) {
    const IVec2 all = site.tiles();
    for (int j = 0; j < all.y; ++j)
      for (int i = 0; i < all.x; ++i) tiles.emplace_back(i, j);
  }
  for (const Camera& camera : cameras) {
    for (const GrassTile& near : grass_tiles(site, camera.eye, kFarthestGrassM)) tiles.push_back(near.tile);
  }
  const auto before = [](IVec2 a, IVec2 b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); };
  std::sort(tiles.begin(), tiles.end(), before);
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  const auto nearest = [&](const auto& distance) {
    float least = kFarthestGrassM;
    for (const Camera& camera : cameras) least = std::min(least, distance(camera));
    return least;
  };
  std::vector<std::vector<Candidate>> found(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t t) {
    const float rank = cameras.empty() ? even_rank : geometry::full_rank(nearest([&](const Camera& c) {
      return tile_distance(site, tiles[t], c.eye);
    }));
    for (geometry::Tuft& tuft : site.patch(tiles[t], rank).tufts) {
      if (cameras.empty()) {
        found[t].push_back({tuft.rank, tuft});
        continue;
      }
      const float d = nearest([&](const Camera& c) { return glm::length(c.eye - tuft.at); });
      if (d < kFarthestGrassM && tuft.rank < geometry::full_rank(d))
        found[t].push_back({tuft.rank / geometry::full_rank(d), tuft});
    }
  });
  std::vector<Candidate> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

using TuftMeshes = std::array<TriangleMesh, geometry::kTuftShapes>;

TuftMeshes tuft_meshes() {
  TuftMeshes shapes;
  for (int s = 0; s < geometry::kTuftShapes; ++s) shapes[static_cast<std::size_t>(s)] = geometry::grass_tuft(s);
  return shapes;
}

std::vector<Candidate> worthiest(const GrassSite& site, std::span<const Camera> cameras, std::size_t max_triangles,
                                 const TuftMeshes& shapes) {
  float even_rank = kEvenRank;
  if (max_triangles > 0) {
    // About twice as many as there is room for, from a meadow all over the site.
    const Vec2 tiles(site.tiles());
    const float room =
        static_cast<float>(max_triangles) / static_cast<float>(shapes[geometry::kFirstMeadow].triangles());
    const float tufts = tiles.x * tiles.y * kGrassTileM * kGrassTileM * geometry::kMeadowTuftsPerM2;
    even_rank = std::min(even_rank, 2.0f * room / tufts);
  }
  std::vector<Candidate> all = candidates(site, cameras, even_rank);
  if (max_triangles == 0) return all;
  // Ties by place.
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.number < b.number; });
  std::size_t triangles = 0, kept = 0;
  while (kept < all.size() && (triangles += shapes[all[kept].tuft.shape].triangles()) <= max_triangles) ++kept;
  all.resize(kept);
  return all;
}

void add_tuft(TriangleMesh& mesh, const TriangleMesh& shape, const geometry::Tuft& tuft, const Vec3& origin) {
  // Turned about the upright, then leant as the ground does.
  const Vec3 east(tuft.turn.x, 0.0f, tuft.turn.y);
  const Vec3 x = glm::normalize(east - tuft.normal * glm::dot(east, tuft.normal)), z = glm::cross(x, tuft.normal);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 tint = glm::clamp(tuft.colour, 0.0f, 1.0f) * 255.0f + 0.5f;
  const Rgba8 colour(static_cast<std::uint8_t>(tint.x), static_cast<std::uint8_t>(tint.y),
                     static_cast<std::uint8_t>(tint.z), 255);
  for (std::size_t v = 0; v < shape.positions.size(); ++v) {
    const Vec3& p = shape.positions[v];
    mesh.positions.push_back(tuft.at - origin + tuft.height_m * (x * p.x + tuft.normal * p.y + z * p.z));
    mesh.normals.push_back(tuft.normal);
    mesh.uvs.push_back(shape.uvs[v]);
    mesh.colours.push_back(colour);
  }
  for (const std::uint32_t i : shape.indices) mesh.indices.push_back(first + i);
}

}  // namespace

std::size_t grass_triangles(const GrassSite& site, std::span<const Camera> cameras, std::size_t max_triangles) {
  if (site.empty()) return 0;
  const TuftMeshes shapes = tuft_meshes();
  std::size_t triangles = 0;
  for (const Candidate& c : worthiest(site, cameras, max_triangles, shapes))
    triangles += shapes[c.tuft.shape].triangles();
  return triangles;
}

BakedGrass bake_grass(const GrassSite& site, std::span<const Camera> cameras, std::size_t material,
                      std::size_t max_triangles) {
  BakedGrass baked;
  if (site.empty()) return baked;
  const TuftMeshes shapes = tuft_meshes();
  const std::vector<Candidate> all = worthiest(site, cameras, max_triangles, shapes);
  const IVec2 across = glm::max(site.tiles() / kTilesOfNode, IVec2(1));
  std::vector<std::vector<const geometry::Tuft*>> groups(static_cast<std::size_t>(across.x) *
                                                         static_cast<std::size_t>(across.y));
  constexpr float kNode_m = kGrassTileM * static_cast<float>(kTilesOfNode);
  for (const Candidate& c : all) {
    const IVec2 at = glm::clamp(IVec2(to_plan(c.tuft.at) / kNode_m), IVec2(0), across - 1);
    groups[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(across.x) + static_cast<std::size_t>(at.x)]
        .push_back(&c.tuft);
  }
  for (auto& group : groups) {
    if (group.empty()) continue;
    // Alike beside alike: so they are found again quickly, and the same whatever the order they came in.
    std::stable_sort(group.begin(), group.end(), [](const auto* a, const auto* b) { return a->shape < b->shape; });
    Node node;
    node.name = fmt::format("grass-{}", baked.nodes.size() + 1);
    Box3 box;
    for (const geometry::Tuft* tuft : group) box.add(tuft->at);
    node.translation = box.centre();
    TriangleMesh mesh;
    for (const geometry::Tuft* tuft : group) add_tuft(mesh, shapes[tuft->shape], *tuft, node.translation);
    baked.triangles += mesh.triangles();
    node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), material});
    baked.nodes.push_back(std::move(node));
  }
  return baked;
}

}  // namespace bosquet::scene
