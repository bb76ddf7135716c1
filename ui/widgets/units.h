// Units: lengths as people read them, in metres or in feet and inches. The document stays in metres.
#pragma once

#include <string>

namespace bosquet::ui {

enum class Units { metres, feet };

inline constexpr float kFeetPerMetre = 1.0f / 0.3048f;

/// "12.50 m" with so many digits behind the point, or "41' 0\"" to the nearest inch, beyond 1000 feet without inches.
std::string length_words(float metres, Units units, int decimals = 1);

/// "120.5 m²" or "1297 ft²".
std::string area_words(float square_metres, Units units);

}  // namespace bosquet::ui
