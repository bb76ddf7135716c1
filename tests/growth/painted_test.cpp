#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scalar.h"
#include "growth/digest.h"
#include "growth/measure.h"
#include "growth/tree.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

/// `count` markers, even in a sphere.
std::vector<Vec3> ball(const Vec3& centre, float radius, int count, std::uint64_t seed = 1) {
  RandomStream random(seed, 0, Purpose::growth);
  std::vector<Vec3> markers;
  while (static_cast<int>(markers.size()) < count) {
    const Vec3 p{random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f)};
    if (glm::dot(p, p) < 1.0f) markers.push_back(centre + radius * p);
  }
  return markers;
}

GrowthInput painted(const Parameters& p, const std::vector<Vec3>& markers) {
  GrowthInput input = sample_input(p, 3, 20.0f);
  input.markers = markers;
  return input;
}

float nearest(const std::vector<Vec3>& points, const Vec3& p) {
  float best = 1e9f;
  for (const Vec3& q : points) best = std::min(best, glm::length(q - p));
  return best;
}

TEST(Painted, ATreeGrowsWhereItWasPaintedAndNowhereElse) {
  const Parameters p = sample_parameters();
  const std::vector<Vec3> markers = ball({1.0f, 6.0f, 0.0f}, 2.0f, 3000);
  const Skeleton s = grow(painted(p, markers));
  const float r = p.occupancy_radius * s.internode_length_m, d = p.perception_depth * s.internode_length_m;
  ASSERT_GT(s.size(), 200u);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.order[i] > 0) {
      EXPECT_LE(nearest(markers, s.distal[i]), r + d) << i;
    }
  }
  // The crown fills what was painted: hardly a marker has no wood within r.
  int left = 0;
  for (const Vec3& m : markers) left += nearest(s.distal, m) >= r;
  EXPECT_LT(left, 60);
  const Measures m = measure(s);
  EXPECT_NEAR(m.crown_centroid.x, 1.0f, 0.4f);
  EXPECT_NEAR(m.height_m, 8.0f, 0.5f);
}

TEST(Painted, AStrokeIsFollowedThroughItsBends) {
  // A ribbon that rises and then arches over to the east and down, as one stroke of a narrow brush.
  const Parameters p = sample_parameters();
  std::vector<Vec3> stroke, markers;
  for (float t = 0.0f; t <= 1.0f; t += 0.02f) {
    const float angle = kPi * t;
    stroke.push_back({2.5f - 2.5f * std::cos(angle), 1.0f + 3.5f * std::sin(angle), 0.0f});
    for (const Vec3& m : ball(stroke.back(), 0.35f, 25, static_cast<std::uint64_t>(1000.0f * t))) markers.push_back(m);
  }
  const Skeleton s = grow(painted(p, markers));
  for (const Vec3& q : stroke) EXPECT_LT(nearest(s.distal, q), 1.0f) << q.x << ", " << q.y;
  for (const Vec3& end : s.distal) EXPECT_TRUE(nearest(stroke, end) < 1.2f || end.y < 1.0f) << end.x << ", " << end.y;
}

TEST(Painted, MarkersStayUntilWoodComesNear) {
  const Parameters p = sample_parameters();
  const std::vector<Vec3> markers = ball({0.0f, 5.0f, 0.0f}, 2.5f, 2000);
  const GrowthInput input = painted(p, markers);
  Tree tree;
  plant(tree, input);
  std::size_t before = markers.size();
  while (!tree.finished) {
    grow_season(tree);
    ASSERT_LE(tree.markers.size(), before);
    before = tree.markers.size();
  }
  // Without shedding what is gone has wood within r, and what is left (but for the last metamer's) has none, as exactly
  // as occupancy tells places.
  const float blur = 0.866f * 1.5f * tree.occupancy.cell_m();
  const auto left = [&](const Vec3& m) {
    return std::find(tree.markers.begin(), tree.markers.end(), m) != tree.markers.end();
  };
  for (const Vec3& m : markers) {
    if (!left(m)) {
      EXPECT_LT(nearest(tree.wood.distal, m), tree.occupied_m + blur);
    }
  }
  for (const Vec3& m : tree.markers) EXPECT_GE(nearest(tree.wood.distal, m), tree.occupied_m - blur);
}

TEST(Painted, BudsWaitForTheirMarkersHoweverLong) {
  // Buds that lived one idle season only would be dead long before the slow climb of a sparse crown comes to its end.
  Parameters patient = sample_parameters(), hasty = patient;
  hasty.bud_life_seasons = 1;
  const std::vector<Vec3> markers = ball({0.0f, 5.0f, 0.0f}, 2.5f, 1000);
  EXPECT_EQ(digest(grow(painted(patient, markers))), digest(grow(painted(hasty, markers))));
  GrowthInput autonomous = sample_input(hasty, 3, 6.0f);
  const std::uint64_t with = digest(grow(autonomous));
  autonomous.parameters = &patient;
  EXPECT_NE(digest(grow(autonomous)), with) << "without markers the life of buds matters";
}

TEST(Painted, RegionGroundAndClearStemHoldForPaintedMarkersToo) {
  const Parameters p = sample_parameters();
  crowns::CrownRegion east;
  east.voxel_m = east.layer_m = 0.5f;
  east.low = {-0.5f, 0.0f, -4.0f}, east.cells = {9, 20, 16};
  east.bits.assign((9 * 20 * 16 + 63) / 64, ~std::uint64_t{0});
  std::vector<Vec3> markers = ball({0.0f, 4.0f, 0.0f}, 3.5f, 4000);
  for (const Vec3& m : ball({0.0f, -2.0f, 0.0f}, 1.9f, 300)) markers.push_back(m);
  GrowthInput input = painted(p, markers);
  input.region = &east;
  input.clear_stem_m = 2.0f;
  const Skeleton s = grow(input);
  ASSERT_GT(s.size(), 200u);
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_GE(s.distal[i].x, -0.5f - 2.0f * s.internode_length_m);
    EXPECT_GE(s.distal[i].y, s.order[i] > 0 ? 2.0f : 0.0f);
  }
}

TEST(Painted, TheSameMarkersGiveTheSameTreeAndOthersAnother) {
  const Parameters p = sample_parameters();
  std::vector<Vec3> markers = ball({0.0f, 4.0f, 0.0f}, 2.0f, 1000);
  const GrowthInput input = painted(p, markers);
  const std::uint64_t tree = digest(grow(input)), before = hash(input);
  EXPECT_EQ(digest(grow(input)), tree);
  markers[500].x += 0.001f;
  EXPECT_NE(hash(painted(p, markers)), before);
  EXPECT_NE(hash(sample_input(p, 3, 20.0f)), before);
}

TEST(Painted, MarkersOutOfReachLeaveABareStemOfTheirHeight) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(painted(p, {{30.0f, 3.0f, 0.0f}}));
  EXPECT_GE(measure(s).height_m, 3.0f);
  EXPECT_LE(measure(s).height_m, 3.0f + s.internode_length_m);
  EXPECT_EQ(std::count(s.order.begin(), s.order.end(), 0), static_cast<std::ptrdiff_t>(s.size()));
}

}  // namespace
}  // namespace bosquet::growth
