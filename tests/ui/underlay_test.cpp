#include "ui/underlay.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "exchange/image_file.h"
#include "geometry/ground_mesh.h"
#include "terrain/terrain.h"

namespace bosquet::ui {
namespace {

// A slope that rises eastward, one metre in ten.
std::vector<std::shared_ptr<const TriangleMesh>> slope() {
  TriangleMesh mesh;
  for (int north = 0; north <= 10; ++north)
    for (int east = 0; east <= 10; ++east) {
      mesh.positions.push_back(to_world(Vec2(10.0f * Vec2(east, north)), static_cast<float>(east)));
      mesh.normals.push_back(kUp);
    }
  for (std::uint32_t n = 0; n < 10; ++n)
    for (std::uint32_t e = 0; e < 10; ++e) {
      const std::uint32_t a = 11 * n + e, b = a + 1, c = a + 11, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  return {std::make_shared<const TriangleMesh>(std::move(mesh))};
}

float area(const TriangleMesh& mesh) {
  float sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec2 a = to_plan(mesh.positions[mesh.indices[i]]), b = to_plan(mesh.positions[mesh.indices[i + 1]]),
               c = to_plan(mesh.positions[mesh.indices[i + 2]]);
    sum += 0.5f * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  return sum;
}

TEST(Underlay, LiesOnTheGroundInsideItsRectangleAlone) {
  const auto ground = slope();
  const PlanRectangle rectangle{{23, 31}, {57, 68}};
  const TriangleMesh mesh = drape(ground, rectangle, 0.25f);
  EXPECT_NEAR(area(mesh), 34 * 37, 0.1);  // all of it, once, seen from above
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec2 plan = to_plan(mesh.positions[i]);
    EXPECT_NEAR(mesh.positions[i].y, plan.x / 10 + 0.25f, 1e-4f);
    EXPECT_NEAR(mesh.uvs[i].x, (plan.x - 23) / 34, 1e-5f);
    EXPECT_NEAR(mesh.uvs[i].y, (68 - plan.y) / 37, 1e-5f);
  }
  EXPECT_NEAR(area(drape(ground, {{-50, 90}, {20, 300}}, 0)), 200, 0.1);  // as far as there is ground
  EXPECT_TRUE(drape(ground, {{120, 0}, {130, 10}}, 0).empty());
}

TEST(Underlay, APictureThatShowsWeaklyIsNearerToTheMeadow) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "bosquet-underlay-test.png";
  Image white(40, 20, 3);
  std::fill(white.pixels.begin(), white.pixels.end(), std::uint8_t{255});
  ASSERT_TRUE(exchange::write_image(file, white));
  const auto red = [&](float opacity) {
    const auto read = read_underlay({file.string(), {}, 10, opacity});
    EXPECT_TRUE(read);
    EXPECT_FLOAT_EQ(read->height_per_width, 0.5f);
    return read->material.materials.front().base_colour->at(3, 3)[0];
  };
  EXPECT_GT(red(1.0f), red(0.5f));
  EXPECT_GT(red(0.5f), red(0.0f));
  std::filesystem::remove(file);
  EXPECT_FALSE(read_underlay({file.string(), {}, 10, 1}));
}

TEST(Underlay, IsScaledByAKnownLengthAboutTheFirstPoint) {
  const scene::Underlay before{"plan.png", {10, -20}, 80, 0.5f};
  const Vec2 a(30, 20), b(33, 24);  // 5 m apart on it
  const scene::Underlay after = scaled_to(before, a, b, 12.5);
  EXPECT_FLOAT_EQ(after.width_m, 200);
  EXPECT_EQ(after.south_west, DVec2(30 - 2.5 * 20, 20 - 2.5 * 40));
  EXPECT_EQ(after.file, before.file);
  EXPECT_EQ(scaled_to(before, a, a, 12.5), before);
  EXPECT_EQ(scaled_to(before, a, b, 0), before);
}

}  // namespace
}  // namespace bosquet::ui
