// Impostor: a few cards with pictures of the tree itself, for trees that are some dozen pixels high.
//
// Source    the tree, looked at by the level raster (lod_raster.h) from the south, from the east and from above
// Forms     two crossed upright cards, seen from both sides (4 triangles); or these with a card for each of their sides,
//           whose normals look outward and up so that they are lit as a crown is, and a level card across the crown for views
//           from above (10 triangles, to be drawn one-sided)
// Texture   a block of 2 x 2 cells: from the south, from the east, from above, empty. Alpha is scaled so that as much of
//           a cell passes the alpha test at kImpostorCutoff as the tree covers; under what is empty the mean colour goes on
// Decision  upright cards are as much wider than the tree as makes the silhouette of both, over all directions, as large
//           as the tree's
// Units     metres, tree frame
// Holds     same tree, same bits, on every machine
// Cost      about 5 ms for a tree of 6,000 triangles
#pragma once

#include <cstddef>
#include <span>

#include "core/image.h"
#include "core/triangle_mesh.h"
#include "geometry/lod_raster.h"

namespace bosquet::geometry {

inline constexpr float kImpostorCutoff = 0.5f;
inline constexpr std::size_t kTwoCardTriangles = 4, kFourCardTriangles = 10;

/// Where the tree stands in its pictures.
struct ImpostorFrame {
  Box3 box;              ///< of the tree
  float level_y = 0.0f;  ///< of the level card
  float widen = 1.0f;    ///< of the upright cards
};

/// Part of an atlas, in pixels.
struct ImpostorBlock {
  int x = 0, y = 0, side = 128;  ///< of all four cells
};

/// Paints a tree (its foliage last) into a block of `atlas` (RGBA).
ImpostorFrame paint_impostor(std::span<const RasterSurface> tree, Image& atlas, const ImpostorBlock& block);

/// The cards for a picture painted into a block of an atlas of this size. `stretch` (plan, up) makes them larger when
/// the picture is another tree's.
TriangleMesh impostor_cards(const ImpostorFrame& frame, const ImpostorBlock& block, int atlas_width, int atlas_height,
                            std::size_t triangles, Vec2 stretch = Vec2(1.0f));

}  // namespace bosquet::geometry
