// glTF meshes: what the vertex data of a model take in a buffer, and the bytes themselves, group by group.
//
// Model     a group is a run of meshes of about kGroupBytes; in it lie, one kind after the other, the positions of
//           all its meshes, then normals, tangents, texture coordinates, colours, indices and what instances have. Each
//           kind is one buffer view, each mesh (or list of instances) an accessor in it.
// Decision  quantized (KHR_mesh_quantization): positions are 16-bit whole numbers q, p = centre + step * q; normals and
//           tangents signed bytes; texture coordinates that leave the unit square stay float, snapped to 1/1024 of a
//           tile, as their range has no bound
// Units     offsets and lengths in bytes from the start of the buffer; every kind starts on a multiple of four
// Holds     layout depends on the meshes alone, so it is known before any byte is made
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "core/triangle_mesh.h"
#include "core/vec.h"
#include "exchange/gltf_instances.h"

namespace bosquet::exchange {

/// The kinds of data, in their order within a group.
enum class Stream {
  position,
  position_short,
  normal,
  normal_byte,
  tangent,
  tangent_byte,
  uv_float,
  uv_short,
  colour,
  wind,
  index_short,
  index_int,
  instance_place,
  instance_turn,
  instance_turn_short,
  instance_size,
  instance_colour
};
inline constexpr std::size_t kStreams = 17;

/// Bytes of one element: a vertex's attribute, one index, or a number of an instance.
std::uint64_t element_bytes(Stream stream);

constexpr bool is_index(Stream s) { return s == Stream::index_short || s == Stream::index_int; }
constexpr bool is_of_instances(Stream s) { return s >= Stream::instance_place; }

/// A mesh of the model, or a list of instances, with what is measured of it.
struct MeshFacts {
  const TriangleMesh* mesh = nullptr;
  const std::vector<Instance>* instances = nullptr;  ///< in place of `mesh`
  bool quantized = false;
  Vec3 centre{0.0f};           ///< of quantized positions
  float step = 1.0f;           ///< of quantized positions, metres
  bool textured = false;       ///< some part draws it with a texture
  bool bumpy = false;          ///< some part draws it with a normal map
  bool coarse_uv = false;      ///< quantized texture coordinates stand on 1/256 of the image
  std::uint64_t vertices = 0;  ///< used by triangles
  Box3 bounds;                 ///< of the used ones
  bool uv_in_unit_square = false;
  bool coloured = false;  ///< some colour is not white

  IVec3 quantum(const Vec3& p) const;  ///< of a quantized position
  bool has(Stream stream) const;
  std::uint64_t count(Stream stream) const;  ///< elements; 0 when it has none
};

/// Fills in `vertices`, `bounds`, `uv_in_unit_square` and `coloured` of a mesh. Error (kind cannot_finish) for indices out of range, arrays of
/// unequal length or numbers that are not finite; the message leaves the mesh's name to the caller.
Result<void> measure(MeshFacts& facts);

struct MeshGroup {
  std::size_t first = 0, last = 0;  ///< meshes [first, last)
  struct View {
    std::uint64_t offset = 0, length = 0;  ///< length 0: the group has none of this kind
  };
  std::array<View, kStreams> views;
  std::uint64_t begin = 0, end = 0;
};

/// Where everything stands. `offsets[mesh][stream]` counts from the start of its group's view.
struct MeshLayout {
  std::vector<MeshGroup> groups;
  std::vector<std::array<std::uint64_t, kStreams>> offsets;
  std::uint64_t bytes = 0;
};

MeshLayout lay_out(std::span<const MeshFacts> meshes);

/// The bytes of one group, made in parallel; `reorder` puts each mesh into its best order first.
void encode_group(std::span<const MeshFacts> meshes, const MeshLayout& layout, const MeshGroup& group, bool reorder,
                  std::vector<std::byte>& out);

}  // namespace bosquet::exchange
