// What must hold for every mesh.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "core/triangle_mesh.h"

namespace bosquet::geometry {

inline bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Twice the area, in the direction that the triangle faces.
inline Vec3 facing(const TriangleMesh& m, std::size_t triangle) {
  const std::uint32_t* i = m.indices.data() + 3 * triangle;
  return glm::cross(m.positions[i[1]] - m.positions[i[0]], m.positions[i[2]] - m.positions[i[0]]);
}

inline double area(const TriangleMesh& m) {
  double sum = 0;
  for (std::size_t t = 0; t < m.triangles(); ++t) sum += 0.5 * static_cast<double>(glm::length(facing(m, t)));
  return sum;
}

/// Numbers are finite, normals of unit length, indices in range, and every triangle is larger than `least_area` (m2).
inline void expect_sound(const TriangleMesh& m, float least_area) {
  ASSERT_EQ(m.normals.size(), m.positions.size());
  ASSERT_EQ(m.uvs.size(), m.positions.size());
  ASSERT_EQ(m.colours.size(), m.positions.size());
  ASSERT_EQ(m.indices.size() % 3, 0u);
  for (std::size_t v = 0; v < m.positions.size(); ++v) {
    ASSERT_TRUE(finite(m.positions[v]) && finite(m.normals[v])) << "vertex " << v;
    ASSERT_TRUE(std::isfinite(m.uvs[v].x) && std::isfinite(m.uvs[v].y)) << "vertex " << v;
    ASSERT_NEAR(glm::length(m.normals[v]), 1.0f, 1e-4f) << "vertex " << v;
  }
  for (std::uint32_t i : m.indices) ASSERT_LT(i, m.positions.size());
  for (std::size_t t = 0; t < m.triangles(); ++t)
    ASSERT_GT(0.5f * glm::length(facing(m, t)), least_area) << "triangle " << t;
}

/// Share of the triangles that face where their vertices' normals point.
inline double share_facing_their_normals(const TriangleMesh& m) {
  std::size_t agree = 0;
  for (std::size_t t = 0; t < m.triangles(); ++t) {
    const std::uint32_t* i = m.indices.data() + 3 * t;
    agree += glm::dot(facing(m, t), m.normals[i[0]] + m.normals[i[1]] + m.normals[i[2]]) > 0.0f;
  }
  return m.empty() ? 1.0 : static_cast<double>(agree) / static_cast<double>(m.triangles());
}

}  // namespace bosquet::geometry
