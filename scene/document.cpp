#include "scene/document.h"

#include <algorithm>

namespace bosquet::scene {
namespace {

constexpr float kLeastScale = 0.02f, kMostScale = 2.0f;

}  // namespace

void set_measured_size(Tree& tree, const Species& species, std::optional<float> height_m,
                       std::optional<float> trunk_diameter_m, std::optional<float> crown_diameter_m) {
  if (!height_m && trunk_diameter_m) height_m = species.allometry.height_m(*trunk_diameter_m);
  if (height_m) tree.scale_height = std::clamp(*height_m / species.shape.mature_height_m, kLeastScale, kMostScale);
  tree.scale_width = crown_diameter_m
                         ? std::clamp(*crown_diameter_m / species.shape.crown_width_m, kLeastScale, kMostScale)
                         : tree.scale_height;
  tree.trunk_diameter_m = trunk_diameter_m;
}

}  // namespace bosquet::scene
