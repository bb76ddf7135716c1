// Brush: strokes that shape the ground, bar places from planting and set the planting density.
//
// Source    Longay 2014, 6.3
// Model     a stroke has weight w(d) at distance d from its polyline: 1 up to hardness * radius, then falling to 0 at
//           the radius as 1 - S(x), S(x) = 6x^5 - 15x^4 + 10x^3. With f = strength * w
//             raise, lower   h +- f * amount_m
//             noise          h + f * Perlin noise of amplitude amount_m and scale noise_scale_m
//             flatten        h + f * (height where the stroke begins - h)
//             smooth         h + f * (mean of the surroundings within a third of the radius - h)
//             density        d + f * (density - d)
//           exclude and include set the exclusion to 1 or 0 wherever d <= radius
// Decision  a stroke passes each place once however often it crosses itself: its effect depends on the path alone,
//           neither on how many events recorded it nor on how fast they came, and "lower by 2 m" is 2 m deep. Painting
//           twice takes two strokes
// Holds     the result shares every tile that the stroke does not touch; cost follows the touched tiles
// Frame     plan (east, north) metres
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/polygon.h"
#include "core/vec.h"
#include "terrain/terrain.h"

namespace bosquet::terrain {

enum class BrushKind { raise, lower, smooth, flatten, noise, exclude, include, density };

inline constexpr std::array<std::string_view, 8> kBrushKindNames{"raise", "lower",   "smooth",  "flatten",
                                                                 "noise", "exclude", "include", "density"};

struct Stroke {
  BrushKind kind = BrushKind::raise;
  std::vector<Vec2> points;  ///< plan polyline; one point is a click
  float radius_m = 5.0f;
  float strength = 1.0f;
  float hardness = 0.0f;
  float amount_m = 1.0f;
  float density = 0.0f;
  float noise_scale_m = 5.0f;
  std::uint64_t seed = 0;  ///< of the noise brush
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Stroke>
void describe(P& p, Visitor& visit) {
  visit(Choice{"kind", kBrushKindNames, "What the stroke does"}, p.kind);
  visit(Real{"radius_m", "m", 0.1, 10000, "Distance from the stroke at which its effect ends"}, p.radius_m);
  visit(Real{"strength", "", 0, 1, "Share of the full effect"}, p.strength);
  visit(Real{"hardness", "", 0, 1, "Share of the radius with the full effect, before it falls off"}, p.hardness);
  visit(Real{"amount_m", "m", 0, 1000, "Height that raise, lower and noise add or take at full strength"}, p.amount_m);
  visit(Real{"density", "", 0, 1, "Planting density that the density brush leads to"}, p.density);
  visit(Real{"noise_scale_m", "m", 0.5, 10000, "Distance between the bumps of the noise brush"}, p.noise_scale_m);
}

/// The terrain after the stroke. A stroke without points changes nothing.
Terrain apply(const Terrain& terrain, const Stroke& stroke);

/// The terrain with nothing planted inside a polygon (its holes stay free).
Terrain exclude(const Terrain& terrain, const Polygon& area);

/// The terrain with nothing planted within half of `width_m` of a polyline; at least a cell's diagonal wide, so that a
/// narrow path has no gaps.
Terrain exclude_path(const Terrain& terrain, std::span<const Vec2> path, float width_m);

}  // namespace bosquet::terrain
