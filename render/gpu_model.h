// GPU model: a scene's meshes, materials and maps in graphics memory.
//
// Frame     a mesh keeps its own coordinates; a Drawable puts it at its node's translation
// Holds     meshes and images that are shared in the model are shared here; one Drawable per part
// Context   made, used and freed with the same context current
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "render/gl.h"
#include "render/overhead.h"
#include "scene/model.h"

namespace bosquet::render {

/// As it lies in the vertex buffer.
struct GpuVertex {
  Vec3 position;
  std::uint32_t normal;  ///< three signed numbers of 10 bits
  Vec2 uv;
  Rgba8 colour;
};

struct GpuMesh {
  GlVertexArray array;
  GlBuffer vertices, indices;
  GLsizei count = 0;
  Box3 box;  ///< own coordinates
};

/// Which shader a part is drawn by.
enum class Shader { solid, leaf, ground, water };

struct GpuMaterial {
  Shader shader = Shader::solid;
  GLuint base_colour = 0, normal = 0;  ///< texture names; 0: none
  Vec4 base_factor{1.0f};
  float roughness = 1, cutoff = 0.5f, translucency = 0;
  bool double_sided = false;
};

struct Drawable {
  std::size_t mesh, material;
  Vec3 translation;
  Box3 box;  ///< world
};

struct GpuModel {
  std::vector<GpuMesh> meshes;
  std::vector<GlTexture> textures;
  std::vector<GpuMaterial> materials;
  std::vector<Drawable> drawables;
  GlTexture cover, ground;                     ///< the maps of Overhead
  Overhead overhead;                           ///< its two maps emptied
  std::optional<std::size_t> ground_material;  ///< the first one, whose texture the land around bears too
  Box3 box;
  scene::Sun sun;

  /// Copies a model to graphics memory.
  static Result<GpuModel> make(const scene::Model& model);
};

}  // namespace bosquet::render
