// Branch mesh: bark as generalised cylinders, as fine or coarse as a triangle budget allows.
//
// Source    Longay 2014, 5.5 (occlusion from the growth model's light) and C.3, eq. C.2; Wang et al. 2008, "Computation
//           of rotation minimizing frames" (double reflection)
// Model     rings of C vertices around a branch curve, joined by strips; C falls along a path as it gets thinner. The
//           tip is closed. Frames are carried along without twist
// Erratum   eq. C.2 is C = 3 (d / d_e)^(1/n); the source prints 3 d^n / d_e
// Decision  n = 2 and at most kMostSides sides. Coarseness c >= 1 divides the sides by c^(1/2) and drops rings that
//           matter less than c
// UV        u counts bark tiles around, v along the branch, upward: whole repeats around, as many as the base of the
//           path takes at true scale; as wood gets thinner its bark gets finer in both directions alike (so no seam, no
//           stretching, and young wood has finer bark, as it has). Each path starts elsewhere on the tile and a small
//           turn hides repetition
// Colour    bark_tint() of the look by diameter and height, times occlusion from the skeleton's light
// Holds     no NaN, no triangle without area, unit normals; a path is closed but for its base, which lies inside its
//           parent or under the ground; a plan's triangles and vertices are exactly what mesh_branches makes
// Cost      about 50 million triangles a second; a plan within a budget some 0.3 microseconds an internode
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/branch_curve.h"
#include "geometry/look.h"

namespace bosquet::geometry {

inline constexpr int kMostSides = 28;

/// Which rings and which paths a mesh has.
struct BranchPlan {
  float coarseness = 1.0f;
  std::vector<std::uint8_t> keep;  ///< for each curve; a curve is kept only with its parent
  std::size_t triangles = 0, vertices = 0;
};

/// Everything, at this coarseness (1 is the finest).
BranchPlan plan_branches(const BranchCurves& curves, float coarseness);

/// The best plan of at most `max_triangles`: first fewer rings and sides, then the thinnest branches go. A stem keeps
/// at least kLeastStemTriangles, whatever the budget.
BranchPlan plan_branches_within(const BranchCurves& curves, std::size_t max_triangles);
inline constexpr std::size_t kLeastStemTriangles = 9;

/// `wind`: weights of each of the curves' samples (wind.h), or none.
TriangleMesh mesh_branches(const BranchCurves& curves, const BranchPlan& plan, const Look& look, std::uint64_t seed,
                           std::uint64_t key, std::span<const Rgba8> wind = {});

/// Share of the light of an open sky that wood or leaves at exposure L receive: linear, kDeepShade..1.
float occlusion(float exposure);
inline constexpr float kDeepShade = 0.38f;

}  // namespace bosquet::geometry
