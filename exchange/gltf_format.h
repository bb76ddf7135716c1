// What glTF 2.0 and its binary container fix: the numbers of component types, targets and filters, the words of a .glb,
// the padding of its parts.
//
// Source    Khronos Group, glTF 2.0 specification, sections 3.6, 3.8.4 and 4.4
#pragma once

#include <cmath>
#include <cstdint>

#include "core/vec.h"

namespace bosquet::exchange {

inline constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbVersion = 2;
inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;

inline constexpr int kSignedByte = 5120, kByte = 5121, kSignedShort = 5122, kShort = 5123, kInt = 5125, kFloat = 5126;
inline constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
inline constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497, kClamp = 33071;

inline constexpr float kMostQuanta = 32'767.0f;  ///< of a normalised signed short

/// `bytes` with the padding that the next part begins after: a multiple of four.
constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) & ~std::uint64_t{3}; }

/// glTF knows neither infinities nor NaN.
inline bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace bosquet::exchange
