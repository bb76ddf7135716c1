// Branch curves: the centre lines and widths of generalised cylinders, one for each thickest path.
//
// Source    Longay 2014, C.3 (thickest paths); Bloomenthal 1985, "Modeling the mighty maple" (generalised cylinders,
//           limbs that flow into each other); Yuksel et al. 2011 (centripetal Catmull-Rom curves)
// Model     a centripetal Catmull-Rom curve through the nodes of a path. Where wood is thick for the length of its
//           internodes the nodes are smoothed first, else rings of one bend would cut each other. A child's curve
//           begins inside its parent, in the parent's direction, and leaves it in an arc; it swells into a
//           collar near the parent's surface, more along the parent than across, so that both flow into each other. A stem widens into a root flare and goes on under the ground
// Decision  the radius at an internode's upper end is the internode's; between nodes it changes evenly
// Decision  how much a sample matters is worked out once (Douglas and Peucker 1973, over position and radius together,
//           in units of what is tolerated there), so that any coarser selection of rings is a filter
// Units     metres, tree frame
// Holds     every child begins within its parent's radius; samples of a path are at least kLeastStep_m apart; a pure
//           function with the same bits anywhere
// Cost      about 0.5 microseconds an internode
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "geometry/thickest_path.h"
#include "growth/skeleton.h"

namespace bosquet::geometry {

inline constexpr float kLeastStep_m = 1e-4f;

/// A place on a centre line at which a ring may stand.
struct BranchSample {
  Vec3 centre{0.0f};
  Vec3 tangent{0.0f};  ///< unit, toward the tip
  float radius = 0;    ///< with collar and root flare
  Vec3 saddle{0.0f};   ///< where it leaves its parent: how much wider it is along the parent, up and down, metres
  float crotch = 0;    ///< 1 at the parent's surface and inside, 0 where the collar ends
  float wood = 0;      ///< radius without
  float along = 0;     ///< metres of centre line from the path's base; below 0 under the ground
  float light = 1;     ///< exposure in 0..1
  float matters = 0;   ///< a ring here is wanted while coarseness < matters; infinite at both ends of a path
};

struct BranchCurve {
  std::uint32_t first = 0,
                count = 0;   ///< in BranchCurves::samples, base to tip; 0 for a path without length, else >= 2
  std::int32_t parent = -1;  ///< curve it springs from, -1 for a stem
  float base_radius = 0;     ///< of its wood, without collar
  float weight = 0;          ///< how much would be missed without it: bark area, with all that springs from it
};

struct BranchCurves {
  std::vector<BranchCurve> curves;  ///< a parent precedes its children
  std::vector<BranchSample> samples;
  float tip_radius = 0;                      ///< of the thinnest wood; at most 4 mm
  std::vector<std::uint32_t> node_sample{};  ///< of each standing internode's upper end, its place in `samples`

  std::span<const BranchSample> of(const BranchCurve& c) const { return {samples.data() + c.first, c.count}; }
};

/// Shape of forks and feet; the same for all species so far.
struct BranchShape {
  float collar = 0.45f;            ///< how much wider a branch is where it leaves its parent
  float saddle = 0.95f;            ///< and by how much more along the parent
  float collar_length = 3.0f;      ///< in radii of the branch
  float root_flare = 0.55f;        ///< how much wider a stem is at the ground
  float root_flare_height = 3.0f;  ///< in radii of the stem; never above kFlareTop_m
};
inline constexpr float kFlareTop_m = 1.1f;  ///< below breast height, so that flare never shows in trunk diameters

BranchCurves branch_curves(const growth::Skeleton& skeleton, std::span<const float> radius, const ThickestPaths& paths,
                           const BranchShape& shape = {});

}  // namespace bosquet::geometry
