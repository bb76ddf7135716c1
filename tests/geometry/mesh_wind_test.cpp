#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geometry/branch_mesh.h"
#include "geometry/lod_shell.h"
#include "geometry/tree_levels.h"
#include "geometry/wind.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

ThickestPaths paths_of(const growth::Skeleton& s) { return thickest_paths(s, s.radius, standing(s, -1)); }

/// A straight stem of so many internodes.
growth::Skeleton stem(int internodes, float internode_m, float radius_m) {
  growth::Skeleton s = test_skeleton({.seasons = internodes, .shoot = 1, .wobble = 0.0f, .branching = 0.0f}, 1);
  for (std::size_t i = 0; i < s.size(); ++i)
    s.distal[i] = {0, internode_m * static_cast<float>(i + 1), 0}, s.radius[i] = radius_m;
  return s;
}

/// The path that each path's limb begins with, -1 for stems.
std::vector<std::int32_t> limbs(const ThickestPaths& paths) {
  std::vector<std::int32_t> limb(paths.paths.size(), -1);
  for (std::size_t p = 0; p < limb.size(); ++p)
    if (const std::int32_t parent = paths.paths[p].parent; parent >= 0)
      limb[p] = limb[static_cast<std::size_t>(parent)] >= 0 ? limb[static_cast<std::size_t>(parent)]
                                                            : static_cast<std::int32_t>(p);
  return limb;
}

TEST(TreeWind, AStemOfOneWidthBendsLikeARodStrainedEverywhereAlike) {
  for (const float radius : {0.01f, 0.2f}) {
    const growth::Skeleton s = stem(40, 0.25f, radius);
    const TreeWind wind = tree_wind(s, s.radius, paths_of(s), 1);
    // A circle of radius r / e: after L metres it is L^2 e / 2r aside.
    EXPECT_NEAR(wind.longest_m, 10.0f * 10.0f * kWindStrain / (2.0f * radius), 1e-4f * wind.longest_m);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const float share = static_cast<float>(i + 1) / 40.0f;
      EXPECT_NEAR(wind.ways[i].of_tree, share * share, 1e-4f);
      EXPECT_EQ(wind.ways[i].of_limb, 0.0f);
    }
    EXPECT_EQ(wind.top, 1.0f);
  }
}

TEST(TreeWind, WoodOfTwiceTheRadiusGivesWayHalfAsFar) {
  growth::Skeleton s = test_skeleton({.internode_m = 0.4f, .tip_diameter_m = 0.02f}, 3);
  const ThickestPaths paths = paths_of(s);
  const TreeWind thin = tree_wind(s, s.radius, paths, 1);
  for (float& r : s.radius) r *= 2.0f;
  const TreeWind thick = tree_wind(s, s.radius, paths, 1);
  EXPECT_NEAR(thick.longest_m, 0.5f * thin.longest_m, 1e-5f * thin.longest_m);
  for (std::size_t i = 0; i < s.size(); ++i) EXPECT_NEAR(thick.ways[i].of_tree, thin.ways[i].of_tree, 1e-5f);
}

TEST(TreeWind, RisesFromTheRootOutwardAndFromEachLimbsFoot) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const ThickestPaths paths = paths_of(s);
    const std::vector<std::int32_t> limb = limbs(paths);
    const TreeWind wind = tree_wind(s, s.radius, paths, 1);
    float most = 0.0f;
    for (std::size_t p = 0; p < paths.paths.size(); ++p)
      for (const std::uint32_t i : paths.of(paths.paths[p])) {
        const std::int32_t below = s.parent[i];
        const TreeWind::Way low = below < 0 ? TreeWind::Way{} : wind.ways[static_cast<std::size_t>(below)];
        EXPECT_GT(wind.ways[i].of_tree, low.of_tree);
        if (limb[p] < 0) {
          EXPECT_EQ(wind.ways[i].of_limb, 0.0f);
        } else {
          EXPECT_GT(wind.ways[i].of_limb, low.of_limb);
        }
        EXPECT_LE(wind.ways[i].of_limb, wind.ways[i].of_tree);
        most = std::max(most, wind.ways[i].of_tree);
      }
    EXPECT_EQ(most, 1.0f);
  }
}

TEST(TreeWind, ALimbHasOnePhaseAndLimbsAndTreesHaveOthers) {
  const growth::Skeleton s = test_skeleton({.seasons = 14}, 2);
  const ThickestPaths paths = paths_of(s);
  const std::vector<std::int32_t> limb = limbs(paths);
  const TreeWind wind = tree_wind(s, s.radius, paths, 1), other = tree_wind(s, s.radius, paths, 2);
  std::set<std::uint8_t> phases;
  std::size_t count = 0, differing = 0;
  for (std::size_t p = 0; p < paths.paths.size(); ++p) {
    const auto foot = paths.paths[static_cast<std::size_t>(std::max(limb[p], 0))].first;
    const std::uint8_t phase = wind.ways[paths.internodes[foot]].phase;
    for (const std::uint32_t i : paths.of(paths.paths[p])) EXPECT_EQ(wind.ways[i].phase, phase);
    if (limb[p] != static_cast<std::int32_t>(p)) continue;
    phases.insert(phase);
    ++count;
    differing += phase != other.ways[paths.internodes[foot]].phase;
  }
  ASSERT_GE(count, 15u);
  EXPECT_GE(phases.size() * 10, count * 8);  // of 256 values few coincide
  EXPECT_GE(differing * 10, count * 9);
}

TEST(TreeWind, ALimbKeepsItsPhaseWhenAnotherFalls) {
  growth::Skeleton s = test_skeleton({}, 2);
  const ThickestPaths before = paths_of(s);
  const TreeWind all = tree_wind(s, s.radius, before, 1);
  // The first limb falls.
  const std::vector<std::int32_t> limb = limbs(before);
  const auto first =
      static_cast<std::size_t>(std::find_if(limb.begin(), limb.end(), [](int l) { return l >= 0; }) - limb.begin());
  const std::uint32_t foot = before.internodes[before.paths[first].first];
  for (std::size_t i = foot; i < s.size(); ++i)
    if (i == foot || (s.parent[i] >= 0 && s.shed[static_cast<std::size_t>(s.parent[i])] == 0)) s.shed[i] = 0;
  const ThickestPaths after = paths_of(s);
  ASSERT_LT(after.internodes.size(), before.internodes.size());
  const TreeWind rest = tree_wind(s, s.radius, after, 1);
  for (const std::uint32_t i : after.internodes) EXPECT_EQ(rest.ways[i].phase, all.ways[i].phase);
}

TEST(CurveWind, StandsStillUnderTheGroundAndNeverFallsAlongAPath) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const ThickestPaths paths = paths_of(s);
    const BranchCurves curves = branch_curves(s, s.radius, paths);
    const std::vector<Rgba8> wind = curve_wind(tree_wind(s, s.radius, paths, 1), s, paths, curves);
    ASSERT_EQ(wind.size(), curves.samples.size());
    for (const BranchCurve& curve : curves.curves)
      for (std::uint32_t k = curve.first; k < curve.first + curve.count; ++k) {
        EXPECT_EQ(wind[k].z, 0);
        if (curve.parent < 0 && curves.samples[k].along <= 0.0f) {
          EXPECT_EQ(wind[k].x, 0);
        }
        if (k == curve.first) continue;
        EXPECT_GE(wind[k].x, wind[k - 1].x);
        EXPECT_GE(wind[k].y, wind[k - 1].y);
        EXPECT_EQ(wind[k].w, wind[k - 1].w);
      }
  }
}

TEST(CurveWind, ABranchMovesWithWhatBearsIt) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const ThickestPaths paths = paths_of(s);
    const BranchCurves curves = branch_curves(s, s.radius, paths);
    const TreeWind of_tree = tree_wind(s, s.radius, paths, 1);
    const std::vector<Rgba8> wind = curve_wind(of_tree, s, paths, curves);
    for (std::size_t p = 0; p < paths.paths.size(); ++p) {
      const BranchCurve& curve = curves.curves[p];
      if (curve.parent < 0 || curve.count == 0) continue;
      const std::uint32_t node = paths.internodes[paths.paths[p].node];
      const Rgba8 parent = of_tree.on(s, node, 1.0f), foot = wind[curve.first];
      EXPECT_EQ(foot.x, parent.x);
      EXPECT_EQ(foot.y, parent.y);
      if (curves.curves[static_cast<std::size_t>(curve.parent)].parent >= 0) {
        EXPECT_EQ(foot.w, parent.w);
      }
      // The last sample has the weights of the tip.
      const Rgba8 tip = of_tree.on(s, paths.of(paths.paths[p]).back(), 1.0f);
      EXPECT_EQ(wind[curve.first + curve.count - 1], tip);
    }
  }
}

TEST(WindMesh, AskingForWeightsChangesNothingElse) {
  for (const growth::Skeleton& s : test_skeletons())
    for (const FoliageLevel level : kLevels)
      for (const std::size_t budget : {0u, 3000u}) {
        MeshOptions options{.foliage = level, .max_triangles = budget, .key = 5};
        const TreeMesh plain = build_tree_mesh(s, s.radius, {}, {}, options);
        options.wind = true;
        const TreeMesh windy = build_tree_mesh(s, s.radius, {}, {}, options);
        const auto same = [](const TriangleMesh& a, const TriangleMesh& b) {
          EXPECT_EQ(a.positions, b.positions);
          EXPECT_EQ(a.normals, b.normals);
          EXPECT_EQ(a.uvs, b.uvs);
          EXPECT_EQ(a.colours, b.colours);
          EXPECT_EQ(a.indices, b.indices);
          EXPECT_TRUE(a.wind.empty());
          EXPECT_EQ(b.wind.size(), b.positions.size());
        };
        same(plain.branches, windy.branches);
        same(plain.leaves, windy.leaves);
        EXPECT_EQ(plain.wind_m, 0.0f);
        EXPECT_GT(windy.wind_m, 0.0f);
      }
}

TEST(WindMesh, WoodHasTheWeightsOfItsPlace) {
  const growth::Skeleton s = stem(40, 0.25f, 0.1f);
  const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, {.wind = true});
  for (std::size_t v = 0; v < tree.branches.positions.size(); ++v) {
    const float share = std::clamp(tree.branches.positions[v].y / 10.0f, 0.0f, 1.0f);
    // Between two nodes evenly: at most an eighth of the square of a fortieth less.
    EXPECT_NEAR(static_cast<float>(tree.branches.wind[v].x) / 255.0f, share * share, 0.003f) << share;
    EXPECT_EQ(tree.branches.wind[v].y, 0);
    EXPECT_EQ(tree.branches.wind[v].z, 0);
  }
}

TEST(WindMesh, LeavesMoveWithTheirWoodAndFlutterAtTheirFarEnds) {
  const growth::Skeleton s = test_skeleton({.seasons = 8}, 2);
  const ThickestPaths paths = paths_of(s);
  const TreeWind wind = tree_wind(s, s.radius, paths, 9);
  const Look look;
  const FoliageLook foliage;
  FoliageInput in{&s, &paths, s.radius, -1, &look, &foliage, Season::summer, 1, 9, &wind};
  for (const FoliageLevel level : kLevels) {
    const std::vector<LeafSite> sites = leaf_sites(in, level);
    const TriangleMesh mesh = mesh_foliage(in, level, sites, sites.size());
    ASSERT_EQ(mesh.wind.size(), mesh.positions.size());
    const std::size_t vertices = mesh.positions.size() / sites.size();
    ASSERT_EQ(vertices * sites.size(), mesh.positions.size());
    std::size_t flutter = 0;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const Rgba8 wood = wind.on(s, sites[k].internode, sites[k].at);
      for (std::size_t v = 0; v < vertices; ++v) {
        const Rgba8 w = mesh.wind[k * vertices + v];
        const bool far = v >= vertices / 2, still = sites[k].leaf == LeafSite::kTwigWood;
        EXPECT_EQ(w, Rgba8(wood.x, wood.y, far && !still ? 255 : 0, wood.w));
        flutter += w.z > 0;
      }
    }
    EXPECT_GT(flutter, 0u);
  }
}

double mean_way(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Rgba8& w : mesh.wind) sum += w.x;
  return sum / 255.0 / static_cast<double>(mesh.wind.size());
}

TEST(WindMesh, CoarserLevelsLeanAsFarAsTheTree) {
  const growth::Skeleton s = test_skeleton({.seasons = 14}, 1);
  const MeshOptions options{.key = 3, .wind = true};
  const TreeMesh whole = build_tree_mesh(s, s.radius, {}, {}, options);
  for (const std::size_t budget : {20000u, 5000u, 1000u}) {
    MeshOptions fewer = options;
    fewer.max_triangles = budget;
    const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, fewer);
    EXPECT_EQ(tree.wind_m, whole.wind_m);
    EXPECT_NEAR(mean_way(tree.leaves), mean_way(whole.leaves), 0.05) << budget;
  }
  const Look look;
  const FoliageLook foliage;
  TreeInput in{&s, s.radius, &look, &foliage, options};
  in.options.max_triangles = 120;
  const TreeMesh shell = build_shell(in, source_mesh(in), {});
  ASSERT_EQ(shell.leaves.wind.size(), shell.leaves.positions.size());
  ASSERT_EQ(shell.branches.wind.size(), shell.branches.positions.size());
  EXPECT_EQ(shell.wind_m, whole.wind_m);
  EXPECT_NEAR(mean_way(shell.leaves), mean_way(whole.leaves), 0.15);

  // On cards the foot stands still and the top goes as far as the tree's.
  Image page(64, 64, 4);
  const ImpostorFrame frame = build_picture(source_mesh(in), {}, {&page, {0, 0, 64}});
  TriangleMesh cards = impostor_cards(frame, {0, 0, 64}, 64, 64, kFourCardTriangles);
  const TreeWind wind = tree_wind(in);
  lean_with_height(cards, wind);
  ASSERT_EQ(cards.wind.size(), cards.positions.size());
  const Box3 box = cards.bounds();
  for (std::size_t v = 0; v < cards.wind.size(); ++v) {
    if (cards.positions[v].y <= 0.0f) {
      EXPECT_EQ(cards.wind[v].x, 0);
    }
    if (cards.positions[v].y == box.high.y) {
      EXPECT_NEAR(static_cast<float>(cards.wind[v].x) / 255.0f, wind.top, 0.002f);
    }
    EXPECT_EQ(cards.wind[v].y, 0);
    EXPECT_EQ(cards.wind[v].z, 0);
  }
}

}  // namespace
}  // namespace bosquet::geometry
