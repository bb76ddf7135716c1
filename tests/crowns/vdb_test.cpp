#include "crowns/vdb.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/parallel.h"
#include "stands.h"

namespace bosquet::crowns {
namespace {

namespace fs = std::filesystem;

// A folder of its own that goes with the test.
class Vdb : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("bosquet_vdb_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

CrownSpace stand() {
  // A slope, so that layers lie below 0 too, and crowns that overhang the site, so that columns do.
  const auto terrain = ground(30, [](Vec2 p) { return 0.2f * p.x - 4.0f; });
  auto trees = clustered(3, 40, 30.0f, 7.0f, 12.0f, 4.0f);
  for (Claimant& t : trees) t.id += 1000, t.ground_y = terrain.ground(t.base);
  return *divide_space(trees, terrain, SpaceOptions{});
}

void expect_equal(const CrownSpace& space, const TreeGrid& grid) {
  EXPECT_EQ(grid.active_voxels(), space.claimed_voxels());
  std::size_t visited = 0;
  grid.for_each([&](IVec3 v, std::int32_t id) {
    ++visited;
    const std::int32_t owner = space.owner(v);
    ASSERT_NE(owner, kFree);
    ASSERT_EQ(space.claimants()[static_cast<std::size_t>(owner)].id, id);
  });
  EXPECT_EQ(visited, space.claimed_voxels());
  for (IVec3 v : {IVec3{20, 3, 30}, IVec3{-3, 2, 50}, IVec3{60, -1, 10}, IVec3{10'000, 3, 3}}) {
    const std::int32_t owner = space.owner(v);
    EXPECT_EQ(grid.id(v), owner == kFree ? 0 : space.claimants()[static_cast<std::size_t>(owner)].id);
  }
}

TEST_F(Vdb, AGridReadBackFromItsFileEqualsTheRegions) {
  const CrownSpace space = stand();
  const TreeGrid grid = build_grid(space);
  expect_equal(space, grid);
  const fs::path path = folder_ / "stand.vdb";
  const auto written = write_vdb(grid, path, {{1001, "English oak"}, {1002, "Silver birch"}});
  ASSERT_TRUE(written) << written.error().message;
  const auto read = read_vdb(path);
  ASSERT_TRUE(read) << read.error().message;
  expect_equal(space, *read);
  EXPECT_FLOAT_EQ(read->voxel_m(), space.voxel_m());
  EXPECT_FLOAT_EQ(read->layer_m(), space.layer_m());
  EXPECT_EQ(read->name(1001), "English oak");
  EXPECT_EQ(read->name(1003), "");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Vdb, ItsTransformPutsVoxelsWhereTheyLieInTheWorld) {
  const CrownSpace space = stand();
  const TreeGrid grid = build_grid(space);
  int checked = 0;
  grid.for_each([&](IVec3 v, std::int32_t id) {
    if (++checked % 1000) return;
    const Vec3 centre = grid.world_centre(v);
    EXPECT_EQ(space.claimants()[static_cast<std::size_t>(space.owner_at(centre))].id, id);
    EXPECT_FLOAT_EQ(centre.z, -(static_cast<float>(v.z) + 0.5f) * space.voxel_m());
  });
  EXPECT_GT(checked, 10'000);
}

TEST_F(Vdb, TheGridIsTheSameForAnyNumberOfThreads) {
  const CrownSpace space = stand();
  for (int threads : {1, 8}) run_with_threads(threads, [&] { expect_equal(space, build_grid(space)); });
}

TEST_F(Vdb, AnEmptySpaceMakesAnEmptyGrid) {
  const TreeGrid grid = build_grid(*divide_space({}, flat(10), {}));
  EXPECT_EQ(grid.active_voxels(), 0u);
  ASSERT_TRUE(write_vdb(grid, folder_ / "empty.vdb"));
  EXPECT_EQ(read_vdb(folder_ / "empty.vdb")->active_voxels(), 0u);
}

TEST_F(Vdb, AFolderThatDoesNotExistIsNamed) {
  const auto result = write_vdb(build_grid(stand()), folder_ / "nowhere" / "a.vdb");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::input);
  EXPECT_NE(result.error().message.find("nowhere"), std::string::npos);
  EXPECT_FALSE(write_vdb(build_grid(stand()), folder_));
}

TEST_F(Vdb, AFullDiskIsReportedAndTheOldFileStays) {
  const fs::path path = folder_ / "stand.vdb";
  std::ofstream(path) << "old";
  const TreeGrid grid = build_grid(stand());
  // No file may grow beyond 4 kB: the next write fails as on a full disk.
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto result = write_vdb(grid, path);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);

  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::cannot_finish);
  EXPECT_EQ(files(), 1u);
  std::string content;
  std::ifstream(path) >> content;
  EXPECT_EQ(content, "old");
}

TEST_F(Vdb, WhatIsNoGridOfTreesIsRefused) {
  std::ofstream(folder_ / "text.vdb") << "not a grid";
  EXPECT_FALSE(read_vdb(folder_ / "text.vdb"));
  EXPECT_FALSE(read_vdb(folder_ / "missing.vdb"));
}

}  // namespace
}  // namespace bosquet::crowns
