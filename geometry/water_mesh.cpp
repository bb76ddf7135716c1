#include "geometry/water_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>

#include "geometry/ground_grid.h"
#include "geometry/ground_texture.h"

namespace bosquet::geometry {
namespace {

// The surface at a level over the cells of the samples that hold it.
void add_water(TriangleMesh& mesh, const GroundGrid& s, float level, const std::function<bool(int, int)>& holds) {
  // Vertices at ground samples under water and at points where edges of the ground pass the level.
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> at_sample(s.height.size(), kNone);
  std::unordered_map<std::uint64_t, std::uint32_t> at_edge;
  const auto vertex = [&](Vec2 plan) {
    mesh.positions.push_back(to_world(plan, level));
    mesh.normals.push_back(kUp);
    mesh.uvs.push_back(ground_uv(plan));
    mesh.colours.push_back({255, 255, 255, 255});
    return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  };

  const auto clip = [&](const std::array<IVec2, 3>& corners) {
    std::array<std::uint32_t, 4> polygon{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const IVec2 a = corners[k], b = corners[(k + 1) % 3];
      const std::size_t ia = s.index(a.x, a.y), ib = s.index(b.x, b.y);
      const float ha = s.height[ia], hb = s.height[ib];
      if (ha < level) {
        if (at_sample[ia] == kNone) at_sample[ia] = vertex(s.plan(a.x, a.y));
        polygon[n++] = at_sample[ia];
      }
      if ((ha < level) != (hb < level)) {
        // From the lower end, so that both triangles at an edge find the same point.
        const bool up = ha < level;
        const std::uint64_t edge = static_cast<std::uint64_t>(std::min(ia, ib)) << 32 | std::max(ia, ib);
        const auto [it, fresh] = at_edge.try_emplace(edge, kNone);
        if (fresh) {
          const Vec2 low = up ? s.plan(a.x, a.y) : s.plan(b.x, b.y), high = up ? s.plan(b.x, b.y) : s.plan(a.x, a.y);
          // Kept off the ends: a shore through a sample would make triangles without area.
          const float t = std::clamp((level - std::min(ha, hb)) / std::abs(hb - ha), 0.001f, 0.999f);
          it->second = vertex(glm::mix(low, high, t));
        }
        polygon[n++] = it->second;
      }
    }
    for (std::size_t k = 2; k < n; ++k)
      mesh.indices.insert(mesh.indices.end(), {polygon[0], polygon[k - 1], polygon[k]});
  };

  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) {
      if (!holds(i, j)) continue;
      clip({IVec2{i, j}, IVec2{i + 1, j}, IVec2{i, j + 1}});
      clip({IVec2{i + 1, j}, IVec2{i + 1, j + 1}, IVec2{i, j + 1}});
    }
}

}  // namespace

TriangleMesh mesh_water(const terrain::Terrain& terrain, std::size_t ground_triangles) {
  TriangleMesh mesh;
  if (!terrain.has_water()) return mesh;
  const GroundGrid s = make_ground_grid(terrain, ground_triangles);
  if (terrain.water_level_m) add_water(mesh, s, *terrain.water_level_m, [](int, int) { return true; });
  if (!terrain.has_ponds()) return mesh;
  for (const terrain::Area& area : terrain.areas.all()) {
    if (!area.water_level_m) continue;
    // Cells of the mesh that a corner or the middle of shows in the pond; under the site's level there is no other.
    const auto in_pond = [&](Vec2 plan) {
      const auto level = terrain.water_level(plan);
      return level && *level == *area.water_level_m && level != terrain.water_level_m;
    };
    add_water(mesh, s, *area.water_level_m, [&](int i, int j) {
      return in_pond(s.plan(i, j)) || in_pond(s.plan(i + 1, j)) || in_pond(s.plan(i, j + 1)) ||
             in_pond(s.plan(i + 1, j + 1)) || in_pond(0.5f * (s.plan(i, j) + s.plan(i + 1, j + 1)));
    });
  }
  return mesh;
}

}  // namespace bosquet::geometry
