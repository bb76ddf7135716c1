// glTF stock: what of a model a file needs, each thing once, in order of first use.
//
// Model     every mesh that some level of some node draws; with instancing the leaf meshes that consist of few kinds of
//           cards give way to the cards and to lists of instances
// Decision  quantized positions need a scale and an offset on the node that draws them, so the meshes that nodes draw
//           together share theirs. Nodes that stand somewhere (trees) keep their origin; where nothing does (ground)
//           the middle of the box is the origin
// Errors    as measure(), the message names the node (kind cannot_finish)
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "exchange/gltf_instances.h"
#include "exchange/gltf_meshes.h"
#include "exchange/gltf_writer.h"
#include "scene/model.h"

namespace bosquet::exchange {

/// Whether a part puts something into a file.
inline bool drawable(const scene::Part& part) { return part.mesh && !part.mesh->empty(); }

/// Whether a file shows coordinates of a material's textures.
bool textured(const scene::Material& material, const GltfOptions& options);

struct GltfStock {
  std::vector<MeshFacts> meshes;    ///< and lists of instances
  std::vector<std::string> owners;  ///< of each: the first node that draws it
  std::unordered_map<const TriangleMesh*, std::size_t> mesh_index;
  struct Card {
    std::size_t mesh = 0, instances = 0;  ///< both in `meshes`
  };
  std::unordered_map<const TriangleMesh*, std::vector<Card>> cards;  ///< of the meshes that are instanced
  std::vector<std::size_t> materials;
  std::vector<int> material_index;  ///< by the model's number; -1: unused
  std::vector<std::unique_ptr<const std::vector<InstancedCard>>> owned;

  bool instanced(const scene::Part& part) const { return cards.count(part.mesh.get()) != 0; }
};

Result<GltfStock> take_stock(const scene::Model& model, const GltfOptions& options);

/// The lists of parts that a node shows: its own, then its coarser ones if they are asked for.
std::vector<const std::vector<scene::Part>*> shown_levels(const scene::Node& node, const GltfOptions& options);

}  // namespace bosquet::exchange
