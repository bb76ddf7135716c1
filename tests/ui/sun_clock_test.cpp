#include "ui/sun_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bosquet::ui {
namespace {

TEST(SunClock, ADayAndHourIsFoundAgainFromWhereTheSunStood) {
  for (const double latitude : {-35.0, 0.0, 23.0, 48.0, 64.0})
    for (const double longitude : {-71.0, 10.0})
      for (const auto& [month, day, hour] :
           {std::tuple(1, 10, 11.0), {3, 21, 9.0}, {6, 21, 15.0}, {8, 17, 17.5}, {9, 21, 12.25}, {12, 21, 12.0}}) {
        const render::Place where{latitude, longitude, {}};
        const render::DateTime when{2026, month, day, hour};
        const scene::Sun sun = render::sun_position(when, where);
        if (sun.elevation_deg < 1.0f) continue;
        const auto found = time_of_sun(sun, where, when);
        ASSERT_TRUE(found) << latitude << " " << month;
        const scene::Sun again = render::sun_position(*found, where);
        EXPECT_LT(glm::length(again.direction() - sun.direction()), 0.01f) << latitude << " " << month;
        // Nearer than that no day can be told by the sun: it hardly rises from one to the next at a solstice.
        EXPECT_NEAR(found->hour, hour, latitude > -30 && latitude < 30 ? 1.0 : 0.2) << latitude << " " << month;
        EXPECT_NEAR(day_of_year(*found), day_of_year(when), month % 6 == 0 ? 12 : 3) << latitude << " " << month;
      }
}

TEST(SunClock, OfTwoDaysWithTheSameSunTheNearerIsTold) {
  const render::Place where{48, 9, {}};
  const scene::Sun sun = render::sun_position({2026, 4, 20, 12.0}, where);
  EXPECT_EQ(time_of_sun(sun, where, {2026, 3, 1, 0})->month, 4);
  EXPECT_EQ(time_of_sun(sun, where, {2026, 10, 1, 0})->month, 8);
}

TEST(SunClock, WhereTheSunNeverStandsThereIsNoTime) {
  EXPECT_FALSE(time_of_sun({0, 60}, {48, 9, {}}, {}));    // high in the north
  EXPECT_FALSE(time_of_sun({180, 89}, {60, 9, {}}, {}));  // overhead near the pole
  EXPECT_TRUE(time_of_sun({180, 41}, {48, 9, {}}, {}));
}

TEST(SunClock, DaysOfTheYearGoThereAndBack) {
  render::DateTime when;
  for (int day = 1; day <= kDaysOfYear; ++day) {
    set_day_of_year(when, day);
    EXPECT_EQ(day_of_year(when), day);
  }
  EXPECT_EQ(when.month, 12);
  EXPECT_EQ(when.day, 31);
}

}  // namespace
}  // namespace bosquet::ui
