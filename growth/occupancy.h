// Occupancy: where nothing new may grow, for living wood stands too near or the place is not the tree's.
//
// Source    Runions et al. 2007 (kill distance); Longay 2014, 4.2.1: a sphere of radius r around every node
// Decision  every node of living wood occupies, whatever its bud does; shedding frees it
// Decision  space is told in cells of r / 3, never smaller than `least_cell_m`: a cell is occupied when its middle is nearer than r to a node, the node set
//           in the middle of its eighth of a cell. Cells stand at the tree's base whatever the room, so the room
//           changes no tree
// Layout    one byte a cell: how many nodes occupy it, or kClosed: below ground, or no voxel of the crown region
//           touches it. A cell that 255 nodes occupy is closed for good. A node's sphere is added in rows of 8 cells;
//           around wood there is always room enough for what its buds perceive; the grid grows when wood leaves it
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "crowns/crown_region.h"
#include "growth/lanes.h"

namespace bosquet::growth {

/// Some voxels along an axis; none when first > last.
struct VoxelRange {
  int first, last;
  bool operator==(const VoxelRange&) const = default;
};

/// Two rows of a sphere's cells: 1 where occupied.
struct alignas(16) OccupiedRows {
  std::array<std::uint8_t, 16> cells{};
};
/// Where they begin, from the cell of the sphere's node.
using RowOffsets = std::array<std::ptrdiff_t, 2>;

class Occupancy {
 public:
  static constexpr float kCell = 1.0f / 3.0f;  ///< in r
  static constexpr std::uint8_t kClosed = 255;

  /// `room` is where wood is expected, `reach_m` how far from it markers stand. The region (may be null: none is closed
  /// but below ground) must outlive the use; above `lid_m` its layer there goes on. `least_cell_m` bounds the memory.
  void reset(const Box3& room, float radius_m, float reach_m, const crowns::CrownRegion* region = nullptr,
             float lid_m = 0.0f, float least_cell_m = 0.0f);

  void add(const Vec3& node) { change(half_cell(node), true); }
  void remove(const Vec3& node) { change(half_cell(node), false); }
  void move(const Vec3& from, const Vec3& to);

  float cell_m() const { return cell_m_; }

  /// Finds the cells of places within reach of wood, four at once; until wood is added.
  struct CellFinder {
    Float4 inverse, origin;
    Int4 first[3];
    Int4 width, depth;
    Int4 operator()(Float4 x, Float4 y, Float4 z) const {
      const Int4 i = whole(x * inverse + origin) - first[0];
      const Int4 j = whole(y * inverse + origin) - first[1];
      const Int4 k = whole(z * inverse + origin) - first[2];
      return (j * depth + k) * width + i;
    }
  };
  CellFinder cell_finder() const {
    const auto four = [](std::int32_t n) { return Int4{n, n, n, n}; };
    return {all4(inverse_),
            all4(kOrigin),
            {four(first_.x), four(first_.y), four(first_.z)},
            four(cells_.x),
            four(cells_.z)};
  }
  /// 0: free; kClosed; else the number of nodes that occupy it.
  std::uint8_t state(std::int32_t cell) const { return taken_[static_cast<std::size_t>(cell)]; }

  /// May nothing stand at p, anywhere? Beyond the grid all is as if free.
  bool occupied(const Vec3& p) const;

 private:
  static constexpr float kOrigin = 32768.0f;  ///< in cells, so that numbers are positive and the same in every room
  static constexpr int kRow = 8;
  static constexpr int kBefore = 3;  ///< cells of a sphere's row before its node's, and layers and rows on each side
  struct Sphere {
    std::vector<OccupiedRows> pairs;
    std::vector<IVec2> at;            ///< of each row, j and k from the node's cell
    std::vector<RowOffsets> offsets;  ///< the same in the present grid
  };

  IVec3 half_cell(const Vec3& p) const {
    const Int4 h = whole(lanes(p) * all4(2.0f * inverse_) + all4(2.0f * kOrigin));
    return {h[0], h[1], h[2]};
  }
  std::size_t index(IVec3 c) const {
    return (static_cast<std::size_t>(c.y) * static_cast<std::size_t>(cells_.z) + static_cast<std::size_t>(c.z)) *
               static_cast<std::size_t>(cells_.x) +
           static_cast<std::size_t>(c.x);
  }
  void change(IVec3 half_cell, bool more);
  void make_spheres();
  void lay_out(IVec3 first, IVec3 cells);
  void close();
  void make_room(IVec3 cell);

  float radius_m_ = 0.0f, cell_m_ = 1.0f, inverse_ = 1.0f, lid_m_ = 0.0f;
  const crowns::CrownRegion* region_ = nullptr;
  int margin_ = 0;  ///< cells around wood that must exist
  IVec3 first_{0};  ///< lowest cell
  IVec3 cells_{0};
  std::vector<std::uint8_t> taken_, old_;  ///< and kRow more
  std::array<Sphere, 8> spheres_;          ///< by the node's eighth of its cell
  std::vector<std::uint8_t> rows_;         ///< a row of cells for each row of the region's voxels
  std::vector<VoxelRange> columns_;        ///< cells that touch each column of its voxels
};

}  // namespace bosquet::growth
