#include "ui/widgets/units.h"

#include <fmt/format.h>

#include <cmath>

namespace bosquet::ui {
namespace {

constexpr int kInchesPerFoot = 12;
constexpr float kFewFeet = 1000.0f;

}  // namespace

std::string length_words(float metres, Units units, int decimals) {
  if (units == Units::metres) return fmt::format("{:.{}f} m", metres, decimals);
  const float feet = std::abs(metres) * kFeetPerMetre;
  const bool below = metres < 0;
  if (feet >= kFewFeet) return fmt::format("{}{:.0f}'", below ? "-" : "", feet);
  const long inches = std::lround(feet * kInchesPerFoot);
  return fmt::format("{}{}' {}\"", below && inches > 0 ? "-" : "", inches / kInchesPerFoot, inches % kInchesPerFoot);
}

std::string area_words(float square_metres, Units units) {
  if (units == Units::metres) return fmt::format("{:.1f} m\xc2\xb2", square_metres);
  return fmt::format("{:.0f} ft\xc2\xb2", square_metres * kFeetPerMetre * kFeetPerMetre);
}

}  // namespace bosquet::ui
