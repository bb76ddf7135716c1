#include "exchange/gltf_meshes.h"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "exchange/mesh_order.h"
#include "exchange/tangents.h"

namespace bosquet::exchange {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");
static_assert(sizeof(Vec3) == 12 && sizeof(Vec2) == 8 && sizeof(Rgba8) == 4);

constexpr std::uint64_t kGroupBytes = std::uint64_t{32} << 20;
constexpr std::uint64_t kShortIndexVertices = 65'535;  // index 65,535 would be the primitive restart value

constexpr std::size_t slot(Stream stream) { return static_cast<std::size_t>(stream); }
constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) & ~std::uint64_t{3}; }

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

Error broken(std::string what) { return cannot_finish(std::move(what)); }

// Round half up of a coordinate in [0, 1].
std::uint16_t normalized_short(float v) { return static_cast<std::uint16_t>(v * 65535.0f + 0.5f); }

}  // namespace

std::uint64_t element_bytes(Stream stream) {
  switch (stream) {
    case Stream::position:
    case Stream::normal:
      return 12;
    case Stream::tangent:
      return 16;
    case Stream::uv_float:
      return 8;
    case Stream::uv_short:
    case Stream::colour:
    case Stream::index_int:
      return 4;
    case Stream::index_short:
      return 2;
  }
  return 0;
}

bool MeshFacts::has(Stream stream) const {
  switch (stream) {
    case Stream::position:
      return true;
    case Stream::normal:
      return !mesh->normals.empty();
    case Stream::tangent:
      return bumpy;
    case Stream::uv_float:
      return textured && !uv_in_unit_square;
    case Stream::uv_short:
      return textured && uv_in_unit_square;
    case Stream::colour:
      return coloured;
    case Stream::index_short:
      return vertices <= kShortIndexVertices;
    case Stream::index_int:
      return vertices > kShortIndexVertices;
  }
  return false;
}

std::uint64_t MeshFacts::count(Stream stream) const {
  if (!has(stream)) return 0;
  return stream == Stream::index_short || stream == Stream::index_int ? mesh->indices.size() : vertices;
}

Result<void> measure(MeshFacts& facts) {
  const TriangleMesh& mesh = *facts.mesh;
  const std::size_t n = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
  if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size()) || !fits(mesh.colours.size()))
    return broken(fmt::format("{} positions, {} normals, {} texture coordinates and {} colours do not go together", n,
                              mesh.normals.size(), mesh.uvs.size(), mesh.colours.size()));
  if (facts.textured && mesh.uvs.empty()) return broken("its material has a texture, the mesh no coordinates for it");
  if (facts.bumpy && mesh.normals.empty()) return broken("its material has a normal map, the mesh no normals");
  if (mesh.indices.size() % 3 != 0) return broken(fmt::format("{} indices are no triangles", mesh.indices.size()));

  std::vector<bool> used(n, false);
  for (std::uint32_t index : mesh.indices) {
    if (index >= n) return broken(fmt::format("index {} of only {} vertices", index, n));
    used[index] = true;
  }
  facts.vertices = 0;
  facts.bounds = {};
  facts.uv_in_unit_square = true;
  facts.coloured = false;
  for (std::size_t v = 0; v < n; ++v) {
    if (!used[v]) continue;
    ++facts.vertices;
    if (!finite(mesh.positions[v])) return broken(fmt::format("the position of vertex {} is not finite", v));
    facts.bounds.add(mesh.positions[v]);
    if (!mesh.normals.empty() && !finite(mesh.normals[v]))
      return broken(fmt::format("the normal of vertex {} is not finite", v));
    if (!mesh.uvs.empty()) {
      const Vec2 uv = mesh.uvs[v];
      if (!finite(uv)) return broken(fmt::format("the texture coordinate of vertex {} is not finite", v));
      if (!(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)) facts.uv_in_unit_square = false;
    }
    if (!mesh.colours.empty() && mesh.colours[v] != Rgba8(255)) facts.coloured = true;
  }
  return {};
}

MeshLayout lay_out(std::span<const MeshFacts> meshes) {
  MeshLayout layout;
  layout.offsets.resize(meshes.size());
  std::uint64_t at = 0;
  for (std::size_t first = 0; first < meshes.size();) {
    MeshGroup group;
    group.first = group.last = first;
    group.begin = at;
    // Take meshes until the group is full; at least one.
    for (std::uint64_t bytes = 0; group.last < meshes.size() && bytes < kGroupBytes; ++group.last) {
      for (std::size_t s = 0; s < kStreams; ++s) {
        const auto stream = static_cast<Stream>(s);
        const std::uint64_t own = meshes[group.last].count(stream) * element_bytes(stream);
        layout.offsets[group.last][s] = group.views[s].length;
        group.views[s].length += own;
        bytes += own;
      }
    }
    for (auto& view : group.views) {
      view.offset = at;
      at += padded(view.length);
    }
    group.end = at;
    layout.groups.push_back(group);
    first = group.last;
  }
  layout.bytes = at;
  return layout;
}

void encode_group(std::span<const MeshFacts> meshes, const MeshLayout& layout, const MeshGroup& group, bool reorder,
                  std::vector<std::byte>& out) {
  out.resize(group.end - group.begin);
  // What pads a view must not depend on what the buffer held before.
  for (const auto& view : group.views)
    std::memset(out.data() + (view.offset - group.begin) + view.length, 0, padded(view.length) - view.length);

  const std::size_t n = group.last - group.first;
  std::vector<float> costs(n);
  for (std::size_t i = 0; i < n; ++i) costs[i] = static_cast<float>(meshes[group.first + i].mesh->indices.size());
  parallel_dearest_first(costs, [&](std::size_t i) {
    const std::size_t m = group.first + i;
    const MeshFacts& facts = meshes[m];
    const TriangleMesh& mesh = *facts.mesh;
    const MeshOrder order = reorder ? best_order(mesh) : present_order(mesh);
    assert(order.vertices.size() == facts.vertices);
    const auto place = [&](Stream stream) {
      const std::size_t s = slot(stream);
      return out.data() + (group.views[s].offset - group.begin) + layout.offsets[m][s];
    };
    // Copies element by element: the places are aligned to four bytes only by file offset, not by type.
    const auto put = [&](Stream stream, std::size_t count, const auto& element) {
      std::byte* to = place(stream);
      for (std::size_t k = 0; k < count; ++k) {
        const auto value = element(k);
        std::memcpy(to, &value, sizeof value);
        to += sizeof value;
      }
    };
    const auto gather = [&](Stream stream, const auto& values) {
      put(stream, order.vertices.size(), [&](std::size_t k) { return values[order.vertices[k]]; });
    };
    gather(Stream::position, mesh.positions);
    if (facts.has(Stream::normal)) gather(Stream::normal, mesh.normals);
    if (facts.has(Stream::tangent)) gather(Stream::tangent, tangents(mesh));
    if (facts.has(Stream::uv_float)) gather(Stream::uv_float, mesh.uvs);
    if (facts.has(Stream::uv_short))
      put(Stream::uv_short, order.vertices.size(), [&](std::size_t k) {
        const Vec2 uv = mesh.uvs[order.vertices[k]];
        return std::array{normalized_short(uv.x), normalized_short(uv.y)};
      });
    if (facts.has(Stream::colour)) gather(Stream::colour, mesh.colours);
    if (facts.has(Stream::index_short))
      put(Stream::index_short, order.indices.size(),
          [&](std::size_t k) { return static_cast<std::uint16_t>(order.indices[k]); });
    else
      std::memcpy(place(Stream::index_int), order.indices.data(), order.indices.size() * sizeof(std::uint32_t));
  });
}

}  // namespace bosquet::exchange
