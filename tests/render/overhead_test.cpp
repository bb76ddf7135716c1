#include "render/overhead.h"

#include <gtest/gtest.h>

#include "render/framing.h"
#include "tests/render/test_scenes.h"

namespace bosquet::render {
namespace {

std::size_t cell_at(const Overhead& map, float x, float z) {
  const int i = static_cast<int>((x - map.low.x) / map.cell), j = static_cast<int>((z - map.low.y) / map.cell);
  return static_cast<std::size_t>(j * map.columns + i);
}

TEST(Overhead, KnowsTheHeightsOfGroundAndRoof) {
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {20, 5, -20}, {4, 10, 4}, {0.5f, 0.5f, 0.5f});
  const Overhead map = make_overhead(model, bounds(model));
  EXPECT_NEAR(map.ground[cell_at(map, 20, -20)], 0, 1e-4);
  EXPECT_NEAR(map.land_height, 0, 1e-4);
  // In the middle of the roof the small disc sees roof alone, in the open ground alone.
  const Vec4 roof = map.cover[cell_at(map, 20, -20)], open = map.cover[cell_at(map, 35, -5)];
  EXPECT_NEAR(map.base + roof.x * map.scale, 10, 0.8);
  EXPECT_NEAR(map.base + open.x * map.scale, 0, 1e-3);
}

TEST(Overhead, TakesTheLargestWaterSurfaceForTheWater) {
  scene::Model model = test::ground_scene(40);
  EXPECT_FALSE(make_overhead(model, bounds(model)).water_level_m);
  test::add_water(model, {5, -5}, 3, 2.0f);
  test::add_water(model, {20, -20}, 20, 1.5f);
  const Overhead map = make_overhead(model, bounds(model));
  ASSERT_TRUE(map.water_level_m);
  EXPECT_EQ(*map.water_level_m, 1.5f);
}

TEST(Overhead, GroundGoesOnAtItsHeightBeyondARaggedEdge) {
  scene::Model model = test::ground_scene(40);
  // A sliver that sticks out by less than a cell.
  TriangleMesh sliver;
  sliver.positions = {{40, 0, -20}, {40.08f, 0, -20}, {40, 0, -20.08f}};
  sliver.normals.assign(3, kUp);
  sliver.indices = {0, 1, 2};
  test::add_node(model, std::move(sliver), 0);
  Box3 box = bounds(model);
  box.low.y = -5;  // of something beside
  const Overhead map = make_overhead(model, box);
  for (const float z : {-39.0f, -20.1f, -3.0f}) EXPECT_NEAR(map.ground[cell_at(map, 45, z)], 0, 1e-4) << z;
}

TEST(Overhead, OfNothingHoldsOneCell) {
  const Overhead map = make_overhead({}, Box3());
  EXPECT_EQ(map.columns * map.rows, 1);
}

TEST(Overhead, ARiverFlowsOnBeyondTheGroundAndAPondDoesNot) {
  scene::Model pond = test::ground_scene(40), river = pond;
  test::add_water(pond, {20, -20}, 12, 0.5f);
  test::add_water(river, {20, -20}, 40, 0.5f);
  EXPECT_FALSE(make_overhead(pond, bounds(pond)).water_flows_on);
  EXPECT_TRUE(make_overhead(river, bounds(river)).water_flows_on);
}

}  // namespace
}  // namespace bosquet::render
