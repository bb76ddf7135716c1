#include "geometry/tree_levels.h"

#include <algorithm>

#include "geometry/branch_mesh.h"
#include "geometry/lod_shell.h"
#include "geometry/thickest_path.h"

namespace bosquet::geometry {
namespace {

// What the wood of a shell gets.
constexpr double kWoodOfLevel = 0.25;

}  // namespace

TreeForm form_within(std::size_t max_triangles, std::size_t stems) {
  const std::size_t more = stems - std::min<std::size_t>(stems, 1);
  if (max_triangles == 0 || max_triangles >= kLeastMeshTriangles + 2 * kLeastTreeTriangles * more)
    return TreeForm::mesh;
  if (max_triangles >= kLeastShellTriangles + 2 * kLeastStemTriangles * more) return TreeForm::shell;
  return max_triangles >= kFourCardTriangles ? TreeForm::four_cards : TreeForm::two_cards;
}

std::size_t stems(const growth::Skeleton& skeleton, int season) {
  const auto stands = standing(skeleton, season);
  std::size_t n = 0;
  for (std::size_t i = 0; i < skeleton.size(); ++i) n += stands[i] && skeleton.parent[i] < 0;
  return n;
}

TreeWind tree_wind(const TreeInput& tree) {
  const auto stands = standing(*tree.skeleton, tree.options.season_of_growth);
  return tree_wind(*tree.skeleton, tree.radius, thickest_paths(*tree.skeleton, tree.radius, stands), tree.options.key);
}

TreeMesh source_mesh(const TreeInput& tree) {
  MeshOptions options = tree.options;
  options.foliage = FoliageLevel::clusters;
  options.max_triangles = kSourceTriangles;
  return build_tree_mesh(*tree.skeleton, tree.radius, *tree.look, *tree.foliage, options);
}

TreeMesh build_shell(const TreeInput& tree, const TreeMesh& source, const TreeSkins& skins) {
  const std::size_t budget = tree.options.max_triangles;
  const auto share = static_cast<std::size_t>(kWoodOfLevel * static_cast<double>(budget));
  const auto stands = standing(*tree.skeleton, tree.options.season_of_growth);
  const ThickestPaths paths = thickest_paths(*tree.skeleton, tree.radius, stands);
  const BranchCurves curves = branch_curves(*tree.skeleton, tree.radius, paths);
  const BranchPlan plan = plan_branches_within(curves, source.leaves.empty() ? budget : share);
  TreeMesh shell;
  shell.foliage = FoliageLevel::cards;
  std::vector<Rgba8> of_samples;
  if (tree.options.wind) {
    const TreeWind wind = tree_wind(*tree.skeleton, tree.radius, paths, tree.options.key);
    of_samples = curve_wind(wind, *tree.skeleton, paths, curves);
    shell.wind_m = wind.longest_m;
  }
  shell.branches = mesh_branches(curves, plan, *tree.look, tree.options.seed, tree.options.key, of_samples);
  const std::size_t rest = budget - std::min(budget, plan.triangles);
  const bool masses = source.foliage == FoliageLevel::cards;
  shell.leaves = crown_shell(source.leaves, masses ? skins.mass : skins.leaf, skins.mass, rest / 2, tree.options.key);
  return shell;
}

ImpostorFrame build_picture(const TreeMesh& source, const TreeSkins& skins, const ImpostorPlace& place) {
  const bool masses = source.foliage == FoliageLevel::cards;
  const RasterSurface tree[] = {{&source.branches, &skins.bark}, {&source.leaves, masses ? &skins.mass : &skins.leaf}};
  return paint_impostor(tree, *place.atlas, place.block);
}

}  // namespace bosquet::geometry
