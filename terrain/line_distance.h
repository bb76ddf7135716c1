// Line distance: how far the points of a grid lie from a line that may grow while it is drawn.
//
// Model     the least distance to any piece of the line; points farther than `reach` are never visited
// Holds     however a line is cut into calls of extend(), the distances in the end are the same bits: each is the least
//           over the same pieces. (A line of one point is a piece of its own until a second one comes.)
// Cost      the points of the box around each new piece, in the tiles near it; 16 kB for each such tile
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/vec.h"
#include "terrain/tiled_grid.h"

namespace bosquet::terrain {

struct Piece {
  Vec2 from, to;
};

/// The pieces between the points of a line; one point is a piece without length.
std::vector<Piece> pieces(std::span<const Vec2> line);

float squared_distance(const Piece& piece, Vec2 p);

/// False only where no point of the box is within the radius of the piece.
bool near_box(const Piece& piece, const Box2& box, float radius);

class LineDistance {
 public:
  /// Grid point (i, j), of `size`, lies at (i + offset, j + offset) * cell.
  LineDistance(IVec2 size, float cell, float offset, float reach)
      : size_(size),
        tiles_((size + kTile - 1) / kTile),
        cell_(cell),
        offset_(offset),
        reach_(reach),
        least_(static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y)) {}

  /// Calls visit(i, j, distance) for each point that the new pieces come nearer to than the line so far. Tiles are
  /// visited in parallel, each by one thread.
  template <class Visit>
  void extend(std::span<const Piece> line, const Visit& visit);

  /// Forgets the line.
  void clear() { std::fill(least_.begin(), least_.end(), nullptr); }

 private:
  static constexpr int kTile = TiledGrid<float>::kTile;
  using Least = TiledGrid<float>::Tile;  // squared distances

  IVec2 low_tile(Vec2 p) const {
    const auto at = [&](float x, int n) {
      const float t = x / cell_ / static_cast<float>(kTile);
      return t > 0.0f ? static_cast<int>(std::min(t, static_cast<float>(n - 1))) : 0;
    };
    return {at(p.x, tiles_.x), at(p.y, tiles_.y)};
  }

  IVec2 size_, tiles_;
  float cell_, offset_, reach_;
  std::vector<std::unique_ptr<Least>> least_;  // by tile; missing where the line did not come near
};

template <class Visit>
void LineDistance::extend(std::span<const Piece> line, const Visit& visit) {
  Box2 box;
  for (const Piece& piece : line) box.add(piece.from), box.add(piece.to);
  if (box.empty()) return;
  const float margin = reach_ + cell_;
  const Vec2 from = box.low - margin, to = box.high + margin;
  if (!(to.x >= 0.0f && to.y >= 0.0f)) return;
  const IVec2 low = low_tile(from), high = low_tile(to), count = high - low + 1;
  parallel_for(static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y), [&](std::size_t n) {
    const IVec2 t = low + IVec2{static_cast<int>(n) % count.x, static_cast<int>(n) / count.x};
    const IVec2 begin = t * kTile, end = glm::min(begin + kTile, size_);
    const Box2 tile_box{(Vec2(begin) + offset_) * cell_, (Vec2(end - 1) + offset_) * cell_};
    std::unique_ptr<Least>& least =
        least_[static_cast<std::size_t>(t.y) * static_cast<std::size_t>(tiles_.x) + static_cast<std::size_t>(t.x)];
    std::array<bool, static_cast<std::size_t>(kTile) * kTile> nearer{};
    IVec2 first = end, last = begin;  // of the points that came nearer
    for (const Piece& piece : line) {
      if (!near_box(piece, tile_box, reach_)) continue;
      if (!least) {
        least = std::make_unique<Least>();
        least->fill(std::numeric_limits<float>::max());
      }
      // The points that can be within reach of the piece, and one more to each side for rounding.
      const Vec2 west_south = (glm::min(piece.from, piece.to) - reach_) / cell_ - offset_;
      const Vec2 east_north = (glm::max(piece.from, piece.to) + reach_) / cell_ - offset_;
      const IVec2 p0{glm::clamp(west_south - 1.0f, Vec2(begin), Vec2(end))};
      const IVec2 p1{glm::clamp(east_north + 2.0f, Vec2(begin), Vec2(end))};
      for (int j = p0.y; j < p1.y; ++j)
        for (int i = p0.x; i < p1.x; ++i) {
          const std::size_t k = TiledGrid<float>::inside(i, j);
          const float distance = squared_distance(piece, (Vec2(i, j) + offset_) * cell_);
          if (!(distance < (*least)[k]) || distance > reach_ * reach_) continue;
          (*least)[k] = distance;
          nearer[k] = true;
          first = glm::min(first, IVec2{i, j}), last = glm::max(last, IVec2{i + 1, j + 1});
        }
    }
    for (int j = first.y; j < last.y; ++j)
      for (int i = first.x; i < last.x; ++i) {
        const std::size_t k = TiledGrid<float>::inside(i, j);
        if (nearer[k]) visit(i, j, std::sqrt((*least)[k]));
      }
  });
}

}  // namespace bosquet::terrain
