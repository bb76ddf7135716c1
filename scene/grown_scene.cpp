#include "scene/grown_scene.h"

#include <algorithm>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "growth/digest.h"
#include "growth/grow.h"

namespace bosquet::scene {

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

std::uint64_t GrownScene::skeleton_digest() const {
  Hasher hasher;
  for (const GrownTree& tree : trees) hasher.add(growth::digest(*tree.skeleton));
  return hasher.digest();
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
  std::vector<float> costs;
  for (const Tree& tree : trees) costs.push_back(growth_cost(document, tree));
  scene.trees.resize(trees.size());
  std::vector<std::string> warnings(trees.size());
  if (progress) progress->begin("trees", trees.size());
  parallel_dearest_first(costs, [&](std::size_t i) {
    if (progress && progress->cancelled()) return;
    const TreeInputs inputs(document, trees[i], around->of(i), options.detail);
    scene.trees[i] = grow_tree(document, trees[i], inputs, options.skeletons ? inputs.hash() : 0, options.year,
                               options.skeletons, progress, warnings[i]);
    if (progress) progress->advance();
  });
  growth::release_work_memory();  // meshes are next
  if (progress && progress->cancelled()) return cannot_finish("cancelled; nothing was written");
  for (std::string& warning : warnings)
    if (!warning.empty()) scene.warnings.push_back(std::move(warning));
  scene.seconds["growth"] = watch.restart();
  scene.space = std::move(around->space);
  scene.light = std::move(around->light);
  return scene;
}

}  // namespace bosquet::scene
