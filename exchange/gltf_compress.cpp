#include "exchange/gltf_compress.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/parallel.h"
#include "exchange/gltf_format.h"

namespace bosquet::exchange {
namespace {

std::vector<std::byte> packed_vertices(const std::byte* data, std::size_t count, std::size_t size) {
  std::vector<std::byte> out(meshopt_encodeVertexBufferBound(count, size));
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), data, count, size));
  return out;
}

// Unit vectors of signed bytes as two numbers (octahedral map) instead of three.
std::vector<std::byte> octahedral(const std::byte* data, std::size_t count) {
  std::vector<float> vectors(4 * count);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = static_cast<float>(std::to_integer<std::int8_t>(data[i])) / 127.0f;
  std::vector<std::byte> out(4 * count);
  meshopt_encodeFilterOct(out.data(), count, 4, 8, vectors.data());
  return out;
}

std::vector<std::byte> packed_indices(const std::byte* data, std::size_t count, std::size_t size) {
  std::vector<unsigned int> indices(count);
  unsigned int most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&indices[i], data + i * size, size);  // little-endian: the upper bytes stay zero
    most = std::max(most, indices[i]);
  }
  std::vector<std::byte> out(meshopt_encodeIndexBufferBound(count, std::size_t{most} + 1));
  out.resize(
      meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), indices.data(), count));
  return out;
}

}  // namespace

void pack_group(const MeshGroup& group, std::span<const std::byte> bytes, PackedViews& packed) {
  meshopt_encodeVertexVersion(0);
  meshopt_encodeIndexVersion(1);
  auto& views = packed.views.emplace_back();
  parallel_for(kStreams, [&](std::size_t s) {
    const auto& view = group.views[s];
    if (view.length == 0) return;
    const auto stream = static_cast<Stream>(s);
    const std::byte* data = bytes.data() + (view.offset - group.begin);
    const std::uint64_t size = element_bytes(stream), count = view.length / size;
    std::vector<std::byte> filtered;
    if (is_octahedral(stream)) filtered = octahedral(data, count), data = filtered.data();
    views[s].data = is_index(stream) ? packed_indices(data, count, size) : packed_vertices(data, count, size);
    views[s].data.shrink_to_fit();
    assert(!views[s].data.empty());
  });
  for (auto& view : views) {
    view.offset = packed.bytes;
    packed.bytes += padded(view.data.size());
  }
}

}  // namespace bosquet::exchange
