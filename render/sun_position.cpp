#include "render/sun_position.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

namespace bosquet::render {
namespace {

constexpr double kRad = 3.14159265358979323846 / 180.0;

/// Days since 2000-01-01 12:00 UT of a Gregorian date at 0 h (Fliegel and Van Flandern 1968).
double days_since_j2000(int year, int month, int day) {
  const long a = (14 - month) / 12, y = year + 4800 - a, m = month + 12 * a - 3;
  const long julian_day = day + (153 * m + 2) / 5 + 365 * y + y / 4 - y / 100 + y / 400 - 32045;
  return static_cast<double>(julian_day) - 2451545.0 - 0.5;
}

/// Lift of the apparent above the true elevation.
double refraction_deg(double elevation_deg) {
  if (elevation_deg < -1.0) return 0.0;
  return 1.02 / 60.0 / std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * kRad);
}

int days_in_month(int year, int month) {
  constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && leap ? 1 : 0);
}

/// The numbers of `text` when it is numbers with exactly these separators between them, else nothing.
std::vector<double> numbers_between(std::string_view text, std::string_view separators) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    while (at != end && *at == ' ' && (i == 0 || separators[i - 1] == ',')) ++at;
    double value = 0;
    const auto [after, problem] = std::from_chars(at, end, value);
    if (problem != std::errc() || !std::isfinite(value)) return {};
    values.push_back(value);
    at = after;
    if (i == separators.size()) break;
    if (at == end || *at != separators[i]) return {};
    ++at;
  }
  if (at != end) return {};
  return values;
}

}  // namespace

double Place::offset() const { return utc_offset_h ? *utc_offset_h : std::round(longitude_deg / 15.0); }

scene::Sun sun_position(const DateTime& when, const Place& where) {
  const double hour_utc = when.hour - where.offset();
  const double n = days_since_j2000(when.year, when.month, when.day) + hour_utc / 24.0;

  // Ecliptic longitude, obliquity, then right ascension and declination.
  const double mean_longitude = 280.460 + 0.9856474 * n;
  const double anomaly = (357.528 + 0.9856003 * n) * kRad;
  const double longitude = (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * kRad;
  const double obliquity = (23.439 - 0.0000004 * n) * kRad;
  const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

  // Hour angle from Greenwich mean sidereal time.
  const double sidereal_h = 18.697374558 + 24.06570982441908 * n;
  const double hour_angle = (sidereal_h * 15.0 + where.longitude_deg) * kRad - right_ascension;

  const double latitude = where.latitude_deg * kRad;
  const double up =
      std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north =
      std::cos(latitude) * std::sin(declination) - std::sin(latitude) * std::cos(declination) * std::cos(hour_angle);
  const double elevation = std::atan2(up, std::hypot(east, north)) / kRad;
  double azimuth = std::atan2(east, north) / kRad;
  if (azimuth < 0) azimuth += 360.0;
  return {static_cast<float>(azimuth), static_cast<float>(elevation + refraction_deg(elevation))};
}

Result<scene::Sun> sun_from_text(std::string_view text, const Place& where) {
  const std::string quoted = "sun \"" + std::string(text) + "\": ";
  const std::string allowed =
      "allowed are a date with clock time, \"2026-06-21 15:00\", or \"azimuth,elevation\" in degrees (azimuth from "
      "north clockwise, elevation 0 to 90)";

  if (const std::vector<double> angles = numbers_between(text, ","); !angles.empty()) {
    if (angles[0] < -360 || angles[0] > 360 || angles[1] < 0 || angles[1] > 90)
      return Error{quoted + "the angles are out of range; " + allowed};
    const double azimuth = angles[0] < 0 ? angles[0] + 360 : angles[0];
    return scene::Sun{static_cast<float>(azimuth), static_cast<float>(angles[1])};
  }

  std::vector<double> t = numbers_between(text, "-- :");
  if (t.empty()) return Error{quoted + "not understood; " + allowed};
  for (const double part : t)
    if (part != std::floor(part)) return Error{quoted + "date and time take whole numbers; " + allowed};
  if (t[0] < 1900 || t[0] > 2100 || t[1] < 1 || t[1] > 12 || t[2] < 1 ||
      t[2] > days_in_month(static_cast<int>(t[0]), static_cast<int>(t[1])) || t[3] < 0 || t[3] > 23 || t[4] < 0 ||
      t[4] > 59)
    return Error{quoted + "no such date or time (years 1900 to 2100); " + allowed};

  const DateTime when{static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]), t[3] + t[4] / 60.0};
  const scene::Sun sun = sun_position(when, where);
  if (sun.elevation_deg < 0)
    return Error{quoted + "the sun is " + std::to_string(static_cast<int>(std::ceil(-sun.elevation_deg))) +
                 " degrees below the horizon at latitude " + std::to_string(where.latitude_deg) + ", longitude " +
                 std::to_string(where.longitude_deg) + "; choose another hour"};
  return sun;
}

}  // namespace bosquet::render
