// Triangle mesh: what geometry/ makes, exchange/ writes and render/ draws.
//
// Arrays hold one entry per vertex or are empty (indices: three per triangle, counter-clockwise seen from outside).
// Positions in metres; normals of unit length; uv (0,0) is the upper left corner of the image, as glTF; colours
// multiply the material's base colour and are linear, alpha unused (255); wind weights as geometry/wind.h, made only
// for files that ask for them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet {

struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Rgba8> colours;
  std::vector<Rgba8> wind;
  std::vector<std::uint32_t> indices;

  std::size_t triangles() const { return indices.size() / 3; }
  bool empty() const { return indices.empty(); }
  Box3 bounds() const {
    Box3 box;
    for (const Vec3& p : positions) box.add(p);
    return box;
  }
};

}  // namespace bosquet
