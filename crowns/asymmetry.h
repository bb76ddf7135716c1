// Neighbourhood asymmetry: which way, and how strongly, a tree is pushed out of its neighbours' way.
//
// Source    Longay 2014, 6.5.2, eq. 6.3 and 6.4; after Brisson 2001, Muth and Bazzaz 2003
// Model     V_i = (|T_i - C_i| / B_i) * sum over neighbours j of w_ij * (T_i - T_j) / |T_i - T_j|,
//           w_ij = alpha_a * A_j / A_i + alpha_d * (1 - |T_i - T_j| / r_ij)
//           T base in plan, A projected crown area, C_i centroid and B_i radius of the tree's region in a layer
// Decision  r_ij = radius_factor * the larger crown width of the two, for membership and weight
// Decision  B_i is the largest distance from C_i to a voxel centre of the layer's region (so the ratio is at most 1);
//           the ratio is averaged over layers by voxel count
// Decision  A_j / A_i is capped, and so is |V_i|: eq. 6.3 gives 100 for a 2 m crown beside a 20 m one. Infinite caps
//           give the source's rule
// Decision  a tree that is kept cut to a form presses nobody: a hedge of a hundred plants would bend the avenue beside it
// Decision  an obstacle presses like a neighbour with the part of its footprint that stands as high as the tree's crown
//           base: T_j is the footprint's nearest point, A_j its area, r_ij goes with the tree's own crown width
// Option    slope: slope_weight * sin(slope) downhill is added to V, as crowns lean down a hillside (Umeki 1995); off
// Decision  a distance below the sum of trunk radii counts as that sum; coincident bases part along an azimuth hashed
//           from the two keys, in opposite directions
// Frame     world: V has x east, z south, y = 0; it adds to a tropism that is dimensionless
// Holds     0 for a tree without neighbours (on level ground, or with the slope off); sums run in key order, then
//           obstacles by id, so trees may come in any order; V is rounded to 1/64
#pragma once

#include <concepts>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/vec.h"
#include "crowns/crown_space.h"

namespace bosquet::crowns {

struct AsymmetryOptions {
  float area_weight = 1.0f;      ///< alpha_a
  float distance_weight = 2.0f;  ///< alpha_d
  float radius_factor = 1.5f;
  float area_ratio_cap = 4.0f;
  float asymmetry_max = 1.0f;
  float slope_weight = 0.0f;

  bool operator==(const AsymmetryOptions&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, AsymmetryOptions>
void describe(P& p, Visitor& visit) {
  visit(Real{"area_weight", "", 0, 10, "Weight of a neighbour's crown area in its pressure"}, p.area_weight);
  visit(Real{"distance_weight", "", 0, 10, "Weight of a neighbour's nearness in its pressure"}, p.distance_weight);
  visit(Real{"radius_factor", "", 0.1, 10, "Trees nearer than this many crown widths (of the larger) are neighbours"},
        p.radius_factor);
  visit(Real{"area_ratio_cap", "", 0.1, std::numeric_limits<double>::infinity(),
             "Largest crown area ratio that counts; inf is without limit"},
        p.area_ratio_cap);
  visit(Real{"asymmetry_max", "", 0, std::numeric_limits<double>::infinity(),
             "Largest length of the asymmetry vector; inf is without limit"},
        p.asymmetry_max);
  visit(Real{"slope_weight", "", 0, 10, "How far crowns shift downhill on a slope; 0 is not at all"}, p.slope_weight);
}

/// V of every claimant of `space`, in its order. The terrain is asked for slopes only.
std::vector<Vec3> neighbourhood_asymmetry(const CrownSpace& space, const AsymmetryOptions& options,
                                          const terrain::Terrain* terrain = nullptr);

}  // namespace bosquet::crowns
