// Ground textures: grass, gravel, paving and soil, light and nearly grey, that vertex colours tint into what the ground is.
//
// Frame     shows kGroundTileM x kGroundTileM metres and tiles in both directions
// Colour    sRGB with mean kGroundMean (linear); a vertex colour of ground_tint(c) makes its mean the linear colour c
// Normal    linear, tangent space, +y up in the image, as glTF
// Holds     a pure function of its arguments, the same bits for any thread count, build and x86-64 CPU
// Cost      0.27 s for grass of 1024 x 1024 on one core
#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/vec.h"
#include "terrain/area.h"

namespace bosquet::geometry {

inline constexpr float kGroundTileM = 3.0f;

/// Mean linear colour of the texture.
inline constexpr Vec3 kGroundMean{0.42f, 0.42f, 0.38f};

/// Albedos, linear, of what the ground may be.
inline constexpr Vec3 kMeadowColour{0.092f, 0.117f, 0.045f};
inline constexpr Vec3 kForestFloorColour{0.095f, 0.075f, 0.045f};
inline constexpr Vec3 kSoilColour{0.120f, 0.085f, 0.055f};
inline constexpr Vec3 kGravelColour{0.330f, 0.300f, 0.250f};
inline constexpr Vec3 kPavingColour{0.380f, 0.370f, 0.350f};
inline constexpr Vec3 kLawnColour{0.066f, 0.098f, 0.034f};
inline constexpr Vec3 kWetSandColour{0.150f, 0.120f, 0.085f};

/// Of a cover; natural ground is meadow.
Vec3 cover_colour(terrain::Cover cover);

inline Vec2 ground_uv(Vec2 plan) { return Vec2{plan.x, -plan.y} / kGroundTileM; }

/// The linear vertex colour that gives the ground this mean albedo; clamped to 1.
inline Vec3 ground_tint(const Vec3& albedo) { return glm::min(albedo / kGroundMean, Vec3(1.0f)); }

struct GroundTextures {
  Image base_colour;  ///< RGB
  Image normal;       ///< RGB
};

/// Short grass. `size` pixels a side: a power of two, 64 to 4096.
GroundTextures make_ground(std::uint64_t seed, int size);

/// Gravel rolled flat; slabs of 60 by 30 cm laid in bond; bare soil, raked. As make_ground.
GroundTextures make_gravel(std::uint64_t seed, int size);
GroundTextures make_paving(std::uint64_t seed, int size);
GroundTextures make_soil(std::uint64_t seed, int size);

}  // namespace bosquet::geometry
