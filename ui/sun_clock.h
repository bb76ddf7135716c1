// Sun clock: the day and the hour at which the sun stands where it does.
//
// Model     a coarse search over days and hours, then ever finer ones round the best. The sun stands twice a year at the
//           same declination: between two days as good, the one nearer to `near` is told
// Units     degrees; hours of the site's clock time; the year is that of `near`
// Accuracy  within kSameSun_deg of the sun that is asked for, else nothing
#pragma once

#include <optional>

#include "render/sun_position.h"

namespace bosquet::ui {

inline constexpr float kSameSun_deg = 0.5f;
inline constexpr int kDaysOfYear = 365;  ///< a year without a leap day

/// 1 to kDaysOfYear.
int day_of_year(const render::DateTime& when);
void set_day_of_year(render::DateTime& when, int day);

/// Nothing where the sun never stands there.
std::optional<render::DateTime> time_of_sun(const scene::Sun& sun, const render::Place& where,
                                            const render::DateTime& near);

}  // namespace bosquet::ui
