#include "scene/project_blob.h"

#include <zlib.h>

#include <cmath>
#include <cstring>

namespace bosquet::scene {
namespace {

constexpr int kLevel = 1;

template <class T>
void put(Bytes& out, std::span<const T> values) {
  if (values.empty()) return;
  const std::size_t at = out.size();
  out.resize(at + values.size_bytes());
  std::memcpy(out.data() + at, values.data(), values.size_bytes());
}

void put(Bytes& out, std::uint64_t value) { put(out, std::span<const std::uint64_t>(&value, 1)); }

// Takes values off the front; fails when there are too few bytes.
class Taker {
 public:
  explicit Taker(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  bool one(T& value) {
    if (rest_.size() < sizeof(T)) return false;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
    return true;
  }
  // A list with its length before it.
  template <class T>
  bool list(std::vector<T>& values) {
    std::uint64_t n = 0;
    if (!one(n) || n > rest_.size() / sizeof(T)) return false;
    values.resize(n);
    if (n) std::memcpy(values.data(), rest_.data(), n * sizeof(T));
    rest_ = rest_.subspan(n * sizeof(T));
    return true;
  }
  bool done() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

template <class T>
void put_list(Bytes& out, const std::vector<T>& values) {
  put(out, std::uint64_t{values.size()});
  put(out, std::span<const T>(values));
}

// The fields of a mesh and of a skeleton, in the order of the file.
template <class Mesh, class Visit>
bool each_list(Mesh& m, const Visit& visit) requires std::same_as<std::remove_const_t<Mesh>, TriangleMesh> {
  return visit(m.positions) && visit(m.normals) && visit(m.uvs) && visit(m.colours) && visit(m.indices);
}
template <class Skeleton, class Visit>
bool each_list(Skeleton& s, const Visit& visit) requires std::same_as<std::remove_const_t<Skeleton>, growth::Skeleton> {
  return visit(s.parent) && visit(s.axis) && visit(s.order) && visit(s.distal) && visit(s.radius) && visit(s.born) &&
         visit(s.shed) && visit(s.light) && visit(s.vigor) && visit(s.pipes);
}
template <class Skeleton, class Visit>
bool each_number(Skeleton& s, const Visit& visit) {
  return visit(s.seasons) && visit(s.internode_length_m) && visit(s.detail) && visit(s.tip_diameter_m) &&
         visit(s.pipe_exponent);
}

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What readers of a skeleton rely on.
bool sound(const growth::Skeleton& s) {
  const std::size_t n = s.size();
  const auto as_many = [&](const auto& list) { return list.size() == n; };
  if (!as_many(s.axis) || !as_many(s.order) || !as_many(s.distal) || !as_many(s.radius) || !as_many(s.born) ||
      !as_many(s.shed) || !as_many(s.light) || !as_many(s.vigor) || !(s.pipes.empty() || as_many(s.pipes)))
    return false;
  for (std::size_t i = 0; i < n; ++i)
    if (s.parent[i] < -1 || s.parent[i] >= static_cast<std::int64_t>(i) || !finite(s.distal[i]) ||
        !std::isfinite(s.radius[i]))
      return false;
  return n > 0;
}

bool sound(const TriangleMesh& m) {
  const std::size_t n = m.positions.size();
  const auto fits = [&](const auto& list) { return list.empty() || list.size() == n; };
  if (!fits(m.normals) || !fits(m.uvs) || !fits(m.colours) || m.indices.size() % 3 != 0) return false;
  for (const Vec3& p : m.positions)
    if (!finite(p)) return false;
  for (std::uint32_t i : m.indices)
    if (i >= n) return false;
  return true;
}

// A tile's values as they stand in the file.
template <class T>
void put_tile(Bytes& out, const std::array<T, 4096>& tile) {
  put(out, std::span<const T>(tile));
}
void put_tile(Bytes& out, const std::array<terrain::AreaCell, 4096>& tile) {
  for (const terrain::AreaCell& c : tile)
    for (int byte : {c.top & 255, c.top >> 8, c.under & 255, c.under >> 8, int{c.cover}})
      out.push_back(static_cast<std::byte>(byte));
}

template <class T>
T value_at(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}
template <>
terrain::AreaCell value_at(const std::byte* b) {
  const auto byte = [&](int i) { return std::to_integer<unsigned>(b[i]); };
  return {static_cast<terrain::AreaId>(byte(0) | byte(1) << 8), static_cast<terrain::AreaId>(byte(2) | byte(3) << 8),
          static_cast<std::uint8_t>(byte(4))};
}

}  // namespace

Bytes compress(std::span<const std::byte> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  Bytes out(size);
  compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            static_cast<uLong>(bytes.size()), kLevel);
  out.resize(size);
  return out;
}

std::optional<Bytes> decompress(std::span<const std::byte> bytes, std::size_t size) {
  Bytes out(size);
  uLongf length = static_cast<uLongf>(size);
  std::byte none{};
  const int code = uncompress(reinterpret_cast<Bytef*>(size ? out.data() : &none), &length,
                              reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  if (code != Z_OK || length != size) return {};
  return out;
}

Bytes bytes_of(const TriangleMesh& mesh) {
  Bytes out;
  each_list(mesh, [&](const auto& list) { return put_list(out, list), true; });
  return out;
}

std::optional<TriangleMesh> mesh_of(std::span<const std::byte> bytes) {
  Taker taker(bytes);
  TriangleMesh mesh;
  if (!each_list(mesh, [&](auto& list) { return taker.list(list); }) || !taker.done() || !sound(mesh)) return {};
  return mesh;
}

Bytes bytes_of(const growth::Skeleton& skeleton) {
  Bytes out;
  each_list(skeleton, [&](const auto& list) { return put_list(out, list), true; });
  each_number(skeleton, [&](const auto& number) { return put(out, std::span(&number, 1)), true; });
  return out;
}

std::optional<growth::Skeleton> skeleton_of(std::span<const std::byte> bytes) {
  Taker taker(bytes);
  growth::Skeleton skeleton;
  if (!each_list(skeleton, [&](auto& list) { return taker.list(list); }) ||
      !each_number(skeleton, [&](auto& number) { return taker.one(number); }) || !taker.done() || !sound(skeleton))
    return {};
  return skeleton;
}

template <class T>
Bytes bytes_of(const terrain::TiledGrid<T>& grid, std::size_t bundle) {
  const Bundles<T> bundles(grid.tiles());
  Bytes out;
  out.reserve(bundles.bytes(bundle));
  bundles.for_each(bundle, [&](IVec2 tile) { put_tile(out, grid.tile(tile)); });
  return out;
}

template <class T>
void put_bytes(terrain::TileEditor<T>& editor, const Bundles<T>& bundles, std::size_t bundle,
               std::span<const std::byte> bytes, std::span<const std::byte> everywhere) {
  constexpr std::size_t kValue = Bundles<T>::kValue;
  std::size_t at = 0;
  bundles.for_each(bundle, [&](IVec2 t) {
    typename terrain::TiledGrid<T>::Tile tile;
    bool same = true;
    for (T& value : tile) {
      value = value_at<T>(bytes.data() + at);
      same = same && std::memcmp(bytes.data() + at, everywhere.data(), kValue) == 0;
      at += kValue;
    }
    if (!same) editor.tile(t) = tile;
  });
}

template <class T>
T first_value(std::span<const std::byte> bytes) {
  return bytes.size() < Bundles<T>::kValue ? T{} : value_at<T>(bytes.data());
}

#define BOSQUET_GRID_OF(T)                                                                                     \
  template Bytes bytes_of(const terrain::TiledGrid<T>&, std::size_t);                                          \
  template void put_bytes(terrain::TileEditor<T>&, const Bundles<T>&, std::size_t, std::span<const std::byte>, \
                          std::span<const std::byte>);                                                         \
  template T first_value<T>(std::span<const std::byte>);
BOSQUET_GRID_OF(float)
BOSQUET_GRID_OF(std::uint8_t)
BOSQUET_GRID_OF(terrain::AreaId)
BOSQUET_GRID_OF(terrain::AreaCell)
#undef BOSQUET_GRID_OF

}  // namespace bosquet::scene
