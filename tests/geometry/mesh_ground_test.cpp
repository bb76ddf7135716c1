#include <gtest/gtest.h>

#include <map>

#include "geometry/ground_mesh.h"
#include "geometry/ground_texture.h"
#include "geometry/water_mesh.h"
#include "terrain/exclusion.h"
#include "tests/geometry/mesh_checks.h"

namespace bosquet::geometry {
namespace {

terrain::Terrain site(Vec2 size, const std::function<float(Vec2)>& height) {
  terrain::Terrain t;
  const auto lattice = terrain::make_lattice(size, 1.0f);
  t.height = terrain::Heightfield(*lattice, height);
  t.exclusion = terrain::Mask(*lattice);
  return t;
}

constexpr std::size_t kGroundTriangles = 200'000;

std::vector<TriangleMesh> meshes(const terrain::Terrain& t, const GroundOptions& options) {
  std::vector<TriangleMesh> list;
  for (GroundPiece& piece : mesh_ground(t, options)) list.push_back(std::move(piece.mesh));
  return list;
}

GroundOptions chunks_of(int cells) {
  GroundOptions options;
  options.chunk_cells = cells;
  return options;
}

GroundOptions within(std::size_t triangles) {
  GroundOptions options;
  options.max_triangles = triangles;
  return options;
}

const auto kHills = [](Vec2 p) { return 2.0f * std::sin(0.2f * p.x) * std::cos(0.15f * p.y) + 0.02f * p.x; };

TEST(GroundMesh, IsSoundAndFacesUp) {
  for (const TriangleMesh& chunk : meshes(site({50, 37}, kHills), chunks_of(16))) {
    expect_sound(chunk, 1e-4f);
    for (std::size_t t = 0; t < chunk.triangles(); ++t) EXPECT_GT(facing(chunk, t).y, 0.0f);
    EXPECT_EQ(share_facing_their_normals(chunk), 1.0);
  }
}

TEST(GroundMesh, CoversTheSiteWithTheGroundsHeights) {
  const terrain::Terrain t = site({50, 37}, kHills);
  Box3 box;
  double plan_area = 0;
  for (const TriangleMesh& chunk : meshes(t, chunks_of(16))) {
    box.add(chunk.bounds());
    for (std::size_t k = 0; k < chunk.triangles(); ++k) plan_area += 0.5 * static_cast<double>(facing(chunk, k).y);
    for (const Vec3& p : chunk.positions) EXPECT_NEAR(p.y, t.ground(to_plan(p)), 1e-5f);
  }
  EXPECT_NEAR(plan_area, 50.0 * 37.0, 0.1);
  EXPECT_FLOAT_EQ(box.low.x, 0.0f);
  EXPECT_FLOAT_EQ(box.high.x, 50.0f);
  EXPECT_FLOAT_EQ(box.low.z, -37.0f) << "north is -z";
  EXPECT_FLOAT_EQ(box.high.z, 0.0f);
}

TEST(GroundMesh, KeepsToItsBudget) {
  const terrain::Terrain t = site({120, 60}, kHills);
  for (const std::size_t budget : {2u, 100u, 5000u, 100000u}) {
    std::size_t triangles = 0;
    for (const TriangleMesh& chunk : meshes(t, within(budget))) triangles += chunk.triangles();
    EXPECT_LE(triangles, budget);
    EXPECT_GE(triangles, std::min<std::size_t>(budget / 5, 14400)) << "a regular step wastes little";
  }
}

/// Edges that one triangle alone has. Every other has the same two end points in both, whatever piece they are in.
int open_edges(const std::vector<TriangleMesh>& pieces) {
  std::map<std::array<float, 6>, int> edges;
  for (const TriangleMesh& chunk : pieces)
    for (std::size_t t = 0; t < chunk.triangles(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        Vec3 a = chunk.positions[chunk.indices[3 * t + k]], b = chunk.positions[chunk.indices[3 * t + (k + 1) % 3]];
        if (std::tie(b.x, b.z) < std::tie(a.x, a.z)) std::swap(a, b);
        ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
      }
  int open = 0;
  for (const auto& [edge, times] : edges) open += times == 1;
  return open;
}

TEST(GroundMesh, ChunksMeetWithoutAGap) {
  EXPECT_EQ(open_edges(meshes(site({40, 40}, kHills), chunks_of(8))), 4 * 40) << "only the site's edge is open";
}

/// A path and a lawn beside it, both aslant.
terrain::Terrain with_path_and_lawn(const terrain::Terrain& t) {
  const terrain::Area path{"path", terrain::AreaKind::path, terrain::Cover::gravel};
  const terrain::Area lawn{"lawn", terrain::AreaKind::lawn, terrain::Cover::grass};
  Polygon grass;
  grass.ring = {{10, 20}, {30, 26}, {26, 37}, {8, 31}};
  const std::vector<Vec2> middle{{5, 8}, {34, 17}};
  return terrain::exclude_path(terrain::exclude(t, grass, lawn), middle, 3.0f, path);
}

double area_of(const std::vector<GroundPiece>& pieces, terrain::Cover cover) {
  double sum = 0;
  for (const GroundPiece& piece : pieces)
    if (piece.cover == cover)
      for (std::size_t k = 0; k < piece.mesh.triangles(); ++k)
        sum += 0.5 * static_cast<double>(facing(piece.mesh, k).y);
  return sum;
}

TEST(GroundMesh, LinesBetweenCoversFollowTheDrawnEdges) {
  terrain::Terrain t = with_path_and_lawn(site({40, 40}, kHills));
  const double length = std::hypot(29.0, 9.0), path = 3.0 * length + 1.5 * 1.5 * 3.1416;  // its ends are round
  struct Case {
    std::size_t budget;
    float off_m;
    int rim;
  };
  // The terrain's cells of 1 m; cells of 2 m, parted along the lines; cells of 2 m and no room to part them.
  for (const auto& [budget, off_m, rim] : {Case{200'000, 0.08f, 160}, {3'000, 0.08f, 80}, {1'500, 0.5f, 80}}) {
    GroundOptions options = within(budget);
    options.chunk_cells = 8;
    const std::vector<GroundPiece> pieces = mesh_ground(t, options);
    EXPECT_NEAR(area_of(pieces, terrain::Cover::gravel), path, (off_m > 0.2f ? 0.06 : 0.03) * path) << budget;
    double all = 0;
    for (const std::size_t c : {0, 1, 2, 3, 4}) all += area_of(pieces, static_cast<terrain::Cover>(c));
    EXPECT_NEAR(all, 1600.0, 0.1);
    std::size_t triangles = 0;
    for (const GroundPiece& piece : pieces) {
      expect_sound(piece.mesh, 1e-5f);
      triangles += piece.mesh.triangles();
      if (piece.cover != terrain::Cover::gravel) continue;
      for (const Vec3& p : piece.mesh.positions) {
        const Vec2 from = to_plan(p) - Vec2(5, 8), along = Vec2(29, 9) / static_cast<float>(length);
        const float beside = std::abs(from.x * along.y - from.y * along.x);
        EXPECT_LT(beside, 1.5f + off_m) << "within " << budget;
      }
    }
    EXPECT_LE(triangles, budget);
    EXPECT_EQ(open_edges(meshes(t, options)), rim) << "only the site's edge is open";
  }
}

TEST(GroundMesh, TexturesAtTrueScale) {
  const TriangleMesh mesh = mesh_ground(site({20, 20}, kHills), {})[0].mesh;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(mesh.uvs[v].x, mesh.positions[v].x / kGroundTileM, 1e-4f);
    EXPECT_NEAR(mesh.uvs[v].y, mesh.positions[v].z / kGroundTileM, 1e-4f);
  }
}

TEST(GroundMesh, PathsAreLighterThanMeadow) {
  terrain::Terrain t = site({20, 20}, [](Vec2) { return 1.0f; });
  const TriangleMesh meadow = mesh_ground(t, {})[0].mesh;
  t.exclusion = terrain::Mask(t.height.lattice(), 1.0f);
  const TriangleMesh path = mesh_ground(t, {})[0].mesh;
  EXPECT_GT(path.colours[50].r, meadow.colours[50].r + 60);
}

TEST(GroundMesh, TheSkirtClosesTheSidesFacingOutward) {
  const terrain::Terrain t = site({30, 20}, kHills);
  GroundOptions with_skirt = chunks_of(10);
  with_skirt.skirt_m = 2.0f;
  double flux = 0;  // of the normals' sideways part: zero for walls all around; downward part missing (no floor)
  double outward = 0;
  for (const TriangleMesh& chunk : meshes(t, with_skirt)) {
    expect_sound(chunk, 1e-5f);
    EXPECT_EQ(share_facing_their_normals(chunk), 1.0);
    for (std::size_t k = 0; k < chunk.triangles(); ++k) {
      const Vec3 f = facing(chunk, k);
      if (f.y > 1e-3f) continue;
      const Vec3 from_middle = chunk.positions[chunk.indices[3 * k]] - Vec3{15, 0, -10};
      flux += static_cast<double>(f.x + f.z);
      outward += glm::dot(f, from_middle) > 0.0f ? 1 : -1000;
    }
  }
  EXPECT_NEAR(flux, 0.0, 25.0) << "opposite walls nearly balance: their heights differ by the hills only";
  EXPECT_GT(outward, 0.0);
}

TEST(WaterMesh, CoversJustThePartOfARampBelowTheLevel) {
  terrain::Terrain t = site({40, 20}, [](Vec2 p) { return 0.1f * p.x; });
  EXPECT_TRUE(mesh_water(t, kGroundTriangles).empty()) << "no level, no water";
  for (const float level : {0.05f, 1.234f, 2.0f, 3.99f}) {
    t.water_level_m = level;
    const TriangleMesh water = mesh_water(t, kGroundTriangles);
    expect_sound(water, 1e-7f);
    EXPECT_NEAR(area(water), 20.0 * 10.0 * static_cast<double>(level), 0.5);
    for (const Vec3& p : water.positions) {
      EXPECT_EQ(p.y, level);
      EXPECT_LE(t.ground(to_plan(p)), level + 0.002f);
    }
    for (std::size_t k = 0; k < water.triangles(); ++k) EXPECT_GT(facing(water, k).y, 0.0f);
  }
}

TEST(WaterMesh, LiesOnlyWhereTheGroundIsBelow) {
  terrain::Terrain t = site({60, 60}, kHills);
  t.water_level_m = 0.3f;
  const TriangleMesh water = mesh_water(t, kGroundTriangles);
  expect_sound(water, 1e-9f);
  ASSERT_FALSE(water.empty());
  for (std::size_t k = 0; k < water.triangles(); ++k) {
    const std::uint32_t* i = water.indices.data() + 3 * k;
    const Vec3 middle = (water.positions[i[0]] + water.positions[i[1]] + water.positions[i[2]]) / 3.0f;
    EXPECT_LT(t.ground(to_plan(middle)), 0.3f + 0.03f) << "bilinear ground between samples may rise a little more";
  }
  t.water_level_m = -100.0f;
  EXPECT_TRUE(mesh_water(t, kGroundTriangles).empty());
}

}  // namespace
}  // namespace bosquet::geometry
