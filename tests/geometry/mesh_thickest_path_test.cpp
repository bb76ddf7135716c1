#include <gtest/gtest.h>

#include "geometry/thickest_path.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

TEST(ThickestPath, EveryStandingInternodeIsInExactlyOnePath) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const auto stands = standing(s, -1);
    const ThickestPaths paths = thickest_paths(s, s.radius, stands);
    std::vector<int> seen(s.size());
    for (std::uint32_t i : paths.internodes) ++seen[i];
    for (std::size_t i = 0; i < s.size(); ++i) ASSERT_EQ(seen[i], stands[i] ? 1 : 0);
  }
}

TEST(ThickestPath, APathIsConnectedAndNoSiblingIsThickerThanItsContinuation) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const auto stands = standing(s, -1);
    const ThickestPaths paths = thickest_paths(s, s.radius, stands);
    std::vector<std::int32_t> next(s.size(), -1);
    for (const auto& path : paths.paths) {
      const auto run = paths.of(path);
      for (std::size_t k = 1; k < run.size(); ++k) {
        ASSERT_EQ(s.parent[run[k]], static_cast<std::int32_t>(run[k - 1]));
        next[run[k - 1]] = static_cast<std::int32_t>(run[k]);
      }
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (!stands[i] || s.parent[i] < 0) continue;
      const std::int32_t main = next[static_cast<std::size_t>(s.parent[i])];
      ASSERT_GE(main, 0) << "a path ends although wood goes on";
      EXPECT_LE(s.radius[i], s.radius[static_cast<std::size_t>(main)]);
    }
  }
}

TEST(ThickestPath, AParentPrecedesItsChildrenAndHoldsTheNodeTheySpringFrom) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const ThickestPaths paths = thickest_paths(s, s.radius, standing(s, -1));
    for (std::size_t k = 0; k < paths.paths.size(); ++k) {
      const auto& path = paths.paths[k];
      const std::int32_t below = s.parent[paths.internodes[path.first]];
      if (path.parent < 0) {
        EXPECT_LT(below, 0);
        continue;
      }
      ASSERT_LT(path.parent, static_cast<std::int32_t>(k));
      const auto& parent = paths.paths[static_cast<std::size_t>(path.parent)];
      EXPECT_GE(path.node, parent.first);
      EXPECT_LT(path.node, parent.first + parent.count);
      EXPECT_EQ(static_cast<std::int32_t>(paths.internodes[path.node]), below);
    }
  }
}

TEST(ThickestPath, AnOvergrowingLateralBecomesTheParent) {
  // A fork at the second internode: the axis goes on with a thin internode, the lateral with a thick one.
  growth::Skeleton s;
  s.parent = {-1, 0, 1, 1};
  s.axis = {0, 0, 0, 1};
  s.radius = {0.3f, 0.3f, 0.1f, 0.25f};
  s.distal = {{0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {1, 3, 0}};
  s.born = {0, 0, 0, 0};
  s.shed.assign(4, growth::kNever);
  const ThickestPaths paths = thickest_paths(s, s.radius, standing(s, -1));
  ASSERT_EQ(paths.paths.size(), 2u);
  EXPECT_EQ(paths.internodes[paths.paths[0].first + 2], 3u);
  EXPECT_EQ(paths.internodes[paths.paths[1].first], 2u);
}

TEST(ThickestPath, AnEarlierSeasonHoldsOnlyWhatStoodThen) {
  const growth::Skeleton s = test_skeleton({.shedding = 0.4f}, 3);
  const auto then = standing(s, 5);
  for (std::size_t i = 0; i < s.size(); ++i) EXPECT_EQ(then[i] != 0, s.alive_at(i, 5));
}

}  // namespace
}  // namespace bosquet::geometry
