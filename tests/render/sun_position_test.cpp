#include "render/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace bosquet::render {
namespace {

// Half a minute of arc time and refraction: what the formulas promise, with room for the published rounding.
constexpr float kTolerance = 0.05f;

TEST(SunPosition, AgreesWithTheExampleOfTheSolarPositionAlgorithm) {
  // Reda and Andreas 2004, NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024.
  const scene::Sun sun = sun_position({2003, 10, 17, 12 + 30.5 / 60}, {39.742476, -105.1786, -7.0});
  EXPECT_NEAR(sun.elevation_deg, 90 - 50.11162, kTolerance);
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, kTolerance);
}

TEST(SunPosition, AtThePoleStandsAtItsDeclination) {
  // Meeus 1998, example 25.a: declination -7.78507 on 13 October 1992 at 0 h.
  EXPECT_NEAR(sun_position({1992, 10, 13, 0.0}, {90, 0, 0.0}).elevation_deg, -7.78507, kTolerance);
}

float highest(int month, int day, double latitude_deg) {
  float best = -90;
  for (int minute = 0; minute < 24 * 60; ++minute)
    best = std::max(best, sun_position({2026, month, day, minute / 60.0}, {latitude_deg, 0, 0.0}).elevation_deg);
  return best;
}

TEST(SunPosition, CulminatesAtTheSolsticeAsHighAsTheTropicSays) {
  constexpr double kObliquity = 23.436;
  for (const double latitude : {60.0, 51.5, 40.0, 30.0, 0.0, -20.0}) {
    EXPECT_NEAR(highest(6, 21, latitude), 90 - std::abs(latitude - kObliquity), kTolerance) << latitude;
    // Low suns are lifted by refraction: 3 minutes of arc at 15 deg, 8 at 6.
    const double winter = 90 - std::abs(latitude + kObliquity);
    const double lift = winter > 20 ? 0 : 1 / 60.0 / std::tan(winter * 3.14159265 / 180);
    EXPECT_NEAR(highest(12, 21, latitude), winter + lift, kTolerance) << latitude;
  }
}

TEST(SunPosition, CrossesTheMeridianWhenTheEquationOfTimeSays) {
  // The Astronomical Almanac: sundials are 16.4 minutes fast on 3 November and 14.2 slow on 11 February.
  for (const auto& [month, day, noon_h] : {std::tuple{11, 3, 12 - 16.45 / 60}, std::tuple{2, 11, 12 + 14.22 / 60}}) {
    EXPECT_LT(sun_position({2026, month, day, noon_h - 0.01}, {50, 0, 0.0}).azimuth_deg, 180);
    EXPECT_GT(sun_position({2026, month, day, noon_h + 0.01}, {50, 0, 0.0}).azimuth_deg, 180);
  }
}

TEST(SunPosition, RisesInTheEastAndCulminatesTowardTheEquator) {
  for (const double latitude : {48.0, -33.9}) {
    EXPECT_NEAR(sun_position({2026, 3, 20, 6.5}, {latitude, 0, 0.0}).azimuth_deg, 90, 10) << latitude;
    EXPECT_NEAR(sun_position({2026, 3, 20, 17.7}, {latitude, 0, 0.0}).azimuth_deg, 270, 10) << latitude;
  }
  const float sydney = sun_position({2026, 12, 21, 11.9}, {-33.9, 151.2, 10.0}).azimuth_deg;
  EXPECT_TRUE(sydney > 345 || sydney < 15) << sydney;
}

TEST(SunPosition, TakesTheZoneNearestToTheLongitudeWhenNoneIsGiven) {
  EXPECT_EQ((Place{48, 9, {}}).offset(), 1);
  EXPECT_EQ((Place{48, -118, {}}).offset(), -8);
  const scene::Sun a = sun_position({2026, 6, 21, 15}, {48, 9, {}}), b = sun_position({2026, 6, 21, 14}, {48, 9, 0.0});
  EXPECT_EQ(a.azimuth_deg, b.azimuth_deg);
}

TEST(SunFromText, ReadsADateWithTimeAndAPairOfAngles) {
  const Place place{48, 9, 2.0};
  const Result<scene::Sun> by_date = sun_from_text("2026-06-21 15:00", place);
  ASSERT_TRUE(by_date) << by_date.error().message;
  EXPECT_EQ(by_date->elevation_deg, sun_position({2026, 6, 21, 15.0}, place).elevation_deg);
  const Result<scene::Sun> by_angles = sun_from_text("212.5, 38", place);
  ASSERT_TRUE(by_angles) << by_angles.error().message;
  EXPECT_EQ(by_angles->azimuth_deg, 212.5f);
  EXPECT_EQ(by_angles->elevation_deg, 38.0f);
}

TEST(SunFromText, RefusesWhatIsNoSunAndSaysWhatIsAllowed) {
  for (const char* text : {"", "noon", "2026-06-21", "2026-02-29 12:00", "2026-13-01 12:00", "2026-06-21 24:00", "10",
                           "10,95", "10,-5", "nan,10", "10,20,30", "2026-06-21 15:00 ", "2026-06-21 02:00"}) {
    const Result<scene::Sun> sun = sun_from_text(text, {48, 9, 1.0});
    ASSERT_FALSE(sun) << text;
    EXPECT_EQ(sun.error().kind, ErrorKind::input);
    EXPECT_NE(sun.error().message.find(std::string("\"") + text + "\""), std::string::npos) << sun.error().message;
  }
  EXPECT_NE(sun_from_text("2026-06-21 02:00", {48, 9, 1.0}).error().message.find("below the horizon"),
            std::string::npos);
  EXPECT_NE(sun_from_text("soon", {48, 9, 1.0}).error().message.find("azimuth,elevation"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::render
