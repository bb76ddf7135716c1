// Tree mesh: bark and foliage of one tree for a triangle budget.
//
// Model     a budget is divided between wood and leaves (kWoodShare, more where one needs less than its share). Wood
//           loses rings and sides, then its thinnest branches; foliage goes from leaves to clusters to cards where its
//           cards would have to grow too much, then loses cards and keeps its area
// Units     metres, tree frame (origin at the tree's base)
// Holds     triangles() <= max_triangles whenever max_triangles >= kLeastTreeTriangles x stems; the same bits anywhere
// Cost      4-14 million triangles a second on one core without a budget, with one about a microsecond an internode; no
//           locks, so trees are built in parallel by the caller
#pragma once

#include <cstdint>
#include <span>

#include "core/triangle_mesh.h"
#include "geometry/foliage.h"
#include "geometry/look.h"
#include "geometry/season.h"
#include "growth/skeleton.h"

namespace bosquet::geometry {

inline constexpr std::size_t kLeastTreeTriangles = 40;

struct MeshOptions {
  int season_of_growth = -1;  ///< -1 the last
  Season season = Season::summer;
  FoliageLevel foliage = FoliageLevel::clusters;
  std::size_t max_triangles = 0;  ///< 0: no limit
  std::uint64_t seed = 0;         ///< of the document
  std::uint64_t key = 0;          ///< of the tree
  bool wind = false;              ///< meshes get wind weights (wind.h)
};

struct TreeMesh {
  TriangleMesh branches;  ///< to be drawn with the species' bark
  TriangleMesh leaves;    ///< to be drawn with the species' leaf atlas of the season, double sided, alpha tested
  FoliageLevel foliage = FoliageLevel::clusters;  ///< what the leaves became; cards show the foliage mass instead
  float wind_m = 0;                               ///< with wind weights: how far what moves most does at kWindStrain

  std::size_t triangles() const { return branches.triangles() + leaves.triangles(); }
};

/// `radius` of each internode at that season: skeleton.radius for the last, growth::radii() for others.
TreeMesh build_tree_mesh(const growth::Skeleton& skeleton, std::span<const float> radius, const Look& look,
                         const FoliageLook& foliage, const MeshOptions& options);

/// About how many triangles build_tree_mesh makes without a limit, within a factor of 1.5 or so: to divide a scene's
/// budget. One pass over the internodes.
std::size_t estimate_triangles(const growth::Skeleton& skeleton, std::span<const float> radius, const Look& look,
                               const FoliageLook& foliage, const MeshOptions& options);

}  // namespace bosquet::geometry
