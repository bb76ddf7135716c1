// Measured size: between which sizes a measured tree is taken, beside the mature size of its species.
#pragma once

namespace bosquet::scene {

inline constexpr float kLeastMeasuredScale = 0.02f, kMostMeasuredScale = 2.0f;

}  // namespace bosquet::scene
