#include "exchange/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "exchange/gltf_format.h"
#include "exchange/mesh_order.h"
#include "exchange/tangents.h"

namespace bosquet::exchange {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");
static_assert(sizeof(Vec3) == 12 && sizeof(Vec2) == 8 && sizeof(Rgba8) == 4);

constexpr std::uint64_t kGroupBytes = std::uint64_t{8} << 20;
constexpr std::uint64_t kShortIndexVertices = 65'535;  // index 65,535 would be the primitive restart value

constexpr std::size_t slot(Stream stream) { return static_cast<std::size_t>(stream); }

Error broken(std::string what) { return cannot_finish(std::move(what)); }

// Round half up of a coordinate in [0, 1].
std::uint16_t normalized_short(float v) { return static_cast<std::uint16_t>(v * 65535.0f + 0.5f); }

// The same to 1/256: the lower byte is 0 nearly everywhere and packs into nothing.
std::uint16_t coarse_short(float v) {
  return static_cast<std::uint16_t>(std::min(std::floor(v * 256.0f + 0.5f) * 256.0f, 65535.0f));
}

// Of a number in [-1, 1].
std::int8_t signed_byte(float v) {
  return static_cast<std::int8_t>(std::clamp(std::floor(v * 127.0f + 0.5f), -127.0f, 127.0f));
}
std::int16_t signed_short(float v) {
  return static_cast<std::int16_t>(std::clamp(std::floor(v * 32767.0f + 0.5f), -32767.0f, 32767.0f));
}

// To a whole number of 1/per: the low bits of the mantissa become zero and compress away.
float snapped(float v, float per) { return std::floor(v * per + 0.5f) / per; }
// Thirty-two tiles on, all coordinates of a tree's bark have one exponent and whole bytes of mantissa stay zero.
Vec2 snapped_uv(Vec2 uv) {
  constexpr float kPerTile = 1024.0f, kTilesOn = 32.0f;
  return {kTilesOn + snapped(uv.x, kPerTile), kTilesOn + snapped(uv.y, kPerTile)};
}
// Half a millimetre; no sizes below a thousandth of their own.
Vec3 snapped_place(const Vec3& p) {
  constexpr float kPerMetre = 1024.0f;
  return {snapped(p.x, kPerMetre), snapped(p.y, kPerMetre), snapped(p.z, kPerMetre)};
}
float snapped_size(float s) {
  int exponent = 0;
  const float mantissa = std::frexp(s, &exponent);
  return std::ldexp(snapped(mantissa, 1024.0f), exponent);
}

// All streams of a mesh; `put` leaves out those that it does not have.
void put_mesh(const MeshFacts& facts, bool reorder, const auto& put) {
  const TriangleMesh& mesh = *facts.mesh;
  const MeshOrder order = reorder ? best_order(mesh) : present_order(mesh);
  assert(order.vertices.size() == facts.vertices);
  const std::size_t n = order.vertices.size();
  const auto& at = order.vertices;
  put(Stream::position, n, [&](std::size_t k) { return mesh.positions[at[k]]; });
  put(Stream::position_short, n, [&](std::size_t k) {
    const IVec3 q = facts.quantum(mesh.positions[at[k]]);
    return std::array{static_cast<std::int16_t>(q.x), static_cast<std::int16_t>(q.y), static_cast<std::int16_t>(q.z),
                      std::int16_t{0}};
  });
  put(Stream::normal, n, [&](std::size_t k) { return mesh.normals[at[k]]; });
  put(Stream::normal_byte, n, [&](std::size_t k) {
    const Vec3& v = mesh.normals[at[k]];
    return std::array{signed_byte(v.x), signed_byte(v.y), signed_byte(v.z), std::int8_t{0}};
  });
  if (facts.bumpy) {
    const std::vector<Vec4> along = tangents(mesh);
    put(Stream::tangent, n, [&](std::size_t k) { return along[at[k]]; });
    put(Stream::tangent_byte, n, [&](std::size_t k) {
      const Vec4& v = along[at[k]];
      return std::array{signed_byte(v.x), signed_byte(v.y), signed_byte(v.z), signed_byte(v.w)};
    });
  }
  if (facts.quantized)
    put(Stream::uv_float, n, [&](std::size_t k) { return snapped_uv(mesh.uvs[at[k]]); });
  else
    put(Stream::uv_float, n, [&](std::size_t k) { return mesh.uvs[at[k]]; });
  put(Stream::uv_short, n, [&](std::size_t k) {
    const Vec2 uv = mesh.uvs[at[k]];
    if (facts.coarse_uv) return std::array{coarse_short(uv.x), coarse_short(uv.y)};
    return std::array{normalized_short(uv.x), normalized_short(uv.y)};
  });
  put(Stream::colour, n, [&](std::size_t k) { return mesh.colours[at[k]]; });
  put(Stream::wind, n, [&](std::size_t k) { return mesh.wind[at[k]]; });
  put(Stream::index_short, order.indices.size(),
      [&](std::size_t k) { return static_cast<std::uint16_t>(order.indices[k]); });
  put(Stream::index_int, order.indices.size(), [&](std::size_t k) { return order.indices[k]; });
}

void put_instances(const std::vector<Instance>& all, bool quantized, const auto& put) {
  const std::size_t n = all.size();
  put(Stream::instance_place, n, [&](std::size_t k) { return quantized ? snapped_place(all[k].place) : all[k].place; });
  put(Stream::instance_turn, n, [&](std::size_t k) { return all[k].turn; });
  put(Stream::instance_turn_short, n, [&](std::size_t k) {
    const Vec4& q = all[k].turn;
    return std::array{signed_short(q.x), signed_short(q.y), signed_short(q.z), signed_short(q.w)};
  });
  put(Stream::instance_size, n,
      [&](std::size_t k) { return Vec3(quantized ? snapped_size(all[k].size) : all[k].size); });
  put(Stream::instance_colour, n, [&](std::size_t k) { return all[k].colour; });
}

}  // namespace

std::uint64_t element_bytes(Stream stream) {
  switch (stream) {
    case Stream::position:
    case Stream::normal:
    case Stream::instance_place:
    case Stream::instance_size:
      return 12;
    case Stream::tangent:
    case Stream::instance_turn:
      return 16;
    case Stream::uv_float:
    case Stream::position_short:  // three shorts and two bytes of padding
    case Stream::instance_turn_short:
      return 8;
    case Stream::normal_byte:  // three bytes and one of padding
    case Stream::tangent_byte:
    case Stream::uv_short:
    case Stream::colour:
    case Stream::wind:
    case Stream::index_int:
    case Stream::instance_colour:
      return 4;
    case Stream::index_short:
      return 2;
  }
  return 0;
}

IVec3 MeshFacts::quantum(const Vec3& p) const {
  const Vec3 q = (p - centre) / step;
  IVec3 out;
  for (int c = 0; c < 3; ++c) out[c] = static_cast<int>(std::clamp(std::floor(q[c] + 0.5f), -kMostQuanta, kMostQuanta));
  return out;
}

bool MeshFacts::has(Stream stream) const {
  if (is_of_instances(stream) != (instances != nullptr)) return false;
  switch (stream) {
    case Stream::position:
      return !quantized;
    case Stream::position_short:
      return quantized;
    case Stream::normal:
      return !mesh->normals.empty() && !quantized;
    case Stream::normal_byte:
      return !mesh->normals.empty() && quantized;
    case Stream::tangent:
      return bumpy && !quantized;
    case Stream::tangent_byte:
      return bumpy && quantized;
    case Stream::uv_float:
      return textured && !uv_in_unit_square;
    case Stream::uv_short:
      return textured && uv_in_unit_square;
    case Stream::colour:
      return coloured;
    case Stream::wind:
      return !mesh->wind.empty();
    case Stream::index_short:
      return vertices <= kShortIndexVertices;
    case Stream::index_int:
      return vertices > kShortIndexVertices;
    case Stream::instance_turn:
      return !quantized;
    case Stream::instance_turn_short:
      return quantized;
    case Stream::instance_colour:
      return coloured;
    case Stream::instance_place:
    case Stream::instance_size:
      return true;
  }
  return false;
}

std::uint64_t MeshFacts::count(Stream stream) const {
  if (!has(stream)) return 0;
  if (instances) return instances->size();
  return is_index(stream) ? mesh->indices.size() : vertices;
}

Result<void> measure(MeshFacts& facts) {
  assert(facts.mesh);
  const TriangleMesh& mesh = *facts.mesh;
  const std::size_t n = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
  if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size()) || !fits(mesh.colours.size()) || !fits(mesh.wind.size()))
    return broken(fmt::format(
        "{} positions, {} normals, {} texture coordinates, {} colours and {} wind weights do not go together", n,
        mesh.normals.size(), mesh.uvs.size(), mesh.colours.size(), mesh.wind.size()));
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
  for (std::size_t i = 0; i < n; ++i) {
    const MeshFacts& facts = meshes[group.first + i];
    costs[i] = static_cast<float>(facts.mesh ? facts.mesh->indices.size() : facts.instances->size());
  }
  parallel_dearest_first(costs, [&](std::size_t i) {
    const std::size_t m = group.first + i;
    const MeshFacts& facts = meshes[m];
    const auto place = [&](Stream stream) {
      const std::size_t s = slot(stream);
      return out.data() + (group.views[s].offset - group.begin) + layout.offsets[m][s];
    };
    // Copies element by element: the places are aligned to four bytes only by file offset, not by type.
    const auto put = [&](Stream stream, std::size_t count, const auto& element) {
      if (!facts.has(stream)) return;
      std::byte* to = place(stream);
      for (std::size_t k = 0; k < count; ++k) {
        const auto value = element(k);
        std::memcpy(to, &value, sizeof value);
        to += sizeof value;
      }
    };
    if (facts.instances)
      put_instances(*facts.instances, facts.quantized, put);
    else
      put_mesh(facts, reorder, put);
  });
}

}  // namespace bosquet::exchange
