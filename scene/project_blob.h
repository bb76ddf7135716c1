// Project blobs: terrain tiles, meshes and skeletons as bytes.
//
// Format    little-endian values one after another, compressed by zlib (level 1: a stroke is to be saved at once); how
//           many bytes there are uncompressed and their checksum stand beside a blob in the file
// Tiles     a bundle of tiles lies in one blob, 64 kB uncompressed for heights, tile by tile from south to north and
//           west to east inside; bundle b is at (b mod w, b / w), w = bundles in a row
// Errors    a blob that is none of ours: nothing
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "growth/skeleton.h"
#include "terrain/area.h"
#include "terrain/tiled_grid.h"

namespace bosquet::scene {

using Bytes = std::vector<std::byte>;

Bytes compress(std::span<const std::byte> bytes);
/// Nothing when they are not `size` bytes compressed.
std::optional<Bytes> decompress(std::span<const std::byte> bytes, std::size_t size);

Bytes bytes_of(const TriangleMesh& mesh);
std::optional<TriangleMesh> mesh_of(std::span<const std::byte> bytes);
Bytes bytes_of(const growth::Skeleton& skeleton);
std::optional<growth::Skeleton> skeleton_of(std::span<const std::byte> bytes);

/// How a grid's tiles are bundled.
template <class T>
struct Bundles {
  static constexpr int kEdge = sizeof(T) >= 4 ? 2 : 4;  ///< tiles along a bundle's edge
  static constexpr std::size_t kValue = std::is_same_v<T, terrain::AreaCell> ? 5 : sizeof(T);

  IVec2 tiles, count;

  explicit Bundles(IVec2 tiles_of_grid) : tiles(tiles_of_grid), count((tiles_of_grid + kEdge - 1) / kEdge) {}

  std::size_t size() const { return static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y); }
  /// Calls body(tile) for the tiles of a bundle.
  template <class Body>
  void for_each(std::size_t bundle, const Body& body) const {
    const IVec2 low = kEdge * IVec2{static_cast<int>(bundle) % count.x, static_cast<int>(bundle) / count.x};
    for (int j = low.y; j < low.y + kEdge && j < tiles.y; ++j)
      for (int i = low.x; i < low.x + kEdge && i < tiles.x; ++i) body(IVec2{i, j});
  }
  /// Bytes of a bundle uncompressed.
  std::size_t bytes(std::size_t bundle) const {
    std::size_t n = 0;
    for_each(bundle, [&](IVec2) { n += kValue * std::tuple_size_v<typename terrain::TiledGrid<T>::Tile>; });
    return n;
  }
};

template <class T>
Bytes bytes_of(const terrain::TiledGrid<T>& grid, std::size_t bundle);
/// Writes a bundle's bytes, which are as many as Bundles says, into the grid. Tiles that hold one value over and over,
/// that of the bytes `everywhere`, are left as the grid was made.
template <class T>
void put_bytes(terrain::TileEditor<T>& editor, const Bundles<T>& bundles, std::size_t bundle,
               std::span<const std::byte> bytes, std::span<const std::byte> everywhere);
template <class T>
T first_value(std::span<const std::byte> bytes);

}  // namespace bosquet::scene
