// Bark texture: what a trunk looks like from two metres, painted from a few words and numbers.
//
// Model     a height field of the bark's build (stretched Voronoi cells for ridges, round ones for scales, stamped
//           lenticels and rhombs for paper), coloured by height and form, with a normal map from the same heights
// Frame     the image shows look.bark.tile_m x look.bark.tile_m of bark; x runs round the trunk, up in the image is up
//           the trunk; it tiles in both directions
// Colour    sRGB, painted relative to bark_reference(look): multiply by bark_tint() (look.h) to see the true colour
// Normal    linear, tangent space, +x right, +y up in the image, as glTF
// Holds     a pure function of its arguments, the same bits for any thread count, build and x86-64 CPU
// Cost      0.13 s for 512 x 512 on one core, 0.5 s for 1024 x 1024; 512 is a pixel a millimetre
#pragma once

#include <cstdint>

#include "core/image.h"
#include "geometry/look.h"

namespace bosquet::geometry {

struct BarkTextures {
  Image base_colour;  ///< RGB
  Image normal;       ///< RGB
};

/// `size` pixels a side: a power of two, 64 to 4096.
BarkTextures make_bark(const Look& look, std::uint64_t seed, int size);

}  // namespace bosquet::geometry
