#include "render/lens.h"

#include <algorithm>
#include <cmath>

namespace bosquet::render {
namespace {

constexpr float kNearestM = 0.05f;

/// Depth buffers of 24 bits tell centimetres apart at the far end up to this ratio of far to near.
constexpr float kDepthRatio = 20000.0f;

}  // namespace

ViewVolume make_view_volume(const View& view, const Box3& scene) {
  ViewVolume v;
  v.eye = view.camera.eye;
  const Vec3 line = view.camera.target - view.camera.eye;
  v.forward = glm::dot(line, line) > 0 ? glm::normalize(line) : Vec3(0, 0, -1);
  // Looking straight up or down, the picture's top is north, as on a plan.
  const bool vertical = std::abs(v.forward.y) > 0.99999f;
  v.right = glm::normalize(glm::cross(v.forward, vertical ? Vec3(0, 0, -1) : kUp));
  v.up = glm::cross(v.right, v.forward);

  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  v.orthographic = view.orthographic_height_m > 0;
  v.half_height = v.orthographic ? view.orthographic_height_m / 2 : std::tan(radians(view.camera.vertical_fov_deg) / 2);
  v.half_width = v.half_height * aspect;

  const Vec2 depths = scene.empty() ? Vec2(1, 10) : depth_range(v.eye, v.forward, scene);
  const float margin = 0.01f * (depths.y - depths.x) + 0.1f;
  if (v.orthographic) {
    v.near = depths.x - margin, v.far = depths.y + margin;
  } else {
    v.far = std::max(depths.y + margin, 1.0f);
    v.near = std::max({depths.x - margin, v.far / kDepthRatio, kNearestM});
  }
  return v;
}

Mat4 relative_to_clip(const ViewVolume& v, const ClipWindow& window) {
  Mat4 to_view(1.0f);
  for (int i = 0; i < 3; ++i) to_view[i] = {v.right[i], v.up[i], -v.forward[i], 0.0f};
  Mat4 clip(0.0f);
  clip[0][0] = 1 / v.half_width;
  clip[1][1] = 1 / v.half_height;
  if (v.orthographic) {
    clip[2][2] = -2 / (v.far - v.near);
    clip[3][2] = -(v.far + v.near) / (v.far - v.near);
    clip[3][3] = 1;
  } else {
    clip[2][2] = -(v.far + v.near) / (v.far - v.near);
    clip[2][3] = -1;
    clip[3][2] = -2 * v.far * v.near / (v.far - v.near);
  }
  Mat4 blow_up(1.0f);
  const Vec2 scale = 2.0f / (window.high - window.low), centre = 0.5f * (window.low + window.high);
  blow_up[0][0] = scale.x, blow_up[1][1] = scale.y;
  blow_up[3][0] = -centre.x * scale.x, blow_up[3][1] = -centre.y * scale.y;
  return blow_up * clip * to_view;
}

Rays rays(const ViewVolume& v, const ClipWindow& window) {
  const Vec2 half = 0.5f * (window.high - window.low), centre = 0.5f * (window.low + window.high);
  const Vec3 offset = v.right * (v.half_width * centre.x) + v.up * (v.half_height * centre.y);
  Rays out;
  out.right = v.right * (v.half_width * half.x);
  out.up = v.up * (v.half_height * half.y);
  out.forward = v.orthographic ? v.forward : v.forward + offset;
  out.origin = v.orthographic ? offset : Vec3(0.0f);
  return out;
}

}  // namespace bosquet::render
