// GPU model: a scene's meshes, materials and maps in graphics memory.
//
// Frame     a mesh keeps its own coordinates; a Drawable puts it at its node's translation
// Holds     meshes and images that are shared in the model are shared here; one Drawable per part
// Context   made, used and freed with the same context current
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "render/gl.h"
#include "render/overhead.h"
#include "render/texture_levels.h"
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
  const TriangleMesh* address = nullptr;     ///< where it was copied from, which may be gone by now
  std::weak_ptr<const TriangleMesh> source;  ///< tells it apart from a later mesh at the same address
  int uses = 0;                              ///< drawables that show it; 0: the place is free
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
  float patchiness = 1;
  bool double_sided = false, whole_trees = false, laid = false;
};

struct Drawable {
  std::size_t mesh, material;
  Vec3 translation;
  Box3 box;                ///< world
  std::uint64_t node = 0;  ///< key of the node it belongs to; 0 for those of the model
};

struct GpuModel {
  std::vector<GpuMesh> meshes;
  std::vector<GlTexture> textures;
  std::vector<GpuMaterial> materials;
  std::vector<Drawable> drawables;
  GlTexture cover, ground;                     ///< the maps of Overhead
  Overhead overhead;                           ///< its two maps emptied
  std::optional<std::size_t> ground_material;  ///< the first one, whose texture the land around bears too
  Box3 box;                                    ///< around all drawables, world
  scene::Sun sun;

  /// Copies a model to graphics memory.
  static Result<GpuModel> make(const scene::Model& model);

  Result<std::size_t> add_materials(const MaterialLevels& added);
  /// Puts another picture in place of a material's own.
  Result<void> replace_colour(std::size_t material, const MaterialLevels& by);
  /// Sets the node with a key above 0.
  Result<void> put(std::uint64_t key, const scene::Node& node);
  void remove(std::uint64_t key);
  Result<void> set_overhead(Overhead map);

 private:
  void add(const scene::Node& node, std::uint64_t key);
  std::size_t mesh_of(const std::shared_ptr<const TriangleMesh>& mesh);

  std::map<const TriangleMesh*, std::size_t> mesh_index_;
  std::vector<std::size_t> free_meshes_;
  std::unordered_map<std::uint64_t, std::size_t> drawables_of_;  ///< of each node: how many
};

}  // namespace bosquet::render
