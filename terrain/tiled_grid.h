// Tiled grid: a two-dimensional array as a value whose copies share all tiles that were not edited.
//
// Layout    tiles of 64 x 64 entries, row-major inside a tile and among tiles; entry (i, j): i east, j north
// Holds     a tile once shared is never written; an editor writes to its own copies of the tiles it touches, so readers
//           of older values need no lock
// Cost      copying a grid copies one pointer; editing it copies a pointer for each tile and the tiles that are written;
//           a grid of one value holds a single tile
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/vec.h"

namespace bosquet::terrain {

template <class T>
class TiledGrid {
 public:
  static constexpr int kTile = 64;
  using Tile = std::array<T, static_cast<std::size_t>(kTile) * kTile>;

  TiledGrid() : TiledGrid(IVec2{1}, T{}) {}
  TiledGrid(IVec2 size, T everywhere)
      : size_(size), tiles_((size.x + kTile - 1) / kTile, (size.y + kTile - 1) / kTile) {
    assert(size.x > 0 && size.y > 0);
    auto tile = std::make_shared<Tile>();
    tile->fill(everywhere);
    use(Table(static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y), std::move(tile)));
  }

  IVec2 size() const { return size_; }
  IVec2 tiles() const { return tiles_; }
  T at(int i, int j) const { return (*pointers_[tile_of(i, j)])[inside(i, j)]; }
  const Tile& tile(IVec2 t) const { return *pointers_[index(t)]; }

  /// Whether both values hold the same memory there.
  bool shares_tile(const TiledGrid& other, IVec2 t) const { return pointers_[index(t)] == other.pointers_[index(t)]; }
  /// Whether nothing was edited between the two values.
  bool shares_all(const TiledGrid& other) const { return table_ == other.table_; }

  static std::size_t inside(int i, int j) {
    return static_cast<std::size_t>(j % kTile) * kTile + static_cast<std::size_t>(i % kTile);
  }

 private:
  template <class>
  friend class TileEditor;
  using Table = std::vector<std::shared_ptr<const Tile>>;

  void use(Table table) {
    auto own = std::make_shared<Table>(std::move(table));
    pointers_ = own->data();
    table_ = std::move(own);
  }
  std::size_t index(IVec2 t) const {
    return static_cast<std::size_t>(t.y) * static_cast<std::size_t>(tiles_.x) + static_cast<std::size_t>(t.x);
  }
  std::size_t tile_of(int i, int j) const { return index({i / kTile, j / kTile}); }

  IVec2 size_, tiles_;
  std::shared_ptr<const Table> table_;
  const std::shared_ptr<const Tile>* pointers_ = nullptr;  // the table's, one step nearer
};

/// Writes into a grid, copying each tile before the first write to it. Nobody may copy the grid while its editor lives.
template <class T>
class TileEditor {
 public:
  using Tile = typename TiledGrid<T>::Tile;

  explicit TileEditor(TiledGrid<T>& grid) : grid_(grid) {
    auto table = std::make_shared<typename TiledGrid<T>::Table>(*grid.table_);
    pointers_ = table->data();
    own_.resize(table->size());
    grid.pointers_ = pointers_;
    grid.table_ = std::move(table);
  }

  void set(int i, int j, T value) {
    tile({i / TiledGrid<T>::kTile, j / TiledGrid<T>::kTile})[TiledGrid<T>::inside(i, j)] = value;
  }

  /// The tile, writable. Different tiles may be asked for from different threads.
  Tile& tile(IVec2 t) {
    const std::size_t n = grid_.index(t);
    if (!own_[n]) {
      auto copy = std::make_shared<Tile>(*pointers_[n]);
      own_[n] = copy.get();
      pointers_[n] = std::move(copy);
    }
    return *own_[n];
  }

 private:
  TiledGrid<T>& grid_;
  std::shared_ptr<const Tile>* pointers_ = nullptr;
  std::vector<Tile*> own_;
};

}  // namespace bosquet::terrain
