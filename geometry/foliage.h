// Foliage: leaves and leafed twigs as textured cards on the young wood of a skeleton.
//
// Source    Longay 2014, C.1.1 (placement on all branches thinner than a threshold), C.1.2 (petiole.h), 5.5 (hue by vigor)
// Model     the side that a blade is drawn to (T of petiole.h) is the normal of a blade that hangs `droop` below level away
//           from its twig, drawn toward the open side of the crown where there is much light
// Levels    clusters: one card (folded along its twig) or crossed cards for each leafed twig of 5-15 leaves. leaves:
//           each of these twigs with a card for every leaf of its own and one for its wood. cards: few, large twig
//           cards for far trees. All show cells of the leaf atlas (leaf_atlas.h), and stand at the same places
// Decision  a twig bears leaves while it is thin and at most leaf_life seasons behind the last growth of its own
//           branch, so old twigs that live on without growing stay green at their ends
// Decision  a smaller number of cards keeps the area of all: each grows by the area of those left out. They are left
//           out evenly along the branches, never at random
// Decision  of hanging whips (strings) such a card grows longer, not wider, up to twice: weeping crowns stay strands
// Bloom     a twig in flower or fruit (bloom.h) shows the atlas' first column: at level clusters and cards the twig with
//           its bunches, at level leaves its bunches one by one besides the leaves
// Colour    linear, times the atlas: occlusion by the skeleton's light relative to that of the crown's open side, a turn toward yellow with low vigor, variation
//           by tree and by card
// Units     metres and degrees as named; tree frame
// Holds     the same bits anywhere; a card's random numbers are keyed by its internode and its place there, so they do
//           not change when other branches go
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/parameter.h"
#include "core/triangle_mesh.h"
#include "geometry/look.h"
#include "geometry/season.h"
#include "geometry/thickest_path.h"
#include "growth/skeleton.h"

namespace bosquet::geometry {

enum class FoliageLevel { leaves, clusters, cards };
inline constexpr std::array<std::string_view, 3> kFoliageLevelNames{"leaves", "clusters", "cards"};

/// How leaves stand on twigs: a part of a species' [look] table.
struct FoliageLook {
  float max_twig_mm = 30.0f;
  int leaf_life_seasons = 12;
  float cluster_spacing_m = 0.08f;
  float divergence_deg = 137.5f;
  float insertion_deg = 50.0f;
  float cluster_droop_deg = 5.0f;
  float twist = 2.0f;
  float bend = 1.5f;
  float turn = 0.5f;
  float sun_turn = 0.35f;
  int cluster_planes = 1;
  float fold_deg = 35.0f;
  float size_variation = 0.2f;
  float vigor_hue = 0.25f;
  float tree_hue = 0.5f;
  float soft_normals = 0.65f;
  float spring_size = 0.65f;
  float autumn_fall = 0.25f;
};

template <class Parameters, class Visitor>
void describe_foliage(Parameters& p, Visitor& visit) {
  visit(Real{"foliage_max_twig_mm", "mm", 0.5, 200, "Leaves sit on wood up to this diameter"}, p.max_twig_mm);
  visit(Whole{"foliage_leaf_life_seasons", 1, 1000,
              "Wood bears leaves up to so many seasons behind the last growth of its branch"},
        p.leaf_life_seasons);
  visit(Real{"foliage_cluster_spacing_m", "m", 0.02, 5, "Length of branch for each twig cluster"}, p.cluster_spacing_m);
  visit(Real{"foliage_divergence_deg", "deg", 0, 360, "Turn around the twig from one leaf to the next"},
        p.divergence_deg);
  visit(Real{"foliage_insertion_deg", "deg", 0, 120, "Angle between a twig and the leaf or twig cluster on it"},
        p.insertion_deg);
  visit(Real{"foliage_cluster_droop_deg", "deg", -90, 90, "Angle below level that twig clusters are drawn to"},
        p.cluster_droop_deg);
  visit(Real{"foliage_twist", "", 0, 10, "e_H, how readily a stalk twists to lay the blade level"}, p.twist);
  visit(Real{"foliage_bend", "", 0, 10, "e_L, how readily a stalk bends"}, p.bend);
  visit(Real{"foliage_turn", "", 0, 10, "e_U, how readily a stalk turns aside"}, p.turn);
  visit(Real{"foliage_sun_turn", "", 0, 1, "How far leaves in the light turn to the open side of the crown"},
        p.sun_turn);
  visit(Whole{"foliage_cluster_planes", 1, 3, "Cards of a twig cluster: one folded along the twig, or crossed ones"},
        p.cluster_planes);
  visit(Real{"foliage_fold_deg", "deg", 0, 80, "How far the halves of a folded card bend down"}, p.fold_deg);
  visit(Real{"foliage_size_variation", "", 0, 0.8, "Spread of leaf and cluster sizes"}, p.size_variation);
  visit(Real{"foliage_vigor_hue", "", 0, 1, "How much yellower leaves are on the weakest branches"}, p.vigor_hue);
  visit(Real{"foliage_tree_hue", "", 0, 1, "Variation of hue and brightness from tree to tree"}, p.tree_hue);
  visit(Real{"foliage_soft_normals", "", 0, 1, "How far normals are bent outward from the crown"}, p.soft_normals);
  visit(Real{"foliage_spring_size", "", 0.1, 1, "Size of leaves in spring as a share of grown ones"}, p.spring_size);
  visit(Real{"foliage_autumn_fall", "", 0, 0.95, "Share of the leaves that have fallen in autumn"}, p.autumn_fall);
}

template <class Parameters, class Visitor>
requires std::same_as<std::remove_const_t<Parameters>, FoliageLook>
void describe(Parameters& p, Visitor& visit) { describe_foliage(p, visit); }

/// Where a leafed twig is attached, or which leaf of such a twig.
struct LeafSite {
  static constexpr std::int16_t kWholeTwig = -2, kTwigWood = -1, kFirstBunch = 1000;
  std::uint32_t internode = 0;
  std::uint16_t place = 0;  ///< number along its internode, for random numbers
  std::int16_t leaf =
      kWholeTwig;     ///< number of a single leaf, from the foot of its twig up, or kFirstBunch + of a bunch
  float at = 0;       ///< 0 lower to 1 upper end of the internode
  float azimuth = 0;  ///< around the branch, radians
  float size = 1;     ///< factor, of the twig or leaf
  bool tip = false;   ///< ends a branch and points where it points

  bool is_bunch() const { return leaf >= kFirstBunch; }                      ///< of flowers or fruit
  bool is_leafy() const { return leaf != kTwigWood && leaf < kFirstBunch; }  ///< a leaf or leafed twig: has leaf area
};

struct TreeWind;

struct FoliageInput {
  const growth::Skeleton* skeleton = nullptr;
  const ThickestPaths* paths = nullptr;
  std::span<const float> radius;
  int season_of_growth = -1;  ///< -1 the last
  const Look* look = nullptr;
  const FoliageLook* foliage = nullptr;
  Season season = Season::summer;
  std::uint64_t seed = 0, key = 0;
  const TreeWind* wind = nullptr;  ///< for weights of the cards' vertices
};

/// All sites of a level, along the branches from path to path. None on a bare tree without leaves, except that clusters
/// and cards go on showing their twigs.
std::vector<LeafSite> leaf_sites(const FoliageInput& input, FoliageLevel level);

/// Leaves that stand one by one on a twig at level leaves: so many as show the area that the twig's picture shows, where
/// leaves hide each other in part.
int single_leaves(const LeafLook& leaf);

/// Triangles of one site's cards at this level (of one leaf, where leaves are single).
std::size_t triangles_per_site(const FoliageLook& foliage, FoliageLevel level);

/// Cards for about `count` of the sites (all: at least sites.size()), spread evenly, with the area of all.
TriangleMesh mesh_foliage(const FoliageInput& input, FoliageLevel level, std::span<const LeafSite> sites,
                          std::size_t count);

}  // namespace bosquet::geometry
