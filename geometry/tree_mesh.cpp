#include "geometry/tree_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/branch_mesh.h"
#include "geometry/thickest_path.h"
#include "geometry/wind.h"

namespace bosquet::geometry {
namespace {

// What wood gets of a budget that is too small for both.
constexpr double kWoodShare = 0.4;

// A level of foliage gives way to the next when its cards would have to stand for more than so many.
constexpr double kMostLeavesInOne = 2.5;
constexpr double kMostClustersInOne = 3.0;

// Leaves keep to the wood that is drawn when at least this share of their area grows there. On a coarser tree, where
// leaves hide that their twigs are missing, they stay where they grew.
constexpr double kLeastOnDrawnWood = 0.4;

// Cards of far trees stand for so many twig clusters.
constexpr std::size_t kClustersInACard = 6;

std::size_t cards_wanted(FoliageLevel level, std::size_t sites) {
  return level == FoliageLevel::cards ? (sites + kClustersInACard - 1) / kClustersInACard : sites;
}

// Leaves out the sites on branches that the plan leaves out; the others grow by their area.
void keep_to_drawn_wood(std::vector<LeafSite>& sites, const ThickestPaths& paths, const BranchPlan& plan,
                        std::size_t internodes) {
  std::vector<std::uint8_t> drawn(internodes, 0);
  for (std::size_t p = 0; p < paths.paths.size(); ++p)
    for (std::uint32_t i : paths.of(paths.paths[p])) drawn[i] = plan.keep[p];
  const auto area = [](const LeafSite& site) {
    return static_cast<double>(site.size) * static_cast<double>(site.size);
  };
  double all = 0.0, on_drawn = 0.0;
  for (const LeafSite& site : sites) {
    all += area(site);
    if (drawn[site.internode]) on_drawn += area(site);
  }
  if (on_drawn < kLeastOnDrawnWood * all) return;
  std::erase_if(sites, [&](const LeafSite& site) { return !drawn[site.internode]; });
  const auto growth = static_cast<float>(std::sqrt(all / on_drawn));
  for (LeafSite& site : sites) site.size *= growth;
}

}  // namespace

TreeMesh build_tree_mesh(const growth::Skeleton& skeleton, std::span<const float> radius, const Look& look,
                         const FoliageLook& foliage, const MeshOptions& options) {
  assert(radius.size() == skeleton.size());
  const auto stands = standing(skeleton, options.season_of_growth);
  const ThickestPaths paths = thickest_paths(skeleton, radius, stands);
  const BranchCurves curves = branch_curves(skeleton, radius, paths);
  TreeWind wind;
  if (options.wind) wind = tree_wind(skeleton, radius, paths, options.key);
  const FoliageInput input{&skeleton,      &paths,       radius,      options.season_of_growth,      &look, &foliage,
                           options.season, options.seed, options.key, options.wind ? &wind : nullptr};
  FoliageLevel level = options.foliage;
  std::vector<LeafSite> sites = leaf_sites(input, level);
  std::size_t cards = cards_wanted(level, sites.size());

  BranchPlan plan;
  if (options.max_triangles == 0) {
    plan = plan_branches(curves, 1.0f);
  } else {
    // Wood takes its share, or all that leaves do not need.
    const std::size_t budget = options.max_triangles;
    const std::size_t leafy = cards * triangles_per_site(foliage, level);
    const auto share = static_cast<std::size_t>(kWoodShare * static_cast<double>(budget));
    plan = plan_branches_within(curves, std::max(share, budget - std::min(budget, leafy)));

    // Leaves take the rest, at the finest level whose cards need not grow too much.
    const std::size_t rest = budget - std::min(budget, plan.triangles);
    const auto crowded = [&](double most) {
      const double wanted = static_cast<double>(cards * triangles_per_site(foliage, level));
      return wanted > most * static_cast<double>(rest);
    };
    if (level == FoliageLevel::leaves && crowded(kMostLeavesInOne)) {
      level = FoliageLevel::clusters;
      sites = leaf_sites(input, level);
      cards = cards_wanted(level, sites.size());
    }
    if (level == FoliageLevel::clusters && crowded(kMostClustersInOne)) level = FoliageLevel::cards;
    if (level != FoliageLevel::cards && !sites.empty()) keep_to_drawn_wood(sites, paths, plan, skeleton.size());
    cards = std::min({cards, sites.size(), rest / triangles_per_site(foliage, level)});
  }
  std::vector<Rgba8> of_samples;
  if (options.wind) of_samples = curve_wind(wind, skeleton, paths, curves);
  return {mesh_branches(curves, plan, look, options.seed, options.key, of_samples),
          mesh_foliage(input, level, sites, cards), level, wind.longest_m};
}

std::size_t estimate_triangles(const growth::Skeleton& skeleton, std::span<const float> radius, const Look& look,
                               const FoliageLook& foliage, const MeshOptions& options) {
  const auto stands = standing(skeleton, options.season_of_growth);
  float thinnest = 0.004f;
  std::vector<std::uint8_t> tip(stands.begin(), stands.end());
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (!stands[i]) continue;
    thinnest = std::min(thinnest, std::max(radius[i], 1e-4f));
    if (skeleton.parent[i] >= 0) tip[static_cast<std::size_t>(skeleton.parent[i])] = 0;
  }

  // Rings in use are about one and a half for each internode; each tip bears a twig more.
  double wood = 0.0, leafy_m = 0.0;
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (!stands[i]) continue;
    const Vec3 d = skeleton.distal[i] - skeleton.proximal(i);
    wood += std::min(84.0f, 9.0f * std::sqrt(radius[i] / thinnest));
    if (2000.0f * radius[i] <= foliage.max_twig_mm)
      leafy_m += std::sqrt(glm::dot(d, d)) + (tip[i] ? foliage.cluster_spacing_m : 0.0f);
  }
  auto sites = static_cast<std::size_t>(leafy_m / static_cast<double>(foliage.cluster_spacing_m));
  if (options.foliage == FoliageLevel::leaves)
    sites *= has_leaves(look.leaf, options.season) ? static_cast<std::size_t>(single_leaves(look.leaf)) + 1 : 0;
  return static_cast<std::size_t>(wood) +
         cards_wanted(options.foliage, sites) * triangles_per_site(foliage, options.foliage);
}

}  // namespace bosquet::geometry
