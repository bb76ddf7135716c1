// Measures on images that several texture tests use.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/image.h"
#include "core/vec.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {

/// Mean absolute difference between columns x and x + 1 (wrapped), over all channels.
inline double column_step(const Image& image, int x) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int c = 0; c < image.channels; ++c) {
      sum += std::abs(image.at(x, y)[c] - image.at((x + 1) % image.width, y)[c]);
    }
  }
  return sum / image.height / image.channels;
}

inline double row_step(const Image& image, int y) {
  double sum = 0;
  for (int x = 0; x < image.width; ++x) {
    for (int c = 0; c < image.channels; ++c) {
      sum += std::abs(image.at(x, y)[c] - image.at(x, (y + 1) % image.height)[c]);
    }
  }
  return sum / image.width / image.channels;
}

/// True when the step across each seam is no larger than the largest step anywhere inside.
inline bool tiles(const Image& image) {
  double inner_column = 0, inner_row = 0;
  for (int x = 0; x + 1 < image.width; ++x) inner_column = std::max(inner_column, column_step(image, x));
  for (int y = 0; y + 1 < image.height; ++y) inner_row = std::max(inner_row, row_step(image, y));
  return column_step(image, image.width - 1) <= inner_column && row_step(image, image.height - 1) <= inner_row;
}

/// Largest departure of a normal map's vectors from unit length; 1 when one points into the surface.
inline float worst_normal(const Image& image) {
  float worst = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const Vec3 n = Vec3(p[0], p[1], p[2]) / 127.5f - 1.0f;
      worst = std::max(worst, n.z > 0 ? std::fabs(std::sqrt(glm::dot(n, n)) - 1.0f) : 1.0f);
    }
  }
  return worst;
}

inline Vec3 linear(const std::uint8_t* p) { return linear_from_srgb(Vec3(p[0], p[1], p[2]) / 255.0f); }

inline Vec3 mean_linear(const Image& image) {
  Vec3 sum{0.0f};
  for (int y = 0; y < image.height; ++y) {
    Vec3 row{0.0f};
    for (int x = 0; x < image.width; ++x) row += linear(image.at(x, y));
    sum += row / static_cast<float>(image.width);
  }
  return sum / static_cast<float>(image.height);
}

}  // namespace bosquet::geometry
