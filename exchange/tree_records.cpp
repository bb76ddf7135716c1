#include "exchange/tree_records.h"

#include <cmath>

#include "exchange/substitutes.h"

namespace bosquet::exchange {
namespace {

constexpr double kPowers[]{1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};

}  // namespace

double map_coordinate(double origin, float offset) {
  const double sum = origin + static_cast<double>(offset);
  for (const double power : kPowers) {
    const double rounded = std::round(sum * power) / power;
    if (static_cast<float>(rounded - origin) == offset) return rounded == 0 ? 0 : rounded;
  }
  return sum;
}

float shortest_length(float scale, float mature) {
  const double length = static_cast<double>(scale) * static_cast<double>(mature);
  for (const double power : kPowers) {
    const auto rounded = static_cast<float>(std::round(length * power) / power);
    if (rounded / mature == scale) return rounded;
  }
  const float near = scale * mature;
  for (const float other : {std::nextafterf(near, 0.0f), std::nextafterf(near, INFINITY)})
    if (other / mature == scale) return other;
  return near;
}

std::vector<TreeRecord> tree_records(const scene::Document& document) {
  std::vector<TreeRecord> out;
  out.reserve(document.trees->size());
  const DVec2 corner = document.place.south_west;
  Substitutes substitutes(document);
  for (const scene::Tree& tree : *document.trees) {
    const scene::Species& species = document.species_of(tree);
    TreeRecord r;
    r.id = tree.id;
    r.species = species.name;
    r.common = species.common_names.empty() ? species.name : species.common_names.front();
    r.botanical = species.botanical_name;
    r.plan = DVec2(tree.at);
    r.map = {map_coordinate(corner.x, tree.at.x), map_coordinate(corner.y, tree.at.y)};
    r.status = tree.status;
    r.surveyed = tree.measured;
    r.height_m = shortest_length(tree.scale_height, species.shape.mature_height_m);
    r.crown_diameter_m = shortest_length(tree.scale_width, species.shape.crown_width_m);
    r.trunk_diameter_m = tree.trunk_diameter_m;
    r.clear_stem_m = tree.clear_stem_m;
    if (tree.form.clipped()) r.form = crowns::kFormKindNames[static_cast<std::size_t>(tree.form.kind)];
    r.inventory_name = tree.inventory_name, r.inventory_id = tree.inventory_id;
    r.stands_for = substitutes.stands_for(tree);
    out.push_back(std::move(r));
  }
  return out;
}

std::vector<TreeRecord> tree_records(const scene::GrownScene& grown) {
  std::vector<TreeRecord> out = tree_records(grown.given);
  // Both in the order of ids; trees to be removed are not among those that grew.
  std::size_t i = 0;
  for (TreeRecord& record : out) {
    if (i >= grown.trees.size() || (*grown.document.trees)[i].id != record.id) continue;
    const scene::GrownTree& tree = grown.trees[i++];
    record.grown = GrownSizes{tree.measures.height_m, tree.measures.trunk_diameter_m, tree.measures.crown_diameter_m,
                              tree.age_years};
  }
  return out;
}

}  // namespace bosquet::exchange
