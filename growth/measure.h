// Measure: the dimensions that a forester would take of a grown tree.
//
// Units     metres; heights above the base of the tree
// Decision  crown diameter: the mean over 8 azimuths of the crown's extent in plan
// Decision  crown base: below it stands 2 % of the living branch wood, so one low twig does not count; lowest limb:
//           where the lowest living first-order branch of 10 or more internodes leaves the trunk (the clear bole)
// Decision  wood is counted in internodes as grown, so that a tree measures the same at any detail
#pragma once

#include "core/vec.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

inline constexpr float kBreastHeight = 1.3f;  ///< where trunk diameters are taken

struct Measures {
  float height_m = 0;
  float crown_diameter_m = 0;
  float crown_base_m = 0;
  float lowest_limb_m = 0;
  float trunk_diameter_m = 0;  ///< at 1.3 m (at the foot of a smaller tree), of the thickest stem
  float widest_point = 0;      ///< height of the widest slice, as a share of the crown's length from its base
  Vec2 crown_centroid{0.0f};   ///< (east, north) of the living branch wood's centre from the base
  int internodes = 0;          ///< living
};

/// Measures at the end of `season` (the last by default).
Measures measure(const Skeleton& skeleton, int season = -1);

}  // namespace bosquet::growth
