#include "geometry/ground_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "core/hash.h"
#include "core/parallel.h"
#include "geometry/ground_colour.h"
#include "geometry/ground_covers.h"
#include "geometry/ground_grid.h"
#include "geometry/ground_texture.h"

namespace bosquet::geometry {
namespace {

using terrain::Cover;

Rgba8 tint_of(const Vec3& albedo) {
  const Vec3 tint = glm::clamp(ground_tint(albedo), 0.0f, 1.0f) * 255.0f + 0.5f;
  return {static_cast<std::uint8_t>(tint.x), static_cast<std::uint8_t>(tint.y), static_cast<std::uint8_t>(tint.z), 255};
}

/// What the meshes of one chunk are made from.
struct Ground {
  const terrain::Terrain& terrain;
  const GroundOptions& options;
  const GroundGrid& grid;
  const CellCovers& covers;
  int parts;  ///< of a cell with several covers, along a side
};

Rgba8 colour_at(const Ground& g, Cover cover, Vec2 plan, float height, const Vec3& normal) {
  const float shade = cover == Cover::natural && g.options.shade ? g.options.shade(plan) : 0.0f;
  return tint_of(ground_albedo(g.terrain, cover, {plan, height, normal, shade}, g.options.season));
}

/// The meshes of a chunk, one a cover, that share a vertex wherever triangles of a cover meet.
class ChunkMeshes {
 public:
  /// Of the grid's cells from `low` to `high`.
  ChunkMeshes(const Ground& ground, IVec2 low, IVec2 high) : ground_(ground), low_(low), size_(high - low + 1) {}

  /// Two triangles between the grid's samples.
  void cell(Cover cover, int i, int j) {
    const std::uint32_t a = sample(cover, i, j), b = sample(cover, i + 1, j), c = sample(cover, i, j + 1),
                        d = sample(cover, i + 1, j + 1);
    auto& indices = mesh(cover).indices;
    indices.insert(indices.end(), {a, b, c, b, d, c});
  }
  void triangle(Cover cover, const Vec3& a, const Vec3& b, const Vec3& c) {
    auto& indices = mesh(cover).indices;
    const std::uint32_t corners[3] = {vertex(cover, a), vertex(cover, b), vertex(cover, c)};
    indices.insert(indices.end(), corners, corners + 3);
  }
  TriangleMesh& mesh(Cover cover) { return meshes_[static_cast<std::size_t>(cover)]; }

 private:
  struct PlaceHash {
    std::size_t operator()(const Vec2& p) const { return Hasher().add(p.x).add(p.y).digest(); }
  };

  std::uint32_t sample(Cover cover, int i, int j) {
    constexpr std::uint32_t kNone = 0xffffffff;
    std::vector<std::uint32_t>& known = samples_[static_cast<std::size_t>(cover)];
    if (known.empty()) known.assign(static_cast<std::size_t>(size_.x * size_.y), kNone);
    std::uint32_t& at = known[static_cast<std::size_t>((j - low_.y) * size_.x + i - low_.x)];
    if (at == kNone) at = add(cover, ground_.grid.world(i, j), ground_.grid.plan(i, j));
    return at;
  }
  std::uint32_t vertex(Cover cover, const Vec3& at) {
    const auto next = static_cast<std::uint32_t>(mesh(cover).positions.size());
    const auto [found, fresh] = places_[static_cast<std::size_t>(cover)].try_emplace(Vec2(at.x, at.z), next);
    return fresh ? add(cover, at, to_plan(at)) : found->second;
  }
  std::uint32_t add(Cover cover, const Vec3& at, Vec2 plan) {
    TriangleMesh& to = mesh(cover);
    const Vec3 normal = ground_.terrain.height.normal(plan);
    to.positions.push_back(at);
    to.normals.push_back(normal);
    to.uvs.push_back(ground_uv(plan));
    to.colours.push_back(colour_at(ground_, cover, plan, at.y, normal));
    return static_cast<std::uint32_t>(to.positions.size()) - 1;
  }

  const Ground& ground_;
  IVec2 low_, size_;
  std::array<std::vector<std::uint32_t>, terrain::kCoverNames.size()> samples_;
  std::array<TriangleMesh, terrain::kCoverNames.size()> meshes_;
  std::array<std::unordered_map<Vec2, std::uint32_t, PlaceHash>, terrain::kCoverNames.size()> places_;
};

/// A cell of one cover: two triangles, or a fan where cells beside it are parted.
void add_even_cell(ChunkMeshes& out, const Ground& g, int i, int j, Cover cover) {
  const GroundGrid& grid = g.grid;
  const int n = g.parts;
  const bool south = g.covers.several(i, j - 1), east = g.covers.several(i + 1, j), north = g.covers.several(i, j + 1),
             west = g.covers.several(i - 1, j);
  if (n == 1 || !(south || east || north || west)) {
    out.cell(cover, i, j);
    return;
  }
  // Round the rim, counter-clockwise seen from above; the middle lies on the diagonal.
  std::vector<Vec3> rim;
  const auto side = [&](bool parted, int s, int t, int ds, int dt) {
    for (int k = 0; k < n; k += parted ? 1 : n) rim.push_back(grid.world_in(i, j, s + k * ds, t + k * dt, n));
  };
  side(south, 0, 0, 1, 0), side(east, n, 0, 0, 1), side(north, n, n, -1, 0), side(west, 0, n, 0, -1);
  const Vec3 middle = 0.5f * (grid.world(i + 1, j) + grid.world(i, j + 1));
  for (std::size_t k = 0; k < rim.size(); ++k) out.triangle(cover, middle, rim[k], rim[(k + 1) % rim.size()]);
}

/// A cell with several covers: parted, and each part's triangles cut.
void add_parted_cell(ChunkMeshes& out, const Ground& g, int i, int j) {
  const int n = g.parts;
  std::vector<CoverPoint> points;
  points.reserve(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int t = 0; t <= n; ++t)
    for (int s = 0; s <= n; ++s)
      points.emplace_back(g.grid.world_in(i, j, s, t, n), cover_shares(g.terrain, g.grid.plan_in(i, j, s, t, n)));
  const auto put = [&](Cover cover, const Vec3& a, const Vec3& b, const Vec3& c) { out.triangle(cover, a, b, c); };
  for (int t = 0; t < n; ++t)
    for (int s = 0; s < n; ++s) {
      const auto at = [&](int ds, int dt) -> const CoverPoint& {
        return points[static_cast<std::size_t>((t + dt) * (n + 1) + s + ds)];
      };
      cut_by_cover(g.terrain, {at(0, 0), at(1, 0), at(0, 1)}, put);
      cut_by_cover(g.terrain, {at(1, 0), at(1, 1), at(0, 1)}, put);
    }
}

/// A wall down from the site's edge, from sample (i, j) of a chunk's rim to the next along (di, dj), which runs with
/// the ground on its left.
void add_wall(TriangleMesh& mesh, const GroundGrid& grid, int i, int j, int di, int dj, int count, float bottom) {
  const Vec3 outward{static_cast<float>(dj), 0.0f, static_cast<float>(di)};
  const Rgba8 soil = tint_of(kSoilColour);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int k = 0; k <= count; ++k, i += di, j += dj) {
    const Vec3 top = grid.world(i, j);
    const float along = (top.x + top.z) / kGroundTileM;
    for (const float y : {top.y, bottom}) {
      mesh.positions.push_back({top.x, y, top.z});
      mesh.normals.push_back(outward);
      mesh.uvs.push_back({along, -y / kGroundTileM});
      mesh.colours.push_back(soil);
    }
    if (k == 0) continue;
    const std::uint32_t a = first + 2u * static_cast<std::uint32_t>(k - 1);  // top, bottom, next top, next bottom
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
  }
}

/// Into how many parts a side cells with several covers go: as many as the terrain's own cells, if the budget has room.
struct Parting {
  int parts;
  CellCovers covers;
};

Parting part(const terrain::Terrain& terrain, const GroundGrid& grid, std::size_t max_triangles) {
  const std::size_t taken = 2 * grid.cells(), spare = max_triangles > taken ? max_triangles - taken : 0;
  for (int parts = grid.fineness;; parts /= 2) {
    CellCovers covers(terrain, grid, std::max(1, parts));
    const auto n = static_cast<std::size_t>(std::max(1, parts));
    // Two triangles a part, more along a line and in the cells beside.
    if (n == 1 || covers.several_count() * (2 * n * n + 8 * n) <= spare)
      return {static_cast<int>(n), std::move(covers)};
  }
}

}  // namespace

std::vector<GroundPiece> mesh_ground(const terrain::Terrain& terrain, const GroundOptions& options) {
  const GroundGrid grid = make_ground_grid(terrain, options.max_triangles);
  const Parting parting = part(terrain, grid, options.max_triangles);
  const Ground ground{terrain, options, grid, parting.covers, parting.parts};
  const int across = (grid.nx + options.chunk_cells - 1) / options.chunk_cells;
  const int up = (grid.ny + options.chunk_cells - 1) / options.chunk_cells;
  const float bottom = *std::min_element(grid.height.begin(), grid.height.end()) - options.skirt_m;

  std::vector<std::vector<GroundPiece>> chunks(static_cast<std::size_t>(across) * static_cast<std::size_t>(up));
  parallel_for(chunks.size(), [&](std::size_t c) {
    const int i0 = static_cast<int>(c) % across * options.chunk_cells,
              j0 = static_cast<int>(c) / across * options.chunk_cells;
    const int i1 = std::min(i0 + options.chunk_cells, grid.nx), j1 = std::min(j0 + options.chunk_cells, grid.ny);
    ChunkMeshes meshes(ground, {i0, j0}, {i1, j1});
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) {
        const std::uint8_t cover = parting.covers.of(i, j);
        if (cover != CellCovers::kSeveral)
          add_even_cell(meshes, ground, i, j, static_cast<Cover>(cover));
        else if (grid.cells() == 1)
          add_even_cell(meshes, ground, i, j, CoverPoint({}, cover_shares(terrain, 0.5f * grid.size)).cover);
        else
          add_parted_cell(meshes, ground, i, j);
      }
    if (options.skirt_m > 0.0f) {
      TriangleMesh& walls = meshes.mesh(Cover::soil);
      if (j0 == 0) add_wall(walls, grid, i0, 0, 1, 0, i1 - i0, bottom);
      if (i1 == grid.nx) add_wall(walls, grid, grid.nx, j0, 0, 1, j1 - j0, bottom);
      if (j1 == grid.ny) add_wall(walls, grid, i1, grid.ny, -1, 0, i1 - i0, bottom);
      if (i0 == 0) add_wall(walls, grid, 0, j1, 0, -1, j1 - j0, bottom);
    }
    for (std::size_t k = 0; k < terrain::kCoverNames.size(); ++k)
      if (TriangleMesh& mesh = meshes.mesh(static_cast<Cover>(k)); !mesh.empty())
        chunks[c].push_back({std::move(mesh), static_cast<Cover>(k), c});
  });
  std::vector<GroundPiece> pieces;
  for (std::vector<GroundPiece>& chunk : chunks) std::move(chunk.begin(), chunk.end(), std::back_inserter(pieces));
  return pieces;
}

}  // namespace bosquet::geometry
