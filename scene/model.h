// Model: the finished scene as meshes and materials, ready to be written to a file or drawn.
//
// Frame     world (x east, y up, z south), metres; a node's meshes are relative to its translation
// Who       scene/model_builder makes it from a grown scene; exchange/gltf writes it, render/ draws it
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/image.h"
#include "core/scalar.h"
#include "core/triangle_mesh.h"

namespace bosquet::scene {

/// What a surface is; the renderer shades by it, glTF names it.
enum class Surface { bark, leaf, ground, water, obstacle, grass };

struct Material {
  std::string name;
  Surface surface = Surface::bark;
  std::shared_ptr<const Image> base_colour;  ///< sRGB; RGBA cuts leaves out (alpha below alpha_cutoff is empty)
  std::shared_ptr<const Image> normal;       ///< tangent space, +y up as glTF; may be missing
  Vec4 base_factor{1.0f};                    ///< linear, multiplies base_colour
  float roughness = 1.0f;
  float alpha_cutoff = 0.5f;
  float translucency = 0.0f;  ///< share of the light falling on the back that shines through (leaves)
  bool mask = false;          ///< alpha is tested
  bool double_sided = false;
  bool whole_trees = false;  ///< shows pictures of trees, whose leaves would shade each other
  float patchiness = 1.0f;   ///< of ground: how much it is drawn drier here and lusher there; 0 even
  bool laid = false;         ///< of ground: its picture is a pattern, never to be turned or mixed with itself
};

/// Facts that go along into files: numbers and texts by name, in order.
using Extras = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

struct Part {
  std::shared_ptr<const TriangleMesh> mesh;
  std::size_t material = 0;
};

/// The same thing with fewer triangles, for views from farther away.
struct Level {
  std::vector<Part> parts;
  float coverage = 0.0f;  ///< as Node::coverage
};

struct Node {
  std::string name;
  Vec3 translation{0.0f};
  std::vector<Part> parts;
  Extras extras;
  float coverage = 0.0f;         ///< least share of a picture's height that its parts are meant for; 0: any
  std::vector<Level> coarser{};  ///< from fine to coarse; coverage falls from level to level
};

struct Camera {
  std::string name;
  Vec3 eye{0.0f}, target{0.0f};  ///< world
  float vertical_fov_deg = 40.0f;

  bool operator==(const Camera&) const = default;
};

struct Sun {
  float azimuth_deg = 225.0f;   ///< from north, clockwise: where the light comes from
  float elevation_deg = 40.0f;  ///< above the horizon

  bool operator==(const Sun&) const = default;

  /// Unit vector toward the sun, world.
  Vec3 direction() const {
    const SinCos a = sin_cos(radians(azimuth_deg)), e = sin_cos(radians(elevation_deg));
    return {a.sin * e.cos, e.sin, -a.cos * e.cos};
  }
};

struct Model {
  std::vector<Material> materials;
  std::vector<Node> nodes;
  std::vector<Camera> cameras;
  Sun sun;
  Extras extras;  ///< of the scene: site, seed, georeference
};

}  // namespace bosquet::scene
