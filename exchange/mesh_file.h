// Mesh file: a triangle mesh of somebody else's from a glTF (.glb, .gltf) or OBJ file, for obstacles.
//
// Format    glTF 2.0 by tinygltf, behind our own check of size and depth (gltf_info.h): every triangle of every node of
//           the scene; materials, textures and skins are left out. OBJ: v and f lines, polygons as fans; the rest is
//           left out
// Frame     x east, y up, z south, metres, as glTF has them; OBJ files are taken to have the same
// Errors    what is no such file, has no triangles, an index beyond its vertices or a number that is none, by name (and
//           line in an OBJ)
// Holds     faces have vertices and flat normals of their own
#pragma once

#include <filesystem>

#include "core/result.h"
#include "core/triangle_mesh.h"

namespace bosquet::exchange {

Result<TriangleMesh> read_mesh(const std::filesystem::path& path);

}  // namespace bosquet::exchange
