// Lanes: four floats at once, for the loops in which growth spends its time.
//
// Holds     the same bits as four single computations: only + - * / sqrt and comparisons, in the order written,
//           nothing fused
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/vec.h"

namespace bosquet::growth {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 load4(const float* from) {
  Float4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline Int4 load4(const std::int32_t* from) {
  Int4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store4(float* to, Float4 v) { std::memcpy(to, &v, sizeof v); }
inline void store4(std::int32_t* to, Int4 v) { std::memcpy(to, &v, sizeof v); }
inline Float4 all4(float x) { return Float4{x, x, x, x}; }

/// A point or direction in the first three lanes, 0 in the last.
inline Float4 lanes(const Vec3& v) { return Float4{v.x, v.y, v.z, 0.0f}; }
inline Vec3 vec3(Float4 v) { return {v[0], v[1], v[2]}; }
/// As glm::dot(v, v).
inline float square(Float4 v) {
  const Float4 s = v * v;
  return s[0] + s[1] + s[2];
}
/// Square roots, each as std::sqrt.
inline Float4 root(Float4 v) {
#ifdef __SSE__
  return __builtin_ia32_sqrtps(v);
#endif
  for (int i = 0; i < 4; ++i) v[i] = std::sqrt(v[i]);
  return v;
}
/// The larger and the smaller of two numbers without a branch, which std::max may become where b decides what follows.
inline float larger(float a, float b) {
#ifdef __SSE__
  return __builtin_ia32_maxss(Float4{a, 0, 0, 0}, Float4{b, 0, 0, 0})[0];
#else
  return a > b ? a : b;
#endif
}
inline float smaller(float a, float b) {
#ifdef __SSE__
  return __builtin_ia32_minss(Float4{a, 0, 0, 0}, Float4{b, 0, 0, 0})[0];
#else
  return a < b ? a : b;
#endif
}
/// x where `so`, else 0, without a branch.
inline float where(bool so, float x) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & -static_cast<std::uint32_t>(so));
}
/// Towards zero.
inline Int4 whole(Float4 v) { return __builtin_convertvector(v, Int4); }

/// Bit i: a comparison held in lane i.
inline int lanes_where(Int4 mask) {
#ifdef __SSE__
  return __builtin_ia32_movmskps(reinterpret_cast<Float4>(mask));
#else
  return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
}
inline bool all(Int4 mask) { return lanes_where(mask) == 15; }
inline bool any(Int4 mask) { return lanes_where(mask) != 0; }

}  // namespace bosquet::growth
