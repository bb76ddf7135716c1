// Sun position: where the sun stands at a date, time and place.
//
// Source    The Astronomical Almanac, "low precision formulas for the Sun" (0.01 deg, 1950-2050), sidereal time after
//           the same; refraction after Bennett 1982 as corrected by Saemundsson
// Units     degrees; longitude east positive; time in hours; azimuth from north clockwise
// Accuracy  better than 0.05 deg from 1950 to 2050 (tested against published positions)
#pragma once

#include <optional>
#include <string_view>

#include "core/result.h"
#include "scene/model.h"

namespace bosquet::render {

struct DateTime {
  int year = 2026, month = 6, day = 21;  ///< Gregorian
  double hour = 12.0;                    ///< 0..24, in the clock time of `Place`
};

struct Place {
  double latitude_deg = 48.0, longitude_deg = 9.0;
  std::optional<double> utc_offset_h;  ///< clock time minus UTC; missing: the whole zone nearest to the longitude

  double offset() const;
};

/// The apparent sun (refraction included); below the horizon the elevation is negative.
scene::Sun sun_position(const DateTime& when, const Place& where);

/// "2026-06-21 15:00" at `where`, or "azimuth,elevation" in degrees. An error says what is allowed; so does a sun that
/// is below the horizon.
Result<scene::Sun> sun_from_text(std::string_view text, const Place& where);

}  // namespace bosquet::render
