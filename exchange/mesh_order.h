// Mesh order: triangles and vertices in the order that graphics hardware reads fastest.
//
// Source    meshoptimizer: vertex cache order (Forsyth's and Sander's ideas), then vertices in order of first use
// Holds     the same triangles with the same windings; every vertex kept is used by a triangle; same mesh, same result
// Decision  small pieces without common vertices (cards of leaves) stay in their order, which is as good as any; their
//           vertices too go in order of first use, which index codecs pack best
// Cost      about 0.1 s per million triangles, of cards a tenth of that
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace bosquet::exchange {

/// New indices, and for each new vertex the old one it is.
struct MeshOrder {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> vertices;
};

/// All indices are below positions.size() and their number is a multiple of three.
MeshOrder best_order(const TriangleMesh& mesh);

/// Triangles as they are, only unused vertices left out.
MeshOrder present_order(const TriangleMesh& mesh);

/// The mesh in its best order.
TriangleMesh optimise(const TriangleMesh& mesh);

}  // namespace bosquet::exchange
