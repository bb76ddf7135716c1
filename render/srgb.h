// sRGB: bytes of files and screens to linear light and back (IEC 61966-2-1).
#pragma once

#include <cstdint>

namespace bosquet::render {

/// Linear value 0..1 of an sRGB byte.
float linear_of_srgb(std::uint8_t byte);

/// sRGB byte nearest to a linear value, clamped to 0..1.
std::uint8_t srgb_of_linear(float linear);

}  // namespace bosquet::render
