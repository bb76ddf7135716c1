// Pond: standing water with a level of its own, dug into the ground inside an outline.
//
// Model     with s the signed distance to the outline in metres, negative inside, the ground becomes
//             min(ground, max(level - depth_m, level + s / bank))
//           so that the water's edge is the outline wherever the ground there was no lower than the level; where it was
//           higher the bank is cut back outside the outline at the same slope
// Decision  without a level it stands kFreeboard_m below the lowest ground on the outline. A higher level than that
//           would run out over the lowest place, so it is lowered to it; a dam is a brush stroke before the pond
// Frame     plan (east, north) metres; level in metres, up
// Holds     nothing is planted inside the outline, which becomes an area of kind water; the level holds in the cells
//           that the outline touches and nowhere else
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>

#include "core/parameter.h"
#include "core/polygon.h"
#include "terrain/terrain.h"

namespace bosquet::terrain {

inline constexpr float kFreeboard_m = 0.1f;

struct PondRules {
  float depth_m = 1.0f;
  float bank = 2.0f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, PondRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"depth_m", "m", 0.05, 1000, "Depth of the water away from its banks"}, p.depth_m);
  visit(Real{"bank", "m/m", 0.1, 100, "How far a bank runs for each metre that it goes down"}, p.bank);
}

struct DugPond {
  Edit edit;
  float level_m = 0.0f;
  bool lowered = false;  ///< from the level asked for
};

/// The outline may lie partly off the site; nothing is dug where it lies off it wholly.
DugPond dig_pond(const Terrain& terrain, const std::string& name, const Polygon& outline,
                 std::optional<float> level_m = {}, const PondRules& rules = {});

}  // namespace bosquet::terrain
