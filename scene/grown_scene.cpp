#include "scene/grown_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "crowns/asymmetry.h"
#include "growth/age.h"
#include "growth/clipped.h"
#include "growth/digest.h"
#include "growth/grow.h"
#include "growth/radii.h"
#include "scene/standing.h"

namespace bosquet::scene {
namespace {

// Twigs end so far inside a clipped form, in sides of a twig cluster, that it is the leaves that reach its sides.
constexpr float kFoliageShare = 0.4f;
// A clipped tree is full, not tall: its own height limit lies so many voxels above the form.
constexpr float kAboveForm = 3.0f;
// However high the clear stem is ordered, some crown is left above it.
constexpr float kHighestCrownBase = 0.9f;

// Work grows about with the number of internodes, that is with crown volume over spacing; height to the square does.
float growth_cost(const Document& document, const Tree& tree) {
  const float h = document.mature_height_m(tree) / document.species_of(tree).growth.internode_length_m;
  return h * h;
}

GrownTree grow_tree(const Document& document, const Tree& tree, const crowns::CrownRegion* region,
                    const growth::Transmittance* light, const Vec3& asymmetry, const GrowOptions& options,
                    const Progress* progress, std::string& warning) {
  const Species& species = document.species_of(tree);
  growth::GrowthInput input;
  input.parameters = &species.growth;
  input.max_height_m = document.mature_height_m(tree);
  input.region = region;
  input.clear_stem_m = tree.clear_stem_m;
  growth::Parameters sheared;
  crowns::CrownRegion cut;
  if (tree.form.clipped()) {
    sheared = growth::clipped(species.growth, crowns::volume_m3(tree.form, tree.clear_stem_m));
    cut = crowns::clip(region, tree.form, tree.clear_stem_m, kFoliageShare * species.look.leaf.cluster_m);
    input.parameters = &sheared;
    input.region = &cut;
    input.max_height_m = tree.form.height_m + kAboveForm * cut.layer_m;
    input.asymmetry = Vec3(0.0f);  // it is tied and cut straight
  }
  input.light = light;
  input.asymmetry = asymmetry;
  input.detail = options.detail;
  input.seed = document.seed;
  input.key = tree.key;

  GrownTree grown;
  grown.asymmetry = asymmetry;
  std::uint64_t key = 0;
  if (options.skeletons) {
    key = Hasher().add(growth::hash(input)).add(tree.trunk_diameter_m.value_or(0.0f)).digest();
    grown.skeleton = options.skeletons->find(key);
    grown.from_cache = grown.skeleton != nullptr;
  }
  if (!grown.skeleton) {
    growth::Skeleton made = growth::grow(input, progress);
    if (progress && progress->cancelled()) return grown;
    if (tree.trunk_diameter_m) {
      if (auto done = growth::constrain_trunk(made, *tree.trunk_diameter_m); !done)
        warning = fmt::format("tree {} ({}): {}", tree.id, species.name, done.error().message);
    }
    grown.skeleton = std::make_shared<const growth::Skeleton>(std::move(made));
    // One whose diameter cannot be had is grown again each time, with its warning.
    if (options.skeletons && warning.empty()) options.skeletons->insert(key, grown.skeleton);
  }
  const growth::Skeleton& skeleton = *grown.skeleton;

  const float full = document.full_height_m(tree);
  const float today = growth::age_at_height(species.growth, full, input.max_height_m);
  grown.age_years = today;
  if (options.year) {
    grown.season = growth::season_at_age(species.growth, skeleton, full, input.max_height_m, *options.year);
    // Nobody knows a growing tree at a later age; a grown one only gets older.
    if (*options.year < today || input.max_height_m >= full) grown.age_years = *options.year;
  }
  grown.measures = growth::measure(skeleton, grown.season);
  return grown;
}

}  // namespace

Document without_removed(const Document& document) {
  const auto removed = [](const Tree& tree) { return tree.status == TreeStatus::to_remove; };
  if (std::none_of(document.trees->begin(), document.trees->end(), removed)) return document;
  Document rest = document;
  std::vector<Tree> standing = document.trees->to_vector();
  std::erase_if(standing, removed);
  rest.trees = std::make_shared<const Trees>(std::move(standing));
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

std::vector<crowns::Claimant> claimants(const Document& document) {
  std::vector<crowns::Claimant> claims;
  claims.reserve(document.trees->size());
  for (const Tree& tree : *document.trees) {
    crowns::RepresentativeShape shape = document.species_of(tree).shape;
    // The crown, and with it the foliage that shades others, begins at the clear stem.
    if (tree.clear_stem_m > 0.0f || tree.form.clipped())
      shape.trunk_height_m = std::min(
          std::max(tree.form.clipped() ? 0.0f : shape.trunk_height_m, tree.clear_stem_m / tree.scale_height),
          kHighestCrownBase * shape.mature_height_m);
    claims.push_back({tree.key, tree.id, tree.at, document.terrain->ground(tree.at), shape, tree.scale_height,
                      tree.scale_width});
  }
  return claims;
}

Result<GrownScene> grow_scene(const Document& given, const GrowOptions& options, Progress* progress) {
  GrownScene scene;
  scene.given = given;
  scene.document = without_removed(given);
  const Document& document = scene.document;
  const Trees& trees = *document.trees;
  const Error cancelled = cannot_finish("cancelled; nothing was written");

  Stopwatch watch;
  std::vector<Vec3> asymmetry(trees.size(), Vec3(0.0f));
  if (options.regions || options.asymmetry) {
    if (progress) progress->begin("crown regions", 0);
    auto there = standing(document, scene.warnings);
    if (!there) return there.error();
    auto space = crowns::divide_space(claimants(document), *there, *document.terrain, document.space, progress);
    if (!space) return space.error();
    scene.space = std::move(*space);
    if (options.asymmetry)
      asymmetry = crowns::neighbourhood_asymmetry(scene.space, document.asymmetry, document.terrain.get());
    for (std::string& warning : space_warnings(scene.space, document)) scene.warnings.push_back(std::move(warning));
  }
  scene.seconds["crowns"] = watch.restart();
  if (progress && progress->cancelled()) return cancelled;

  const bool shaded = options.light && options.regions && document.light.canopy_light;
  if (shaded) scene.light = crowns::canopy_light(scene.space, document.light, progress);
  scene.seconds["light"] = watch.restart();
  if (progress && progress->cancelled()) return cancelled;

  std::vector<float> costs;
  for (const Tree& tree : trees) costs.push_back(growth_cost(document, tree));
  scene.trees.resize(trees.size());
  std::vector<std::string> warnings(trees.size());
  if (progress) progress->begin("trees", trees.size());
  parallel_dearest_first(costs, [&](std::size_t i) {
    if (progress && progress->cancelled()) return;
    crowns::CrownRegion region;
    if (options.regions) region = crowns::region(scene.space, i);
    growth::Transmittance light;
    if (shaded) {
      const crowns::TreeLight& sky = scene.light.of(i);
      light = {sky.low, 1.0f, sky.cells, sky.level};
    }
    scene.trees[i] = grow_tree(document, trees[i], options.regions ? &region : nullptr, shaded ? &light : nullptr,
                               asymmetry[i], options, progress, warnings[i]);
    if (progress) progress->advance();
  });
  if (progress && progress->cancelled()) return cancelled;
  for (std::string& warning : warnings)
    if (!warning.empty()) scene.warnings.push_back(std::move(warning));
  scene.seconds["growth"] = watch.restart();
  return scene;
}

}  // namespace bosquet::scene
