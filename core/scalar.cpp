#include "core/scalar.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace bosquet {
namespace {

constexpr double kHalfPi = 1.5707963267948966;
constexpr double kPiD = 3.141592653589793;
constexpr double kLn2 = 0.6931471805599453;

// Nearest integer, exact for |x| < 2^51: adding 1.5 * 2^52 rounds to an integer in the current (nearest) mode.
double nearest(double x) {
  constexpr double kMagic = 6755399441055744.0;
  return (x + kMagic) - kMagic;
}

double exp2_double(double x) {
  if (x < -1000.0) return 0.0;
  if (x > 1000.0) return std::numeric_limits<double>::infinity();
  const double k = nearest(x);
  const double f = (x - k) * kLn2;  // |f| <= 0.347, so the series to f^12 leaves less than 1e-15
  double sum = 1.0;
  for (int n = 12; n >= 1; --n) sum = 1.0 + sum * f / n;
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52);
}

// x > 0 and normal as a double, which every positive float is.
double log2_double(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  bits = (bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull;
  double m = std::bit_cast<double>(bits);
  if (m > 1.4142135623730951) m *= 0.5, ++exponent;
  // ln m = 2 atanh(s), |s| <= 0.172: the series to s^19 leaves less than 1e-17.
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
  double sum = 0.0;
  for (int n = 19; n >= 1; n -= 2) sum = sum * s2 + 1.0 / n;
  return static_cast<double>(exponent) + 2.0 * s * sum / kLn2;
}

double atan_double(double t) {  // 0 <= t <= 1
  const bool far = t > 0.41421356237309503;
  const double u = far ? (t - 1.0) / (t + 1.0) : t, u2 = u * u;  // |u| <= 0.415: to u^35 leaves less than 1e-14
  double sum = 0.0;
  for (int n = 35; n >= 1; n -= 2) sum = 1.0 / n - u2 * sum;
  return (far ? kHalfPi / 2.0 : 0.0) + u * sum;
}

double atan2_double(double y, double x) {
  const double ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double angle = ay <= ax ? atan_double(ay / ax) : kHalfPi - atan_double(ax / ay);
  if (x < 0) angle = kPiD - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace

SinCos sin_cos(float x) {
  // Reduce by quarter turns; pi/2 in two parts keeps the remainder good to 1e-16 for |x| <= 1e4.
  constexpr double kHalfPiHigh = 1.57079632673412561417e+00, kHalfPiLow = 6.07710050650619224932e-11;
  const double k = nearest(static_cast<double>(x) / kHalfPi);
  const double r = (static_cast<double>(x) - k * kHalfPiHigh) - k * kHalfPiLow, r2 = r * r;
  double s = 1.0, c = 1.0;  // Taylor series, |r| <= pi/4: to r^17 and r^16, less than 1e-16 left
  for (int n = 16; n >= 2; n -= 2) {
    s = 1.0 - s * r2 / (n * (n + 1));
    c = 1.0 - c * r2 / (n * (n - 1));
  }
  s *= r;
  switch (static_cast<std::int64_t>(k) & 3) {
    case 0:
      return {static_cast<float>(s), static_cast<float>(c)};
    case 1:
      return {static_cast<float>(c), static_cast<float>(-s)};
    case 2:
      return {static_cast<float>(-s), static_cast<float>(-c)};
    default:
      return {static_cast<float>(-c), static_cast<float>(s)};
  }
}

float acos(float x) {
  const double d = x < -1.0f ? -1.0 : x > 1.0f ? 1.0 : static_cast<double>(x);
  return static_cast<float>(atan2_double(std::sqrt((1.0 - d) * (1.0 + d)), d));
}

float atan2(float y, float x) { return static_cast<float>(atan2_double(y, x)); }

float exp2(float x) { return static_cast<float>(exp2_double(x)); }

float log2(float x) {
  if (!(x > 0.0f)) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(log2_double(x));
}

float pow(float x, float y) {
  if (y == 0.0f) return 1.0f;
  if (!(x > 0.0f)) return y > 0.0f ? 0.0f : std::numeric_limits<float>::infinity();
  return static_cast<float>(exp2_double(static_cast<double>(y) * log2_double(x)));
}

float exp(float x) { return static_cast<float>(exp2_double(static_cast<double>(x) / kLn2)); }

float log(float x) {
  if (!(x > 0.0f)) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(log2_double(x) * kLn2);
}

}  // namespace bosquet
