#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "geometry/ground_finish.h"
#include "geometry/ground_texture.h"
#include "geometry/noise.h"

namespace bosquet::geometry {
namespace {

/// What a place of a texture shows.
struct GroundGrain {
  Vec3 colour;
  float height_cm;
};

/// Calls grain(u, v) for every pixel.
template <class Paint>
GroundTextures paint_ground(int size, const Paint& grain) {
  assert(size >= 64 && size <= 4096 && (size & (size - 1)) == 0);
  const auto n = static_cast<std::size_t>(size);
  std::vector<Vec3> colours(n * n);
  Relief relief(size, 100.0f * kGroundTileM);
  parallel_for(n, [&](std::size_t y) {
    const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
    for (std::size_t x = 0; x < n; ++x) {
      const GroundGrain seen = grain((static_cast<float>(x) + 0.5f) / static_cast<float>(size), v);
      colours[y * n + x] = seen.colour;
      relief.at(static_cast<int>(x), static_cast<int>(y)) = seen.height_cm;
    }
  });
  return finish_ground(colours, relief);
}

/// Of stones: grey to ochre, and light to dark.
Vec3 stone_colour(float kind, float light) {
  return glm::mix(Vec3(0.97f, 0.99f, 1.03f), Vec3(1.06f, 1.0f, 0.88f), kind) * (0.72f + 0.56f * light);
}

}  // namespace

GroundTextures make_gravel(std::uint64_t seed, int size) {
  // Chips of two sizes in sand, trodden in more or less.
  const TileCells chips(seed, 80, 130, 130, 0.9f), grit(seed, 81, 300, 300, 0.9f);
  const TileFractal sand(seed, 82, 160, 160, 2), trodden(seed, 83, 4, 4, 3);
  return paint_ground(size, [&](float u, float v) {
    const float deep = 0.5f + 0.5f * trodden(u, v);
    GroundGrain seen{Vec3(0.92f, 0.90f, 0.84f) * (0.86f + 0.16f * sand(u, v)), 0.05f * sand(u, v)};
    const auto lay = [&](const TileCells& cells, float share, float height_cm) {
      const TileCells::Hit hit = cells(u, v);
      if (cells.random(hit.cell, 1) > share) return;
      const float cover = smooth_step(0.04f, 0.20f, hit.border);
      const Vec3 stone = stone_colour(cells.random(hit.cell, 2), cells.random(hit.cell, 3));
      // Its foot lies in the shade of its neighbours.
      seen.colour = glm::mix(seen.colour * (1.0f - 0.22f * smooth_step(0.0f, 0.06f, hit.border)), stone, cover);
      seen.height_cm = std::max(seen.height_cm, height_cm * cover * (0.6f + 0.4f * cells.random(hit.cell, 4)));
    };
    lay(grit, 0.75f, 0.22f);
    lay(chips, 0.22f + 0.25f * deep, 0.55f);
    seen.colour *= 0.97f + 0.06f * deep;
    return seen;
  });
}

GroundTextures make_paving(std::uint64_t seed, int size) {
  constexpr int kAlong = 5, kRows = 10;  // slabs a tile
  constexpr float kLong_m = kGroundTileM / kAlong, kShort_m = kGroundTileM / kRows, kJoint_m = 0.007f;
  const TileFractal face(seed, 84, 24, 24, 4), fine(seed, 85, 200, 200, 2);
  const TileCells slabs(seed, 86, kAlong, kRows, 0.0f);  // for each slab's own random numbers
  return paint_ground(size, [&](float u, float v) {
    const int row = std::min(static_cast<int>(v * kRows), kRows - 1);
    float along = u * kAlong + (row % 2 ? 0.5f : 0.0f);
    if (along >= kAlong) along -= kAlong;
    const int column = std::min(static_cast<int>(along), kAlong - 1);
    const float x_m = (along - static_cast<float>(column)) * kLong_m,
                y_m = (v * kRows - static_cast<float>(row)) * kShort_m;
    const float from_edge = std::min(std::min(x_m, kLong_m - x_m), std::min(y_m, kShort_m - y_m));
    const auto slab = static_cast<std::uint32_t>(row * kAlong + column);
    const float tone = 0.93f + 0.14f * slabs.random(slab, 1), warm = slabs.random(slab, 2);
    const float raised = smooth_step(0.4f * kJoint_m, 1.1f * kJoint_m, from_edge);
    const Vec3 stone = glm::mix(Vec3(0.98f, 1.0f, 1.02f), Vec3(1.02f, 1.0f, 0.95f), warm) *
                       (tone * (1.0f + 0.07f * face(u, v) + 0.05f * fine(u, v)));
    const Vec3 joint = Vec3(0.62f, 0.58f, 0.50f) * (1.0f + 0.2f * fine(u, v));
    return GroundGrain{glm::mix(joint, stone, raised), 0.5f * raised + 0.03f * fine(u, v)};
  });
}

GroundTextures make_soil(std::uint64_t seed, int size) {
  const TileCells clods(seed, 87, 70, 70, 1.0f);
  const TileFractal crumbs(seed, 88, 90, 90, 3, 0.7f), wide(seed, 89, 5, 5, 3);
  return paint_ground(size, [&](float u, float v) {
    const TileCells::Hit hit = clods(u, v);
    const bool clod = clods.random(hit.cell, 1) < 0.35f;
    const float round = clod ? smooth_step(0.02f, 0.35f, hit.border) : 0.0f, crumb = crumbs(u, v);
    const float light =
        0.80f + 0.22f * crumb + 0.10f * wide(u, v) + round * (0.10f + 0.25f * clods.random(hit.cell, 2));
    return GroundGrain{Vec3(1.03f, 1.0f, 0.96f) * light, 1.4f * round + 0.5f * crumb};
  });
}

}  // namespace bosquet::geometry
