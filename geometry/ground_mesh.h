// Ground mesh: the terrain as triangles, and the water that stands on it.
//
// Model     heights are read on a square grid of one step, the smallest multiple of the terrain's cell that keeps to
//           the budget; normals are the heightfield's. Water covers, cell by cell, the part of each ground triangle
//           that lies below the level (exact clip), so both meet along one line; a pond's own level is held by the
//           cells that its outline touches
// Colour    linear, tints the ground texture (ground_tint() of ground_texture.h): meadow, the areas' covers (gravel,
//           paving, lawn, soil) where planting is excluded, forest floor under trees where the caller says so, wet
//           sand at the water's edge, mud below
// UV        metres / kGroundTileM, u east, v south
// Frame     world (x east, y up, z = -north)
// Holds     triangles are counter-clockwise seen from above; chunks meet without gap (shared edge samples)
#pragma once

#include <functional>
#include <vector>

#include "core/triangle_mesh.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

struct GroundOptions {
  std::size_t max_triangles = 200'000;  ///< of the surface, without skirt; at least 2
  int chunk_cells = 128;                ///< steps along a side of one chunk
  float skirt_m = 0.0f;                 ///< a wall down from the site's edge to so far below its lowest point; 0 none
  std::function<float(Vec2)> shade;     ///< share 0..1 of forest floor at a plan position; may be missing
};

/// Distance between samples that keeps the surface to the budget.
float ground_step_m(const terrain::Terrain& terrain, const GroundOptions& options);

/// Chunks of the ground, western first, row by row from the south; the skirt is part of the outer ones.
std::vector<TriangleMesh> mesh_ground(const terrain::Terrain& terrain, const GroundOptions& options);

/// The water's surface, flat; empty without water.
TriangleMesh mesh_water(const terrain::Terrain& terrain, const GroundOptions& options);

}  // namespace bosquet::geometry
