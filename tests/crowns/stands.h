// Small stands of trees on simple ground, for the tests of crowns/.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/random.h"
#include "crowns/crown_space.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {

inline constexpr float kUnlimited = std::numeric_limits<float>::infinity();

/// A tree of crown width `width_m` and height `height_m` at scale 1.
inline Claimant tree(std::int32_t id, Vec2 base, float width_m, float height_m, float ground_y = 0.0f) {
  Claimant t;
  t.key = mix_bits(static_cast<std::uint64_t>(id));
  t.id = id;
  t.base = base;
  t.ground_y = ground_y;
  t.shape.trunk_width_m = 0.03f * height_m;
  t.shape.trunk_height_m = 0.2f * height_m;
  t.shape.crown_width_m = width_m;
  t.shape.mature_height_m = height_m;
  return t;
}

/// Clustered trees with crown areas in the ratio 1 to `area_ratio` on a square site, heights going with widths. As in
/// planting no trunk stands in another.
inline std::vector<Claimant> clustered(std::uint64_t seed, int count, float side_m, float widest_m, float tallest_m,
                                       float area_ratio) {
  std::vector<Claimant> trees;
  for (std::uint64_t n = 0; trees.size() < static_cast<std::size_t>(count); ++n) {
    RandomStream draw(seed, n, Purpose::planting);
    RandomStream cluster(seed, draw.below(static_cast<std::uint32_t>(1 + count / 10)), Purpose::statistics);
    const float middle_east = cluster.uniform(0.0f, side_m), middle_north = cluster.uniform(0.0f, side_m);
    const float spread = 0.2f * side_m;
    const float east = middle_east + draw.uniform(-spread, spread),
                north = middle_north + draw.uniform(-spread, spread);
    Claimant t = tree(static_cast<std::int32_t>(trees.size()) + 1, {east, north}, widest_m, tallest_m);
    t.scale_width = t.scale_height = draw.uniform(1.0f / std::sqrt(area_ratio), 1.0f);

    bool stands = east > 0.0f && north > 0.0f && east < side_m && north < side_m;
    for (const Claimant& other : trees)
      stands = stands && glm::distance(t.base, other.base) > t.trunk_radius_m() + other.trunk_radius_m();
    if (stands) trees.push_back(t);
  }
  return trees;
}

inline terrain::Terrain ground(float side_m, const std::function<float(Vec2)>& height) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({side_m, side_m}), height));
}
inline terrain::Terrain flat(float side_m) {
  return ground(side_m, [](Vec2) { return 0.0f; });
}

/// The source's rule: fronts end only when all is claimed, and crowns do not overhang the site.
inline SpaceOptions unlimited(float voxel_m, float layer_m) {
  SpaceOptions o;
  o.voxel_m = voxel_m;
  o.layer_m = layer_m;
  o.reach_factor = kUnlimited;
  return o;
}

/// Calls visit(voxel, what CrownSpace::owner() says) for every voxel kept.
inline void for_each_voxel(const CrownSpace& space, const std::function<void(IVec3, std::int32_t)>& visit) {
  for (const auto& tile : space.tiles())
    for (std::int32_t k = tile->first_layer; k < tile->first_layer + tile->layers; ++k)
      for (std::int32_t j = 0; j < kTileEdge; ++j)
        for (std::int32_t i = 0; i < kTileEdge; ++i) {
          const std::int32_t held = tile->owner[tile->offset(k) + static_cast<std::size_t>(j * kTileEdge + i)];
          visit({tile->tile.x * kTileEdge + i, k, tile->tile.y * kTileEdge + j},
                held < 0 ? held : space.claimant_of(held));
        }
}

/// A box as a closed mesh, faces outward.
inline TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.positions.push_back({n & 1 ? high.x : low.x, n & 2 ? high.y : low.y, n & 4 ? high.z : low.z});
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                  1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
  return mesh;
}

inline Polygon rectangle(Vec2 low, Vec2 high) { return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}}; }

/// A building over a rectangle in plan.
inline Obstacle building(std::int32_t id, Vec2 low, Vec2 high, float bottom_y, float top_y, VoxelSize size) {
  return {id, "building", std::make_shared<const ObstacleVolume>(extrude(rectangle(low, high), bottom_y, top_y, size))};
}

/// Distance from base to a voxel's centre in plan, metres.
inline double plan_distance(const CrownSpace& space, IVec3 voxel, Vec2 base) {
  const double edge = static_cast<double>(space.voxel_m());
  const double x = (voxel.x + 0.5) * edge - static_cast<double>(base.x);
  const double y = (voxel.z + 0.5) * edge - static_cast<double>(base.y);
  return std::sqrt(x * x + y * y);
}

}  // namespace bosquet::crowns
