// Four vectors at once, for the loops that place leaves.
//
// Holds     each lane has the bits of the same computation on single vectors with GLM: only + - * / sqrt and comparisons,
//           in GLM's order, nothing fused
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <cmath>

#include "core/vec.h"
#include "growth/lanes.h"

namespace bosquet::geometry {

using growth::all4;
using growth::Float4;
using growth::Int4;

struct Vec3x4 {
  Float4 x, y, z;

  Vec3 lane(int k) const { return {x[k], y[k], z[k]}; }
  void set(int k, const Vec3& v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
};

inline Vec3x4 all4(const Vec3& v) { return {all4(v.x), all4(v.y), all4(v.z)}; }
inline Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3x4 operator-(const Vec3x4& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3x4 operator*(Float4 s, const Vec3x4& v) { return {s * v.x, s * v.y, s * v.z}; }

inline Float4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
inline Vec3x4 mix(const Vec3x4& a, const Vec3x4& b, Float4 t) { return (1.0f - t) * a + t * b; }

inline Float4 sqrt(Float4 v) {
#ifdef __SSE__
  return _mm_sqrt_ps(v);
#else
  Float4 root;
  for (int k = 0; k < 4; ++k) root[k] = std::sqrt(v[k]);
  return root;
#endif
}
inline Float4 select(Int4 mask, Float4 yes, Float4 no) { return mask ? yes : no; }
inline Vec3x4 select(Int4 mask, const Vec3x4& yes, const Vec3x4& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
inline Float4 min(Float4 a, Float4 b) { return select(b < a, b, a); }
inline Float4 max(Float4 a, Float4 b) { return select(a < b, b, a); }

/// v at unit length, `otherwise` where it has none to speak of.
inline Vec3x4 unit(const Vec3x4& v, const Vec3x4& otherwise) {
  const Float4 l2 = dot(v, v);
  const Float4 root = sqrt(l2);
  return select(l2 > 1e-10f, {v.x / root, v.y / root, v.z / root}, otherwise);
}
inline Vec3 unit(const Vec3& v, const Vec3& otherwise) {
  const float l2 = glm::dot(v, v);
  return l2 > 1e-10f ? v / std::sqrt(l2) : otherwise;
}

}  // namespace bosquet::geometry
