// glTF document: the JSON of a file, put together from what was taken stock of, laid out and packed.
//
// Nodes     one for each of the model's. With instanced leaves, or with levels as children, the tree's node carries name,
//           place and extras, and nodes below it the meshes
// Decision  EXT_mesh_gpu_instancing is always required: a reader without it would show one leaf at the tree's foot
// Decision  EXT_meshopt_compression is required where no file with the unpacked data lies beside (.glb)
#pragma once

#include <string>
#include <vector>

#include "exchange/gltf_compress.h"
#include "exchange/gltf_images.h"
#include "exchange/gltf_meshes.h"
#include "exchange/gltf_stock.h"

namespace bosquet::exchange {

/// All that goes into a file.
struct GltfContent {
  const scene::Model* model = nullptr;
  const GltfStock* stock = nullptr;
  const MeshLayout* layout = nullptr;
  const std::vector<GltfImage>* images = nullptr;
  const PackedViews* packed = nullptr;  ///< with Compression::meshopt
};

/// Names of the files beside a .gltf; nothing for a .glb.
struct GltfFiles {
  bool separate = false;
  std::string data, fallback;
  std::vector<std::string> images;
};

std::vector<std::string> used_extensions(const GltfStock& stock, const scene::Model& model, const GltfOptions& options);
std::vector<std::string> required_extensions(const std::vector<std::string>& used, const GltfFiles& files);

/// The JSON text in pieces, one after the other.
std::vector<std::string> gltf_json(const GltfContent& content, const GltfFiles& files, const GltfOptions& options);

}  // namespace bosquet::exchange
