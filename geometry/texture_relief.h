// Texture relief: a tileable square of heights and the normal map that goes with it.
//
// Frame     sample (x, y), y from the top row down; the square repeats in both directions
// Units     heights and `side` in the same unit
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

namespace bosquet::geometry {

struct Relief {
  int size = 0;
  float side = 1.0f;
  std::vector<float> heights;

  Relief(int samples, float length)
      : size(samples), side(length), heights(static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples)) {}
  float& at(int x, int y) {
    return heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
  }
  float at(int x, int y) const {
    return heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
  }
};

/// Normals by central differences with wrap; slopes above `steepest` are drawn in toward it.
Image normal_map(const Relief& relief, float steepest);

/// How much lower a sample lies than its surroundings within about `radius` samples (box mean, wrapped), in the unit of
/// heights: positive in furrows. Cost independent of the radius.
Relief hollowness(const Relief& relief, int radius);

}  // namespace bosquet::geometry
