// Tree records: a document's trees as schedules and maps list them.
//
// Frame     `plan` from the site's south-west corner; `map` in the site's reference system: the shortest decimal number
//           that leads back to the tree's place, so that what an inventory gave comes back as it was
// Model     sizes twice: as the document says them (surveyed, or those of the species at the tree's scale) and, once
//           grown, as the tree stands. Sizes that were surveyed come back likewise by their shortest decimal
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"
#include "scene/document.h"
#include "scene/grown_scene.h"

namespace bosquet::exchange {

struct GrownSizes {
  float height_m = 0, trunk_diameter_m = 0, crown_diameter_m = 0, age_years = 0;
};

struct TreeRecord {
  std::int32_t id = 0;
  std::string species;    ///< as in recipes
  std::string common;     ///< common name
  std::string botanical;  ///< botanical name
  DVec2 plan{0.0}, map{0.0};
  scene::TreeStatus status = scene::TreeStatus::proposed;
  bool surveyed = false;                     ///< sizes are those it has, not those it will have
  float height_m = 0, crown_diameter_m = 0;  ///< as the document says
  std::optional<float> trunk_diameter_m;     ///< likewise; missing when nobody said it
  float clear_stem_m = 0;                    ///< 0: none was asked for
  std::string form;                          ///< that it is clipped to; empty: none
  std::string inventory_name, inventory_id;  ///< may be empty
  std::string stands_for;  ///< the inventory's name, when the tree is drawn as another kind; else empty
  std::optional<GrownSizes> grown;

  float shown_height_m() const { return grown ? grown->height_m : height_m; }
  float shown_crown_m() const { return grown ? grown->crown_diameter_m : crown_diameter_m; }
  std::optional<float> shown_trunk_m() const {
    return grown ? std::optional(grown->trunk_diameter_m) : trunk_diameter_m;
  }
};

std::vector<TreeRecord> tree_records(const scene::Document& document);
/// With what became of the trees; those to be removed are listed without, as they are not grown.
std::vector<TreeRecord> tree_records(const scene::GrownScene& grown);

/// The shortest decimal number x with float(x - origin) == offset.
double map_coordinate(double origin, float offset);

/// The length of fewest decimals that scales to `scale` times `mature`.
float shortest_length(float scale, float mature);

}  // namespace bosquet::exchange
