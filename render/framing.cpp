#include "render/framing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace bosquet::render {
namespace {

/// Share of the picture left free on the tightest side.
constexpr float kMargin = 0.04f;

std::array<Vec3, 8> corners(const Box3& box) {
  std::array<Vec3, 8> out;
  for (unsigned i = 0; i < 8; ++i)
    out[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
  return out;
}

}  // namespace

Box3 bounds(const scene::Model& model) {
  Box3 box;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!part.mesh || part.mesh->empty()) continue;
      const Box3 own = part.mesh->bounds();
      box.add(own.low + node.translation);
      box.add(own.high + node.translation);
    }
  return box;
}

scene::Camera frame(const Box3& box, float aspect, float elevation_deg, float azimuth_deg, float vertical_fov_deg) {
  return frame(std::span(&box, 1), aspect, elevation_deg, azimuth_deg, vertical_fov_deg);
}

scene::Camera frame(std::span<const Box3> boxes, float aspect, float elevation_deg, float azimuth_deg,
                    float vertical_fov_deg) {
  Box3 box;
  for (const Box3& one : boxes) box.add(one);
  scene::Camera camera;
  camera.name = "whole";
  camera.vertical_fov_deg = vertical_fov_deg;
  if (box.empty()) {
    camera.eye = {0.0f, 10.0f, 20.0f};
    return camera;
  }

  // The camera's axes; `back` points from the model to the eye.
  const Vec3 back = scene::Sun{azimuth_deg, std::min(elevation_deg, 89.9f)}.direction();
  const Vec3 right = glm::normalize(glm::cross(kUp, back));
  const Vec3 up = glm::cross(back, right);
  const float tan_up = std::tan(radians(vertical_fov_deg) / 2) * (1 - 2 * kMargin);
  const float tan_right = tan_up * aspect;

  // A corner c (from the box's centre) is inside when |c.r - x| <= tan * (d - c.back) for the eye at distance d and
  // offset x: each side gives a bound, left and right (low and high) together give d and x.
  float right_bound = -1e30f, left_bound = -1e30f, high_bound = -1e30f, low_bound = -1e30f;
  for (const Box3& one : boxes) {
    if (one.empty()) continue;
    for (const Vec3& corner : corners(one)) {
      const Vec3 c = corner - box.centre();
      const float toward = glm::dot(c, back);
      right_bound = std::max(right_bound, glm::dot(c, right) + tan_right * toward);
      left_bound = std::max(left_bound, -glm::dot(c, right) + tan_right * toward);
      high_bound = std::max(high_bound, glm::dot(c, up) + tan_up * toward);
      low_bound = std::max(low_bound, -glm::dot(c, up) + tan_up * toward);
    }
  }
  float distance = std::max((right_bound + left_bound) / (2 * tan_right), (high_bound + low_bound) / (2 * tan_up));
  distance = std::max(distance, 0.05f);
  const Vec3 centre = box.centre() + right * ((right_bound - left_bound) / 2) + up * ((high_bound - low_bound) / 2);
  camera.eye = centre + back * distance;
  camera.target = centre;
  return camera;
}

scene::Camera look_at_world(const Vec3& eye, const Vec3& target, float vertical_fov_deg) {
  return {"", eye, target, vertical_fov_deg};
}

scene::Camera look_at_plan(const Vec3& eye, const Vec3& target, float vertical_fov_deg) {
  return look_at_world(to_world({eye.x, eye.y}, eye.z), to_world({target.x, target.y}, target.z), vertical_fov_deg);
}

Result<scene::Camera> camera_from_text(std::string_view text, const scene::Model& model) {
  for (const scene::Camera& camera : model.cameras)
    if (camera.name == text) return camera;

  // Six numbers between commas, spaces allowed.
  std::array<float, 6> v{};
  std::size_t count = 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (bool more = true; more && count < 6; ++count) {
    while (at != end && *at == ' ') ++at;
    const auto [after, problem] = std::from_chars(at, end, v[count]);
    if (problem != std::errc() || !std::isfinite(v[count])) break;
    at = after;
    while (at != end && *at == ' ') ++at;
    more = at != end && *at == ',';
    if (more) ++at;
  }
  const Vec3 eye(v[0], v[1], v[2]), target(v[3], v[4], v[5]);
  if (count == 6 && at == end && eye != target) return look_at_plan(eye, target);

  std::string message = "camera \"" + std::string(text) + "\": ";
  message += count == 6 && at == end ? "eye and target are the same point" : "no such camera and not six numbers";
  message += "; allowed are \"x,y,z,tx,ty,tz\" (eye and target as metres east, north, up)";
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    message += (i ? ", \"" : " and \"") + model.cameras[i].name + "\"";
  if (model.cameras.empty()) message += "; this scene names no camera";
  return Error{message};
}

}  // namespace bosquet::render
