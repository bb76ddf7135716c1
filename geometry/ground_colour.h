// Ground colour: the albedo of the ground at a place, that its mesh and the grass on it share.
//
// Model     the cover's colour in its season; natural ground is meadow, forest floor under trees where the caller says so
//           and soil where it is steep; wet sand at the water's edge, mud below
// Units     linear albedo; shade 0..1 is the share of forest floor
// Frame     plan (east, north) metres; the normal is the world's
#pragma once

#include "core/vec.h"
#include "geometry/season.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

/// Cosine of the slope from which on natural ground shows soil, and from which on nothing else.
inline constexpr float kSteepGround = 0.80f, kBareGround = 0.62f;

/// What a season makes of the colour of lawn and meadow; 1 in summer and on all other covers. Grass is fresh in spring, straw
/// in autumn and dull in winter, a mown lawn less so.
Vec3 season_tint(terrain::Cover cover, Season season);

struct GroundPlace {
  Vec2 plan{0.0f};
  float height_m = 0.0f;
  Vec3 normal = kUp;
  float shade = 0.0f;
};
Vec3 ground_albedo(const terrain::Terrain& terrain, terrain::Cover cover, const GroundPlace& place, Season season);

}  // namespace bosquet::geometry
