#include "crowns/propagation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/random.h"
#include "polygon_reference.h"
#include "stands.h"

namespace bosquet::crowns {
namespace {

// A square layer of blocks x blocks blocks, all open.
LayerCells open_layer(std::int32_t blocks) {
  LayerCells cells;
  const auto block = [&](std::int32_t e, std::int32_t n) {
    return e < 0 || n < 0 || e >= blocks || n >= blocks ? LayerCells::kNoBlock : n * blocks + e;
  };
  for (std::int32_t n = 0; n < blocks; ++n)
    for (std::int32_t e = 0; e < blocks; ++e)
      cells.blocks.push_back({{e * 64, n * 64}, block(e - 1, n), block(e + 1, n), block(e, n - 1), block(e, n + 1)});
  cells.open.assign(static_cast<std::size_t>(blocks * blocks) * 4096, 1);
  return cells;
}
std::uint32_t cell_at(std::int32_t blocks, IVec2 column) {
  const std::int32_t block = column.y / 64 * blocks + column.x / 64;
  return static_cast<std::uint32_t>(block * 4096 + column.y % 64 * 64 + column.x % 64);
}

Front front_at(DVec2 base, std::int32_t blocks, std::int32_t rank, double trunk = 0.5, double slowness = 0x1p30) {
  Front f;
  f.east = base.x, f.north = base.y;
  f.trunk = trunk;
  f.slowness = slowness;
  f.reach_squared = std::numeric_limits<double>::infinity();
  f.root = cell_at(blocks, {static_cast<int>(base.x), static_cast<int>(base.y)});
  f.rank = f.owner = rank;
  return f;
}

// Whether a front already starts in the last one's cell.
bool root_taken(const std::vector<Front>& fronts) {
  return std::any_of(fronts.begin(), fronts.end() - 1, [&](const Front& f) { return f.root == fronts.back().root; });
}

TEST(Propagation, ALoneFrontIsACircle) {
  const std::int32_t blocks = 2;
  const DVec2 base{60.3, 63.8};
  const auto result = propagate(std::vector{front_at(base, blocks, 0)}, open_layer(blocks));
  double worst = 0;
  for (std::int32_t j = 0; j < 128; ++j)
    for (std::int32_t i = 0; i < 128; ++i) {
      const double x = i + 0.5 - base.x, y = j + 0.5 - base.y;
      const double reached = static_cast<double>(result.ticks[cell_at(blocks, {i, j})]) / 0x1p30;
      worst = std::max(worst, std::fabs(reached - std::max(0.0, std::sqrt(x * x + y * y) - 0.5)));
    }
  // A free straight way is exact, so no anisotropy builds up with the radius; what is left is rounding.
  EXPECT_LT(worst, 1e-6);
}

// A wall with a free end: behind it the shortest way turns at the wall's corner.
double error_behind_a_wall(std::int32_t blocks) {
  const double n = blocks * 64.0;
  const DVec2 base{0.25 * n, 0.25 * n};
  LayerCells cells = open_layer(blocks);
  const std::int32_t west = static_cast<std::int32_t>(0.5 * n), thick = blocks * 4,
                     end = static_cast<std::int32_t>(0.5 * n);
  for (std::int32_t j = 0; j < end; ++j)
    for (std::int32_t i = west; i < west + thick; ++i) cells.open[cell_at(blocks, {i, j})] = 0;
  const auto result = propagate(std::vector{front_at(base, blocks, 0, 0.0)}, cells);

  const DVec2 near_corner(west, end), far_corner(west + thick, end);
  double worst = 0;
  for (std::int32_t j = 0; j < end; ++j)
    for (std::int32_t i = west + thick; i < blocks * 64; ++i) {
      const DVec2 p(i + 0.5, j + 0.5);
      // From the near corner the far one is straight east; points below it are reached round both.
      const double way = glm::length(near_corner - base) + thick + glm::length(p - far_corner);
      const double reached = static_cast<double>(result.ticks[cell_at(blocks, {i, j})]) / 0x1p30;
      worst = std::max(worst, std::fabs(reached - way) / n);
    }
  return worst;
}

TEST(Propagation, BehindAWallTimesConvergeToTheShortestWayRoundIt) {
  const double coarse = error_behind_a_wall(1), fine = error_behind_a_wall(2), finest = error_behind_a_wall(4);
  // First order at a corner: h log h, so halving the voxel must leave less than 0.75 of the error.
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, 0.75 * coarse);
  EXPECT_LT(finest, 0.75 * fine);
}

TEST(Propagation, EachCellIsAtLeastOneTickLaterThanANeighbourOfTheSameTree) {
  const std::int32_t blocks = 1;
  std::vector<Front> fronts;
  for (std::int32_t t = 0; t < 20; ++t) {
    RandomStream draw(3, static_cast<std::uint64_t>(t), Purpose::planting);
    const double east = 64.0 * static_cast<double>(draw.uniform()), north = 64.0 * static_cast<double>(draw.uniform());
    fronts.push_back(
        front_at({east, north}, blocks, t, 1.5, 0x1p20 * (1.0 + 10.0 * static_cast<double>(draw.uniform()))));
    if (root_taken(fronts)) fronts.pop_back();
  }
  const auto result = propagate(fronts, open_layer(blocks));
  for (std::int32_t j = 0; j < 64; ++j)
    for (std::int32_t i = 0; i < 64; ++i) {
      const std::uint32_t c = cell_at(blocks, {i, j});
      const std::int32_t f = result.front[c];
      ASSERT_NE(f, LayerResult::kUnclaimed);
      if (fronts[static_cast<std::size_t>(f)].root == c) continue;
      bool earlier = false;
      for (IVec2 d : {IVec2{1, 0}, IVec2{-1, 0}, IVec2{0, 1}, IVec2{0, -1}}) {
        const IVec2 at = IVec2{i, j} + d;
        if (at.x < 0 || at.y < 0 || at.x > 63 || at.y > 63) continue;
        const std::uint32_t n = cell_at(blocks, at);
        earlier = earlier || (result.front[n] == f && result.ticks[n] < result.ticks[c]);
      }
      EXPECT_TRUE(earlier) << "cell " << i << ", " << j;
    }
}

TEST(Propagation, TiesGoToTheLowestKey) {
  // Two equal trees, an odd number of columns apart: the column halfway is reached by both in the same tick.
  const std::int32_t blocks = 1;
  for (bool swapped : {false, true}) {
    const std::vector fronts{front_at({20.5, 30.5}, blocks, swapped ? 1 : 0),
                             front_at({30.5, 30.5}, blocks, swapped ? 0 : 1)};
    const auto result = propagate(fronts, open_layer(blocks));
    EXPECT_EQ(result.front[cell_at(blocks, {25, 30})], swapped ? 1 : 0);
  }
}

TEST(Propagation, TheOrderOfBlocksDoesNotMatter) {
  // Blocks number the cells, and cells of one tick leave the queue by number.
  const std::int32_t blocks = 3;
  const std::int32_t shuffled[] = {4, 0, 8, 3, 7, 1, 6, 2, 5};
  const LayerCells cells = open_layer(blocks);
  LayerCells other = cells;
  for (std::size_t b = 0; b < 9; ++b) {
    const auto moved = [&](std::int32_t n) { return n < 0 ? n : shuffled[n]; };
    const LayerCells::Block& from = cells.blocks[b];
    other.blocks[static_cast<std::size_t>(shuffled[b])] = {from.low, moved(from.west), moved(from.east),
                                                           moved(from.south), moved(from.north)};
  }
  std::vector<Front> fronts, others;
  for (std::int32_t t = 0; t < 60; ++t) {
    // Bases on cell centres and two sizes only, so that ties abound.
    RandomStream draw(8, static_cast<std::uint64_t>(t), Purpose::planting);
    const IVec2 column(draw.below(192), draw.below(192));
    fronts.push_back(front_at(DVec2(column) + 0.5, blocks, t, 0.5, t % 2 ? 0x1p30 : 0x1p31));
    if (root_taken(fronts)) {
      fronts.pop_back();
      continue;
    }
    others.push_back(fronts.back());
    const std::uint32_t root = fronts.back().root;
    others.back().root = static_cast<std::uint32_t>(shuffled[root / 4096]) * 4096 + root % 4096;
  }
  const auto expected = propagate(fronts, cells), got = propagate(others, other);
  for (std::size_t c = 0; c < expected.front.size(); ++c) {
    const std::size_t at = static_cast<std::size_t>(shuffled[c / 4096]) * 4096 + c % 4096;
    ASSERT_EQ(got.front[at], expected.front[c]);
    ASSERT_EQ(got.ticks[at], expected.ticks[c]);
  }
}

TEST(Propagation, TheFastestAndTheSlowestTreeFitTheTicks) {
  for (float area : {1e-3f, 0.03f, 1.0f, 2000.0f, 1e5f})
    for (float exponent : {0.0f, 0.5f, 1.0f, 2.0f})
      for (float voxel : {0.02f, 0.25f, 20.0f}) {
        const double s = front_slowness(area, exponent, voxel);
        EXPECT_GE(s, 0x1p10);
        EXPECT_LE(s, 0x1p46);
      }
  EXPECT_DOUBLE_EQ(front_slowness(8.0f, 1.0f, 0.5f), 0x1p36);
}

// Shares of cells on which both methods agree, exactly and within one cell.
struct Agreement {
  double exact = 0, within_one = 0;
};

Agreement with_polygons(int count, std::uint64_t seed) {
  constexpr std::int32_t kSide = 128, kBlocks = 2;
  const float voxel = 30.0f / static_cast<float>(kSide);
  std::vector<PolygonTree> polygons;
  std::vector<Front> fronts;
  for (const Claimant& t : clustered(seed, count, 30.0f, 7.0f, 12.0f, 4.0f)) {
    const DVec2 base = DVec2(t.base) / static_cast<double>(voxel);
    const double radius = static_cast<double>(t.trunk_radius_m() / voxel);
    polygons.push_back({base, radius, static_cast<double>(t.projected_area_m2())});
    fronts.push_back(front_at(base, kBlocks, static_cast<std::int32_t>(fronts.size()), radius,
                              front_slowness(t.projected_area_m2(), 1.0f, voxel)));
  }
  const auto ours = propagate(fronts, open_layer(kBlocks));
  const auto theirs = polygon_division(polygons, kSide);

  int claimed = 0, exact = 0, within_one = 0;
  for (std::int32_t j = 0; j < kSide; ++j)
    for (std::int32_t i = 0; i < kSide; ++i) {
      const std::int32_t reference = theirs[static_cast<std::size_t>(j * kSide + i)];
      if (reference < 0) continue;
      ++claimed;
      bool near = false;
      for (std::int32_t y = std::max(0, j - 1); y <= std::min(kSide - 1, j + 1); ++y)
        for (std::int32_t x = std::max(0, i - 1); x <= std::min(kSide - 1, i + 1); ++x)
          near = near || ours.front[cell_at(kBlocks, {x, y})] == reference;
      exact += ours.front[cell_at(kBlocks, {i, j})] == reference;
      within_one += near;
    }
  EXPECT_GT(claimed, 0.95 * kSide * kSide);
  return {static_cast<double>(exact) / claimed, static_cast<double>(within_one) / claimed};
}

TEST(Propagation, AgreesWithThePolygonMethodOfTheSource) {
  // Two step sizes of the polygon method agree with each other on 97.6 % of the cells only at 300 trees.
  for (const auto& [count, least] : {std::pair{10, 0.95}, {30, 0.95}, {300, 0.90}})
    for (std::uint64_t seed : {1u, 2u, 3u}) {
      const Agreement a = with_polygons(count, seed);
      std::printf("%d trees, sample %d: %.1f %% of cells alike, %.1f %% within one cell\n", count,
                  static_cast<int>(seed), 100 * a.exact, 100 * a.within_one);
      EXPECT_GE(a.exact, least) << count << " trees, sample " << seed;
      EXPECT_GE(a.within_one, 0.98) << count << " trees, sample " << seed;
    }
}

}  // namespace
}  // namespace bosquet::crowns
