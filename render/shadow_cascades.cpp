#include "render/shadow_cascades.h"

#include <algorithm>
#include <cmath>

namespace bosquet::render {
namespace {

/// Weight of logarithmic against even splits.
constexpr float kLogarithmic = 0.75f;

/// Soft edges read this many texels beside a point.
constexpr float kBorderTexels = 6.0f;

Vec3 corner(const Box3& box, unsigned i) {
  return {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
}

}  // namespace

Vec2 depth_range(const Vec3& eye, const Vec3& forward, const Box3& box) {
  Vec2 range(1e30f, -1e30f);
  for (unsigned i = 0; i < 8; ++i) {
    const float depth = glm::dot(corner(box, i) - eye, forward);
    range = {std::min(range.x, depth), std::max(range.y, depth)};
  }
  return range;
}

std::vector<Cascade> fit_cascades(const ViewVolume& view, const Box3& scene, const Vec3& to_sun, int count, int size) {
  // Axes of the light: z toward the sun, the others any.
  const Vec3 z = to_sun;
  const Vec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99f ? kUp : Vec3(0, 0, 1), z));
  const Vec3 y = glm::cross(z, x);
  const auto in_light = [&](const Vec3& p) { return Vec3(glm::dot(p, x), glm::dot(p, y), glm::dot(p, z)); };
  Box3 scene_light;
  for (unsigned i = 0; i < 8; ++i) scene_light.add(in_light(corner(scene, i)));

  std::vector<Cascade> cascades;
  float begin = view.near;
  for (int c = 0; c < count; ++c) {
    const float share = static_cast<float>(c + 1) / static_cast<float>(count);
    const float even = view.near + (view.far - view.near) * share;
    const float logarithmic = view.near * std::pow(view.far / view.near, share);
    const float end = view.orthographic || c + 1 == count ? even : glm::mix(even, logarithmic, kLogarithmic);

    Box3 slice;
    for (const float depth : {begin, end}) {
      const float spread = view.orthographic ? 1.0f : depth;
      for (const float sx : {-1.0f, 1.0f})
        for (const float sy : {-1.0f, 1.0f})
          slice.add(in_light(view.eye + view.forward * depth + view.right * (sx * spread * view.half_width) +
                             view.up * (sy * spread * view.half_height)));
    }
    // Only what is there can be shaded; everything toward the sun can cast.
    Vec2 low = glm::max(Vec2(slice.low), Vec2(scene_light.low)),
         high = glm::min(Vec2(slice.high), Vec2(scene_light.high));
    high = glm::max(high, low + Vec2(0.01f));
    const float extent = std::max(high.x - low.x, high.y - low.y);
    const float border = extent * kBorderTexels / static_cast<float>(size - 2 * static_cast<int>(kBorderTexels));
    const Vec2 centre = 0.5f * (low + high);
    const float half = 0.5f * extent + border;
    const float near_z = scene_light.high.z + 1.0f, far_z = scene_light.low.z - 1.0f;

    Cascade cascade;
    cascade.far_depth = end;
    cascade.texel_m = 2 * half / static_cast<float>(size);
    cascade.depth_range_m = near_z - far_z;
    Mat4& m = cascade.world_to_clip;
    m = Mat4(0.0f);
    for (int i = 0; i < 3; ++i) {
      m[i][0] = x[i] / half;
      m[i][1] = y[i] / half;
      m[i][2] = -2 * z[i] / (near_z - far_z);
    }
    m[3] = {-centre.x / half, -centre.y / half, (near_z + far_z) / (near_z - far_z), 1.0f};
    cascades.push_back(cascade);
    begin = end;
  }
  return cascades;
}

}  // namespace bosquet::render
