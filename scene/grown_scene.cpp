#include "scene/grown_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "growth/age.h"
#include "growth/digest.h"
#include "growth/fallen.h"
#include "growth/grow.h"

namespace bosquet::scene {

namespace {

// The tree as it is shown, and no earlier one.
void keep_standing_wood(GrownTree& tree) {
  const growth::Skeleton& whole = *tree.skeleton;
  tree.skeleton = std::make_shared<const growth::Skeleton>(
      growth::without_fallen(tree.season < 0 ? whole : growth::tree_at_season(whole, tree.season)));
  tree.season = -1;
}

// Surveyed trees that found no room for more than a rest of their crown, as of two at one place the smaller, in one line.
std::string crowded_words(const GrownScene& scene) {
  constexpr float kRest = 0.25f;  // of the surveyed crown
  constexpr std::size_t kNamed = 5;
  std::size_t count = 0;
  std::string named;
  for (std::size_t i = 0; i < scene.trees.size(); ++i) {
    const Tree& tree = (*scene.document.trees)[i];
    const float surveyed_m = tree.scale_width * scene.document.species_of(tree).shape.crown_width_m;
    const float crown_m = scene.trees[i].measures.crown_diameter_m;
    if (!tree.measured || crown_m >= kRest * surveyed_m || ++count > kNamed) continue;
    named += fmt::format("{}tree {} ({:.1f} of {:.1f} m)", count > 1 ? ", " : "", tree.id, crown_m, surveyed_m);
  }
  if (count == 0) return {};
  return fmt::format("{} not a quarter of {} measured crown, since neighbours take the room: {}{}",
                     count == 1 ? "1 tree has" : fmt::format("{} trees have", count), count == 1 ? "its" : "their",
                     named, count > kNamed ? fmt::format(" and {} more", count - kNamed) : "");
}

}  // namespace

Document without_removed(const Document& document) {
  const auto removed = [](const Tree& tree) { return tree.status == TreeStatus::to_remove; };
  if (std::none_of(document.trees->begin(), document.trees->end(), removed)) return document;
  std::vector<std::int32_t> gone;
  for (const Tree& tree : *document.trees)
    if (removed(tree)) gone.push_back(tree.id);
  Document rest = document;
  rest.trees = std::make_shared<const Trees>(document.trees->edited({}, gone));
  return rest;
}

std::size_t GrownScene::internodes() const {
  std::size_t sum = 0;
  for (const GrownTree& tree : trees) sum += static_cast<std::size_t>(tree.measures.internodes);
  return sum;
}

Result<GrownScene> grow_scene(const Document& given, const GrowOptions& options, Progress* progress) {
  GrownScene scene;
  scene.given = given;
  scene.document = without_removed(given);
  const Document& document = scene.document;
  const Trees& trees = *document.trees;

  StandingKeeper standing;
  auto around = surround(document, {options.regions, options.asymmetry, options.light}, standing, scene.warnings,
                         &scene.seconds, progress);
  if (!around) return around.error();

  Stopwatch watch;
  scene.claimed_voxels = around->space.claimed_voxels();
  std::vector<std::optional<TreeInputs>> inputs(trees.size());
  const auto gather = [&](std::size_t i) { inputs[i].emplace(document, trees[i], around->of(i), options.detail); };
  if (options.only_meshes) {
    // Trees need far less of the crown space than it takes, a bit for a voxel.
    parallel_for(trees.size(), gather);
    *around = {};
  }
  std::vector<float> costs;
  for (const Tree& tree : trees) costs.push_back(growth_cost(document, tree));
  scene.trees.resize(trees.size());
  std::vector<std::string> warnings(trees.size());
  std::vector<std::uint64_t> digests(trees.size());
  if (progress) progress->begin("trees", trees.size());
  parallel_dearest_first(costs, [&](std::size_t i) {
    if (progress && progress->cancelled()) return;
    if (!inputs[i]) gather(i);
    GrownTree& tree = scene.trees[i] =
        grow_tree(document, trees[i], *inputs[i], options.skeletons ? inputs[i]->hash() : 0, options.year,
                  options.skeletons, progress, warnings[i]);
    inputs[i].reset();
    if (!tree.skeleton) return;
    digests[i] = growth::digest(*tree.skeleton);
    // One that a cache keeps takes no more room whole.
    if (options.only_meshes && !options.skeletons) keep_standing_wood(tree);
    if (progress) progress->advance();
  });
  growth::release_work_memory();  // meshes are next
  if (progress && progress->cancelled()) return cannot_finish("cancelled; nothing was written");
  Hasher hasher;
  for (const std::uint64_t digest : digests) hasher.add(digest);
  scene.skeleton_digest = hasher.digest();
  for (std::string& warning : warnings)
    if (!warning.empty()) scene.warnings.push_back(std::move(warning));
  if (options.regions && !options.year)
    if (std::string crowded = crowded_words(scene); !crowded.empty()) scene.warnings.push_back(std::move(crowded));
  scene.seconds["growth"] = watch.restart();
  scene.space = std::move(around->space);
  scene.light = std::move(around->light);
  return scene;
}

}  // namespace bosquet::scene
