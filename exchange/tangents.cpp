#include "exchange/tangents.h"

#include <cassert>
#include <cmath>

namespace bosquet::exchange {
namespace {

constexpr float kTiny = 1e-20f;  // squared length below which a direction is noise

Vec3 any_perpendicular(const Vec3& n) {
  // Away from the axis that lies nearest to n.
  const Vec3 axis = std::abs(n.x) < 0.6f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return glm::normalize(axis - n * glm::dot(n, axis));
}

}  // namespace

std::vector<Vec4> tangents(const TriangleMesh& mesh) {
  assert(mesh.normals.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
  // Directions of growing u and of falling v, summed over triangles.
  std::vector<Vec3> along_u(mesh.positions.size(), Vec3(0.0f)), against_v = along_u;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const Vec3 p = mesh.positions[b] - mesh.positions[a], q = mesh.positions[c] - mesh.positions[a];
    const Vec2 s = mesh.uvs[b] - mesh.uvs[a], t = mesh.uvs[c] - mesh.uvs[a];
    const float determinant = s.x * t.y - s.y * t.x;
    if (determinant == 0.0f) continue;
    const float sign = determinant > 0.0f ? 1.0f : -1.0f;
    // dP/du times |determinant| would weigh by area in the image; its direction times the area in space is wanted.
    const Vec3 u = sign * (p * t.y - q * s.y), v = sign * (p * t.x - q * s.x);
    const float area = std::sqrt(glm::dot(glm::cross(p, q), glm::cross(p, q)));
    const float u2 = glm::dot(u, u), v2 = glm::dot(v, v);
    if (u2 < kTiny || v2 < kTiny) continue;
    const Vec3 du = u * (area / std::sqrt(u2)), dv = v * (area / std::sqrt(v2));
    for (std::uint32_t corner : {a, b, c}) along_u[corner] += du, against_v[corner] += dv;
  }

  std::vector<Vec4> out(mesh.positions.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 n = mesh.normals[i];
    Vec3 t = along_u[i] - n * glm::dot(n, along_u[i]);
    const float length2 = glm::dot(t, t);
    // Nearly parallel to the normal after the projection: rounding, not a direction.
    t = length2 > kTiny && length2 > 1e-8f * glm::dot(along_u[i], along_u[i]) ? t / std::sqrt(length2)
                                                                              : any_perpendicular(n);
    const float w = glm::dot(glm::cross(n, t), against_v[i]) < 0.0f ? -1.0f : 1.0f;
    out[i] = Vec4(glm::normalize(t), w);
  }
  return out;
}

}  // namespace bosquet::exchange
