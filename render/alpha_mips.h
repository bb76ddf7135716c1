// Alpha mips: smaller and smaller copies of a cut-out texture whose cover stays what it was.
//
// Source    Castano 2010, "Computing alpha mipmaps": averaging alpha thins leaves out with distance, since fewer texels
//           pass the cutoff; each level's alpha is scaled until the same share passes
// Colour    averaged in linear light and weighted by alpha, so that the empty texels' colour never bleeds in
// Frame     level 0 is the image itself; each next one has max(1, n/2) pixels a side
// Holds     the share of texels above the cutoff at each level is that of level 0, as near as its texels allow
#pragma once

#include <vector>

#include "core/image.h"

namespace bosquet::render {

/// What an image's channels mean, which decides how texels are averaged.
enum class TextureKind {
  colour,  ///< sRGB; with alpha: weighted by it
  normal,  ///< vectors; their mean keeps its shortness, so that far bumps flatten
};

/// All levels of an RGBA or RGB image, as RGBA. `cutoff` in (0, 1) keeps cover; 0: alpha is averaged plainly.
std::vector<Image> mip_chain(const Image& image, TextureKind kind, float cutoff);

/// Share of the texels whose alpha is at least cutoff, the texture sampled with bilinear filtering.
float cover(const Image& rgba, float cutoff);

}  // namespace bosquet::render
