// Prism: an upright solid over an outline in plan, as a building is drawn that nothing but its footprint is known of.
//
// Model     walls over the outline and its holes, a roof and a floor of the outline's triangles (ear clipping, holes
//           joined to the outline by a cut each; Eberly 2008, "Triangulation by ear clipping")
// Frame     world; outline in plan metres, either orientation. Faces point outward, each wall has vertices of its own
// Errors    none: an outline without area gives an empty mesh; one that crosses itself, a roof with a fault
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/polygon.h"
#include "core/triangle_mesh.h"

namespace bosquet::geometry {

TriangleMesh prism(const Polygon& outline, float low_y, float high_y);

/// Triangles of an outline, counter-clockwise seen from above, as indices into its ring and then its holes in turn.
std::vector<std::array<std::uint32_t, 3>> triangulate(const Polygon& outline);

}  // namespace bosquet::geometry
