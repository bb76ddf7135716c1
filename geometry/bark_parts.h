// Bark parts: what the forms of bark in bark_texture.cpp and bark_skins.h share.
//
// Frame     a form maps (u, v) in one tile, [0,1) x [0,1), v downward, to a BarkPoint
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/look.h"
#include "geometry/noise.h"

namespace bosquet::geometry {

// What a point of the bark is: height in cm, linear colour.
struct BarkPoint {
  float height;
  Vec3 colour;
};

struct Palette {
  Vec3 top, furrow, mark, patch, lichen;
};

// Cells per tile for features of this size, at least 2 and even.
inline int cells_per_tile(const BarkLook& look, float feature_cm) {
  const int n = static_cast<int>(100.0f * look.tile_m / feature_cm + 0.5f);
  return std::max(2, n + n % 2);
}

// A point's distance to a wrapped stamp, -1/2 .. 1/2 of a tile.
inline float wrapped(float d) { return d > 0.5f ? d - 1.0f : d < -0.5f ? d + 1.0f : d; }

// Noises that every form uses.
struct Grain {
  TileFractal broad, fine, fibre, warp_u, warp_v;

  Grain(std::uint64_t seed, const BarkLook& look, int octaves)
      : broad(seed, 1, 3, 3, 4),
        fine(seed, 2, cells_per_tile(look, 2.0f), cells_per_tile(look, 2.0f), octaves, 0.65f),
        fibre(seed, 3, cells_per_tile(look, 1.2f), cells_per_tile(look, 6.0f), octaves - 1, 0.6f),
        warp_u(seed, 4, cells_per_tile(look, 2.2f * look.feature_width_cm),
               cells_per_tile(look, 0.8f * look.feature_length_cm), 3),
        warp_v(seed, 5, cells_per_tile(look, 2.0f * look.feature_width_cm),
               cells_per_tile(look, 0.8f * look.feature_length_cm), 2) {}
};

// Stamps (lenticels, scars) listed by the bands of rows that they can touch.
template <class Stamp>
class StampRows {
 public:
  // `s` has u, v in tiles; `reach` is how far up and down it goes.
  void add(Stamp s, float reach) {
    const auto into_tile = [](float x) { return x < 0.0f ? x + 1.0f : x >= 1.0f ? x - 1.0f : x; };
    s.u = into_tile(s.u), s.v = into_tile(s.v);
    const int first = static_cast<int>((s.v - reach + 1.0f) * kRows),
              last = static_cast<int>((s.v + reach + 1.0f) * kRows);
    for (int r = first; r <= std::min(last, first + kRows - 1); ++r)
      rows_[static_cast<std::size_t>(r % kRows)].push_back(s);
  }
  const std::vector<Stamp>& at(float v) const {
    return rows_[static_cast<std::size_t>(std::min(kRows - 1, static_cast<int>(v * kRows)))];
  }

 private:
  static constexpr int kRows = 64;
  std::vector<Stamp> rows_[kRows];
};

}  // namespace bosquet::geometry
