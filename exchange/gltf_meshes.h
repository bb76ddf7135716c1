// glTF meshes: what the vertex data of a model take in a buffer, and the bytes themselves, group by group.
//
// Model     a group is a run of meshes of about kGroupBytes; in it lie, one kind after the other, the positions of
//           all its meshes, then normals, tangents, texture coordinates, colours and indices. Each kind is one buffer
//           view, each mesh an accessor in it.
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

namespace bosquet::exchange {

/// The kinds of data, in their order within a group.
enum class Stream { position, normal, tangent, uv_float, uv_short, colour, index_short, index_int };
inline constexpr std::size_t kStreams = 8;

/// Bytes of one element: a vertex's attribute or one index.
std::uint64_t element_bytes(Stream stream);

/// A mesh of the model with what is measured of it.
struct MeshFacts {
  const TriangleMesh* mesh = nullptr;
  bool textured = false;       ///< some part draws it with a texture
  bool bumpy = false;          ///< some part draws it with a normal map
  std::uint64_t vertices = 0;  ///< used by triangles
  Box3 bounds;                 ///< of the used ones
  bool uv_in_unit_square = false;
  bool coloured = false;  ///< some colour is not white

  bool has(Stream stream) const;
  std::uint64_t count(Stream stream) const;  ///< elements; 0 when it has none
};

/// Fills in all but `mesh`, `textured` and `bumpy`. Error (kind cannot_finish) for indices out of range, arrays of
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
