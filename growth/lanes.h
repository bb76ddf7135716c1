// Lanes: four floats at once, for the loops in which growth spends its time.
//
// Holds     the same bits as four single computations: only + - * and comparisons, in the order written, nothing fused
#pragma once

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
/// Towards zero.
inline Int4 whole(Float4 v) { return __builtin_convertvector(v, Int4); }

/// True when a comparison held in every lane.
inline bool all(Int4 mask) {
  std::uint64_t halves[2];
  std::memcpy(halves, &mask, sizeof halves);
  return (halves[0] & halves[1]) == ~std::uint64_t{0};
}
/// True when a comparison held in one of the lanes.
inline bool any(Int4 mask) {
  std::uint64_t halves[2];
  std::memcpy(halves, &mask, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

}  // namespace bosquet::growth
