// Every built-in species against the botanical figures in its file: 20 free-standing trees each.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/calibration.h"

namespace bosquet::scene {
namespace {

std::vector<std::string> with_sizes() {
  std::vector<std::string> names;
  for (const std::string& name : builtin_species_names())
    if (auto species = builtin_species(name); species && !species->sizes.empty()) names.push_back(name);
  return names;
}

std::string named(const ::testing::TestParamInfo<std::string>& of) { return of.param; }

class BuiltinSpecies : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    auto read = builtin_species(GetParam());
    ASSERT_TRUE(read) << read.error().message;
    species_ = std::move(*read);
    auto measured = calibrate(species_, {20, false});
    ASSERT_TRUE(measured);
    calibration_ = std::move(*measured);
  }
  Species species_;
  Calibration calibration_;
};

// The file's numbers are rounded, and a change to growth may move them a little before it must be calibrated again with
// `bosquet species calibrate NAME -o scene/species/NAME.toml`.
TEST_P(BuiltinSpecies, FileSaysWhatItsTreesMeasure) {
  const crowns::RepresentativeShape& shape = species_.shape;
  const growth::Measures& m = calibration_.mature;
  EXPECT_NEAR(m.height_m / shape.mature_height_m, 1.0f, 0.03f);
  EXPECT_NEAR(m.crown_diameter_m / shape.crown_width_m, 1.0f, 0.05f);
  EXPECT_NEAR(m.crown_base_m, shape.trunk_height_m, std::max(0.2f, 0.05f * shape.trunk_height_m));
  EXPECT_NEAR(calibration_.trunk_of_file_m / shape.trunk_width_m, 1.0f, 0.05f);
}

using SizedSpecies = BuiltinSpecies;

TEST_P(SizedSpecies, CrownAndTrunkEmergeInTheirBandsAtEachAge) {
  for (const AgeMeasures& at : calibration_.ages) {
    const auto band = allowed_deviation(at.age_years);
    if (!band) continue;
    EXPECT_NEAR(at.mean.height_m / at.target->height_m, 1.0f, *band) << "height at " << at.age_years;
    EXPECT_NEAR(at.mean.crown_diameter_m / at.target->crown_m, 1.0f, *band) << "crown at " << at.age_years;
    EXPECT_NEAR(100.0f * at.trunk_of_file_m / at.target->trunk_cm, 1.0f, *band) << "trunk at " << at.age_years;
  }
}

TEST_P(SizedSpecies, PipeExponentIsThatOfTheLastTrunkAndBelievable) {
  ASSERT_TRUE(calibration_.exponent_solved);
  EXPECT_NEAR(species_.growth.pipe_exponent, calibration_.pipe_exponent, 0.02f);
  EXPECT_GE(calibration_.pipe_exponent, kLeastExponent);
  EXPECT_LE(calibration_.pipe_exponent, kGreatestExponent);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinSpecies, ::testing::ValuesIn(builtin_species_names()), named);
INSTANTIATE_TEST_SUITE_P(All, SizedSpecies, ::testing::ValuesIn(with_sizes()), named);

}  // namespace
}  // namespace bosquet::scene
