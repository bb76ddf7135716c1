// Leaf atlas: the leafed twigs and single leaves that foliage cards show.
//
// Layout    2 x 2 equal square cells, uv origin upper left:
//             upper row  two variants of a twig cluster: a thin twig with its leaves (or a spray of needle shoots),
//                        growing from the middle of the cell's bottom edge upward and filling the cell
//             lower row  two variants of a single leaf (or one needle shoot), stalk at the middle of the bottom edge,
//                        tip up
//           in a season with a bloom (bloom.h) the left column shows it: above on the twig, below one bunch, springing
//           from the middle of the bottom edge
// Scale     true: a cluster cell is cluster_cell_m(leaf) metres wide and high, a leaf cell leaf_cell_m(leaf),
//           a bunch bunch_cell_m(bloom)
// Margin    the outer kAtlasMargin of each cell (share of its side) is transparent; the stalk or twig starts at the
//           middle of the lower margin line
// Colour    sRGB albedo with alpha; under transparent pixels the nearest leaf colours go on, so that filtering finds no
//           dark rim. Normal: linear, tangent space of the card, +x right, +y up in the image, half the size
// Holds     a pure function of its arguments, the same bits for any thread count, build and x86-64 CPU
// Cost      0.1 s for 1024 x 1024 on one core
#pragma once

#include <cstdint>

#include "core/image.h"
#include "geometry/look.h"

namespace bosquet::geometry {

inline constexpr float kAtlasMargin = 1.0f / 64.0f;

/// Share of a bunch's cell below the bunch, where its stalk is seen.
inline constexpr float kBunchStem = 0.09f;

/// Side in metres of what an upper cell shows.
float cluster_cell_m(const LeafLook& leaf);

/// Side in metres of what a lower cell shows.
float leaf_cell_m(const LeafLook& leaf);

/// Side in metres of what the lower left cell shows where there is a bloom.
float bunch_cell_m(const Bloom& bloom);

struct AtlasCell {
  float u0, v0, u1, v1;  ///< upper left and lower right corner
};

/// The cell of a twig cluster, or of a single leaf, variant 0 or 1.
constexpr AtlasCell cluster_cell(int variant) {
  return {0.5f * static_cast<float>(variant), 0.0f, 0.5f * static_cast<float>(variant) + 0.5f, 0.5f};
}
constexpr AtlasCell leaf_cell(int variant) {
  return {0.5f * static_cast<float>(variant), 0.5f, 0.5f * static_cast<float>(variant) + 0.5f, 1.0f};
}

struct LeafAtlas {
  Image base_colour;  ///< RGBA, size x size
  Image normal;       ///< RGB, size/2 x size/2
};

/// `size` pixels a side: a power of two, 128 to 4096.
LeafAtlas make_leaf_atlas(const LeafLook& leaf, Season season, std::uint64_t seed, int size);

}  // namespace bosquet::geometry
