// Whether a triangle mesh bounds a solid.
//
// Model     vertices at the same position are one. A mesh is closed when an even number of triangles meets in every
//           edge, whichever way they face; it crosses itself when an edge of one triangle passes through the inside of
//           another that shares no vertex with it
// Decision  triangles that overlap in one plane do not count as crossing: coplanar walls bound no other room
// Cost      closed: sorting; crossing: sorting along the longest side, then pairs whose boxes overlap
#pragma once

#include "core/triangle_mesh.h"

namespace bosquet::crowns {

bool is_closed(const TriangleMesh& mesh);
bool crosses_itself(const TriangleMesh& mesh);

}  // namespace bosquet::crowns
