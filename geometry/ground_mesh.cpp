#include "geometry/ground_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>

#include "core/parallel.h"
#include "core/scalar.h"
#include "geometry/ground_texture.h"

namespace bosquet::geometry {
namespace {

// Around the water the ground is wet up to so far above its level; steeper ground than this (cosine) shows soil.
constexpr float kWetRise_m = 0.25f;
constexpr float kSteep = 0.80f, kVerySteep = 0.62f;

float step_between(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// Samples of the ground: (nx + 1) x (ny + 1), southern row first.
struct Samples {
  int nx = 1, ny = 1;
  Vec2 size{1.0f};
  std::vector<float> height;

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx + 1) + static_cast<std::size_t>(i);
  }
  Vec2 plan(int i, int j) const {
    return {size.x * static_cast<float>(i) / static_cast<float>(nx),
            size.y * static_cast<float>(j) / static_cast<float>(ny)};
  }
  Vec3 world(int i, int j) const { return to_world(plan(i, j), height[index(i, j)]); }
};

int steps(float length, float step) { return std::max(1, static_cast<int>(std::ceil(length / step - 1e-3f))); }

Samples sample(const terrain::Terrain& terrain, const GroundOptions& options) {
  const float step = ground_step_m(terrain, options);
  Samples s;
  s.size = terrain.size_m();
  s.nx = steps(s.size.x, step), s.ny = steps(s.size.y, step);
  s.height.resize(static_cast<std::size_t>(s.nx + 1) * static_cast<std::size_t>(s.ny + 1));
  parallel_for(
      static_cast<std::size_t>(s.ny) + 1,
      [&](std::size_t j) {
        for (int i = 0; i <= s.nx; ++i)
          s.height[s.index(i, static_cast<int>(j))] = terrain.ground(s.plan(i, static_cast<int>(j)));
      },
      16);
  return s;
}

/// Colour of what covers the ground where planting is barred; `open` is what it would be else.
Vec3 cover_colour(const terrain::Terrain& terrain, Vec2 plan, const Vec3& open) {
  if (terrain.areas.empty()) return kGravelColour;
  const std::array<Vec3, 5> colours{open, kGravelColour, kPavingColour, kLawnColour, kSoilColour};  // as terrain::Cover
  const terrain::CoverShares shares = terrain.covers(plan);
  Vec3 sum{0.0f};
  float barred = 0.0f;
  for (std::size_t c = 0; c < shares.size(); ++c) sum += shares[c] * colours[c], barred += shares[c];
  return barred > 0.0f ? sum / barred : open;
}

Rgba8 colour_at(const terrain::Terrain& terrain, const GroundOptions& options, Vec2 plan, float height,
                const Vec3& normal) {
  const float shade = options.shade ? std::clamp(options.shade(plan), 0.0f, 1.0f) : 0.0f;
  Vec3 albedo = glm::mix(kMeadowColour, kForestFloorColour, shade);
  albedo = glm::mix(kSoilColour, albedo, step_between(kVerySteep, kSteep, normal.y));
  if (const float barred = terrain.exclusion.at(plan); barred > 0.0f)
    albedo = glm::mix(albedo, cover_colour(terrain, plan, albedo), step_between(0.25f, 0.75f, barred));
  if (const std::optional<float> level = terrain.water_level(plan)) {
    const float rise = height - *level;
    albedo = glm::mix(kWetSandColour, albedo, step_between(0.25f * kWetRise_m, kWetRise_m, rise));
    albedo *= glm::mix(0.55f, 1.0f, step_between(-0.8f, 0.0f, rise));  // darker with depth
  }
  const Vec3 tint = glm::clamp(ground_tint(albedo), 0.0f, 1.0f) * 255.0f + 0.5f;
  return {static_cast<std::uint8_t>(tint.x), static_cast<std::uint8_t>(tint.y), static_cast<std::uint8_t>(tint.z), 255};
}

Vec2 uv_at(Vec2 plan) { return Vec2{plan.x, -plan.y} / kGroundTileM; }

/// A wall down from the site's edge, from sample (i, j) of a chunk's rim to the next along (di, dj), which runs with
/// the ground on its left.
void add_wall(TriangleMesh& mesh, const Samples& s, int i, int j, int di, int dj, int count, float bottom,
              Rgba8 colour) {
  const Vec3 outward{static_cast<float>(dj), 0.0f, static_cast<float>(di)};
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int k = 0; k <= count; ++k, i += di, j += dj) {
    const Vec3 top = s.world(i, j);
    const float along = (top.x + top.z) / kGroundTileM;
    for (const float y : {top.y, bottom}) {
      mesh.positions.push_back({top.x, y, top.z});
      mesh.normals.push_back(outward);
      mesh.uvs.push_back({along, -y / kGroundTileM});
      mesh.colours.push_back(colour);
    }
    if (k == 0) continue;
    const std::uint32_t a = first + 2u * static_cast<std::uint32_t>(k - 1);  // top, bottom, next top, next bottom
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
  }
}

// The surface at a level over the cells of the samples that hold it.
void add_water(TriangleMesh& mesh, const Samples& s, float level, const std::function<bool(int, int)>& holds) {
  // Vertices at ground samples under water and at points where edges of the ground pass the level.
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> at_sample(s.height.size(), kNone);
  std::unordered_map<std::uint64_t, std::uint32_t> at_edge;
  const auto vertex = [&](Vec2 plan) {
    mesh.positions.push_back(to_world(plan, level));
    mesh.normals.push_back(kUp);
    mesh.uvs.push_back(uv_at(plan));
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

float ground_step_m(const terrain::Terrain& terrain, const GroundOptions& options) {
  assert(options.max_triangles >= 2);
  const Vec2 size = terrain.size_m();
  const float cell = terrain.height.cell_m();
  for (int multiple = 1;; ++multiple) {
    const float step = cell * static_cast<float>(multiple);
    const auto cells = static_cast<std::size_t>(steps(size.x, step)) * static_cast<std::size_t>(steps(size.y, step));
    if (2 * cells <= options.max_triangles || cells == 1) return step;
  }
}

std::vector<TriangleMesh> mesh_ground(const terrain::Terrain& terrain, const GroundOptions& options) {
  const Samples s = sample(terrain, options);
  const int across = (s.nx + options.chunk_cells - 1) / options.chunk_cells;
  const int up = (s.ny + options.chunk_cells - 1) / options.chunk_cells;
  const float bottom = *std::min_element(s.height.begin(), s.height.end()) - options.skirt_m;
  const Vec3 soil = glm::clamp(ground_tint(kSoilColour), 0.0f, 1.0f) * 255.0f + 0.5f;
  const Rgba8 wall{static_cast<std::uint8_t>(soil.x), static_cast<std::uint8_t>(soil.y),
                   static_cast<std::uint8_t>(soil.z), 255};

  std::vector<TriangleMesh> chunks(static_cast<std::size_t>(across) * static_cast<std::size_t>(up));
  parallel_for(chunks.size(), [&](std::size_t c) {
    const int i0 = static_cast<int>(c) % across * options.chunk_cells,
              j0 = static_cast<int>(c) / across * options.chunk_cells;
    const int i1 = std::min(i0 + options.chunk_cells, s.nx), j1 = std::min(j0 + options.chunk_cells, s.ny);
    TriangleMesh& mesh = chunks[c];
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const Vec2 plan = s.plan(i, j);
        const Vec3 p = s.world(i, j), normal = terrain.height.normal(plan);
        mesh.positions.push_back(p);
        mesh.normals.push_back(normal);
        mesh.uvs.push_back(uv_at(plan));
        mesh.colours.push_back(colour_at(terrain, options, plan, p.y, normal));
      }
    const auto row = static_cast<std::uint32_t>(i1 - i0 + 1);
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) {
        const std::uint32_t a = static_cast<std::uint32_t>(j - j0) * row + static_cast<std::uint32_t>(i - i0);
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
      }
    if (options.skirt_m > 0.0f) {
      if (j0 == 0) add_wall(mesh, s, i0, 0, 1, 0, i1 - i0, bottom, wall);
      if (i1 == s.nx) add_wall(mesh, s, s.nx, j0, 0, 1, j1 - j0, bottom, wall);
      if (j1 == s.ny) add_wall(mesh, s, i1, s.ny, -1, 0, i1 - i0, bottom, wall);
      if (i0 == 0) add_wall(mesh, s, 0, j1, 0, -1, j1 - j0, bottom, wall);
    }
  });
  return chunks;
}

TriangleMesh mesh_water(const terrain::Terrain& terrain, const GroundOptions& options) {
  TriangleMesh mesh;
  if (!terrain.has_water()) return mesh;
  const Samples s = sample(terrain, options);
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
