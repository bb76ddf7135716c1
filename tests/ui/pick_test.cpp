#include "ui/pick.h"

#include <gtest/gtest.h>

#include "scene/document.h"
#include "tests/scene/sample_document.h"

namespace bosquet::ui {
namespace {

SightRay down_at(Vec2 plan, Vec2 from_plan, float height) {
  const Vec3 origin = to_world(from_plan, height);
  return {origin, glm::normalize(to_world(plan, 0.0f) - origin)};
}

TEST(Pick, ARayMeetsFlatGroundWhereItIsAimed) {
  const terrain::Terrain ground = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({100, 100})));
  for (const Vec2 aim : {Vec2(10, 80), Vec2(50, 50), Vec2(99, 1)}) {
    const auto hit = ground_hit(ground, down_at(aim, {50, -20}, 25));
    ASSERT_TRUE(hit);
    EXPECT_LT(glm::length(to_plan(*hit) - aim), 0.01f);
  }
  EXPECT_FALSE(ground_hit(ground, {{50, 10, -50}, glm::normalize(Vec3(1, 0.2f, 0))}));
}

TEST(Pick, TheNearerFlankOfAHillHidesTheFartherOne) {
  const terrain::Lattice lattice = *terrain::make_lattice({100, 100});
  std::vector<float> samples;
  const int n = lattice.cells.x + 1;
  for (int j = 0; j <= lattice.cells.y; ++j)
    for (int i = 0; i < n; ++i)
      samples.push_back(std::max(0.0f, 20.0f - std::abs(static_cast<float>(j) * lattice.cell_m - 50.0f)));
  const auto field = terrain::Heightfield::from_samples(lattice, samples);
  ASSERT_TRUE(field);
  const terrain::Terrain ground = terrain::make_terrain(*field);
  const auto hit = ground_hit(ground, {to_world({50, -30}, 12), Vec3(0, 0, -1)});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(to_plan(*hit).y, 42.0f, 0.1f);  // where the southern flank is 12 m high
}

TEST(Pick, TheTreeInFrontIsTakenByCrownOrTrunk) {
  const scene::Document document = scene::sample_document("english_oak", {{30, 20}, {30, 40}}, {60, 60}, 0.5f);
  const crowns::RepresentativeShape& shape = document.species[0]->shape;
  const float crown = 0.5f * (shape.trunk_height_m + 0.5f * shape.crown_height_m());
  EXPECT_EQ(tree_hit(document, {to_world({30, -10}, crown), Vec3(0, 0, -1)}), 1);
  EXPECT_EQ(tree_hit(document, {to_world({30, 70}, crown), Vec3(0, 0, 1)}), 2);
  EXPECT_EQ(tree_hit(document, {to_world({30, -10}, 0.2f), Vec3(0, 0, -1)}), 1);
  EXPECT_FALSE(tree_hit(document, {to_world({5, -10}, crown), Vec3(0, 0, -1)}));
}

TEST(Pick, ALassoTakesTheFeetInsideIt) {
  const scene::Document document = scene::sample_document("english_oak", {{10, 10}, {30, 30}, {50, 50}}, {60, 60});
  CameraRig rig;
  rig.frame({{0, 0, -60}, {60, 1, 0}}, 1.0f);
  rig.show_plan(true);
  const Vec2 view(600, 600);
  const Vec2 low = *rig.project(to_world({20, 20}, 0), view), high = *rig.project(to_world({55, 55}, 0), view);
  EXPECT_EQ(trees_inside(document, rig, view, {low, {high.x, low.y}, high, {low.x, high.y}}),
            (std::vector<std::int32_t>{2, 3}));
  EXPECT_TRUE(trees_inside(document, rig, view, {low, high}).empty());
}

}  // namespace
}  // namespace bosquet::ui
