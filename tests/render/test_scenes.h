// Small scenes for the tests of render/: boxes, cards and water on level ground of so many metres a side, whose
// south-west corner is the world's origin.
#pragma once

#include <array>
#include <memory>

#include "scene/model.h"

namespace bosquet::render::test {

inline std::size_t add_material(scene::Model& model, scene::Surface surface, const Vec3& colour) {
  scene::Material material;
  material.surface = surface;
  material.base_factor = Vec4(colour, 1.0f);
  model.materials.push_back(material);
  return model.materials.size() - 1;
}

/// Two triangles centre +- u +- v, facing u x v.
inline void add_quad(TriangleMesh& mesh, const Vec3& centre, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec2& s : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    mesh.positions.push_back(centre + u * s.x + v * s.y);
    mesh.normals.push_back(glm::normalize(glm::cross(u, v)));
    mesh.uvs.push_back({(s.x + 1) / 2, (1 - s.y) / 2});
  }
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

inline void add_node(scene::Model& model, TriangleMesh mesh, std::size_t material, const Vec3& at = Vec3(0.0f)) {
  scene::Node node;
  node.translation = at;
  node.parts.push_back({std::make_shared<TriangleMesh>(std::move(mesh)), material});
  model.nodes.push_back(std::move(node));
}

inline scene::Model ground_scene(float side) {
  scene::Model model;
  model.sun = {180, 45};
  TriangleMesh mesh;
  add_quad(mesh, {side / 2, 0, -side / 2}, {side / 2, 0, 0}, {0, 0, -side / 2});
  add_node(model, std::move(mesh), add_material(model, scene::Surface::ground, Vec3(0.3f)));
  return model;
}

inline void add_box(scene::Model& model, const Vec3& centre, const Vec3& size, const Vec3& colour) {
  TriangleMesh mesh;
  const Vec3 h = 0.5f * size, x(h.x, 0, 0), y(0, h.y, 0), z(0, 0, h.z);
  add_quad(mesh, x, y, z), add_quad(mesh, -x, z, y);
  add_quad(mesh, y, z, x), add_quad(mesh, -y, x, z);
  add_quad(mesh, z, x, y), add_quad(mesh, -z, y, x);
  add_node(model, std::move(mesh), add_material(model, scene::Surface::obstacle, colour), centre);
}

inline void add_water(scene::Model& model, Vec2 centre_xz, float side, float level) {
  TriangleMesh mesh;
  add_quad(mesh, {centre_xz.x, level, centre_xz.y}, {side / 2, 0, 0}, {0, 0, -side / 2});
  add_node(model, std::move(mesh), add_material(model, scene::Surface::water, Vec3(0.1f)));
}

/// An upright card facing south, cut out by `image`.
inline void add_card(scene::Model& model, std::shared_ptr<const Image> image, const Vec3& centre, float side) {
  TriangleMesh mesh;
  add_quad(mesh, Vec3(0.0f), {side / 2, 0, 0}, {0, side / 2, 0});
  scene::Material material;
  material.surface = scene::Surface::leaf;
  material.base_colour = std::move(image);
  material.mask = material.double_sided = true;
  material.translucency = 0.4f;
  model.materials.push_back(material);
  add_node(model, std::move(mesh), model.materials.size() - 1, centre);
}

}  // namespace bosquet::render::test
