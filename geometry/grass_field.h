// Grass field: where tufts of grass stand on a site.
//
// Model     places are the cells of two lattices, one of lawns and one of meadows, jittered. A place bears a tuft when its
//           own random number lies below the share of full cover there: that of the terrain's cover (lawn, or natural
//           ground as meadow), less in the shade of crowns, none on steep ground, at the water's edge, beneath it, and
//           where something stands. Flowers come in patches
// Rank      what is left of that number, even in (0, 1): seen from a distance d only tufts below full_rank(d) are worth
//           drawing, so that grass thins out with distance, each tuft at its own
// Decision  a place's numbers are a hash of its cell alone: painting one corner moves no blade elsewhere, and a denser field
//           holds the sparser one
// Frame     plan (east, north) metres in, world out; tile (i, j) covers kGrassTileM from (i, j) kGrassTileM on
// Holds     the same bits for any thread count, build and x86-64 CPU
// Cost      about 0.5 ms a tile at full rank on one core, much less farther off
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/vec.h"
#include "geometry/ground_grid.h"
#include "geometry/season.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

inline constexpr float kGrassTileM = 8.0f;
/// Nearer than this all tufts are worth drawing; beyond kFarthestGrassM none.
inline constexpr float kFullGrassM = 9.0f, kFarthestGrassM = 64.0f;

/// The rank below which tufts are worth drawing at a distance, for a usual lens.
inline float full_rank(float distance_m) {
  const float share = kFullGrassM / std::max(distance_m, kFullGrassM);
  return share * share;
}

struct GrassOptions {
  float density = 1.0f;  ///< up to kMostGrassDensity
  float lawn_height_m = 0.06f, meadow_height_m = 0.4f;
  Season season = Season::summer;
  std::uint64_t seed = 1;
  const GroundGrid* grid = nullptr;  ///< the surface that tufts stand on; null: the terrain's own heights
  std::function<float(Vec2)> shade;  ///< share 0..1 of forest floor, as GroundOptions'; may be missing
  std::function<bool(Vec2)> taken;   ///< whether something stands there; may be missing
};
/// About how many a meadow has at density 1.
inline constexpr float kMeadowTuftsPerM2 = 80.0f;
inline constexpr float kMostGrassDensity = 3.0f;

struct Tuft {
  Vec3 at{0.0f};       ///< world, the middle of its foot
  Vec3 normal = kUp;   ///< of the ground
  Vec2 turn{1.0f, 0};  ///< cosine and sine of its turn about the upright, from x toward z
  float height_m = 1;  ///< that it is scaled to
  float rank = 0;
  Vec3 colour{1.0f};  ///< linear factor (geometry/grass_tuft.h)
  std::uint8_t shape = 0;
  bool lawn = false;
};

/// The tufts of a tile with ranks below `rank`, by lattice, row and column.
std::vector<Tuft> grass_in(const terrain::Terrain& terrain, const GrassOptions& options, IVec2 tile, float rank = 1.0f);

}  // namespace bosquet::geometry
