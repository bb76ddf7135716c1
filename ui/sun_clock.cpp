#include "ui/sun_clock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.h"

namespace bosquet::ui {
namespace {

constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
constexpr int kShortestDay = 355, kLongestDay = 172;  ///< solstices, north of the equator
constexpr int kCoarseDays = 8;
constexpr double kCoarseHours = 0.5, kFineHours = 1.0 / 60.0;

struct Found {
  int day = 0;
  double hour = 0, off_deg = 1e9;
};

render::DateTime at(int day, double hour, int year) {
  render::DateTime when{year, 1, 1, hour};
  set_day_of_year(when, day);
  return when;
}

// The best of days first..last and hours from..to, which may reach over the ends of the year and of the day.
Found best(const Vec3& toward, const render::Place& where, int year, int first, int last, int days, double from,
           double to, double hours) {
  Found found;
  for (int d = first; d <= last; d += days) {
    const int day = (d - 1 + kDaysOfYear) % kDaysOfYear + 1;
    for (double hour = std::max(0.0, from); hour <= std::min(24.0, to) + 1e-9; hour += hours) {
      const Vec3 there = render::sun_position(at(day, hour, year), where).direction();
      // The chord, which keeps its digits where the angle is small.
      const double off = static_cast<double>(2.0f * std::asin(std::min(1.0f, 0.5f * glm::length(there - toward))));
      const double off_deg = off * 180.0 / static_cast<double>(kPi);
      if (off_deg < found.off_deg) found = {day, hour, off_deg};
    }
  }
  return found;
}

int days_between(int a, int b) {
  const int apart = std::abs(a - b);
  return std::min(apart, kDaysOfYear - apart);
}

}  // namespace

int day_of_year(const render::DateTime& when) {
  int day = std::min(when.day, kDays[static_cast<std::size_t>(when.month - 1)]);
  for (int m = 0; m + 1 < when.month; ++m) day += kDays[static_cast<std::size_t>(m)];
  return day;
}

void set_day_of_year(render::DateTime& when, int day) {
  int month = 1;
  for (; month < 12 && day > kDays[static_cast<std::size_t>(month - 1)]; ++month)
    day -= kDays[static_cast<std::size_t>(month - 1)];
  when.month = month, when.day = day;
}

std::optional<render::DateTime> time_of_sun(const scene::Sun& sun, const render::Place& where,
                                            const render::DateTime& near) {
  const Vec3 toward = sun.direction();
  const auto half = [&](int first, int last) {
    Found f = best(toward, where, near.year, first, last, kCoarseDays, 0, 24, kCoarseHours);
    f = best(toward, where, near.year, f.day - kCoarseDays, f.day + kCoarseDays, 2, f.hour - kCoarseHours,
             f.hour + kCoarseHours, 0.1);
    return best(toward, where, near.year, f.day - 2, f.day + 2, 1, f.hour - 0.1, f.hour + 0.1, kFineHours);
  };
  const Found rising = half(kShortestDay - kDaysOfYear, kLongestDay), falling = half(kLongestDay, kShortestDay);
  const int wanted = day_of_year(near);
  const bool both = std::max(rising.off_deg, falling.off_deg) < static_cast<double>(kSameSun_deg);
  const bool first =
      both ? days_between(rising.day, wanted) <= days_between(falling.day, wanted) : rising.off_deg <= falling.off_deg;
  const Found& found = first ? rising : falling;
  if (found.off_deg >= static_cast<double>(kSameSun_deg)) return {};
  return at(found.day, found.hour, near.year);
}

}  // namespace bosquet::ui
