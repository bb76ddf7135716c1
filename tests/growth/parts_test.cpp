// The small parts of growth against closed forms and slow, obvious versions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/scalar.h"
#include "growth/age.h"
#include "growth/directions.h"
#include "growth/gravimorphism.h"
#include "growth/markers.h"
#include "growth/measure.h"
#include "growth/occupancy.h"
#include "growth/shadow.h"
#include "growth/shadow_pyramid.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

TEST(Gravimorphism, NeutralEllipseAndVerticalAxesFavourNoBud) {
  for (float chi = 0.0f; chi < 6.2f; chi += 0.3f) {
    EXPECT_NEAR(propensity(1.0f, 1.0f, 0.0f, 0.3f, std::cos(chi), std::sin(chi)), 1.0f, 1e-6f);
    EXPECT_NEAR(propensity(0.5f, 2.0f, 0.2f, 1.0f, std::cos(chi), std::sin(chi)), 1.0f, 1e-6f);
  }
}

TEST(Gravimorphism, TheDistanceEndsOnTheEllipse) {
  const float s_v = 0.8f, s_p = 1.7f, e_v = 0.5f;
  for (float chi = 0.0f; chi < 6.2f; chi += 0.1f) {
    const float d = ellipse_distance(s_v, s_p, e_v, std::cos(chi), std::sin(chi));
    const float v = (d * std::cos(chi) - e_v) / s_v, p = d * std::sin(chi) / s_p;
    EXPECT_GT(d, 0.0f);
    EXPECT_NEAR(v * v + p * p, 1.0f, 1e-5f);
  }
}

TEST(Gravimorphism, ShiftedUpIsEpitonyDownHypotonyWideAmphitony) {
  EXPECT_GT(propensity(1, 1, 0.5f, 0, 1, 0), propensity(1, 1, 0.5f, 0, -1, 0));
  EXPECT_LT(propensity(1, 1, -0.5f, 0, 1, 0), propensity(1, 1, -0.5f, 0, -1, 0));
  EXPECT_GT(propensity(0.5f, 1, 0, 0, 0, 1), propensity(0.5f, 1, 0, 0, 1, 0));
}

TEST(Shadow, OneInternodeCastsAPyramid) {
  ShadowGrid grid;
  Box3 room;
  room.add({-5, 0, -5}), room.add({5, 10, 5});
  grid.reset(room, room.low, 1.0f, 0.5f, 2.0f, 3);
  grid.cast({0.5f, 8.5f, 0.5f});
  EXPECT_EQ(grid.settle(), 1u);
  // At its own place the tree's light is full: its own shadow is given back.
  EXPECT_EQ(grid.exposure({0.5f, 8.5f, 0.5f}), 1.0f);
  // q layers down the shadow is a * b^-q as far as q cells to the side, and nothing beyond.
  for (int q = 1; q <= 5; ++q) {
    for (int i = 0; i <= 5; ++i) {
      const float s = q <= 3 && i <= q ? 0.5f / static_cast<float>(1 << q) : 0.0f;
      const Vec3 p{0.5f + static_cast<float>(i), 8.5f - static_cast<float>(q), 0.5f};
      EXPECT_NEAR(grid.exposure(p), std::min(1.0f, 1.0f - s + 0.5f), 1e-4f) << q << " " << i;
    }
  }
}

RC_GTEST_PROP(Shadow, APyramidIsTheSameHoweverManyNumbersAreAddedAtOnce, ()) {
  const int last = *rc::gen::inRange(0, kMostShadowDepth + 1);
  const auto width = static_cast<std::size_t>(2 * last + 3 + *rc::gen::inRange(0, 5));
  const std::vector<std::int32_t> amount =
      *rc::gen::container<std::vector<std::int32_t>>(kMostShadowDepth + 1, rc::gen::inRange<std::int32_t>(1, 1 << 16));
  const ShadowPyramid pyramid{last, width, width * width, amount.data()};
  std::vector<std::int32_t> wide(width * width * static_cast<std::size_t>(last + 1) + kPastPyramid), plain, slow;
  plain = slow = wide;
  const auto cell = [&](std::vector<std::int32_t>& sums, int i, int j, int k) {
    const auto middle = static_cast<int>(width / 2);
    return sums.data() + (static_cast<std::size_t>(last - j) * width + static_cast<std::size_t>(middle + k)) * width +
           static_cast<std::size_t>(middle + i);
  };
  for (const int times : {2, -3}) {
    add_pyramid(pyramid, cell(wide, 0, 0, 0), times);
    add_pyramid_plainly(pyramid, cell(plain, 0, 0, 0), times);
    for (int q = 0; q <= last; ++q) {
      for (int k = -q; k <= q; ++k) {
        for (int i = -q; i <= q; ++i) *cell(slow, i, q, k) += times * amount[static_cast<std::size_t>(q)];
      }
    }
  }
  RC_ASSERT(wide == slow);
  RC_ASSERT(plain == slow);
}

TEST(Shadow, SecondInternodeInACellIsShadedByTheFirst) {
  ShadowGrid grid;
  Box3 room;
  room.add(Vec3{-2, 0, -2}), room.add(Vec3{2, 4, 2});
  grid.reset(room, room.low, 1.0f, 0.25f, 2.0f, 2);
  for (int n = 0; n < 3; ++n) grid.cast({0.5f, 1.5f, 0.5f});
  EXPECT_EQ(grid.settle(), 1u) << "three internodes in one cell are one update";
  EXPECT_NEAR(grid.exposure({0.5f, 1.5f, 0.5f}), 0.5f, 1e-4f);
}

RC_GTEST_PROP(Shadow, WhatIsTakenBackLeavesNothing, ()) {
  ShadowGrid grid;
  Box3 room;
  room.add(Vec3{-2, 0, -2}), room.add(Vec3{2, 3, 2});
  grid.reset(room, room.low, 0.5f, 0.3f, 1.7f, 6);
  std::vector<Vec3> places;
  const int n = *rc::gen::inRange(1, 30);
  for (int i = 0; i < n; ++i) {
    // Some of them far outside the room that was expected.
    places.push_back({static_cast<float>(*rc::gen::inRange(-800, 800)) * 0.01f,
                      static_cast<float>(*rc::gen::inRange(0, 900)) * 0.01f,
                      static_cast<float>(*rc::gen::inRange(-800, 800)) * 0.01f});
  }
  for (const Vec3& p : places) {
    grid.cast(p);
    if (*rc::gen::inRange(0, 4) == 0) grid.settle();
  }
  for (const Vec3& p : places) grid.take_back(p);
  grid.settle();
  ShadowGrid fresh;
  fresh.reset(room, room.low, 0.5f, 0.3f, 1.7f, 6);
  for (const Vec3& p : places) RC_ASSERT(grid.exposure(p) == fresh.exposure(p));
}

/// Half the diagonal of a cell and of an eighth of it: how far markers and nodes are from where occupancy sees them.
constexpr float kBlur = 0.866f * Occupancy::kCell * 1.5f;

RC_GTEST_PROP(Occupancy, AgreesWithMeasuringEveryDistanceButForACellNearTheSurface, ()) {
  Occupancy occupancy;
  Box3 room;
  room.add(Vec3{-1, 0, -1}), room.add(Vec3{1, 2, 1});
  const float radius = 0.6f;
  occupancy.reset(room, radius, 1.0f);
  const auto point = [](int reach) {
    return Vec3{static_cast<float>(*rc::gen::inRange(-reach, reach)), static_cast<float>(*rc::gen::inRange(0, reach)),
                static_cast<float>(*rc::gen::inRange(-reach, reach))} *
           0.013f;
  };
  std::vector<Vec3> nodes;
  std::vector<bool> stands;
  for (int i = *rc::gen::inRange(1, 40); i > 0; --i) {
    nodes.push_back(point(300)), stands.push_back(true);
    occupancy.add(nodes.back());
  }
  for (std::size_t i = 0; i < nodes.size(); i += 3) {
    if (i % 2) {
      occupancy.remove(nodes[i]), stands[i] = false;
    } else {
      const Vec3 to = point(300);
      occupancy.move(nodes[i], to), nodes[i] = to;
    }
  }
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = point(350);
    float nearest = 1e9f;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (stands[k]) nearest = std::min(nearest, glm::length(nodes[k] - p));
    }
    if (nearest < (1.0f - kBlur) * radius) RC_ASSERT(occupancy.occupied(p));
    if (nearest > (1.0f + kBlur) * radius) RC_ASSERT(!occupancy.occupied(p));
  }
}

TEST(Occupancy, TheOccupiedSphereIsAsLargeAsTheRadiusSays) {
  Occupancy occupancy;
  Box3 room;
  room.add(Vec3{-1, 0, -1}), room.add(Vec3{1, 2, 1});
  const float radius = 0.6f;
  double occupied = 0, tested = 0;
  RandomStream random(1, 2, Purpose::statistics);
  for (int n = 0; n < 50; ++n) {
    occupancy.reset(room, radius, 1.0f);
    const Vec3 node{random.uniform(-0.3f, 0.3f), random.uniform(0.9f, 1.1f), random.uniform(-0.3f, 0.3f)};
    occupancy.add(node);
    for (int i = 0; i < 2000; ++i, ++tested) {
      const Vec3 p = node + Vec3{random.uniform(-0.8f, 0.8f), random.uniform(-0.8f, 0.8f), random.uniform(-0.8f, 0.8f)};
      occupied += occupancy.occupied(p);
    }
  }
  const double sphere = 4.0 / 3.0 * 3.14159265 * 0.6 * 0.6 * 0.6;
  EXPECT_NEAR(occupied / tested * 1.6 * 1.6 * 1.6 / sphere, 1.0, 0.03);
}

TEST(Occupancy, TheRoomItWasGivenChangesNothing) {
  Box3 small, large;
  small.add(Vec3{-0.1f, 0.0f, -0.1f}), small.add(Vec3{0.1f, 0.2f, 0.1f});
  large.add(Vec3{-5.0f, 0.0f, -4.0f}), large.add(Vec3{3.0f, 9.0f, 6.0f});
  Occupancy grown, roomy;
  grown.reset(small, 0.5f, 1.0f), roomy.reset(large, 0.5f, 1.0f);
  RandomStream random(3, 4, Purpose::statistics);
  const auto place = [&] {
    return Vec3{random.uniform(-2.0f, 2.0f), random.uniform(0.0f, 5.0f), random.uniform(-2.0f, 2.0f)};
  };
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = place();
    grown.add(p), roomy.add(p);
  }
  int occupied = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = place();
    ASSERT_EQ(grown.occupied(p), roomy.occupied(p));
    occupied += grown.occupied(p);
  }
  EXPECT_GT(occupied, 500);
  EXPECT_LT(occupied, 4500);
}

TEST(Occupancy, NothingStandsUndergroundNorWhereNoVoxelOfTheRegionIsNear) {
  crowns::CrownRegion east;
  east.low = {0.0f, 0.0f, -2.0f}, east.voxel_m = 0.5f, east.layer_m = 1.0f, east.cells = {4, 3, 8};
  east.bits.assign((4 * 3 * 8 + 63) / 64, ~std::uint64_t{0});
  Box3 room;
  room.add(Vec3{-1, 0, -1}), room.add(Vec3{1, 3, 1});
  Occupancy occupancy;
  const float radius = 0.6f, cell = radius * Occupancy::kCell;
  occupancy.reset(room, radius, 1.0f, &east, 2.0f);
  EXPECT_TRUE(occupancy.occupied({1.0f, -0.01f, 0.0f}));
  EXPECT_TRUE(occupancy.occupied({-cell - 0.01f, 1.0f, 0.0f}));
  EXPECT_FALSE(occupancy.occupied({0.01f, 1.0f, 0.0f}));
  EXPECT_FALSE(occupancy.occupied({0.01f, 3.5f, 0.0f})) << "the region has no lid";
}

RC_GTEST_PROP(Markers, TheNearestPerceivingBudWins, ()) {
  const auto coordinate = [](int reach) { return static_cast<float>(*rc::gen::inRange(-reach, reach)) * 0.01f; };
  const float reach = 1.0f, cos = 0.5f;
  std::vector<Competitor> buds;
  for (int i = *rc::gen::inRange(1, 60); i > 0; --i) {
    const Vec3 direction = normalised_or({coordinate(100), coordinate(100), coordinate(100)}, kUp);
    const bool beside = !buds.empty() && *rc::gen::inRange(0, 3) == 0;  // buds of a node stand at one place
    const Vec3 at = beside ? buds.back().at : Vec3{coordinate(200), coordinate(200), coordinate(200)};
    buds.push_back({at, static_cast<std::int32_t>(buds.size()), direction});
  }
  CompetitorIndex index;
  index.build(buds, reach, cos);
  for (int k = 0; k < 50; ++k) {
    const Vec3 p{coordinate(250), coordinate(250), coordinate(250)};
    std::int32_t best = -1;
    float best2 = reach * reach;
    for (const Competitor& b : buds) {
      const Vec3 to = p - b.at;
      const float square = glm::dot(to, to);
      if (square < best2 && glm::dot(to, b.direction) >= cos * std::sqrt(square)) best2 = square, best = b.bud;
    }
    RC_ASSERT(index.nearest(p, reach, -1) == best);
    RC_ASSERT(index.nearest_plainly(p, reach, -1) == best);
  }
}

TEST(Markers, SamplesFillThePerceptionVolumeEvenly) {
  PerceptionSamples samples;
  const float depth = 1.5f, cos = 0.5f;
  samples.reset(depth, cos, false);
  const auto n = PerceptionSamples::kCount;
  double inner = 0, narrow = 0;
  const float half_radius = std::cbrt(0.5f * (1.0f + 2.5f * 2.5f * 2.5f));  // halves the volume of the shell
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 p{samples.reader().x(i)[0], samples.reader().y(i)[0], samples.reader().z(i)[0]};
    const float radius = glm::length(p);
    EXPECT_GE(radius, 0.9999f);
    EXPECT_LE(radius, 1.0f + depth + 1e-4f);
    EXPECT_GE(p.z, cos * radius - 1e-4f);
    inner += radius<half_radius, narrow += p.z> 0.75f * radius;  // 0.75: halves the cone's solid angle
  }
  // The standard error of as many random points would be 0.0156.
  EXPECT_NEAR(inner / n, 0.5, 0.006);
  EXPECT_NEAR(narrow / n, 0.5, 0.006);
}

TEST(Age, HeightAndAgeAreInversesAndRise) {
  Parameters p;
  p.age_rate_per_year = 0.03f, p.age_shape = 1.3f;
  float last = 0.0f;
  for (float years = 5.0f; years < 120.0f; years += 5.0f) {
    const float share = height_share_at_age(p, years);
    EXPECT_GT(share, last);
    EXPECT_NEAR(age_at_height_share(p, share), years, 0.02f * years);
    last = share;
  }
  EXPECT_EQ(height_share_at_age(p, 0.0f), 0.0f);
}

TEST(Age, TheSeasonShownIsTheFirstThatIsHighEnough) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 1));
  for (const float height : {1.0f, 4.0f, 9.0f}) {
    const int season = season_at_height(s, height);
    EXPECT_GE(measure(s, season).height_m, height);
    ASSERT_GT(season, 0);
    EXPECT_LT(measure(s, season - 1).height_m, height);
  }
  EXPECT_EQ(season_at_height(s, 100.0f), s.seasons - 1);
}

TEST(Measure, ACrossOfTwoBranchesHasKnownDimensions) {
  // A trunk of 4 m and two level branches of 2 m to the east and west at 3 m, in internodes of 1 m.
  Skeleton s;
  const auto add = [&](int parent, int axis, int order, Vec3 end) {
    s.parent.push_back(parent), s.axis.push_back(static_cast<std::uint32_t>(axis));
    s.order.push_back(static_cast<std::uint8_t>(order)), s.distal.push_back(end);
    s.born.push_back(0), s.shed.push_back(kNever), s.light.push_back(1), s.vigor.push_back(1);
    s.radius.push_back(0.1f);
  };
  for (int i = 0; i < 4; ++i) add(i - 1, 0, 0, {0, static_cast<float>(i + 1), 0});
  add(2, 1, 1, {1, 3, 0}), add(4, 1, 1, {2, 3, 0});
  add(2, 2, 1, {-1, 3, 0}), add(6, 2, 1, {-2, 3, 0});
  s.seasons = 1;
  const Measures m = measure(s);
  EXPECT_FLOAT_EQ(m.height_m, 4.0f);
  EXPECT_FLOAT_EQ(m.crown_base_m, 3.0f);
  EXPECT_EQ(m.internodes, 8);
  EXPECT_FLOAT_EQ(m.trunk_diameter_m, 0.2f);
  EXPECT_NEAR(m.crown_centroid.x, 0.0f, 1e-6f);
  // The mean over eight azimuths of 4 m * |cos|: (1 + 2 cos 22.5 + 2 cos 45 + 2 cos 67.5) / 8.
  EXPECT_NEAR(m.crown_diameter_m, 4.0f * (1.0f + 2 * 0.9238795f + 2 * 0.7071068f + 2 * 0.3826834f) / 8.0f, 1e-4f);
}

}  // namespace
}  // namespace bosquet::growth
