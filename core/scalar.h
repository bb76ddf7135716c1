// Scalar functions that give the same bits in every build and on every x86-64 CPU.
//
// The C library picks code by CPU and compilers fold constants with other rounding, so stages whose results are
// promised bit for bit (planting, regions, skeletons) use these and + - * / sqrt only, never <cmath>'s transcendental
// functions nor GLM's rotate and angleAxis. Everything is built from IEEE double + - * / and exact bit operations, and
// the project is compiled with -ffp-contract=off.
//
// Accuracy  within 4 units in the last place of float over the stated domains (tests/core/scalar_test.cpp)
// Units     radians
#pragma once

#include <cmath>
#include <numbers>

namespace bosquet {

inline constexpr float kPi = std::numbers::pi_v<float>;

struct SinCos {
  float sin, cos;
};

/// Sine and cosine, |x| up to 1e4.
SinCos sin_cos(float x);

/// Angle in [0, pi] whose cosine is x; x outside [-1, 1] is clamped.
float acos(float x);

/// Angle of the point (x, y) in [-pi, pi]; 0 for the origin.
float atan2(float y, float x);

/// 2^x; 0 below -150, infinity above 128.
float exp2(float x);

/// log2(x) for x > 0; -infinity at 0.
float log2(float x);

/// x^y for x >= 0; 0^0 = 1.
float pow(float x, float y);

/// e^x, natural logarithm.
float exp(float x);
float log(float x);

inline constexpr float radians(float degrees) { return degrees * (kPi / 180.0f); }
inline constexpr float degrees(float radians) { return radians * (180.0f / kPi); }

}  // namespace bosquet
