// glTF compression: the buffer views of a layout packed by meshoptimizer's codecs (EXT_meshopt_compression).
//
// Model     each view of each group is packed on its own: vertex and instance data as ATTRIBUTES, indices as TRIANGLES
//           (the codec keeps the order of triangles and their winding but may turn their corners)
// Filter    normals and tangents go through the octahedral map of 8 bits: two numbers instead of three, at most a degree off
// Holds     the same bytes for any number of threads
// Cost      one group unpacked and everything packed are held; about 250 MB a second and core
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exchange/gltf_meshes.h"

namespace bosquet::exchange {

struct PackedViews {
  struct View {
    std::uint64_t offset = 0;  ///< multiple of four
    std::vector<std::byte> data;
  };
  std::vector<std::array<View, kStreams>> views;  ///< for each group
  std::uint64_t bytes = 0;
};

/// Kinds that are packed through the octahedral filter.
constexpr bool is_octahedral(Stream s) { return s == Stream::normal_byte || s == Stream::tangent_byte; }

/// Packs one group, whose bytes encode_group made; groups in order.
void pack_group(const MeshGroup& group, std::span<const std::byte> bytes, PackedViews& packed);

}  // namespace bosquet::exchange
