// Lanes: four floats at once, for the loops in which growth spends its time.
//
// Holds     the same bits as four single computations: only + - * and comparisons, in the order written, nothing fused
#pragma once

#include <cstdint>
#include <cstring>

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

/// True when a comparison held in one of the lanes.
inline bool any(Int4 mask) {
  std::uint64_t halves[2];
  std::memcpy(halves, &mask, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

}  // namespace bosquet::growth
