// Ground mesh: the terrain as triangles, apart by what covers them.
//
// Model     heights are read on a ground grid (geometry/ground_grid.h); normals are the heightfield's. Where covers meet
//           (gravel, paving, lawn, soil where planting is barred, meadow elsewhere) the triangles are cut along the line
//           between them; cells of a grid coarser than the terrain's are parted for that as finely as the budget allows
// Colour    linear, tints the covers' textures, which share a mean (ground_tint() of ground_texture.h), to the colour of the
//           ground (geometry/ground_colour.h)
// UV        metres / kGroundTileM, u east, v south
// Frame     world (x east, y up, z = -north)
// Holds     triangles are counter-clockwise seen from above; pieces meet without gap (shared samples and cuts)
#pragma once

#include <functional>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/season.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

struct GroundOptions {
  std::size_t max_triangles =
      200'000;                       ///< of the surface, without skirt; at least 2. Many lines may take a little more
  int chunk_cells = 128;             ///< steps along a side of one chunk
  float skirt_m = 0.0f;              ///< a wall down from the site's edge to so far below its lowest point; 0 none
  std::function<float(Vec2)> shade;  ///< share 0..1 of forest floor at a plan position; may be missing
  Season season = Season::summer;
};

/// What of a chunk has one cover.
struct GroundPiece {
  TriangleMesh mesh;
  terrain::Cover cover = terrain::Cover::natural;
  std::size_t chunk = 0;
};

/// Chunks of the ground, western first, row by row from the south, each as one piece a cover; the skirt is part of the
/// outer ones.
std::vector<GroundPiece> mesh_ground(const terrain::Terrain& terrain, const GroundOptions& options);

}  // namespace bosquet::geometry
