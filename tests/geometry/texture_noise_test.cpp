#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/noise.h"
#include "geometry/texture_colour.h"
#include "geometry/texture_relief.h"
#include "tests/geometry/texture_checks.h"

namespace bosquet::geometry {
namespace {

TEST(TileNoise, RepeatsAfterOneTileToTheLastBit) {
  const TileNoise noise(1, 2, 8, 6);
  const TileFractal fractal(1, 3, 4, 4, 3);
  // Sixteenths and whole tiles are exact in float, so equality is too.
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float u = static_cast<float>(x) / 16.0f, v = static_cast<float>(y) / 16.0f;
      EXPECT_EQ(noise(u, v), noise(u + 1.0f, v - 2.0f));
      EXPECT_EQ(fractal(u, v), fractal(u - 1.0f, v + 1.0f));
    }
  }
}

TEST(TileNoise, StaysNearItsRangeWithMeanZero) {
  const TileNoise noise(5, 1, 32, 32);
  double sum = 0;
  float low = 0, high = 0;
  constexpr int kSide = 256;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float n = noise((static_cast<float>(x) + 0.5f) / kSide, (static_cast<float>(y) + 0.5f) / kSide);
      sum += n, low = std::min(low, n), high = std::max(high, n);
    }
  }
  EXPECT_GE(low, -1.0f);  // |gradient . offset| <= sqrt(1/2) where four corners agree, times sqrt(2)
  EXPECT_LE(high, 1.0f);
  EXPECT_GT(high - low, 1.0f);
  // 1024 nearly independent cells of standard deviation about 0.35: five standard errors.
  EXPECT_NEAR(sum / kSide / kSide, 0.0, 5 * 0.35 / 32);
}

TEST(TileCells, FindsItsOwnCentresAndNothingElseWithinTheBordersDistance) {
  const TileCells cells(3, 4, 4, 6, 0.9f);
  for (int i = 0; i < 400; ++i) {
    RandomStream stream(8, static_cast<std::uint64_t>(i), Purpose::texture);
    const float u = stream.uniform(), v = stream.uniform();
    const TileCells::Hit hit = cells(u, v);
    // The centre lies where the offset says; from there the same cell is found, at offset zero.
    const Vec2 centre{u - hit.offset.x / 4.0f, v - hit.offset.y / 6.0f};
    const TileCells::Hit home = cells(centre.x, centre.y);
    EXPECT_EQ(home.cell, hit.cell);
    EXPECT_NEAR(home.offset.x, 0.0f, 1e-4f);
    EXPECT_NEAR(home.offset.y, 0.0f, 1e-4f);
    // Within the border's distance nothing else is met; the border is not far either.
    for (int k = 0; k < 16; ++k) {
      const SinCos a = sin_cos(static_cast<float>(k) * kPi / 8.0f);
      const float r = 0.98f * hit.border;
      EXPECT_EQ(cells(u + r * a.cos / 4.0f, v + r * a.sin / 6.0f).cell, hit.cell);
    }
    EXPECT_LT(hit.border, 1.2f);
    EXPECT_NE(hit.second, hit.cell);
  }
}

TEST(TileCells, RandomsOfABorderAreTheSameFromBothSides) {
  const TileCells cells(3, 4, 4, 4, 0.5f);
  EXPECT_EQ(cells.random(3, 7, 1), cells.random(7, 3, 1));
  EXPECT_NE(cells.random(3, 7, 1), cells.random(3, 7, 2));
  EXPECT_NE(cells.random(3, 1), cells.random(4, 1));
}

TEST(TextureColour, EveryByteSurvivesTheWayThroughLinearLight) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(srgb_byte(linear_from_srgb(static_cast<float>(byte) / 255.0f)), byte);
  }
  EXPECT_EQ(srgb_byte(-1.0f), 0);
  EXPECT_EQ(srgb_byte(2.0f), 255);
}

TEST(TextureRelief, ASineWaveHasTheNormalsOfItsDerivative) {
  constexpr int kSize = 256;
  Relief relief(kSize, 2.0f);  // two metres: one wave, 0.1 m high
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) relief.at(x, y) = 0.1f * sin_cos(2.0f * kPi * static_cast<float>(x) / kSize).sin;
  }
  const Image normals = normal_map(relief, 1000.0f);
  for (int x = 0; x < kSize; x += 7) {
    const float slope = 0.1f * kPi * sin_cos(2.0f * kPi * static_cast<float>(x) / kSize).cos;
    const float expected = -slope / std::sqrt(1.0f + slope * slope);
    EXPECT_NEAR(static_cast<float>(normals.at(x, 9)[0]) / 127.5f - 1.0f, expected,
                1.0f / 127.0f);  // half a step, and rounding
    EXPECT_NEAR(static_cast<float>(normals.at(x, 9)[1]) / 127.5f - 1.0f, 0.0f, 1.0f / 127.0f);
  }
}

TEST(TextureRelief, UpInTheImageIsPlusY) {
  // A roof whose ridge runs through the middle row: above it the ground falls upward, so normals lean up.
  constexpr int kSize = 64;
  Relief relief(kSize, 64.0f);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) relief.at(x, y) = -std::fabs(static_cast<float>(y) - 32.0f);
  }
  const Image normals = normal_map(relief, 10.0f);
  EXPECT_GT(normals.at(10, 16)[1], 200);
  EXPECT_LT(normals.at(10, 48)[1], 55);
}

TEST(TextureRelief, HollownessIsPositiveInAPitAndSumsToZero) {
  Relief relief(64, 1.0f);
  relief.at(3, 60) = -1.0f;
  const Relief hollow = hollowness(relief, 2);
  EXPECT_NEAR(hollow.at(3, 60), 24.0f / 25.0f, 1e-6f);
  EXPECT_NEAR(hollow.at(5, 62), -1.0f / 25.0f, 1e-6f);
  double sum = 0;
  for (const float h : hollow.heights) sum += h;
  EXPECT_NEAR(sum, 0.0, 1e-4);
}

}  // namespace
}  // namespace bosquet::geometry
