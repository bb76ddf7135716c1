// Wind weights: how far each place of a tree gives way to the wind, for the shaders of engines.
//
// Source    Metzger 1893, Morgan & Cannell 1994 (wood grows until the wind strains its surface everywhere alike); the
//           split into tree, branch and leaf: Sousa 2007, "Vegetation procedural animation and shading", GPU Gems 3, 16
// Model     wood of radius r whose surface strains by e bends by e / r radians a metre, so along a path s from the root
//             turn = integral of e / r ds,  way = integral of turn ds     (e = kWindStrain)
//           thick wood is stiff, twigs are not, and what stands on a limb goes where it goes
// Weights   four bytes a vertex: x the way from the root, the tree's longest being 255; y the same from the foot of its
//           limb, 0 on the stem; z how far a leaf flutters, 0 on wood and at its stalk; w the phase of its limb (on the
//           stem: of the tree), any of 256
// Decision  a limb is what leaves a stem, with all that it carries, so no place where branches join is torn: beyond it
//           all share one phase, and at its foot y is 0
// Units     way in metres at that strain; x and y in 255ths of TreeWind::longest_m
// Holds     along any path from the root x never falls, along any path from a limb's foot y never falls; the same bits
//           anywhere; a tree's weights do not depend on what level of detail shows them
// Cost      one sweep over the internodes, one over the samples of the curves; nothing where no weights are asked for
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/branch_curve.h"
#include "geometry/thickest_path.h"
#include "growth/skeleton.h"

namespace bosquet::geometry {

/// Strain of the wood's surface that lengths are told for: that of a strong wind.
inline constexpr float kWindStrain = 1e-3f;

/// Of each internode's upper end.
struct TreeWind {
  struct Way {
    float of_tree = 0, of_limb = 0;  ///< 0..1
    std::uint8_t phase = 0;
  };
  std::vector<Way> ways;  ///< only those of standing internodes are set
  float longest_m = 0;    ///< way of the place that moves most, at kWindStrain
  float top = 0;          ///< of_tree at the highest place

  /// On the internode, `at` = 0 at its lower and 1 at its upper end; z is 0.
  Rgba8 on(const growth::Skeleton& skeleton, std::uint32_t internode, float at) const;
};

TreeWind tree_wind(const growth::Skeleton& skeleton, std::span<const float> radius, const ThickestPaths& paths,
                   std::uint64_t key);

/// Weights of each of the curves' samples.
std::vector<Rgba8> curve_wind(const TreeWind& wind, const growth::Skeleton& skeleton, const ThickestPaths& paths,
                              const BranchCurves& curves);

/// Weights of a tree drawn on upright cards: it leans as a whole, its top as far as the tree's own.
void lean_with_height(TriangleMesh& cards, const TreeWind& wind);

}  // namespace bosquet::geometry
