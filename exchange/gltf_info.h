// glTF info: what is in a .glb or .gltf file, from its JSON alone.
//
// Errors    anything that is no glTF 2.0: one message that names the file and what is wrong. Hostile input is
//           safe: size and nesting are limited, every index is checked, sums saturate.
// Cost      memory and time of the JSON chunk; the binary chunk is not read
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "scene/model.h"

namespace bosquet::exchange {

struct GltfNode {
  std::string name;
  DVec3 translation{0.0};
  scene::Extras extras;         ///< numbers and texts; other JSON as its text
  std::uint64_t triangles = 0;  ///< of its mesh and what hangs below it but coarser levels, instances counted
};

struct GltfInfo {
  std::string generator;
  std::uint64_t file_bytes = 0;
  std::uint64_t triangles = 0;  ///< as drawn: over nodes
  std::uint64_t vertices = 0;   ///< as stored: over position accessors, each once
  std::size_t wind_meshes = 0;  ///< with wind weights (_WIND)
  std::size_t meshes = 0, materials = 0, images = 0, cameras = 0, lights = 0;
  std::vector<GltfNode> nodes;
  scene::Extras extras;  ///< of the scene
  std::vector<std::string> extensions_used, extensions_required;
};

Result<GltfInfo> read_gltf_info(const std::filesystem::path& path);

}  // namespace bosquet::exchange
