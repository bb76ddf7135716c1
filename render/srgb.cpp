#include "render/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bosquet::render {
namespace {

constexpr std::size_t kSteps = 1 << 14;

const std::array<float, 256>& to_linear() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < 256; ++i) {
      const float s = static_cast<float>(i) / 255.0f;
      t[i] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    }
    return t;
  }();
  return table;
}

/// By the square root of the linear value, so that dark steps are as fine as bright ones.
const std::array<std::uint8_t, kSteps + 1>& to_srgb() {
  static const std::array<std::uint8_t, kSteps + 1> table = [] {
    std::array<std::uint8_t, kSteps + 1> t{};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const float root = static_cast<float>(i) / kSteps, l = root * root;
      const float s = l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f;
      t[i] = static_cast<std::uint8_t>(std::clamp(s, 0.0f, 1.0f) * 255.0f + 0.5f);
    }
    return t;
  }();
  return table;
}

}  // namespace

float linear_of_srgb(std::uint8_t byte) { return to_linear()[byte]; }

std::uint8_t srgb_of_linear(float linear) {
  return to_srgb()[static_cast<std::size_t>(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * kSteps + 0.5f)];
}

}  // namespace bosquet::render
