// glTF writer: a model as .glb, or as .gltf with a .bin and image files beside it.
//
// Source    glTF 2.0 (ISO/IEC 12113:2022); KHR_lights_punctual for the sun; by option EXT_mesh_gpu_instancing,
//           KHR_mesh_quantization, EXT_meshopt_compression, MSFT_lod
// Model     a glTF node for each node of the model (name, translation, extras) with one mesh of a primitive per part.
//           Parts that use the same TriangleMesh share its accessors, nodes with the same parts share the mesh.
// Layout    POSITION and NORMAL float, TANGENT float where a normal map is used; TEXCOORD_0 16-bit when all lie in
//           [0, 1], else float, absent without textures; COLOR_0 8-bit, absent when all white; indices 16-bit up to
//           65,535 vertices, else 32-bit. Meshes are packed in groups of about 8 MB, in each group one buffer view per
//           kind of data.
// Instances with `instancing` leaves that are copies of a few cards are written once and placed by the graphics card; the
//           colour of each is _COLOR_0 of the instance, which three.js shows and others leave out
// Compress  quantize: positions 16-bit, normals and tangents 8-bit (gltf_meshes.h); opens nearly everywhere. meshopt: that,
//           packed by meshoptimizer. A packed .glb needs a reader that can unpack it; beside a packed .gltf lies
//           NAME-fallback.bin with the plain data for those that cannot
// Levels    nodes: the levels of a tree as children NAME_LOD0, NAME_LOD1, ..., as game engines import them (a plain viewer
//           shows them all at once). msft: MSFT_lod with MSFT_screencoverage; readers without it show the finest
// Wind      meshes that have wind weights (geometry/wind.h) are written with the attribute _WIND, four normalized bytes;
//           instances have none of their own, so the two are not written together
// Images    JPEG for colour without alpha and for normal maps, PNG where alpha is tested
// Frame     world, metres, +Y up: glTF's own; numbers go out as they are. Degrees become radians.
// Decision  normal maps of cut-out materials (leaves) are left out unless asked for: the tangents they need are a third
//           of the bytes of a tree, for what is seen from very near only
// Decision  the sun's intensity is `sun_intensity`, not its 100,000 lux, since most viewers have no exposure control
// Holds     same model, options and file name, same bytes: no time, no thread count; nothing unused is written; the
//           file appears whole or not at all
// Errors    `input`: a .glb that would exceed 2^32 - 1 bytes (refused before writing, with its size and ways out), an
//           ending other than .glb or .gltf, wind weights with instancing, what FileOutput refuses. `cannot_finish`: disk full, cancelled, a mesh
//           with indices out of range or numbers that are not finite (names the node).
// Cost      one pass over the vertices to measure, one to order and write; besides the model one group of meshes and
//           the encoded images are held, with instancing 36 bytes an instance, with meshopt the packed data
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "exchange/texture_cache.h"
#include "scene/model.h"

namespace bosquet::exchange {

enum class Compression { none, quantize, meshopt };
enum class LodFiles { none, nodes, msft };
inline constexpr std::array<std::string_view, 3> kCompressionNames{"none", "quantize", "meshopt"};
inline constexpr std::array<std::string_view, 3> kLodFilesNames{"none", "nodes", "msft"};

struct GltfOptions {
  std::string version;                     ///< of the program; goes into asset.generator
  const TextureCache* textures = nullptr;  ///< keeps encoded images between runs
  Progress* progress = nullptr;            ///< stage "export", counted in meshes; asked for cancellation
  bool instancing = false;                 ///< leaves by EXT_mesh_gpu_instancing
  Compression compression = Compression::none;
  LodFiles lod = LodFiles::none;               ///< of the nodes' coarser levels; none leaves them out
  bool leaf_normal_maps = false;               ///< write the normal maps of cut-out materials too
  bool reorder = true;                         ///< order for the vertex cache; false writes triangles as they come
  std::uint64_t max_glb_bytes = 0xffff'ffffu;  ///< a .glb's own limit; 2^31 - 1 suits web browsers
  float sun_intensity = 3.0f;  ///< of the directional light, "lux"; 3 lights white to about 1 in viewers
};

/// Why wind weights and instancing are not written together.
inline constexpr std::string_view kNoWindOfInstances =
    "leaves that are instances have no wind weights of their own: give --wind on or --instancing on, not both";

/// What a model holds, before or without writing it.
struct ModelCount {
  std::uint64_t triangles = 0;  ///< as drawn
  std::uint64_t vertices = 0;   ///< as stored
};
ModelCount count(const scene::Model& model);

struct WrittenGltf {
  std::uint64_t bytes = 0;                       ///< of all files written
  std::vector<std::string> required_extensions;  ///< what a reader must know
};

/// Writes `path` (ending .glb or .gltf in any case).
Result<WrittenGltf> write_gltf(const scene::Model& model, const std::filesystem::path& path,
                               const GltfOptions& options = {});

}  // namespace bosquet::exchange
