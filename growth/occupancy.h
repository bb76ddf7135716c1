// Occupancy: where living wood stands so near that nothing new may grow.
//
// Source    Runions et al. 2007 (kill distance); Longay 2014, 4.2.1: a sphere of radius r around every node
// Decision  every node of living wood occupies, whatever its bud does; shedding frees it
// Layout    cells of a little under r / sqrt(3), so that a cell that holds a node is occupied as a whole; one bit a
//           cell, a word for a block of 4 x 4 x 4: what may stand within r of a place is in the bits of eight words,
//           and only nodes of cells that hold some are measured. The first node of a cell stands in the cell's entry,
//           further ones in a list; the grid grows when wood leaves it
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "growth/lanes.h"

namespace bosquet::growth {

class Occupancy {
 public:
  void reset(const Box3& room, float radius_m);

  void add(std::int32_t node, const Vec3& p);
  void remove(std::int32_t node);

  /// Tells the memory that occupied(p) will be asked.
  void expect(Float4 p) const {
    const Int4 at = whole((p - lanes(low_)) * all4(inverse_));
    const IVec3 c{at[0], at[1], at[2]};
    if (inside(c, 0)) __builtin_prefetch(&first_[place(c).entry()]);
  }
  /// True when a node stands nearer than r.
  bool occupied(Float4 p) const;
  bool occupied(const Vec3& p) const { return occupied(lanes(p)); }

 private:
  struct Entry {
    Vec3 at;
    std::int32_t node;
  };
  struct Place {
    std::size_t block;
    int bit;
    std::size_t entry() const { return block * 64 + static_cast<std::size_t>(bit); }
  };

  /// Cells outside the grid are far from 0 .. cells: negative, or beyond.
  IVec3 cell(const Vec3& p) const {
    const Vec3 q = (p - low_) * inverse_;
    return {static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z)};
  }
  bool inside(IVec3 c, int margin) const {
    const auto m = static_cast<unsigned>(margin);
    return static_cast<unsigned>(c.x) - m < static_cast<unsigned>(cells_.x) - 2 * m &&
           static_cast<unsigned>(c.y) - m < static_cast<unsigned>(cells_.y) - 2 * m &&
           static_cast<unsigned>(c.z) - m < static_cast<unsigned>(cells_.z) - 2 * m;
  }
  std::size_t block(IVec3 b) const {
    return (static_cast<std::size_t>(b.y) * static_cast<std::size_t>(blocks_.z) + static_cast<std::size_t>(b.z)) *
               static_cast<std::size_t>(blocks_.x) +
           static_cast<std::size_t>(b.x);
  }
  Place place(IVec3 c) const { return {block(c >> 2), (c.y & 3) << 4 | (c.z & 3) << 2 | (c.x & 3)}; }
  bool near(const Vec3& p, std::size_t block, std::uint64_t cells) const;
  void lay_out(const Box3& room);
  void link(std::int32_t node, IVec3 c);

  float radius_m_ = 1.0f, cell_m_ = 1.0f, inverse_ = 1.0f;
  Vec3 low_{0.0f};
  IVec3 cells_{0}, blocks_{0};
  Box3 room_;
  std::vector<std::uint64_t> bits_;    ///< by block: cells that hold a node
  std::vector<Entry> first_;           ///< by cell; valid where its bit is set
  std::vector<std::int32_t> next_;     ///< by node: next one in its cell, -1 at the end
  std::vector<std::int64_t> cell_of_;  ///< by node: its cell's entry, -1 when it is not here
  std::vector<Vec3> at_;               ///< by node
};

}  // namespace bosquet::growth
