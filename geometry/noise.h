// Noise: tileable random fields for textures, the same bits everywhere.
//
// Source    Perlin 2002, "Improving noise" (gradient noise, quintic fade); Worley 1996 (cells)
// Frame     one tile is [0,1) x [0,1); a field with `nx` x `ny` lattice cells a tile repeats exactly after 1
// Holds     values depend on (seed, key) and the point alone; only + - * / sqrt
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::geometry {

/// Gradient noise with nx x ny lattice cells a tile; values in about [-1, 1], mean 0.
class TileNoise {
 public:
  TileNoise(std::uint64_t seed, std::uint64_t key, int nx, int ny);
  float operator()(float u, float v) const;

 private:
  int nx_, ny_;
  std::vector<Vec2> gradients_;  ///< row by row
};

/// Sum of `octaves` noises, each twice as fine and `gain` times as strong as the one before; about [-1, 1].
class TileFractal {
 public:
  TileFractal(std::uint64_t seed, std::uint64_t key, int nx, int ny, int octaves, float gain = 0.5f);
  float operator()(float u, float v) const;

 private:
  std::vector<TileNoise> octaves_;
  float gain_, norm_ = 1.0f;
};

/// Jittered cells, nx x ny a tile, each `stretch` times as high as wide; odd rows are shifted by half a cell (ny even).
class TileCells {
 public:
  struct Hit {
    std::uint32_t cell;    ///< nearest cell, its number in the tile
    std::uint32_t second;  ///< the cell across the nearest border
    Vec2 offset;           ///< from the nearest cell's centre to the point, in cells
    float border;          ///< distance to the nearest border, in cell widths
  };

  TileCells(std::uint64_t seed, std::uint64_t key, int nx, int ny, float jitter, float stretch = 1.0f);
  Hit operator()(float u, float v) const;

  /// Uniform in [0, 1): property `what` of a cell.
  float random(std::uint32_t cell, std::uint64_t what) const;
  /// Uniform in [0, 1): property of the border between two cells, whichever comes first.
  float random(std::uint32_t a, std::uint32_t b, std::uint64_t what) const;

 private:
  int nx_, ny_;
  float inverse_stretch_;
  std::uint64_t key_;
  std::vector<Vec2> centres_;  ///< in cells
};

/// 0 below a, 1 above b, smooth between (a < b).
inline float smooth_step(float a, float b, float x) {
  float t = (x - a) / (b - a);
  t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace bosquet::geometry
