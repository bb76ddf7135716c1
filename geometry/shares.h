// Shares of one, as colours, coverages and tints have them: kept to 0..1, and as bytes.
#pragma once

#include <algorithm>
#include <cstdint>

namespace bosquet::geometry {

inline float clamp01(float x) { return std::clamp(x, 0.0f, 1.0f); }

/// The nearest of the 256 shares; x outside 0..1 is clamped.
inline std::uint8_t unorm8(float x) { return static_cast<std::uint8_t>(clamp01(x) * 255.0f + 0.5f); }

}  // namespace bosquet::geometry
