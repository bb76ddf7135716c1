// Shadow cascades: which part of the scene each shadow map covers.
//
// Source    Zhang et al. 2006, parallel-split shadow maps: slices of the view's depth, their ends between even and
//           logarithmic
// Frame     a cascade's matrix takes world to clip space of its map, the sun looking down -z
// Holds     every point of `scene` inside the view is inside the first cascade whose far end lies beyond it
#pragma once

#include <array>
#include <vector>

#include "core/vec.h"

namespace bosquet::render {

/// The part of a view that cascades need.
struct ViewVolume {
  Vec3 eye{0.0f}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  float half_width = 1, half_height = 1;  ///< at depth 1 (perspective) or everywhere (orthographic)
  bool orthographic = false;
  float near = 0.1f, far = 1000.0f;
};

struct Cascade {
  Mat4 world_to_clip{1.0f};
  float far_depth = 0;      ///< along the view, metres
  float texel_m = 0;        ///< side of a texel in the world
  float depth_range_m = 0;  ///< between the map's near and far ends
};

/// `count` cascades of `size` x `size` texels for sunlight from `to_sun` (unit).
std::vector<Cascade> fit_cascades(const ViewVolume& view, const Box3& scene, const Vec3& to_sun, int count, int size);

/// Nearest and farthest depth of the box along the view, cut to what is in front of the eye.
Vec2 depth_range(const Vec3& eye, const Vec3& forward, const Box3& box);

}  // namespace bosquet::render
