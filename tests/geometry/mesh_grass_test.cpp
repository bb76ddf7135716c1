#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "geometry/grass_field.h"
#include "geometry/grass_tuft.h"
#include "geometry/ground_mesh.h"
#include "geometry/texture_colour.h"
#include "terrain/exclusion.h"
#include "tests/geometry/mesh_checks.h"

namespace bosquet::geometry {
namespace {

using terrain::Cover;

terrain::Terrain level_ground(Vec2 size) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(size, 0.5f)));
}

Polygon rectangle(Vec2 low, Vec2 high) { return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}}; }

std::vector<Tuft> all_grass(const terrain::Terrain& ground, const GrassOptions& options, float rank = 1.0f) {
  std::vector<Tuft> all;
  const IVec2 tiles(glm::ceil(ground.size_m() / kGrassTileM));
  for (int j = 0; j < tiles.y; ++j)
    for (int i = 0; i < tiles.x; ++i)
      for (const Tuft& tuft : grass_in(ground, options, {i, j}, rank)) all.push_back(tuft);
  return all;
}

/// What tells a tuft from others, to the bit.
using Known = std::tuple<float, float, float, float, float, int, float>;
Known known(const Tuft& t) { return {t.at.x, t.at.y, t.at.z, t.turn.x, t.height_m, t.shape, t.colour.y}; }
std::set<Known> known(const std::vector<Tuft>& tufts) {
  std::set<Known> all;
  for (const Tuft& t : tufts) all.insert(known(t));
  return all;
}

TEST(GrassTuft, IsSoundAndOnePieceFromItsFootUpward) {
  for (int shape = 0; shape < kTuftShapes; ++shape) {
    TriangleMesh mesh = grass_tuft(shape);
    mesh.colours.assign(mesh.positions.size(), Rgba8(255));
    expect_sound(mesh, 1e-6f);
    ASSERT_LE(mesh.positions.size(), kTuftVertices);
    EXPECT_EQ(mesh.indices[0], 0u);
    EXPECT_EQ(mesh.indices[1], mesh.positions.size() - 1);
    const Box3 box = mesh.bounds();
    EXPECT_GE(box.low.y, 0.0f);
    EXPECT_GT(box.high.y, 0.8f);
    EXPECT_LT(box.high.y, 1.6f);
    for (const Vec2 uv : mesh.uvs) EXPECT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
  }
}

TEST(GrassTuft, ItsBladesHaveTheGroundsToneOnAverage) {
  for (const Season season : {Season::spring, Season::summer, Season::autumn, Season::bare}) {
    const Image picture = grass_picture(season);
    for (int shape = 0; shape < kFirstSeed; ++shape) {
      const TriangleMesh mesh = grass_tuft(shape);
      Vec3 sum(0.0f);
      float area = 0;
      for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const float a = glm::length(facing(mesh, t));
        for (std::size_t c = 0; c < 3; ++c) {
          const Vec2 uv = mesh.uvs[mesh.indices[3 * t + c]];
          const std::uint8_t* p = picture.at(static_cast<int>(uv.x * static_cast<float>(picture.width)),
                                             static_cast<int>(uv.y * static_cast<float>(picture.height)));
          sum += a * linear_from_srgb(Vec3(p[0], p[1], p[2]) / 255.0f), area += a;
        }
      }
      const Vec3 mean = kTuftTone * sum / area;
      EXPECT_NEAR(luminance(mean), 1.0f, 0.12f) << shape;
      EXPECT_NEAR(mean.r / mean.g, 1.0f, 0.12f) << shape;
    }
  }
}

TEST(GrassField, GrowsOnLawnsAndMeadowsAlone) {
  terrain::Terrain ground = level_ground({32, 32});
  const std::vector<Vec2> path{{16, 0}, {16, 32}};
  ground = terrain::exclude(ground, rectangle({2, 2}, {12, 12}), {"lawn", terrain::AreaKind::lawn, Cover::grass});
  ground = terrain::exclude_path(ground, path, 3.0f, {"path", terrain::AreaKind::path, Cover::gravel});
  ground = terrain::exclude(ground, rectangle({20, 2}, {30, 12}), {"bed", terrain::AreaKind::bed, Cover::soil});
  std::size_t lawn = 0, meadow = 0;
  for (const Tuft& tuft : all_grass(ground, {})) {
    const Vec2 at = to_plan(tuft.at);
    EXPECT_GT(std::abs(at.x - 16.0f), 1.4f);
    EXPECT_FALSE(at.x > 20.2f && at.x < 29.8f && at.y > 2.2f && at.y < 11.8f);
    if (at.x > 2.3f && at.x < 11.7f && at.y > 2.3f && at.y < 11.7f) {
      EXPECT_TRUE(tuft.lawn);
    }
    if (at.y > 13.0f) {
      EXPECT_FALSE(tuft.lawn);
    }
    ++(tuft.lawn ? lawn : meadow);
    EXPECT_LT(tuft.lawn ? tuft.height_m : 0.0f, 0.08f);
  }
  // Short and dense, tall and sparse.
  EXPECT_NEAR(static_cast<double>(lawn) / 100.0, 220.0, 12.0);
  EXPECT_GT(meadow, 10'000u);
  EXPECT_LT(static_cast<double>(meadow) / (32.0 * 32.0 - 296.0), 90.0);
}

TEST(GrassField, NoneGrowsUnderWaterOnCliffsOrWhereSomethingStands) {
  const auto lattice = terrain::make_lattice({24, 24}, 0.5f);
  // A slope of 60 degrees from 8 m east on, water in the south.
  terrain::Terrain ground = terrain::make_terrain(terrain::Heightfield(*lattice, [](Vec2 p) {
    return 0.2f * p.y - 1.0f + (p.x > 8.0f ? 1.73f * (std::min(p.x, 12.0f) - 8.0f) : 0.0f);
  }));
  ground.water_level_m = 0.0f;
  GrassOptions options;
  options.taken = [](Vec2 p) { return glm::length(p - Vec2(4, 16)) < 2.0f; };
  std::size_t found = 0;
  for (const Tuft& tuft : all_grass(ground, options)) {
    const Vec2 at = to_plan(tuft.at);
    ++found;
    EXPECT_GT(ground.ground(at), 0.1f);
    EXPECT_FALSE(at.x > 8.6f && at.x < 11.4f);
    EXPECT_GE(glm::length(at - Vec2(4, 16)), 2.0f);
  }
  EXPECT_GT(found, 1000u);
}

TEST(GrassField, ShadeThinsItAndClosedCrownsLeaveNone) {
  const terrain::Terrain ground = level_ground({16, 16});
  const auto count = [&](float shade) {
    GrassOptions options;
    options.shade = [shade](Vec2) { return shade; };
    return all_grass(ground, options).size();
  };
  EXPECT_EQ(count(0.0f), all_grass(ground, {}).size());
  EXPECT_LT(count(0.8f), count(0.0f) / 2);
  EXPECT_LT(count(0.95f), count(0.0f) / 8);
  EXPECT_EQ(count(1.0f), 0u);
}

TEST(GrassField, PaintingOneCornerMovesNoTuftElsewhere) {
  const terrain::Terrain before = level_ground({32, 32});
  const terrain::Terrain after =
      terrain::exclude(before, rectangle({0, 0}, {7, 7}), {"lawn", terrain::AreaKind::lawn, Cover::grass});
  const auto beyond = [](const std::vector<Tuft>& all) {
    std::vector<Tuft> some;
    for (const Tuft& tuft : all)
      if (const Vec2 at = to_plan(tuft.at); at.x > 8 || at.y > 8) some.push_back(tuft);
    return known(some);
  };
  EXPECT_EQ(beyond(all_grass(before, {})), beyond(all_grass(after, {})));
}

TEST(GrassField, ADenserFieldHoldsTheSparserOneAndLowRanksAreTheSameTufts) {
  const terrain::Terrain ground = level_ground({16, 16});
  const std::vector<Tuft> usual = all_grass(ground, {});
  GrassOptions dense;
  dense.density = 2.0f;
  const std::set<Known> more = known(all_grass(ground, dense));
  EXPECT_NEAR(static_cast<double>(more.size()), 2.0 * static_cast<double>(usual.size()),
              0.06 * static_cast<double>(more.size()));
  std::set<Known> low;
  for (const Tuft& tuft : usual) {
    EXPECT_TRUE(more.count(known(tuft)));
    if (tuft.rank < 0.2f) low.insert(known(tuft));
  }
  EXPECT_EQ(known(all_grass(ground, {}, 0.2f)), low);
  GrassOptions none;
  none.density = 0.0f;
  EXPECT_TRUE(all_grass(ground, none).empty());
}

TEST(GrassField, TuftsStandOnTheTrianglesOfTheGround) {
  const auto lattice = terrain::make_lattice({32, 32}, 0.5f);
  const terrain::Terrain ground = terrain::make_terrain(
      terrain::Heightfield(*lattice, [](Vec2 p) { return 0.5f * std::sin(0.9f * p.x) * std::cos(0.7f * p.y); }));
  constexpr std::size_t kTriangles = 600;  // far coarser than the heights
  const GroundGrid grid = make_ground_grid(ground, kTriangles);
  GrassOptions options;
  options.grid = &grid;
  GroundOptions of_ground;
  of_ground.max_triangles = kTriangles;
  const std::vector<GroundPiece> pieces = mesh_ground(ground, of_ground);
  std::size_t checked = 0;
  const std::vector<Tuft> tufts = all_grass(ground, options, 0.02f);
  for (const Tuft& tuft : tufts)
    for (const GroundPiece& piece : pieces)
      for (std::size_t t = 0; t < piece.mesh.triangles(); ++t) {
        const std::uint32_t* i = &piece.mesh.indices[3 * t];
        const Vec3 &a = piece.mesh.positions[i[0]], &b = piece.mesh.positions[i[1]], &c = piece.mesh.positions[i[2]];
        const Vec3 n = glm::cross(b - a, c - a), p = tuft.at;
        const auto left = [&](const Vec3& u, const Vec3& v) { return glm::cross(v - u, p - u).y >= 0.0f; };
        if (!left(a, b) || !left(b, c) || !left(c, a)) continue;
        const float surface = a.y - (n.x * (p.x - a.x) + n.z * (p.z - a.z)) / n.y;
        EXPECT_LT(p.y, surface);
        EXPECT_NEAR(p.y, surface, 0.05f * tuft.height_m + 1e-4f);
        ++checked;
      }
  EXPECT_GE(checked, tufts.size());
  EXPECT_GT(tufts.size(), 100u);
}

TEST(GrassField, SeasonsTellThemselvesByHeightHeadsAndFlowers) {
  const terrain::Terrain ground = level_ground({32, 32});
  struct Told {
    double height = 0, flowers = 0, heads = 0;
  };
  const auto in = [&](Season season) {
    GrassOptions options;
    options.season = season;
    const std::vector<Tuft> tufts = all_grass(ground, options);
    Told told;
    for (const Tuft& tuft : tufts) {
      told.height += static_cast<double>(tuft.height_m);
      told.flowers += tuft.shape >= kFirstFlower;
      told.heads += tuft.shape >= kFirstSeed && tuft.shape < kFirstFlower;
    }
    told.height /= static_cast<double>(tufts.size());
    return told;
  };
  const Told summer = in(Season::summer), autumn = in(Season::autumn), winter = in(Season::bare);
  EXPECT_GT(summer.flowers, 100);
  EXPECT_EQ(autumn.flowers, 0);
  EXPECT_EQ(winter.flowers, 0);
  EXPECT_GT(autumn.heads, summer.heads);
  EXPECT_LT(winter.height, 0.5 * summer.height);
}

}  // namespace
}  // namespace bosquet::geometry
