// Water mesh: the surface of the water that stands on the terrain.
//
// Model     covers, cell by cell, the part of each triangle of the ground (geometry/ground_mesh.h with the same budget)
//           that lies below the level, by exact clip, so both meet along one line; a pond's own level is held by the
//           cells that its outline touches
// Frame     world (x east, y up, z = -north); UV metres / kGroundTileM, u east, v south
#pragma once

#include "core/triangle_mesh.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

/// Flat; empty without water. `ground_triangles`: GroundOptions::max_triangles of the ground that it lies on.
TriangleMesh mesh_water(const terrain::Terrain& terrain, std::size_t ground_triangles);

}  // namespace bosquet::geometry
