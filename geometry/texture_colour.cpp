#include "geometry/texture_colour.h"

#include <array>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::geometry {
namespace {

// sRGB bytes over the square root of linear light: nearly a straight line, so equal steps serve dark and light.
constexpr int kSteps = 4096;

std::array<std::uint8_t, kSteps> make_bytes() {
  std::array<std::uint8_t, kSteps> bytes{};
  for (int i = 0; i < kSteps; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(kSteps - 1);
    bytes[static_cast<std::size_t>(i)] = unit_byte(srgb_from_linear(root * root));
  }
  return bytes;
}

}  // namespace

float linear_from_srgb(float c) { return c <= 0.04045f ? c / 12.92f : pow((c + 0.055f) / 1.055f, 2.4f); }

float srgb_from_linear(float l) { return l <= 0.0031308f ? l * 12.92f : 1.055f * pow(l, 1.0f / 2.4f) - 0.055f; }

std::uint8_t srgb_byte(float linear) {
  static const std::array<std::uint8_t, kSteps> bytes = make_bytes();
  const float l = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  return bytes[static_cast<std::size_t>(std::sqrt(l) * static_cast<float>(kSteps - 1) + 0.5f)];
}

}  // namespace bosquet::geometry
