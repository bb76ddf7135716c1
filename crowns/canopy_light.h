// Canopy light: how much of the sky's light the other trees' crowns let through to each part of a tree's region.
//
// Source    ours, after Monsi and Saeki 1953 (Beer-Lambert in canopies); sky.h has the directions and constants
// Model     foliage = voxels of a tree's region with their centres inside its scaled representative ellipsoid, with
//           leaf_area_density m2 of leaves in a m3. On a lattice of 1 m cells every cell holds the leaf area of all
//           trees, and each tree knows its own share of it. For tree i and every cell that its region touches
//             T = sum over 13 directions k of w_k exp(-p_k / 2),   p_k the leaf area index on the way, all minus own
// Decision  a direction is followed for light_reach_m of horizontal distance, so a tree farther than that (and two
//           cells) from another's region cannot change its light
// Decision  T is kept in 16 levels (round half up) and nothing finer, so changes too small to matter change no tree. In
//           cells beside the region, where a tip may cross the border, the darkest touched cell next to them counts;
//           farther out there is full light
// Decision  obstacles cast no canopy shade: foliage alone does
// Units     metres, m2 of leaves
// Frame     lattice cells (east, up, north), cell c spans c to c + 1 m from the site's south-west corner at height 0;
//           a tree's light in its tree frame
// Holds     levels are the same bits for any number of threads, any order of trees, and whether computed at once or by
//           updates: all sums are of whole numbers
// Cost      a few microseconds a cubic metre of region; 2 bytes a cell of foliage and tree, 4 a cell in all
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/progress.h"
#include "core/vec.h"
#include "crowns/crown_space.h"

namespace bosquet::crowns {

struct LightOptions {
  bool canopy_light = true;
  float light_reach_m = 15.0f;

  bool operator==(const LightOptions&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, LightOptions>
void describe(P& p, Visitor& visit) {
  visit(Switch{"canopy_light", "Trees are shaded by their neighbours' crowns"}, p.canopy_light);
  visit(Real{"light_reach_m", "m", 1, 100, "Horizontal distance from which a crown still shades"}, p.light_reach_m);
}

/// One tree's light, laid out as growth reads it: cell (i, j, k) spans low + (i, j, k) to the next in the tree frame,
/// level[(j * cells.z + k) * cells.x + i], transmittance (level + 1) / 16. Empty where all is full light.
struct TreeLight {
  Vec3 low{0.0f};
  IVec3 cells{0};
  std::vector<std::uint8_t> level;

  bool operator==(const TreeLight&) const = default;
};

class CanopyLight {
 public:
  std::size_t size() const { return trees_.size(); }
  const TreeLight& of(std::size_t claimant) const { return *trees_[claimant].light; }

  /// Leaf area of all trees in a cell, and of one of them.
  double leaf_area_m2(IVec3 cell) const;
  double leaf_area_m2(IVec3 cell, std::size_t claimant) const;

  const LightOptions& options() const { return options_; }
  std::size_t bytes() const;

 private:
  friend class LightBuilder;

  // Leaf area of a box of cells, in 2^-14 m2.
  struct Foliage {
    IVec3 low{0}, cells{0};
    std::vector<std::uint16_t> leaf;  ///< at ((up * cells.z) + north) * cells.x + east
  };
  struct Tree {
    std::uint64_t key = 0;
    std::shared_ptr<const Foliage> foliage;
    std::shared_ptr<const TreeLight> light;
  };
  // Leaf area of all trees over 32 x 32 columns of cells.
  struct Tile {
    IVec2 tile{0};
    std::int32_t first = 0, layers = 0;
    std::vector<std::uint32_t> leaf;  ///< at ((up - first) * 32 + north) * 32 + east
  };

  const Tile* find_tile(IVec2 tile) const;

  LightOptions options_;
  std::vector<Tree> trees_;
  std::vector<std::shared_ptr<const Tile>> tiles_;  ///< sorted by (north, east)
};

/// The light of every claimant of `space`, in parallel; a step of progress is a tree. When cancelled it is incomplete.
CanopyLight canopy_light(const CrownSpace& space, const LightOptions& options, Progress* progress = nullptr);

struct LightUpdate {
  CanopyLight light;
  std::vector<std::size_t> changed;  ///< claimants of `space` whose light differs from before, or who are new
};

/// The light of an edited space from that of the space before: computed only where foliage within light_reach_m
/// changed, equal to canopy_light(space, ...). `regions_changed` names the claimants of `space` whose region or size
/// is not what it was; trees that came or went are found by their keys.
LightUpdate update_canopy_light(const CanopyLight& before, const CrownSpace& space,
                                std::span<const std::size_t> regions_changed);

}  // namespace bosquet::crowns
