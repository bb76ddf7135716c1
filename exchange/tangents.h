// Tangents: the direction of growing u at every vertex, for normal maps.
//
// Source    Lengyel 2001, "Computing tangent space basis vectors for an arbitrary mesh"
// Model     T = sum over a vertex's triangles of dP/du weighted by area, made perpendicular to the normal; w = +-1 so
//           that w * (N x T) points to falling v, which is up in an image: glTF's tangent space
// Holds     unit length, perpendicular to the normal; any perpendicular where u has no direction
#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace bosquet::exchange {

/// One for each vertex; the mesh has normals and uvs.
std::vector<Vec4> tangents(const TriangleMesh& mesh);

}  // namespace bosquet::exchange
