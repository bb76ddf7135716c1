// Gravimorphism: buds on one side of a leaning axis grow more readily than on the others.
//
// Source    Longay 2014, 4.4.3, eq. 4.6; the captions of its fig. 5.6 swap amphitony and epitony
// Model     an ellipse with half-axes s_v along V and s_p along P, its centre e_v along V, lies across the axis; d is
//           the distance from the axis to it in the bud's direction chi; b = cos^2(tau) + d * sin^2(tau), tau the
//           axis's angle to the vertical
// Holds     b = 1 on a vertical axis, and everywhere for s_v = s_p = 1, e_v = 0; |e_v| < s_v, so d > 0
#pragma once

#include <cmath>

namespace bosquet::growth {

/// d in the direction of unit vector (along_v, along_p).
inline float ellipse_distance(float s_v, float s_p, float e_v, float along_v, float along_p) {
  // ((t*c - e)/s_v)^2 + (t*s/s_p)^2 = 1 has one positive root t when the axis lies inside.
  const float iv = 1.0f / (s_v * s_v), ip = 1.0f / (s_p * s_p);
  const float a = along_v * along_v * iv + along_p * along_p * ip;
  const float half_b = along_v * e_v * iv;
  const float c = 1.0f - e_v * e_v * iv;
  return (half_b + std::sqrt(half_b * half_b + a * c)) / a;
}

/// b for a bud whose direction across the axis is (along_v, along_p) on an axis with cos(tau) = heading_y.
inline float propensity(float s_v, float s_p, float e_v, float heading_y, float along_v, float along_p) {
  const float cos2 = heading_y * heading_y;
  return cos2 + ellipse_distance(s_v, s_p, e_v, along_v, along_p) * (1.0f - cos2);
}

}  // namespace bosquet::growth
