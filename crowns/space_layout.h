// Space layout: where trees, obstacles and hero trees stand on the lattice, before any front moves. For the division
// and its updates; nobody else includes it.
//
// Rule      crown_space.h's decisions: roots, layers, reach, and the domain, the columns that exist
// Decision  with a limited reach and no overhang given, crowns overhang the site by the largest reach, so nothing cuts
//           them and the domain has no edge that an edit could move
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "crowns/crown_space.h"
#include "crowns/propagation.h"

namespace bosquet::terrain {
struct Terrain;
}

namespace bosquet::crowns {

inline std::uint64_t packed(IVec2 v) {
  return (std::uint64_t{static_cast<std::uint32_t>(v.y)} << 32) | static_cast<std::uint32_t>(v.x);
}
inline IVec2 tile_of(IVec2 column) { return {column.x >> 6, column.y >> 6}; }
inline bool by_north_then_east(IVec2 a, IVec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }
inline std::size_t inside(IVec2 column) {
  return static_cast<std::size_t>((column.y & (kTileEdge - 1)) * kTileEdge + (column.x & (kTileEdge - 1)));
}

/// Columns that exist, both ends included.
struct Domain {
  IVec2 low{0}, high{0};
  bool contains(IVec2 c) const { return c.x >= low.x && c.y >= low.y && c.x <= high.x && c.y <= high.y; }
  bool operator==(const Domain&) const = default;
};

/// A tree on the lattice. Two trees of one key and id with equal placements have equal fronts.
struct Placed {
  double east = 0, north = 0;      ///< columns
  double reach = 0;                ///< columns; below 0 when the tree has the voxels over its base alone
  double trunk = 0;                ///< radius, columns
  double slowness = 1;             ///< ticks a column
  std::int32_t base = 0, top = 0;  ///< layers [base, top)
  IVec2 root{0};                   ///< column

  bool takes_part(std::int32_t layer) const { return layer >= base && layer < top; }
  bool operator==(const Placed&) const = default;
};

/// Voxels of hero trees in one tile, those of higher ids first.
struct HeroVoxel {
  std::int32_t layer = 0;
  std::uint16_t column = 0;  ///< inside the tile
  std::int32_t owner = 0;
};

struct SpaceLayout {
  Domain domain;
  std::vector<Placed> placed;                                        ///< of each claimant
  std::vector<std::int32_t> rank;                                    ///< place of its key among all keys
  std::unordered_map<std::uint64_t, std::vector<HeroVoxel>> heroes;  ///< by packed tile
};

/// Checks options, trees and what stands; never runs long.
Result<void> check_input(std::span<const Claimant> trees, const Standing& standing, const SpaceOptions& options);

/// Obstacles and hero trees by falling id: the order in which they claim.
Standing sorted(Standing standing);

/// Places all. `standing` is sorted. Fails when there are fewer columns than trees.
Result<SpaceLayout> lay_out(std::span<const Claimant> trees, const Standing& standing, Vec2 site_m,
                            const SpaceOptions& options);

/// Calls visit(tile) for each tile that a tree of limited reach may claim of.
template <class Visit>
void for_each_tile_reached(const Placed& p, const Domain& domain, const Visit& visit) {
  const auto clipped = [&](double v, int axis) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(v), static_cast<double>(domain.low[axis]), static_cast<double>(domain.high[axis])));
  };
  const double reach = std::max(p.reach, 0.0);
  const IVec2 from = tile_of({clipped(p.east - reach, 0), clipped(p.north - reach, 1)});
  const IVec2 to = tile_of({clipped(p.east + reach, 0), clipped(p.north + reach, 1)});
  const IVec2 home = tile_of(p.root);
  bool at_home = false;
  for (std::int32_t n = from.y; n <= to.y; ++n)
    for (std::int32_t e = from.x; e <= to.x; ++e) {
      const double x = p.east - std::clamp(p.east, e * 64.0, e * 64.0 + 64.0);
      const double y = p.north - std::clamp(p.north, n * 64.0, n * 64.0 + 64.0);
      if (x * x + y * y > reach * reach) continue;
      at_home = at_home || home == IVec2{e, n};
      visit(IVec2{e, n});
    }
  if (!at_home) visit(home);
}

/// Whether a tree's reach takes in every column of the domain's box.
bool reaches_everything(const Placed& p, const Domain& domain);

/// Lowest layer above the ground in each column of a tile; the largest number off the domain.
std::shared_ptr<const std::vector<std::int32_t>> ground_layers(IVec2 tile, const terrain::Terrain& terrain,
                                                               const Domain& domain, const SpaceOptions& options);
inline constexpr std::int32_t kNoGround = std::numeric_limits<std::int32_t>::max();

/// A tree's front in one layer; the caller sets root and owner.
Front front_of(const Placed& p, std::int32_t rank);

/// Calls visit(span) for the spans of a volume over a tile.
template <class Visit>
void for_each_span(const ObstacleVolume& volume, IVec2 tile, const Visit& visit) {
  const IVec2 low = tile * kTileEdge, high = low + (kTileEdge - 1);
  if (volume.high.x < low.x || volume.high.y < low.y || volume.low.x > high.x || volume.low.y > high.y) return;
  for (std::int32_t j = std::max(low.y, volume.low.y); j <= std::min(high.y, volume.high.y); ++j)
    for (const ColumnSpan& s : row(volume, j))
      if (s.column.x >= low.x && s.column.x <= high.x) visit(s);
}

// Steps on one tile, in this order: obstacles, fronts, what hangs below bases, hero trees.

/// Gives free voxels above the ground to the obstacles over them.
void claim_for_obstacles(SpaceTile& tile, const Standing& standing);

/// Free voxels above ground but below the base of the tree that owns the voxel above them go to that tree.
/// base(slot) is the layer of a tree's base.
void hang_below_bases(SpaceTile& tile, const std::function<std::int32_t(std::int32_t)>& base);

/// Gives hero trees their voxels, and notes what lay under them.
void claim_for_heroes(SpaceTile& tile, const SpaceLayout& layout);

/// Adds `n` voxels from `first` eastwards to a share.
void add_run(LayerShare& share, IVec2 first, std::int32_t n);

}  // namespace bosquet::crowns
