// Crown space: the volume above the ground divided among the trees, each voxel owned by one tree or free.
//
// Source    Longay 2014, 6.5.1: boundary propagation in horizontal layers of a voxel space
// Model     in each layer every tree whose representative shape reaches it starts from its trunk and its front advances
//           at speed A^e, A = pi (S_w C_w / 2)^2 the projected crown area, e the speed exponent (1 in the source); a
//           voxel belongs to the front that reaches it first, and a front passes only through its own tree's voxels
//           (propagation.h says how arrival times are computed). Larger trees get more room, borders curve, and a tall
//           tree owns the layers above its lower neighbours.
// Decision  a front ends at reach_factor * S_w C_w / 2 beside the base, so a lone tree does not claim the whole site;
//           infinity gives the source's rule, where it ends when all voxels are claimed
// Decision  layers are world heights; a tree takes part from the layer that holds its base up to the one that holds its
//           top. On a slope, voxels above the ground but below the base of the tree that owns the voxel above them go
//           to that tree. The volume overhangs the site by the largest reach, with the ground's edge height there.
// Decision  the voxel under a base is its tree's in every layer it takes part in, so no tree is left without a region;
//           of several bases in one voxel the lowest key keeps it and the others, in key order, take the nearest free
// Decision  obstacles hold their voxels before any front starts. A tree takes part up to the first layer in which an
//           obstacle stands over its base; a tree whose base lies in an obstacle has the voxels over its base and no
//           more. Hero trees claim theirs after the division (hero_claim.h)
//
// Units     metres
// Lattice   voxel (i, k, j) = (east, up, north) spans [i, i+1] * voxel_m east, [k, k+1] * layer_m up, [j, j+1] *
//           voxel_m north of the site's south-west corner at height 0; indices may be negative. It exists where any
//           part of it lies above the ground at its column's centre and some tree can reach it.
// Holds     each region is 4-connected in every layer from its tree's base up; the division is the same for any number
//           of threads and any order of trees (ties in time go by key)
// Errors    options out of range, trees that are not numbers, and spaces beyond memory_gb come back as one message
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/progress.h"
#include "core/result.h"
#include "core/vec.h"
#include "crowns/crown_region.h"
#include "crowns/hero_claim.h"
#include "crowns/obstacle.h"
#include "crowns/representative_shape.h"

namespace bosquet::terrain {
struct Terrain;
}

namespace bosquet::crowns {

/// A tree that asks for room.
struct Claimant {
  std::uint64_t key = 0;  ///< stable and unique; settles ties
  std::int32_t id = 0;    ///< positive; what grids and slices hold
  Vec2 base{0.0f};        ///< plan (east, north)
  float ground_y = 0.0f;  ///< height of the base
  RepresentativeShape shape;
  float scale_height = 1.0f;  ///< S_h
  float scale_width = 1.0f;   ///< S_w
  bool presses = true;        ///< on its neighbours (asymmetry.h); what is kept cut to a form does not

  float top_y() const { return ground_y + scale_height * shape.mature_height_m; }
  float trunk_radius_m() const { return 0.5f * scale_width * shape.trunk_width_m; }
  float crown_radius_m() const { return 0.5f * scale_width * shape.crown_width_m; }
  float projected_area_m2() const { return shape.projected_area_m2(scale_width); }

  bool operator==(const Claimant&) const = default;
};

/// What stands there before the trees that ask for room.
struct Standing {
  std::vector<Obstacle> obstacles;
  std::vector<HeroClaim> heroes;

  bool operator==(const Standing&) const = default;
};

struct SpaceOptions {
  float voxel_m = 0.25f;
  float layer_m = 1.0f;
  float speed_exponent = 1.0f;
  float reach_factor = 1.5f;
  float overhang_m = -1.0f;  ///< below 0: the largest reach; when that is infinite, 0
  float memory_gb = 8.0f;
  bool keep_ticks = false;  ///< keep arrival times too (8 bytes a voxel more), for comparisons

  VoxelSize voxel() const { return {voxel_m, layer_m}; }
  bool operator==(const SpaceOptions&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, SpaceOptions>
void describe(P& p, Visitor& visit) {
  visit(Real{"voxel_m", "m", 0.02, 20, "Horizontal edge of a voxel"}, p.voxel_m);
  visit(Real{"layer_m", "m", 0.05, 20, "Height of a layer of voxels"}, p.layer_m);
  visit(Real{"speed_exponent", "", 0, 2, "How a front's speed follows the projected crown area; 0 divides as Voronoi"},
        p.speed_exponent);
  visit(Real{"reach_factor", "", 0.5, std::numeric_limits<double>::infinity(),
             "How far beside its base a tree may claim, in crown radii; inf is without limit"},
        p.reach_factor);
  visit(Real{"overhang_m", "m", -1, 1000, "How far crowns may overhang the site's edge; -1 is the largest reach"},
        p.overhang_m);
  visit(Real{"memory_gb", "GB", 0.01, 1000, "A crown space that would take more memory is refused"}, p.memory_gb);
}

inline constexpr std::int32_t kFree = -1;  ///< owner of a voxel that nobody claimed
/// Owner of a voxel of an obstacle or hero tree with this id, below kFree; and back.
inline constexpr std::int32_t owner_of_id(std::int32_t id) { return id - 1; }
inline constexpr std::int32_t id_of_owner(std::int32_t owner) { return owner + 1; }

inline constexpr std::int32_t kTileEdge = 64;  ///< columns along a tile's edge
inline constexpr std::int32_t kTileColumns = kTileEdge * kTileEdge;

/// What one tree owns of one layer.
struct LayerShare {
  std::int32_t layer = 0;
  std::int64_t voxels = 0;
  std::int64_t east_sum = 0, north_sum = 0;  ///< of the voxels' i and j
  IVec2 low{0}, high{0};                     ///< columns (i, j), both included

  bool operator==(const LayerShare&) const = default;
};

/// Owners in a stack of layers over 64 x 64 columns. Immutable once it stands in a CrownSpace, so copies share it.
struct SpaceTile {
  IVec2 tile{0};                 ///< columns tile * 64 .. tile * 64 + 63, (east, north)
  std::int32_t first_layer = 0;  ///< lowest layer kept
  std::int32_t layers = 0;
  std::int32_t highest_base = 0;  ///< no tree that reaches the tile has its base in a higher layer
  /// At ((k - first_layer) * 64 + j) * 64 + i: a tree's slot (CrownSpace::claimant_of), kFree, or owner_of_id.
  std::vector<std::int32_t> owner;
  std::vector<std::uint64_t> ticks;  ///< arrival times (propagation.h), same order; empty unless asked for
  std::shared_ptr<const std::vector<std::int32_t>> ground;  ///< lowest layer above the ground, for each column
  /// What a hero tree's voxel held before, by place in `owner`.
  struct Under {
    std::uint32_t place;
    std::int32_t owner;
  };
  std::vector<Under> under_heroes;

  bool has(std::int32_t layer) const { return layer >= first_layer && layer < first_layer + layers; }
  std::size_t offset(std::int32_t layer) const {
    return static_cast<std::size_t>(layer - first_layer) * static_cast<std::size_t>(kTileColumns);
  }
};

struct SpaceLayout;  // space_layout.h: where claimants stand on the lattice

class CrownSpace {
 public:
  CrownSpace() = default;

  float voxel_m() const { return options_.voxel_m; }
  float layer_m() const { return options_.layer_m; }
  const SpaceOptions& options() const { return options_; }
  std::span<const Claimant> claimants() const { return claimants_; }
  const Standing& standing() const { return standing_; }  ///< sorted by falling id

  /// What owns voxel (i, k, j): a claimant's index, kFree, or owner_of_id of an obstacle or hero tree.
  std::int32_t owner(IVec3 voxel) const;
  /// Its id: positive for a tree, negative for an obstacle or hero tree, 0 when free.
  std::int32_t id(IVec3 voxel) const;
  /// The same for a world point.
  std::int32_t owner_at(const Vec3& world) const;
  /// Arrival time in ticks; 0 when free or not kept.
  std::uint64_t ticks(IVec3 voxel) const;

  std::size_t claimed_voxels() const { return claimed_; }
  std::size_t claimed_voxels(std::size_t claimant) const;
  /// The claimant's layers, from the lowest up.
  std::span<const LayerShare> shares(std::size_t claimant) const { return *shares_[claimant]; }
  /// Centroid of a share, plan metres.
  Vec2 centroid(const LayerShare& share) const;

  std::size_t bytes() const;  ///< of the voxels

  /// Tiles that hold the space, sorted by (north, east).
  std::span<const std::shared_ptr<const SpaceTile>> tiles() const { return tiles_; }
  /// The tile with this index, or null.
  const SpaceTile* find_tile(IVec2 tile) const;

  /// Tiles hold trees by slots, which stay when claimants before them in the list go. A slot's claimant, and back.
  std::int32_t slots() const { return static_cast<std::int32_t>(claimant_of_.size()); }
  std::int32_t claimant_of(std::int32_t slot) const { return claimant_of_[static_cast<std::size_t>(slot)]; }
  std::int32_t slot_of(std::size_t claimant) const { return slot_of_[claimant]; }

 private:
  friend class SpaceBuilder;
  friend class SpaceUpdater;

  SpaceOptions options_;
  std::vector<Claimant> claimants_;
  Standing standing_;
  std::shared_ptr<const SpaceLayout> layout_;
  std::vector<std::int32_t> slot_of_;      ///< of each claimant
  std::vector<std::int32_t> claimant_of_;  ///< of each slot; -1 when its tree is gone
  std::vector<std::shared_ptr<const SpaceTile>> tiles_;
  std::vector<std::shared_ptr<const std::vector<LayerShare>>> shares_;  ///< of each claimant
  std::size_t claimed_ = 0;
};

/// Divides the volume above `terrain` among the trees. Layers are divided in parallel; a step of progress is a layer.
Result<CrownSpace> divide_space(std::span<const Claimant> trees, const Standing& standing,
                                const terrain::Terrain& terrain, const SpaceOptions& options,
                                Progress* progress = nullptr);
Result<CrownSpace> divide_space(std::span<const Claimant> trees, const terrain::Terrain& terrain,
                                const SpaceOptions& options, Progress* progress = nullptr);

/// A tree that stands where no tree can, or an obstacle or hero tree off the site.
struct SpaceProblem {
  enum class Kind { base_in_obstacle, base_in_trunk, obstacle_off_site, hero_off_site };
  Kind kind;
  std::int32_t id = 0;     ///< of the tree, obstacle or hero tree
  std::int32_t other = 0;  ///< of the obstacle, or of the tree whose trunk it is
};

/// All of them, by kind, then id. Of two trees in each other's trunks the thinner one (of equals the higher key) is named.
std::vector<SpaceProblem> problems(const CrownSpace& space, Vec2 site_m);

/// The region of one claimant in its tree's frame, the tight box around its voxels. The grid's third axis runs south.
CrownRegion region(const CrownSpace& space, std::size_t claimant);

/// A horizontal cut: ids of the owners, 0 where free, below 0 for obstacles and hero trees.
struct SpaceSlice {
  Vec2 low{0.0f};  ///< plan position of the south-west corner
  float voxel_m = 1.0f;
  std::int32_t width = 0, height = 0;  ///< columns east, north
  std::vector<std::int32_t> ids;       ///< at j * width + i, southernmost row first
};

/// The layer that holds world height `y`, within `area` (plan metres) and where there are tiles.
SpaceSlice slice(const CrownSpace& space, float y, const Box2& area);

}  // namespace bosquet::crowns
