// What must hold for the meshes of every built-in species as it really grows.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <unordered_map>

#include "geometry/branch_mesh.h"
#include "geometry/foliage_mass.h"
#include "geometry/leaf_atlas.h"
#include "geometry/tree_mesh.h"
#include "growth/grow.h"
#include "scene/species.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"
#include "tests/geometry/texture_checks.h"

namespace bosquet::geometry {
namespace {

struct Grown {
  scene::Species species;
  growth::Skeleton skeleton;
  ThickestPaths paths;
  BranchCurves curves;
  FoliageInput input;

  Grown(const std::string& name, std::uint64_t seed) {
    species = *scene::builtin_species(name);
    growth::GrowthInput in;
    in.parameters = &species.growth;
    in.max_height_m = species.shape.mature_height_m;
    in.detail = 0.5f;
    in.seed = seed, in.key = 1;
    skeleton = growth::grow(in, nullptr);
    paths = thickest_paths(skeleton, skeleton.radius, standing(skeleton, -1));
    curves = branch_curves(skeleton, skeleton.radius, paths);
    input = {&skeleton, &paths, skeleton.radius, -1, &species.look, &species.foliage, Season::summer, seed, 1};
  }
  Grown(const Grown&) = delete;
};

class SpeciesMesh : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SpeciesMesh, testing::ValuesIn(scene::builtin_species_names()),
                         [](const auto& species) { return species.param; });

/// Edges without an opposite, after vertices at one place have been made one; two triangles on one side of an edge fail.
std::vector<std::pair<std::uint32_t, std::uint32_t>> open_edges(const TriangleMesh& mesh) {
  struct Bits {
    std::uint32_t x, y, z;
    bool operator==(const Bits&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Bits& b) const { return mix_bits(b.x + mix_bits(b.y + mix_bits(b.z))); }
  };
  std::unordered_map<Bits, std::uint32_t, Hash> place;
  std::vector<std::uint32_t> weld(mesh.positions.size());
  for (std::size_t v = 0; v < weld.size(); ++v) {
    Bits bits;
    std::memcpy(&bits, &mesh.positions[v], sizeof bits);
    weld[v] = place.try_emplace(bits, static_cast<std::uint32_t>(v)).first->second;
  }
  std::vector<std::uint64_t> edges;
  for (std::size_t t = 0; t < mesh.triangles(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(static_cast<std::uint64_t>(weld[mesh.indices[3 * t + k]]) << 32 |
                      weld[mesh.indices[3 * t + (k + 1) % 3]]);
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end()) << "two triangles on one side of an edge";
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const std::uint64_t e : edges)
    if (!std::binary_search(edges.begin(), edges.end(), e << 32 | e >> 32))
      open.emplace_back(static_cast<std::uint32_t>(e >> 32), static_cast<std::uint32_t>(e));
  return open;
}

/// Closed loops among edges, each of which must have one follower.
std::size_t loops(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
  std::map<std::uint32_t, std::uint32_t> next(edges.begin(), edges.end());
  EXPECT_EQ(next.size(), edges.size()) << "open edges meet at a vertex";
  std::size_t count = 0;
  while (!next.empty()) {
    ++count;
    for (auto at = next.begin(); at != next.end();) {
      const std::uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return count;
}

TEST_P(SpeciesMesh, BranchesAreSoundAndEachPathIsOpenAtItsBaseOnly) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const Grown tree(GetParam(), seed);
    for (const float coarseness : {1.0f, 5.0f}) {
      const BranchPlan plan = plan_branches(tree.curves, coarseness);
      const TriangleMesh mesh = mesh_branches(tree.curves, plan, tree.species.look, seed, 1);
      ASSERT_GT(mesh.triangles(), 500u);
      expect_sound(mesh, 1e-9f);
      if (HasFatalFailure()) return;
      EXPECT_GT(share_facing_their_normals(mesh), 0.99);
      std::size_t paths = 0;
      for (std::size_t c = 0; c < tree.curves.curves.size(); ++c)
        paths += plan.keep[c] && tree.curves.curves[c].count > 0;
      EXPECT_EQ(loops(open_edges(mesh)), paths) << "seed " << seed;
    }
  }
}

TEST_P(SpeciesMesh, EveryBranchBeginsInsideTheOneThatBearsIt) {
  const Grown tree(GetParam(), 3);
  const auto outside = [&](const BranchCurve& curve, const Vec3& p) {
    const auto samples = tree.curves.of(curve);
    float least = 1e9f;
    for (std::size_t k = 1; k < samples.size(); ++k) {
      const Vec3 a = samples[k - 1].centre, step = samples[k].centre - a;
      const float t = std::clamp(glm::dot(p - a, step) / glm::dot(step, step), 0.0f, 1.0f);
      least = std::min(least, glm::length(p - a - t * step) - glm::mix(samples[k - 1].radius, samples[k].radius, t));
    }
    return least;
  };
  // A branch whose parent's first nodes lie in the trunk may begin there too.
  const auto outside_all = [&](const BranchCurve& child, const Vec3& p) {
    float least = 1e9f;
    for (std::int32_t c = child.parent; c >= 0; c = tree.curves.curves[static_cast<std::size_t>(c)].parent)
      least = std::min(least, outside(tree.curves.curves[static_cast<std::size_t>(c)], p));
    return least;
  };
  std::size_t rims = 0, out = 0;
  for (const BranchCurve& child : tree.curves.curves) {
    if (child.parent < 0 || child.count == 0) continue;
    const BranchSample& base = tree.curves.of(child)[0];
    ASSERT_LT(outside_all(child, base.centre), 0.0f);
    for (int k = 0; k < 6; ++k, ++rims)
      out += outside_all(child, base.centre + base.radius * across(base.tangent, 1.0472f * static_cast<float>(k))) >
             0.1f * base.radius;
  }
  ASSERT_GT(rims, 100u);
  // Where the parent is hardly thicker and bends away, a rim may show by more than a tenth of its radius.
  EXPECT_LT(static_cast<double>(out), 0.005 * static_cast<double>(rims));
}

TEST_P(SpeciesMesh, BarkOfTheTrunkIsNearLifeSizeAndOfOtherWoodNeverLarger) {
  const Grown tree(GetParam(), 1);
  const TriangleMesh mesh = mesh_branches(tree.curves, plan_branches(tree.curves, 1.0f), tree.species.look, 1, 1);
  const float tile = tree.species.look.bark.tile_m;
  // How many times larger than life a triangle's bark is, by area.
  double trunk = 0, trunk_tiles = 0;
  float largest = 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* i = mesh.indices.data() + 3 * t;
    const Vec2 a = mesh.uvs[i[1]] - mesh.uvs[i[0]], b = mesh.uvs[i[2]] - mesh.uvs[i[0]];
    const double tiles = 0.5 * std::fabs(static_cast<double>(a.x * b.y - a.y * b.x));
    const double shown = 0.5 * static_cast<double>(glm::length(facing(mesh, t)));
    const Vec3 p = mesh.positions[i[0]];
    if (p.y > 1.3f && p.y < 3.0f && p.x * p.x + p.z * p.z < 1.0f) trunk += shown, trunk_tiles += tiles;
    if (tiles * tile * tile > 1e-5)
      largest = std::max(largest, static_cast<float>(std::sqrt(shown / (tiles * tile * tile))));
  }
  ASSERT_GT(trunk_tiles, 0.0);
  // At least one whole tile around: thin stems show it smaller.
  const double scale = std::sqrt(trunk / (trunk_tiles * tile * tile));
  EXPECT_GT(scale, 0.05);
  EXPECT_LT(scale, 1.35);
  // The outer side of a bend and the collar and flare are longer than the centre line.
  EXPECT_LT(largest, 3.0f);
}

TEST_P(SpeciesMesh, FoliageIsSoundInEverySeasonAndLevel) {
  Grown tree(GetParam(), 1);
  for (const Season season : {Season::spring, Season::summer, Season::autumn, Season::bare}) {
    tree.input.season = season;
    for (const FoliageLevel level : {FoliageLevel::leaves, FoliageLevel::clusters, FoliageLevel::cards}) {
      const auto sites = leaf_sites(tree.input, level);
      const TriangleMesh mesh = mesh_foliage(tree.input, level, sites, 1200);
      expect_sound(mesh, 1e-9f);
      if (HasFatalFailure()) return;
      EXPECT_GT(share_facing_their_normals(mesh), 0.999);
    }
  }
}

/// Leaf area and mean colour that cards show: what of their cells is painted, times the cards.
struct Shown {
  double area = 0;
  DVec3 colour{0.0};
};
Shown shown(const TriangleMesh& mesh, const Image& atlas) {
  struct Cell {
    double alpha = 0;
    DVec3 colour{0.0};
  };
  std::array<Cell, 4> cells;
  const int half = atlas.width / 2;
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x) {
      const std::uint8_t* p = atlas.at(x, y);
      Cell& cell = cells[static_cast<std::size_t>(y / half * 2 + x / half)];
      cell.alpha += p[3] / 255.0, cell.colour += p[3] / 255.0 * DVec3(linear(p));
    }
  Shown sum;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* i = mesh.indices.data() + 3 * t;
    const Vec2 a = mesh.uvs[i[1]] - mesh.uvs[i[0]], b = mesh.uvs[i[2]] - mesh.uvs[i[0]];
    const double uv = 0.5 * std::fabs(static_cast<double>(a.x * b.y - a.y * b.x));
    if (uv < 1e-4) continue;  // the twig's wood
    const Vec2 middle = (mesh.uvs[i[0]] + mesh.uvs[i[1]] + mesh.uvs[i[2]]) / 3.0f;
    const Cell& cell = cells[static_cast<std::size_t>((middle.y > 0.5f ? 2 : 0) + (middle.x > 0.5f ? 1 : 0))];
    // Of a row of cards, each shows as much of what is painted as of its cell; narrow ones still show all of their leaf.
    const Vec3 d = mesh.positions[i[1]] - mesh.positions[i[0]], e = mesh.positions[i[2]] - mesh.positions[i[0]];
    const double world = 0.5 * static_cast<double>(glm::length(glm::cross(d, e)));
    const double all = cell.alpha / (static_cast<double>(half) * half);
    const double covered = middle.y > 0.5f ? all * 0.25 / (2.0 * uv) : all;
    const double w = world * std::min(1.0, covered);
    const Rgba8 c = mesh.colours[i[0]];
    sum.area += w;
    sum.colour += w * cell.colour / std::max(cell.alpha, 1e-9) * DVec3(c.r, c.g, c.b) / 255.0;
  }
  sum.colour /= std::max(sum.area, 1e-9);
  return sum;
}

TEST_P(SpeciesMesh, LeafAreaAndColourStayFromLeavesToClustersToCards) {
  const Grown tree(GetParam(), 1);
  const LeafAtlas atlas = make_leaf_atlas(tree.species.look.leaf, Season::summer, 5, 256);
  const LeafAtlas mass = make_foliage_mass(atlas, tree.species.look.leaf.cluster, 5);
  // Of the first thousand twigs.
  auto twigs = leaf_sites(tree.input, FoliageLevel::clusters);
  if (twigs.size() > 1000) twigs.resize(1000);
  auto single = leaf_sites(tree.input, FoliageLevel::leaves);
  const auto beyond = std::find_if(single.begin(), single.end(), [&, past = false](const LeafSite& site) mutable {
    const bool of_last = site.internode == twigs.back().internode && site.place == twigs.back().place;
    past = past || of_last;
    return past && !of_last;
  });
  single.erase(beyond, single.end());
  const auto at = [&](FoliageLevel level, std::size_t in_one) {
    const auto& sites = level == FoliageLevel::leaves ? single : twigs;
    return shown(mesh_foliage(tree.input, level, sites, sites.size() / in_one),
                 level == FoliageLevel::cards ? mass.base_colour : atlas.base_colour);
  };
  const Shown leaves = at(FoliageLevel::leaves, 1), clusters = at(FoliageLevel::clusters, 1),
              cards = at(FoliageLevel::cards, 6);
  // Cells of 128 pixels blur the finest needles, and the twig's own wood is part of a cluster's picture.
  const bool needles = is_needle(tree.species.look.leaf.outline);
  EXPECT_NEAR(leaves.area / clusters.area, 1.0, needles ? 0.6 : 0.35);
  EXPECT_NEAR(cards.area / clusters.area, 1.0, needles ? 0.45 : 0.25);
  for (const Shown* level : {&leaves, &cards}) EXPECT_NEAR(level->colour.g / clusters.colour.g, 1.0, 0.3);
}

}  // namespace
}  // namespace bosquet::geometry
