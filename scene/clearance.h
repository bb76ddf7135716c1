// Clearance: trees that are proposed nearer to something than the rules of the site allow.
//
// Model     from the middle of the trunk to the nearest point in plan of a building (an obstacle, or an area that is
//           one), of a path (an area that is one, or one of which nobody said what it is), of another tree's trunk, or
//           of the site's edge
// Decision  only proposed trees are judged: what stands already is not ordered to move. Two clipped trees are not held
//           apart, or every hedge would break the rule; trees to be removed count for nothing
// Units     metres; a rule of 0 asks for nothing
// Frame     plan (east, north) from the site's south-west corner
// Cost      a few cells of the ground and a few neighbours for each tree, and every building's outline
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/vec.h"

namespace bosquet::scene {

struct Document;

struct ClearanceRules {
  float building_m = 0.0f, path_m = 0.0f, tree_m = 0.0f, edge_m = 0.0f;

  bool operator==(const ClearanceRules&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, ClearanceRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"building_m", "m", 0, 100, "Least distance of a proposed trunk to buildings and other obstacles"},
        p.building_m);
  visit(Real{"path_m", "m", 0, 100, "Least distance of a proposed trunk to paths"}, p.path_m);
  visit(Real{"tree_m", "m", 0, 100, "Least distance of a proposed trunk to other trunks"}, p.tree_m);
  visit(Real{"edge_m", "m", 0, 100, "Least distance of a proposed trunk to the edge of the site"}, p.edge_m);
}

struct ClearanceBreach {
  enum class To { building, path, tree, edge };
  std::int32_t tree = 0;  ///< its id
  Vec2 at{0.0f};
  To to = To::building;
  std::string name;        ///< of the building or path; may be empty
  std::int32_t other = 0;  ///< the other tree's id
  float distance_m = 0.0f, wanted_m = 0.0f;
};

/// All of them in the order of the trees, for each the nearest building, path and tree. Two trees too near to each other
/// are told once, of the one planted later.
std::vector<ClearanceBreach> clearance_breaches(const Document& document, const ClearanceRules& rules);

/// "tree 12 (english_oak) at (4.0, 7.5): 2.10 m from building 'house'; the rule is 4 m".
std::string words(const ClearanceBreach& breach, const Document& document);

}  // namespace bosquet::scene
