#include "scene/document.h"

#include <algorithm>

#include "scene/measured_size.h"

namespace bosquet::scene {

void settle_counters(Document& document) {
  if (document.trees && !document.trees->empty())
    document.next_tree_id = std::max(document.next_tree_id, document.trees->back().id + 1);
  for (const Obstacle& o : document.obstacles)
    document.next_standing_id = std::min(document.next_standing_id, o.id - 1);
  for (const HeroTree& h : document.heroes) document.next_standing_id = std::min(document.next_standing_id, h.id - 1);
}

void set_measured_size(Tree& tree, const Species& species, std::optional<float> height_m,
                       std::optional<float> trunk_diameter_m, std::optional<float> crown_diameter_m) {
  const auto scale = [](float size, float mature) {
    return std::clamp(size / mature, kLeastMeasuredScale, kMostMeasuredScale);
  };
  if (trunk_diameter_m) {
    if (!height_m) height_m = species.allometry.height_m(*trunk_diameter_m);
    if (!crown_diameter_m) crown_diameter_m = species.allometry.crown_m(*trunk_diameter_m);
  }
  if (height_m) tree.scale_height = tree.scale_width = scale(*height_m, species.shape.mature_height_m);
  if (crown_diameter_m) {
    tree.scale_width = scale(*crown_diameter_m, species.shape.crown_width_m);
    if (!height_m) tree.scale_height = tree.scale_width;
  }
  tree.trunk_diameter_m = trunk_diameter_m;
  tree.measured = height_m || crown_diameter_m;
}

}  // namespace bosquet::scene
