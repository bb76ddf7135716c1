#include <gtest/gtest.h>

#include "geometry/tree_mesh.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

std::size_t stems(const growth::Skeleton& s) {
  return static_cast<std::size_t>(std::count(s.parent.begin(), s.parent.end(), -1));
}

TEST(TreeMesh, TheTriangleBudgetIsHeld) {
  for (const growth::Skeleton& s : test_skeletons())
    for (const FoliageLevel level : kLevels)
      for (const std::size_t budget : {40u, 300u, 1000u, 6000u, 30000u, 100000u}) {
        const std::size_t least = kLeastTreeTriangles * stems(s);
        if (budget < least) continue;
        const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, {.foliage = level, .max_triangles = budget});
        EXPECT_LE(tree.triangles(), budget);
        EXPECT_FALSE(tree.branches.empty());
        EXPECT_FALSE(tree.leaves.empty());
      }
}

TEST(TreeMesh, ABudgetIsUsed) {
  const growth::Skeleton s = test_skeleton({.seasons = 14}, 1);
  for (const std::size_t budget : {300u, 1000u, 6000u, 30000u}) {
    const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, {.max_triangles = budget});
    EXPECT_GT(tree.triangles() * 10, budget * 9);
  }
}

TEST(TreeMesh, LeafAreaIsKeptUnderABudget) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const growth::Skeleton s = test_skeleton({.seasons = 14}, seed);
    const double all = area(build_tree_mesh(s, s.radius, {}, {}, {}).leaves);
    for (const std::size_t budget : {400u, 2000u, 10000u}) {
      const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, {.max_triangles = budget});
      EXPECT_NEAR(area(tree.leaves) / all, 1.0, 0.1) << budget;
    }
  }
}

TEST(TreeMesh, IsSoundUnderEveryBudget) {
  for (const growth::Skeleton& s : test_skeletons())
    for (const std::size_t budget : {300u, 5000u}) {
      const TreeMesh tree = build_tree_mesh(s, s.radius, {}, {}, {.max_triangles = budget});
      expect_sound(tree.branches, 1e-9f);
      expect_sound(tree.leaves, 1e-9f);
      if (HasFatalFailure()) return;
    }
}

TEST(TreeMesh, AnEarlierSeasonIsASmallerTree) {
  const growth::Skeleton s = test_skeleton({}, 2);
  const TreeMesh young = build_tree_mesh(s, s.radius, {}, {}, {.season_of_growth = 5});
  const TreeMesh old = build_tree_mesh(s, s.radius, {}, {}, {});
  expect_sound(young.branches, 1e-9f);
  EXPECT_LT(young.branches.bounds().high.y, 0.7f * old.branches.bounds().high.y);
  EXPECT_LT(young.triangles(), old.triangles());
  const TreeMesh last = build_tree_mesh(s, s.radius, {}, {}, {.season_of_growth = s.seasons - 1});
  EXPECT_EQ(last.branches.indices, old.branches.indices);
}

TEST(TreeMesh, TheSameInputGivesTheSameMeshAndAnotherKeyOtherLeaves) {
  const growth::Skeleton s = test_skeleton({}, 2);
  const TreeMesh a = build_tree_mesh(s, s.radius, {}, {}, {.key = 7}),
                 b = build_tree_mesh(s, s.radius, {}, {}, {.key = 7});
  const TreeMesh c = build_tree_mesh(s, s.radius, {}, {}, {.key = 8});
  EXPECT_EQ(a.branches.positions, b.branches.positions);
  EXPECT_EQ(a.branches.uvs, b.branches.uvs);
  EXPECT_EQ(a.leaves.positions, b.leaves.positions);
  EXPECT_EQ(a.leaves.colours, b.leaves.colours);
  EXPECT_NE(a.leaves.positions, c.leaves.positions);
}

TEST(TreeMesh, TheEstimateIsWithinAFactorOfTwo) {
  for (const growth::Skeleton& s : test_skeletons()) {
    if (s.size() < 100) continue;
    for (const FoliageLevel level : kLevels) {
      const MeshOptions options{.foliage = level};
      const auto made = static_cast<double>(build_tree_mesh(s, s.radius, {}, {}, options).triangles());
      const auto guessed = static_cast<double>(estimate_triangles(s, s.radius, {}, {}, options));
      EXPECT_LT(guessed, 2.0 * made);
      EXPECT_GT(guessed, 0.5 * made);
    }
  }
}

TEST(TreeMesh, NothingStandsBeforeTheFirstInternode) {
  const growth::Skeleton none;
  const TreeMesh tree = build_tree_mesh(none, none.radius, {}, {}, {});
  EXPECT_TRUE(tree.branches.empty());
  EXPECT_TRUE(tree.leaves.empty());
}

}  // namespace
}  // namespace bosquet::geometry
