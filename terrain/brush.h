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
//           exclude and include set the exclusion to 1 or 0 wherever d <= radius; exclude gives the place to `area`
// Decision  a stroke passes each place once however often it crosses itself: its effect depends on the path alone,
//           neither on how many events recorded it nor on how fast they came, and "lower by 2 m" is 2 m deep. Painting
//           twice takes two strokes
// Holds     the result shares every tile that the stroke does not touch; cost follows the touched tiles. Undo is
//           keeping the earlier value
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
#include "terrain/exclusion.h"
#include "terrain/line_distance.h"
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
  Area area = {};          ///< that the exclude brush makes; without a name at first
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

/// The terrain after the stroke, and what it touched. A stroke without points changes nothing.
Edit edit(const Terrain& terrain, const Stroke& stroke);

/// The terrain after the stroke.
Terrain apply(const Terrain& terrain, const Stroke& stroke);

/// A stroke while it is drawn. Its terrain after each event is the one that edit() makes of all points so far, bit for
/// bit, however the points came; an event costs the places that it brings the stroke nearer to.
class LiveStroke {
 public:
  /// Begins with the stroke's own points, if it has any.
  LiveStroke(const Terrain& before, Stroke stroke);

  /// Continues the stroke; returns the rectangle beyond which nothing changed by that.
  Box2 extend(std::span<const Vec2> points);

  const Terrain& before() const { return before_; }
  const Terrain& terrain() const { return after_; }  ///< may be copied at any time
  const Stroke& stroke() const { return stroke_; }   ///< with all points so far, to be kept

 private:
  LineDistance empty_distance() const;
  void begin();
  void shape(std::span<const Piece> fresh);
  void bar(std::span<const Piece> fresh);
  void set_density(std::span<const Piece> fresh);

  Terrain before_, after_;
  Stroke stroke_;
  LineDistance distance_;
  AreaId area_ = 0;
};

}  // namespace bosquet::terrain
