// Species and standing trees, as planting sees them.
//
// Units     metres; plan positions (east, north) from the site's south-west corner
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "core/hash.h"
#include "core/parameter.h"
#include "core/vec.h"

namespace bosquet::distribution {

/// Where trees of a species are planted and how large.
struct PlantingRules {
  float min_spacing_m = 0.5f;
  float max_slope_deg = 60.0f;
  float min_altitude_m = -500.0f;
  float max_altitude_m = 9000.0f;
  float scale_min = 0.75f;
  float scale_max = 1.1f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, PlantingRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"min_spacing_m", "m", 0, 100, "Least distance kept to any other trunk's centre"}, p.min_spacing_m);
  visit(Real{"max_slope_deg", "deg", 0, 90, "Steepest ground it is planted on"}, p.max_slope_deg);
  visit(Real{"min_altitude_m", "m", -500, 9000, "Lowest ground it is planted on"}, p.min_altitude_m);
  visit(Real{"max_altitude_m", "m", -500, 9000, "Highest ground it is planted on"}, p.max_altitude_m);
  visit(Real{"scale_min", "", 0.05, 4, "Smallest tree that is planted, as a share of the mature size"}, p.scale_min);
  visit(Real{"scale_max", "", 0.05, 4, "Largest tree that is planted, as a share of the mature size"}, p.scale_max);
}

struct Species {
  std::string name;
  float trunk_width_m = 0.5f;  ///< T_w at scale 1
  PlantingRules rules;
};

struct StandingTree {
  std::uint64_t key = 0;  ///< stable and unique; random numbers and ties go by it
  std::uint32_t species = 0;
  Vec2 at{0.0f};
  float scale = 1.0f;
  float trunk_radius_m = 0.25f;
  float spacing_m = 0.0f;  ///< its own least distance to any other tree

  bool operator==(const StandingTree&) const = default;
};

/// Two trees may stand at this distance or farther: the larger of both spacings and of the sum of the trunk radii.
inline float least_distance_m(const StandingTree& a, const StandingTree& b) {
  const float trunks = a.trunk_radius_m + b.trunk_radius_m;
  const float spacing = a.spacing_m > b.spacing_m ? a.spacing_m : b.spacing_m;
  return trunks > spacing ? trunks : spacing;
}

/// A tree of a species at a place.
inline StandingTree standing_tree(std::uint64_t key, std::uint32_t index, const Species& species, Vec2 at,
                                  float scale) {
  return {key, index, at, scale, 0.5f * scale * species.trunk_width_m, species.rules.min_spacing_m};
}

/// Key of tree `index` of a planting block (hash_text of its name): the same however many trees other blocks plant.
inline std::uint64_t tree_key(std::uint64_t block, std::uint64_t index) {
  return Hasher().add(block).add(index).digest();
}

/// Block of the n-th use of a tool in a document: each has keys of its own, so that undoing one, or drawing it again,
/// leaves the trees of the others as they are.
inline std::uint64_t block_of_use(std::uint64_t number) {
  return Hasher().add(std::string_view("planting by hand")).add(number).digest();
}

}  // namespace bosquet::distribution
