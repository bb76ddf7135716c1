// Directions: the frames and turns that growth needs.
//
// Frame     HVP at an internode: H heading; V perpendicular to H in the vertical plane through H; P = V x H, level
// Holds     only + - * / sqrt, so the same bits everywhere
#pragma once

#include <cmath>

#include "core/vec.h"

namespace bosquet::growth {

/// Two directions that make an orthonormal basis with the unit vector n (Duff et al. 2017).
struct Basis {
  Vec3 x, y;
};
inline Basis basis_around(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

inline Vec3 normalised_or(const Vec3& v, const Vec3& fallback) {
  const float square = glm::dot(v, v);
  return square > 1e-12f ? v / std::sqrt(square) : fallback;
}

/// V of the HVP frame; zero when H is vertical.
inline Vec3 most_vertical(const Vec3& h) { return normalised_or(kUp - h.y * h, Vec3{0.0f}); }

/// v turned about the unit vector `axis` by the angle whose sine and cosine are given, right-handed.
inline Vec3 turned(const Vec3& v, const Vec3& axis, float sin, float cos) {
  return v * cos + glm::cross(axis, v) * sin + axis * (glm::dot(axis, v) * (1.0f - cos));
}

}  // namespace bosquet::growth
