// glTF check: what the Khronos validator does not know of a file, judged by reading all of its data.
//
// Judges    buffers and buffer views: inside their file; accessors: type, alignment, inside their view; what
//           EXT_meshopt_compression packs is unpacked, and its sizes, modes and strides compared with the view's;
//           positions finite and within the stated bounds, normals finite, indices below the number of vertices;
//           EXT_mesh_gpu_instancing: attributes exist, are as many and of the right types, rotations of unit length,
//           sizes finite, the extension is required; MSFT_lod: ids exist, each once, no level leads back to itself, as
//           many coverages as levels, falling; nodes: children exist, one parent each, no circles; every extension that
//           is met is listed as used
// Not       images, materials, animations, skins, sparse accessors, data: URIs
// Errors    a file that is no glTF, or cannot be read. Hostile files are safe: depth, sizes and every number are checked
//           before they are used, nothing is allocated that the file's own size does not vouch for
// Cost      the file's data is held, and one unpacked view beside it at a time for each packed one in use
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace bosquet::exchange {

struct GltfCheck {
  std::vector<std::string> faults;  ///< at most kMostFaults; empty: the file is good
  std::size_t more_faults = 0;      ///< beyond those
  std::size_t accessors = 0, packed_views = 0, instances = 0, nodes_with_levels = 0;

  bool good() const { return faults.empty(); }
};
inline constexpr std::size_t kMostFaults = 50;

Result<GltfCheck> check_gltf(const std::filesystem::path& path);

}  // namespace bosquet::exchange
