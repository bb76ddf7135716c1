#include "scene/clipped_tree.h"

#include <algorithm>

namespace bosquet::scene {
namespace {

// A tree may claim so far beside its base by default, in crown radii (crowns/crown_space.h, reach_factor).
constexpr float kReach = 1.5f;

}  // namespace

float clipped_scale(const Species& species, const crowns::ClippedForm& form) {
  return form.height_m / species.shape.mature_height_m;
}

void set_form(Tree& tree, const Species& species, const crowns::ClippedForm& form, float clear_stem_m) {
  tree.form = form;
  tree.clear_stem_m = clear_stem_m;
  tree.scale_height = clipped_scale(species, form);
  const float crown_m = std::max({form.width_m, form.depth_m, 2.0f / kReach * crowns::farthest_m(form)});
  tree.scale_width = crown_m / species.shape.crown_width_m;
}

}  // namespace bosquet::scene
