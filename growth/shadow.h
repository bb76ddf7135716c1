// Shadow: how much of the sky a tree's own wood takes from the places below it.
//
// Source    Palubicki et al. 2009, shadow propagation; Longay 2014, 4.2.2
// Model     wood in cell (i, j, k) adds a * b^-q to the cells q = 0 .. q_max layers below within |di|, |dk| <= q
// Units     cells of 2 l (at detail 1); sums in integers of 2^-16, so that shed wood takes back exactly what it gave
// Layout    cell (i, j, k) spans anchor + cell * (first + (i, j, k)) to the next; sum[(j * nz + k) * nx + i]; the grid
//           grows when wood leaves it. Cells stand at the anchor whatever the room, so the room changes no light
// Decision  what casts and takes back is only counted by cell until settle(), once a season: most shoots of a season
//           stand in few cells, and wood that is moved within its cell costs nothing. Light is as of the last settle()
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "growth/lanes.h"
#include "growth/shadow_pyramid.h"

namespace bosquet::growth {

class ShadowGrid {
 public:
  static constexpr float kUnit = 65536.0f;

  /// `strength` is a of one internode. `room` is where wood is expected; it may grow past it. Cells have a corner at
  /// `anchor`, which stands on the ground.
  void reset(const Box3& room, const Vec3& anchor, float cell_m, float strength, float falloff, int depth);

  /// Returns p's place, in this layout.
  std::int32_t cast(const Vec3& p) { return count(p, 1); }
  void take_back(const Vec3& p) { count(p, -1); }
  /// Another one once the grid grew: places of before are void.
  int layout() const { return layout_; }
  /// Brings the sums up to date; returns how many cells' shadows changed.
  std::size_t settle();

  /// Reads light at many places, its numbers beside it; until wood casts or settles.
  struct Reader {
    Float4 anchor, inverse;
    Int4 first, cells;
    std::int32_t row, layer;  ///< numbers from one row and layer to the next
    std::int32_t own;         ///< what an internode takes from its own cell
    const std::int32_t* sum;

    Int4 cell(const Vec3& p) const {
      const Float4 q = (lanes(p) - anchor) * inverse;
      const Int4 c = whole(q);
      // Towards zero is one too high below zero: the comparison is -1 there.
      return c + (__builtin_convertvector(c, Float4) > q) - first;
    }
    std::int32_t number(Int4 cell) const { return cell[1] * layer + cell[2] * row + cell[0]; }
    /// Of p's cell, for p in the grid.
    std::int32_t place(const Vec3& p) const { return number(cell(p)); }
    float exposure(const Vec3& p) const {
      const Int4 c = cell(p);
      return all((c >= Int4{}) & (c < cells)) ? exposure(number(c)) : 1.0f;
    }
    float exposure(std::int32_t place) const {
      const std::int32_t s = sum[place] - own;
      return 1.0f - static_cast<float>(std::min(std::max(s, 0), static_cast<std::int32_t>(kUnit))) * (1.0f / kUnit);
    }
  };
  const Reader& reader() const { return reader_; }

  /// Light that the tree's own wood leaves at p, where an internode of its own stands: clamp(1 - s + a, 0, 1).
  float exposure(const Vec3& p) const { return reader_.exposure(p); }

 private:
  std::size_t index(IVec3 c) const {
    return (static_cast<std::size_t>(c.y) * static_cast<std::size_t>(cells_.z) + static_cast<std::size_t>(c.z)) *
               static_cast<std::size_t>(cells_.x) +
           static_cast<std::size_t>(c.x);
  }
  std::int32_t count(const Vec3& p, int change);
  void add(IVec3 c, int times);
  void make_room(IVec3 c);
  void prepare();

  Vec3 anchor_{0.0f};
  float inverse_ = 1.0f;
  IVec3 first_{0};  ///< lowest cell, from the anchor
  IVec3 cells_{0};
  int depth_ = 1;
  int layout_ = 0;
  Reader reader_{};                 ///< of the present grid
  Int4 inner_low_{}, inner_end_{};  ///< cells whose pyramids fit into it
  std::array<std::int32_t, kMostShadowDepth + 1> amount_{};
  std::vector<std::int32_t> sum_, old_;  ///< and kPastPyramid more
  std::vector<std::int32_t> waiting_;    ///< change of the wood in a cell since the last settle; 0 beyond the grid
  std::vector<IVec3> changed_;           ///< cells where it may not be 0
};

}  // namespace bosquet::growth
