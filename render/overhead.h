// Overhead: what stands above the ground, as maps seen from straight above.
//
// Model     how much of the sky a point sees is taken from the heights h around it: with mean m and variance v of h
//           over a disc, at most v / (v + (m - y)^2) of the disc is higher than a point at y < m (Cantelli's
//           inequality). Two discs are kept, one for contact with the ground, one for a stand of trees
// Frame     cell (i, j) covers world x from low.x + i * cell and world z from low.y + j * cell; row by row, z growing
// Units     metres; in `cover`, heights are (h - base) / scale
// Cost      one pass over the triangles, some 20 ns each
#pragma once

#include <optional>
#include <vector>

#include "core/vec.h"
#include "scene/model.h"

namespace bosquet::render {

/// All water of one height.
struct WaterSurface {
  float level_m = 0;
  float area_m2 = 0;
  Box2 box;  ///< world x and z
};

struct Overhead {
  int columns = 0, rows = 0;
  Vec2 low{0.0f};  ///< world x and z of the first cell's corner
  float cell = 1.0f;
  float base = 0.0f, scale = 1.0f;
  std::vector<Vec4> cover;    ///< mean and mean square of the height over the small disc, then over the large one
  std::vector<float> ground;  ///< height of the ground, metres; around it that of its nearest edge

  Box2 ground_box;                     ///< world x and z that the ground covers; empty without ground
  float land_height = 0.0f;            ///< of plain land around the site: median of the ground along the site's edge
  Vec3 ground_albedo{0.16f};           ///< mean of the ground's base colour, linear
  Vec3 land_tint{0.16f};               ///< of plain land around: what the ground's edge multiplies its texture by
  std::vector<WaterSurface> waters;    ///< the largest first
  std::optional<float> water_level_m;  ///< of the largest water surface
  bool water_flows_on = false;         ///< it reaches the ground's edge, so there is more of it beyond; a pond does not

  Vec2 size() const { return cell * Vec2(columns, rows); }
};

/// Maps of a model with these bounds, at most `side` cells long.
Overhead make_overhead(const scene::Model& model, const Box3& bounds, int side = 512);

}  // namespace bosquet::render
