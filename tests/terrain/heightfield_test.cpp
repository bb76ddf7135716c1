#include "terrain/heightfield.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "terrain/perlin.h"

namespace bosquet::terrain {
namespace {

Lattice lattice(Vec2 size_m) { return *make_lattice(size_m); }

TEST(Lattice, CellsAreHalfAMetreUntilASideWouldHaveMoreThan4096) {
  EXPECT_EQ(lattice({30, 30}).cell_m, 0.5f);
  EXPECT_EQ(lattice({30, 30}).cells, IVec2(60, 60));
  EXPECT_EQ(lattice({2048, 100}).cell_m, 0.5f);
  EXPECT_EQ(lattice({8192, 100}).cell_m, 2.0f);
  EXPECT_EQ(lattice({200'000, 1}).cells.x, 4096);
  EXPECT_EQ(lattice({200'000, 1}).cells.y, 1);
}

TEST(Lattice, ItsCellsCoverASideThatIsNoWholeNumberOfThem) {
  EXPECT_EQ(lattice({30.2f, 30.0f}).cells, IVec2(61, 60));
  EXPECT_EQ(make_lattice({30.0f, 30.0f}, 0.1f)->cells, IVec2(300, 300));  // 0.1 is not a binary fraction
}

TEST(Lattice, ASiteOfZeroOrAbsurdSizeIsRefusedWithTheAllowedRange) {
  for (const Vec2 size : {Vec2{0, 30}, Vec2{30, -1}, Vec2{0.9f, 30}, Vec2{200'001, 30},
                          Vec2{std::numeric_limits<float>::quiet_NaN(), 30}}) {
    const auto made = make_lattice(size);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("from 1 m to 200 km"), std::string::npos) << made.error().message;
  }
}

RC_GTEST_PROP(Heightfield, BilinearHeightsReproduceAnyPlaneEverywhere, ()) {
  const float east = static_cast<float>(*rc::gen::inRange(-200, 200)) / 100.0f;
  const float north = static_cast<float>(*rc::gen::inRange(-200, 200)) / 100.0f;
  const Heightfield field(lattice({90.3f, 47.0f}), [&](Vec2 p) { return 3.0f + east * p.x + north * p.y; });
  for (int n = 0; n < 50; ++n) {
    const Vec2 p{static_cast<float>(*rc::gen::inRange(0, 9030)) / 100.0f,
                 static_cast<float>(*rc::gen::inRange(0, 4700)) / 100.0f};
    RC_ASSERT(std::abs(field.at(p) - (3.0f + east * p.x + north * p.y)) < 1e-4f * 300.0f);
    const Vec2 gradient = field.gradient(p);
    RC_ASSERT(std::abs(gradient.x - east) < 1e-3f);
    RC_ASSERT(std::abs(gradient.y - north) < 1e-3f);
  }
}

TEST(Heightfield, NormalsPointAwayFromTheRiseInWorldAxes) {
  // Rising to the north: the ground faces south, which is +z.
  const Heightfield north(lattice({20, 20}), [](Vec2 p) { return p.y; });
  const Vec3 n = north.normal({10, 10});
  EXPECT_NEAR(n.x, 0.0f, 1e-5f);
  EXPECT_NEAR(n.y, std::sqrt(0.5f), 1e-5f);
  EXPECT_NEAR(n.z, std::sqrt(0.5f), 1e-5f);
  const Heightfield east(lattice({20, 20}), [](Vec2 p) { return p.x; });
  EXPECT_NEAR(east.normal({10, 10}).x, -std::sqrt(0.5f), 1e-5f);
}

TEST(Heightfield, NormalsOfASphereConvergeWithTheSquareOfTheCell) {
  // A cap of radius 100 m; the error of central differences falls fourfold when the cell is halved.
  const auto error = [](float cell) {
    const Heightfield cap(*make_lattice({64, 64}, cell), [](Vec2 p) {
      const Vec2 d = p - Vec2{32};
      return std::sqrt(10'000.0f - d.x * d.x - d.y * d.y);
    });
    double sum = 0.0;
    int count = 0;
    for (float y = 12.3f; y < 52; y += 4)
      for (float x = 12.3f; x < 52; x += 4, ++count) {
        const Vec2 d = Vec2{x, y} - Vec2{32};
        const Vec2 exact = -d / std::sqrt(10'000.0f - d.x * d.x - d.y * d.y);
        sum += glm::length(cap.gradient({x, y}) - exact);
      }
    return sum / count;
  };
  EXPECT_GT(error(8.0f) / error(4.0f), 3.0);
}

TEST(Heightfield, PlacesOutsideTheSiteAreReadAtItsNearestEdge) {
  const Heightfield field(lattice({20, 10}), [](Vec2 p) { return p.x + 100.0f * p.y; });
  EXPECT_EQ(field.at({-5, 5}), field.at({0, 5}));
  EXPECT_EQ(field.at({25, 15}), field.at({20, 10}));
  EXPECT_EQ(field.at({std::numeric_limits<float>::quiet_NaN(), 5}), field.at({0, 5}));
}

TEST(Heightfield, SamplesStandOnCellCornersTheSouthernRowFirst) {
  const Lattice l = *make_lattice({3, 2}, 1.0f);
  const std::vector<float> samples{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23};
  const auto field = Heightfield::from_samples(l, samples);
  ASSERT_TRUE(field);
  EXPECT_EQ(field->at({0, 0}), 0.0f);
  EXPECT_EQ(field->at({3, 0}), 3.0f);
  EXPECT_EQ(field->at({0, 2}), 20.0f);
  EXPECT_EQ(field->at({1.5f, 0.5f}), 6.5f);
  EXPECT_EQ(field->range().low, 0.0f);
  EXPECT_EQ(field->range().high, 23.0f);
}

TEST(Heightfield, AMissingOrBrokenSampleIsRefused) {
  const Lattice l = *make_lattice({1, 1}, 1.0f);
  EXPECT_FALSE(Heightfield::from_samples(l, std::vector<float>{1, 2, 3}));
  const auto broken = Heightfield::from_samples(l, std::vector<float>{1, 2, std::nanf(""), 4});
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("0 m east, 1 m north"), std::string::npos) << broken.error().message;
}

TEST(Perlin, NoiseStaysWithinItsAmplitudeAndIsNotFlat) {
  const PerlinNoise noise{0.5f, 20.0f, 5};
  float low = 0.0f, high = 0.0f;
  for (float y = 0; y < 200; y += 0.7f)
    for (float x = 0; x < 200; x += 0.7f) {
      const float h = perlin_height(noise, 7, {x, y});
      low = std::min(low, h), high = std::max(high, h);
    }
  EXPECT_GE(low, -0.5f);
  EXPECT_LE(high, 0.5f);
  EXPECT_LT(low, -0.15f);
  EXPECT_GT(high, 0.15f);
}

TEST(Perlin, NoiseIsContinuousAndItsLargestBumpsAreItsScaleApart) {
  const PerlinNoise noise{1.0f, 20.0f, 1};
  for (float x = 0; x < 100; x += 0.37f)
    EXPECT_LT(std::abs(perlin_height(noise, 3, {x, 11}) - perlin_height(noise, 3, {x + 0.01f, 11})), 0.005f);
  // One octave vanishes on the corners of its lattice.
  for (int n = 0; n < 10; ++n) EXPECT_NEAR(perlin_height(noise, 3, {20.0f * static_cast<float>(n), 40}), 0.0f, 1e-6f);
}

TEST(Perlin, AnotherSeedMakesAnotherGround) {
  const Heightfield flat(lattice({30, 30}));
  const Heightfield a = with_noise(flat, {}, 1), b = with_noise(flat, {}, 2), again = with_noise(flat, {}, 1);
  EXPECT_NE(a.at({11.3f, 7.9f}), b.at({11.3f, 7.9f}));
  for (int n = 0; n <= 60; ++n) EXPECT_EQ(a.sample(n, 17), again.sample(n, 17));
}

}  // namespace
}  // namespace bosquet::terrain
