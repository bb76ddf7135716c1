// Small models for the glTF tests: two "trees" with bark and leaves, shared parts, a ground, a camera.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "scene/model.h"

namespace bosquet::exchange {

/// A tube of `sides` x `rings` around the y axis, counter-clockwise from outside; uv: u round, v up in `repeats`.
inline TriangleMesh tube(int sides, int rings, float radius, float height, float repeats) {
  TriangleMesh mesh;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= sides; ++s) {
      const float u = static_cast<float>(s) / static_cast<float>(sides);
      const float v = static_cast<float>(r) / static_cast<float>(rings);
      const SinCos a = sin_cos(2 * kPi * u);
      const Vec3 out = glm::normalize(Vec3(a.cos, 0, -a.sin));
      mesh.positions.push_back(radius * out + Vec3(0, height * v, 0));
      mesh.normals.push_back(out);
      mesh.uvs.push_back({repeats * u, repeats * (1 - v)});
    }
  const auto at = [&](int s, int r) { return static_cast<std::uint32_t>(r * (sides + 1) + s); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sides; ++s)
      for (auto i : {at(s, r), at(s + 1, r), at(s + 1, r + 1), at(s, r), at(s + 1, r + 1), at(s, r + 1)})
        mesh.indices.push_back(i);
  return mesh;
}

/// `n` upright square cards on a spiral, each a quad of its own, coloured.
inline TriangleMesh cards(int n) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const SinCos a = sin_cos(2.4f * static_cast<float>(k));
    const Vec3 side(a.cos, 0, -a.sin), normal(a.sin, 0, a.cos);
    const Vec3 foot = 1.2f * normal + Vec3(0, 2 + 0.02f * static_cast<float>(k), 0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (Vec2 c : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      mesh.positions.push_back(foot + 0.8f * (c.x - 0.5f) * side + Vec3(0, 0.8f * c.y, 0));
      mesh.normals.push_back(glm::normalize(normal));
      mesh.uvs.push_back({c.x, 1 - c.y});
      mesh.colours.push_back({200, static_cast<std::uint8_t>(255 - k % 100), 200, 255});
    }
    for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  }
  return mesh;
}

inline std::shared_ptr<const Image> filled_image(int size, int channels, const auto& pixel) {
  auto image = std::make_shared<Image>(size, size, channels);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) pixel(x, y, image->at(x, y));
  return image;
}

inline scene::Model sample_model() {
  scene::Model model;
  auto& bark = model.materials.emplace_back();
  bark.name = "oak bark";
  bark.base_colour = filled_image(16, 3, [](int x, int y, std::uint8_t* p) {
    p[0] = static_cast<std::uint8_t>(90 + 5 * x), p[1] = 80, p[2] = static_cast<std::uint8_t>(60 + y);
  });
  bark.normal =
      filled_image(16, 3, [](int x, int, std::uint8_t* p) { p[0] = x % 4 < 2 ? 110 : 146, p[1] = 128, p[2] = 250; });
  bark.roughness = 0.9f;
  auto& leaf = model.materials.emplace_back();
  leaf.name = "oak leaf";
  leaf.surface = scene::Surface::leaf;
  leaf.base_colour = filled_image(32, 4, [](int x, int y, std::uint8_t* p) {
    p[0] = 60, p[1] = 140, p[2] = 40;
    p[3] = (x - 16) * (x - 16) + (y - 16) * (y - 16) < 150 ? 255 : 0;
  });
  leaf.normal = filled_image(8, 3, [](int, int, std::uint8_t* p) { p[0] = p[1] = 128, p[2] = 255; });
  leaf.mask = leaf.double_sided = true;
  leaf.alpha_cutoff = 0.4f;
  leaf.translucency = 0.25f;
  auto& ground = model.materials.emplace_back();
  ground.name = "ground";
  ground.surface = scene::Surface::ground;
  ground.base_factor = {0.2f, 0.3f, 0.1f, 1.0f};
  model.materials.emplace_back().name = "never used";

  const auto trunk = std::make_shared<TriangleMesh>(tube(8, 6, 0.2f, 4.0f, 3.0f));
  const auto crown = std::make_shared<TriangleMesh>(cards(60));
  auto plane = std::make_shared<TriangleMesh>();
  for (Vec2 c : {Vec2(0, 0), Vec2(12, 0), Vec2(12, 8), Vec2(0, 8)}) {
    plane->positions.push_back(to_world(c, 0));
    plane->normals.push_back(kUp);
    plane->uvs.push_back(c);
  }
  plane->indices = {0, 1, 2, 0, 2, 3};

  model.nodes.push_back({"ground", Vec3(0.0f), {{plane, 2}}, {}});
  // East, north: an L that a mirror would turn.
  const Vec2 places[] = {{2, 2}, {10, 2}, {2, 6}};
  for (int i = 0; i < 3; ++i) {
    scene::Node tree;
    tree.name = "english_oak-" + std::to_string(i + 1);
    tree.translation = to_world(places[i], 0.1f);
    tree.parts = {{trunk, 0}, {crown, 1}};
    tree.extras = {{"species", std::string("english_oak")}, {"height_m", 4.0 + i}, {"id", double(i + 1)}};
    model.nodes.push_back(std::move(tree));
  }
  model.cameras.push_back({"from the south", {6, 4, 10}, {6, 2, -4}, 45.0f});
  model.cameras.push_back({"plan", {6, 30, -4}, {6, 0, -4}, 30.0f});
  model.extras = {{"seed", 12.0}, {"site", std::string("test \"site\"")}};
  return model;
}

/// The same with wind weights on what moves: different ones on every vertex of trunk and crown.
inline scene::Model windy_model() {
  scene::Model model = sample_model();
  const auto windy = [](const TriangleMesh& still) {
    auto mesh = std::make_shared<TriangleMesh>(still);
    for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
      const auto byte = [&](std::size_t step) { return static_cast<std::uint8_t>(step * v); };
      mesh->wind.push_back({byte(1), byte(7), byte(31), byte(97)});
    }
    return mesh;
  };
  const auto trunk = windy(*model.nodes[1].parts[0].mesh), crown = windy(*model.nodes[1].parts[1].mesh);
  for (std::size_t i = 1; i < model.nodes.size(); ++i)
    model.nodes[i].parts[0].mesh = trunk, model.nodes[i].parts[1].mesh = crown;
  return model;
}

}  // namespace bosquet::exchange
