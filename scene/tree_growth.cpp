#include "scene/tree_growth.h"

#include <fmt/format.h>

#include <utility>

#include "core/hash.h"
#include "growth/age.h"
#include "growth/clipped.h"
#include "growth/radii.h"
#include "scene/tree_parameters.h"

namespace bosquet::scene {
namespace {

// Twigs end so far inside a clipped form, in sides of a twig cluster, that it is the leaves that reach its sides.
constexpr float kFoliageShare = 0.4f;
// A clipped tree is full, not tall: its own height limit lies so many voxels above the form.
constexpr float kAboveForm = 3.0f;

}  // namespace

TreeInputs::TreeInputs(const Document& document, const Tree& tree, const TreeSurroundings& around, float detail)
    : trunk_diameter_m_(tree.trunk_diameter_m) {
  const Species& species = document.species_of(tree);
  input_.parameters = &species.growth;
  if (!tree.overrides.empty())
    // Edits and readers refuse what does not fit; a tree whose own parameters do not is as its species.
    if (auto own = with_overrides(species.growth, tree.overrides)) input_.parameters = &own_parameters_.emplace(*own);
  input_.max_height_m = document.mature_height_m(tree);
  if (around.space) {
    region_ = crowns::region(*around.space, around.claimant);
    input_.region = &region_;
  }
  input_.clear_stem_m = tree.clear_stem_m;
  if (tree.form.clipped()) {
    own_parameters_ = growth::clipped(*input_.parameters, crowns::volume_m3(tree.form, tree.clear_stem_m));
    region_ = crowns::clip(input_.region, tree.form, tree.clear_stem_m, kFoliageShare * species.look.leaf.cluster_m);
    input_.parameters = &*own_parameters_;
    input_.region = &region_;
    input_.max_height_m = tree.form.height_m + kAboveForm * region_.layer_m;
  }
  if (around.light) {
    const crowns::TreeLight& sky = around.light->of(around.claimant);
    light_ = {sky.low, 1.0f, sky.cells, sky.level};
    input_.light = &light_;
  }
  input_.asymmetry = tree.form.clipped() ? Vec3(0.0f) : around.asymmetry;  // it is tied and cut straight
  input_.detail = detail;
  input_.seed = document.seed;
  input_.key = tree.key;
}

std::uint64_t TreeInputs::hash() const {
  return Hasher().add(growth::hash(input_)).add(trunk_diameter_m_.value_or(0.0f)).digest();
}

// Work grows about with the number of internodes, that is with crown volume over spacing; height to the square does.
float growth_cost(const Document& document, const Tree& tree) {
  const float h = document.mature_height_m(tree) / document.species_of(tree).growth.internode_length_m;
  return h * h;
}

GrownTree grow_tree(const Document& document, const Tree& tree, const TreeInputs& inputs, std::uint64_t hash,
                    std::optional<float> year, SkeletonCache* cache, const Progress* progress, std::string& warning) {
  const Species& species = document.species_of(tree);
  const growth::GrowthInput& input = inputs.growth();
  GrownTree grown;
  grown.asymmetry = input.asymmetry;
  if (cache) {
    grown.skeleton = cache->find(hash);
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
    if (cache && warning.empty()) cache->insert(hash, grown.skeleton);
  }
  const growth::Skeleton& skeleton = *grown.skeleton;

  const growth::Parameters& parameters = species.growth;
  const float full = document.full_height_m(tree);
  const float today = growth::age_at_height(parameters, full, input.max_height_m);
  grown.age_years = today;
  if (year) {
    grown.season = growth::season_at_age(parameters, skeleton, full, input.max_height_m, *year);
    // Nobody knows a growing tree at a later age; a grown one only gets older.
    if (*year < today || input.max_height_m >= full) grown.age_years = *year;
  }
  grown.measures = growth::measure(skeleton, grown.season);
  return grown;
}

}  // namespace bosquet::scene
