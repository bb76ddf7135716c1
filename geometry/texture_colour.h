// Texture colour: between sRGB bytes and linear light, by tables made once from the exact scalar functions.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/vec.h"

namespace bosquet::geometry {

/// One channel, 0..1 to 0..1.
float linear_from_srgb(float encoded);
float srgb_from_linear(float linear);

inline Vec3 linear_from_srgb(const Vec3& c) {
  return {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
}

/// The sRGB byte of linear light; clamped, right to the nearest step but at its edges.
std::uint8_t srgb_byte(float linear);

inline void put_srgb(std::uint8_t* pixel, const Vec3& linear) {
  pixel[0] = srgb_byte(linear.r), pixel[1] = srgb_byte(linear.g), pixel[2] = srgb_byte(linear.b);
}

/// A byte for 0..1, clamped and rounded.
inline std::uint8_t unit_byte(float x) { return static_cast<std::uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// A unit vector as a normal map's pixel.
inline void put_normal(std::uint8_t* pixel, const Vec3& n) {
  pixel[0] = unit_byte(0.5f + 0.5f * n.x), pixel[1] = unit_byte(0.5f + 0.5f * n.y);
  pixel[2] = unit_byte(0.5f + 0.5f * n.z);
}

inline float luminance(const Vec3& linear) { return 0.2126f * linear.r + 0.7152f * linear.g + 0.0722f * linear.b; }

}  // namespace bosquet::geometry
