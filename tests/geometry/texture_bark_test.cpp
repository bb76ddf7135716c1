#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "geometry/bark_texture.h"
#include "geometry/ground_texture.h"
#include "tests/geometry/texture_checks.h"
#include "tests/geometry/texture_looks.h"

namespace bosquet::geometry {
namespace {

const std::vector<std::string> kBarks{"english_oak", "silver_birch", "norway_spruce", "weeping_willow"};

class Bark : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Species, Bark, testing::ValuesIn(kBarks), [](const auto& species) { return species.param; });

TEST_P(Bark, TilesInBothDirections) {
  const BarkTextures bark = make_bark(species_look(GetParam()), 11, 256);
  EXPECT_TRUE(tiles(bark.base_colour));
  EXPECT_TRUE(tiles(bark.normal));
}

TEST_P(Bark, NormalsAreUnitVectorsOutOfTheWood) {
  // Three channels rounded by half a step of 1/127.5 each.
  EXPECT_LT(worst_normal(make_bark(species_look(GetParam()), 11, 128).normal), std::sqrt(3.0f) / 255.0f + 1e-4f);
}

TEST_P(Bark, IsTheSameForAnyNumberOfThreads) {
  const Look look = species_look(GetParam());
  BarkTextures first;
  run_with_threads(1, [&] { first = make_bark(look, 5, 128); });
  for (const int threads : {2, 3, 8}) {
    run_with_threads(threads, [&] {
      const BarkTextures again = make_bark(look, 5, 128);
      EXPECT_EQ(again.base_colour.pixels, first.base_colour.pixels);
      EXPECT_EQ(again.normal.pixels, first.normal.pixels);
    });
  }
  EXPECT_NE(make_bark(look, 6, 128).base_colour.pixels, first.base_colour.pixels);
}

TEST_P(Bark, OldTrunksHaveAboutTheColourTheSpeciesGives) {
  const Look look = species_look(GetParam());
  const Vec3 mean = mean_linear(make_bark(look, 3, 256).base_colour) * bark_tint(look, 3.0f, 10.0f);
  const float given = luminance(linear_from_srgb(look.bark.colour));
  // Furrows, rhombs and lenticels are darker than the ridges that the colour names, nothing is brighter as a whole.
  EXPECT_GT(luminance(mean), 0.45f * given);
  EXPECT_LT(luminance(mean), 1.05f * given);
}

TEST(BarkTexture, TheFourSpeciesDiffer) {
  std::vector<Vec3> means;
  std::vector<double> upright;  // how much more the picture changes across the trunk than along it
  for (const std::string& name : kBarks) {
    const Look look = species_look(name);
    const Image image = make_bark(look, 7, 256).base_colour;
    means.push_back(mean_linear(image) * bark_tint(look, 3.0f, 10.0f));
    double columns = 0, rows = 0;
    for (int i = 0; i < image.width; ++i) columns += column_step(image, i), rows += row_step(image, i);
    upright.push_back(columns / rows);
  }
  EXPECT_GT(luminance(means[1]), 3.0f * luminance(means[0]));  // birch is white
  EXPECT_GT(upright[0], 1.15);                                 // oak: furrows run up the trunk
  EXPECT_LT(upright[1], 0.85);                                 // birch: lenticels run round it
  EXPECT_GT(upright[2], 0.85);                                 // spruce: round scales, neither way
  EXPECT_LT(upright[2], 1.15);
  EXPECT_GT(means[3].r / means[3].b, 1.1f * means[0].r / means[0].b);  // willow is browner than oak
}

TEST(BarkTint, IsAFactorThatMakesThickWoodOldAndThinWoodTwig) {
  for (const std::string& name : kBarks) {
    const Look look = species_look(name);
    const Vec3 reference = bark_reference(look);
    for (const float diameter : {0.0f, 0.001f, 0.01f, 0.05f, 0.2f, 1.0f, 5.0f}) {
      for (const float height : {0.0f, 0.5f, 1.0f, 20.0f}) {
        const Vec3 tint = bark_tint(look, diameter, height);
        for (int c = 0; c < 3; ++c) {
          EXPECT_GE(tint[c], 0.0f);
          EXPECT_LE(tint[c], 1.0f);
        }
      }
    }
    const auto expect_colour = [&](const Vec3& seen, const Vec3& srgb_colour) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], linear_from_srgb(srgb_colour)[c], 1e-5f) << name;
    };
    expect_colour(bark_tint(look, 3.0f, 20.0f) * reference, look.bark.colour);
    expect_colour(bark_tint(look, 3.0f, 0.0f) * reference, look.bark.base_colour);
    expect_colour(bark_tint(look, 0.0f, 20.0f) * reference, look.leaf.twig_colour);
  }
}

TEST(GroundTexture, TilesWithUnitNormalsAndThePromisedMean) {
  const GroundTextures ground = make_ground(4, 256);
  EXPECT_TRUE(tiles(ground.base_colour));
  EXPECT_TRUE(tiles(ground.normal));
  EXPECT_LT(worst_normal(ground.normal), std::sqrt(3.0f) / 255.0f + 1e-4f);
  const Vec3 mean = mean_linear(ground.base_colour);
  // What is brighter than white is cut, which darkens the mean a little.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], kGroundMean[c], 0.02f * kGroundMean[c]);
  for (const Vec3& albedo : {kMeadowColour, kForestFloorColour, kSoilColour, kGravelColour, kWetSandColour}) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ground_tint(albedo)[c] * kGroundMean[c], albedo[c], 1e-6f);
  }
}

TEST(GroundTexture, IsTheSameForAnyNumberOfThreads) {
  GroundTextures first;
  run_with_threads(1, [&] { first = make_ground(5, 128); });
  run_with_threads(8, [&] {
    const GroundTextures again = make_ground(5, 128);
    EXPECT_EQ(again.base_colour.pixels, first.base_colour.pixels);
    EXPECT_EQ(again.normal.pixels, first.normal.pixels);
  });
}

}  // namespace
}  // namespace bosquet::geometry
