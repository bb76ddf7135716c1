#include "scene/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/scalar.h"
#include "growth/age.h"

namespace bosquet::scene {
namespace {

constexpr CalibrationOptions kFew{3, false};

Species species_in(const std::string& text) {
  auto file = TomlFile::parse(text, "test.toml");
  EXPECT_TRUE(file) << file.error().message;
  Species species;
  TomlTable root = file->root();
  root.text("name");
  read_species_tables(root, species);
  root.finish();
  const auto fine = file->check();
  EXPECT_TRUE(fine) << fine.error().message;
  return species;
}

std::string mistake_in(const std::string& text) {
  auto file = TomlFile::parse(text, "test.toml");
  EXPECT_TRUE(file) << file.error().message;
  Species species;
  TomlTable root = file->root();
  read_species_tables(root, species);
  const auto fine = file->check();
  return fine ? "" : fine.error().message;
}

// A small, quick tree.
constexpr std::string_view kShrub = R"(name = "shrub"
[shape]  # measured
trunk_width_m = 0.30
trunk_height_m = 1.0   # crown base
crown_width_m = 3

mature_height_m = 6
[growth]
internode_length_m = 0.15
pipe_exponent=2.2
)";

TEST(SizeRows, AreReadInOrderOfAge) {
  const Species s = species_in(
      "[[size]]\nage_years = 10\nheight_m = 4\ncrown_m = 2\ntrunk_cm = 5\n"
      "[[size]]\nage_years = 100\nheight_m = 24\ncrown_m = 15\ntrunk_cm = 75\nwidest_point = 0.4\n");
  ASSERT_EQ(s.sizes.size(), 2u);
  EXPECT_EQ(s.sizes[0].crown_m, 2.0f);
  EXPECT_EQ(s.sizes[1].age_years, 100.0f);
  EXPECT_EQ(s.sizes[1].widest_point, 0.4f);
}

TEST(SizeRows, AMistakeIsToldWithItsLine) {
  EXPECT_EQ(mistake_in("\n[[size]]\nage_years = 10\nheight_m = 4\ntrunk_cm = 5\n"),
            "test.toml:2: this [[size]] lacks 'crown_m'");
  EXPECT_EQ(mistake_in("[[size]]\nage_years = 10\nheigth_m = 4\ncrown_m = 2\ntrunk_cm = 5\n"),
            "test.toml:3: unknown key 'heigth_m'; did you mean 'height_m'?");
  const std::string row = "[[size]]\nage_years = 30\nheight_m = 4\ncrown_m = 2\ntrunk_cm = 5\n";
  EXPECT_EQ(mistake_in(row + row), "test.toml:7: age_years = 30 must be above that of the [[size]] before it, 30");
  EXPECT_NE(mistake_in("[[size]]\nage_years = 10\nheight_m = -4\ncrown_m = 2\ntrunk_cm = 5\n").find("test.toml:3:"),
            std::string::npos);
}

TEST(CalibratedText, ReplacesNumbersAndNothingElse) {
  Calibration c;
  c.mature.crown_base_m = 1.449f, c.mature.crown_diameter_m = 4.04f, c.mature.trunk_diameter_m = 0.256f;
  c.pipe_exponent = 1.9174f;
  const auto text = calibrated_text(kShrub, c);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, R"(name = "shrub"
[shape]  # measured
trunk_width_m = 0.26
trunk_height_m = 1.4   # crown base
crown_width_m = 4

mature_height_m = 6
[growth]
internode_length_m = 0.15
pipe_exponent=1.917
)");
  EXPECT_EQ(*calibrated_text(*text, c), *text);
}

TEST(CalibratedText, AddsAKeyThatIsMissingToItsTable) {
  EXPECT_EQ(*with_number("[a]\r\nx = 1\r\n[b]  # two\nx = 2\n", "b", "y", "3"),
            "[a]\r\nx = 1\r\n[b]  # two\ny = 3\nx = 2\n");
  EXPECT_EQ(*with_number("[b]", "b", "y", "3"), "[b]\ny = 3\n");
  EXPECT_FALSE(with_number("[a]\ny = 1\n", "b", "y", "3"));
}

TEST(CalibratedText, TouchesNoKeyOfAnotherTableNorAComment) {
  EXPECT_EQ(*with_number("[[b.c]]\ny = 1\n[b]\n# y = 2\nyy = 5\ny = 3# old\n", "b", "y", "7"),
            "[[b.c]]\ny = 1\n[b]\n# y = 2\nyy = 5\ny = 7# old\n");
}

TEST(Calibration, TheSolvedExponentMakesTheTrunkOfTheLastRow) {
  Species s = species_in(std::string(kShrub) + "[[size]]\nage_years=40\nheight_m=4\ncrown_m=3\ntrunk_cm=13\n");
  const auto first = calibrate(s, kFew);
  ASSERT_TRUE(first);
  ASSERT_TRUE(first->exponent_solved);
  EXPECT_NEAR(first->ages.back().mean.trunk_diameter_m, 0.13f, 1e-4f);
  // A tree that grows with it has that trunk.
  s.growth.pipe_exponent = first->pipe_exponent;
  EXPECT_NEAR(calibrate(s, kFew)->ages.back().trunk_of_file_m, 0.13f, 1e-4f);
}

TEST(Calibration, ATrunkThatNoExponentMakesIsToldAndTheFilesExponentStays) {
  const Species s = species_in(std::string(kShrub) + "[[size]]\nage_years=40\nheight_m=4\ncrown_m=3\ntrunk_cm=0.2\n");
  const auto c = calibrate(s, kFew);
  ASSERT_TRUE(c);
  EXPECT_FALSE(c->exponent_solved);
  EXPECT_EQ(c->pipe_exponent, s.growth.pipe_exponent);
}

TEST(Calibration, HeightsOnACurveFitThatCurve) {
  Species s = species_in(std::string(kShrub));
  growth::Parameters p = s.growth;
  p.age_rate_per_year = 0.042f, p.age_shape = 1.7f;
  for (float age : {5.0f, 20.0f, 45.0f, 80.0f})
    s.sizes.push_back({age, 6.0f * growth::height_share_at_age(p, age), 2.0f, 5.0f, 0.0f});
  const auto c = calibrate(s, kFew);
  ASSERT_TRUE(c && c->fitted);
  for (float age : {5.0f, 12.0f, 60.0f, 150.0f})
    EXPECT_NEAR(growth::height_share_at_age(*c->fitted, age), growth::height_share_at_age(p, age), 0.005f) << age;
}

TEST(Calibration, IsTheSameAgain) {
  const Species s = species_in(std::string(kShrub));
  const auto a = calibrate(s, kFew), b = calibrate(s, kFew);
  EXPECT_EQ(a->mature.crown_diameter_m, b->mature.crown_diameter_m);
  EXPECT_EQ(a->mature.trunk_diameter_m, b->mature.trunk_diameter_m);
}

TEST(Calibration, ACancelledRunSaysSo) {
  Progress progress;
  progress.cancel();
  const auto c = calibrate(species_in(std::string(kShrub)), kFew, &progress);
  ASSERT_FALSE(c);
  EXPECT_EQ(c.error().kind, ErrorKind::cannot_finish);
}

}  // namespace
}  // namespace bosquet::scene
