// Draws of a seedling, made of the words that its random stream has at fixed numbers.
#pragma once

#include <cstdint>

namespace bosquet::distribution {

/// Uniform in [0, 1), multiples of 2^-24.
constexpr float unit_interval(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

}  // namespace bosquet::distribution
