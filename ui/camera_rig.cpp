#include "ui/camera_rig.h"

#include <algorithm>
#include <cmath>

namespace bosquet::ui {
namespace {

constexpr float kTurnPerHeight_deg = 180.0f;  ///< a drag over the whole view's height
constexpr float kLeastElevation_deg = -60.0f, kMostElevation_deg = 89.0f;
constexpr float kZoomPerNotch = 0.85f;
constexpr float kFrameMargin = 1.08f;
constexpr float kLeastClearance_m = 0.3f;

float wrapped(float degrees) { return degrees - 360.0f * std::floor(degrees / 360.0f); }

}  // namespace

Vec3 CameraRig::toward_eye() const {
  const float a = radians(azimuth_deg_), e = radians(elevation_deg_);
  return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

Vec3 CameraRig::eye() const {
  if (plan_) return target_ + Vec3(0.0f, 1000.0f, 0.0f);
  return target_ + distance_m_ * toward_eye();
}

scene::Camera CameraRig::camera() const {
  scene::Camera camera;
  camera.name = "window";
  camera.eye = eye();
  camera.target = target_;
  camera.vertical_fov_deg = fov_deg_;
  return camera;
}

void CameraRig::basis(Vec3& right, Vec3& up, Vec3& forward) const {
  if (plan_) {
    right = {1, 0, 0}, up = {0, 0, -1}, forward = {0, -1, 0};
    return;
  }
  forward = -toward_eye();
  right = glm::normalize(glm::cross(forward, kUp));
  up = glm::cross(right, forward);
}

void CameraRig::orbit(Vec2 pixels, float height) {
  if (plan_) return pan(pixels, height);
  const Vec2 turn = pixels / std::max(1.0f, height) * kTurnPerHeight_deg;
  const Vec3 before = eye();
  azimuth_deg_ = wrapped(azimuth_deg_ + turn.x);
  elevation_deg_ = std::clamp(elevation_deg_ + turn.y, kLeastElevation_deg, kMostElevation_deg);
  if (walking_) target_ = before - distance_m_ * toward_eye();
}

void CameraRig::pan(Vec2 pixels, float height) {
  Vec3 right, up, forward;
  basis(right, up, forward);
  const float seen = plan_ ? plan_height_m_ : 2.0f * distance_m_ * std::tan(radians(fov_deg_) / 2);
  const float metres = seen / std::max(1.0f, height);
  target_ += (-pixels.x * metres) * right + (pixels.y * metres) * up;
}

void CameraRig::zoom(float notches, std::optional<Vec3> toward) {
  const float factor = std::pow(kZoomPerNotch, notches);
  if (plan_) {
    const float before = plan_height_m_;
    plan_height_m_ = std::clamp(plan_height_m_ * factor, kNearest_m, kFarthest_m);
    if (toward) {
      const float share = 1.0f - plan_height_m_ / before;
      target_.x += share * (toward->x - target_.x), target_.z += share * (toward->z - target_.z);
    }
    return;
  }
  const float before = distance_m_;
  distance_m_ = std::clamp(distance_m_ * factor, kNearest_m, kFarthest_m);
  // What lies under the pointer stays there: target and eye come nearer to it alike.
  if (toward) target_ += (1.0f - distance_m_ / before) * (*toward - target_);
}

void CameraRig::frame(const Box3& box, float aspect) {
  if (box.empty()) return;
  walking_ = false;
  target_ = box.centre();
  const float radius = 0.5f * glm::length(box.size());
  const float half = radians(fov_deg_) / 2;
  const float narrow = aspect < 1.0f ? std::atan(std::tan(half) * aspect) : half;
  distance_m_ = std::clamp(kFrameMargin * radius / std::sin(narrow), kNearest_m, kFarthest_m);
  plan_height_m_ = kFrameMargin * std::max(box.size().z, box.size().x / std::max(0.1f, aspect));
}

void CameraRig::look(StandardView view) {
  walking_ = false;
  plan_ = view == StandardView::top;
  switch (view) {
    case StandardView::south:
      azimuth_deg_ = 180.0f, elevation_deg_ = 8.0f;
      break;
    case StandardView::north:
      azimuth_deg_ = 0.0f, elevation_deg_ = 8.0f;
      break;
    case StandardView::east:
      azimuth_deg_ = 90.0f, elevation_deg_ = 8.0f;
      break;
    case StandardView::west:
      azimuth_deg_ = 270.0f, elevation_deg_ = 8.0f;
      break;
    case StandardView::oblique:
      azimuth_deg_ = 200.0f, elevation_deg_ = 30.0f;
      break;
    case StandardView::top:
      plan_height_m_ = 2.0f * distance_m_ * std::tan(radians(fov_deg_) / 2);
      break;
  }
}

void CameraRig::look(const scene::Camera& camera) {
  walking_ = plan_ = false;
  const Vec3 back = camera.eye - camera.target;
  const float length = glm::length(back);
  if (!(length > 0.0f)) return;
  target_ = camera.target;
  distance_m_ = std::clamp(length, kNearest_m, kFarthest_m);
  elevation_deg_ = degrees(std::asin(std::clamp(back.y / length, -1.0f, 1.0f)));
  elevation_deg_ = std::clamp(elevation_deg_, kLeastElevation_deg, kMostElevation_deg);
  azimuth_deg_ = wrapped(degrees(std::atan2(back.x, -back.z)));
  fov_deg_ = camera.vertical_fov_deg;
}

void CameraRig::show_plan(bool plan) {
  if (plan && !plan_) plan_height_m_ = 2.0f * distance_m_ * std::tan(radians(fov_deg_) / 2);
  plan_ = plan;
  if (plan) walking_ = false;
}

void CameraRig::walk(bool on, const terrain::Terrain& ground) {
  if (on == walking_) return;
  plan_ = false;
  walking_ = on;
  if (!on) return;
  // Down to the ground where one looked, facing the same way.
  const Vec2 at = to_plan(target_);
  distance_m_ = kWalkReach_m;
  elevation_deg_ = 0.0f;
  const Vec3 standing = to_world(at, ground.ground(at) + kEyeHeight_m);
  target_ = standing - distance_m_ * toward_eye();
}

void CameraRig::step(float right_m, float ahead_m, const terrain::Terrain& ground) {
  const float a = radians(azimuth_deg_);
  const Vec3 ahead(-std::sin(a), 0.0f, std::cos(a)), right(-std::cos(a), 0.0f, -std::sin(a));
  Vec3 standing = eye() + right_m * right + ahead_m * ahead;
  if (walking_) {
    const Vec2 at = to_plan(standing);
    standing.y = ground.ground(at) + kEyeHeight_m;
  }
  target_ = standing - distance_m_ * toward_eye();
}

void CameraRig::keep_above(const terrain::Terrain& ground) {
  if (plan_) return;
  const Vec3 now = eye();
  const Vec2 at = to_plan(now);  // beyond the site the land goes on about as its edge is
  const float lift = ground.ground(at) + kLeastClearance_m - now.y;
  if (lift > 0.0f) target_.y += lift;
}

SightRay CameraRig::ray(Vec2 pixel, Vec2 size) const {
  Vec3 right, up, forward;
  basis(right, up, forward);
  const Vec2 at = 2.0f * pixel / glm::max(size, Vec2(1.0f)) - 1.0f;
  const float aspect = size.x / std::max(1.0f, size.y);
  if (plan_) {
    const float half = 0.5f * plan_height_m_;
    return {eye() + right * (at.x * half * aspect) - up * (at.y * half), forward};
  }
  const float half = std::tan(radians(fov_deg_) / 2);
  return {eye(), glm::normalize(forward + right * (at.x * half * aspect) - up * (at.y * half))};
}

std::optional<Vec2> CameraRig::project(const Vec3& world, Vec2 size) const {
  Vec3 right, up, forward;
  basis(right, up, forward);
  const Vec3 from = world - eye();
  const float depth = glm::dot(from, forward);
  if (!plan_ && depth <= 1e-3f) return {};
  const float half = plan_ ? 0.5f * plan_height_m_ : depth * std::tan(radians(fov_deg_) / 2);
  const float aspect = size.x / std::max(1.0f, size.y);
  const Vec2 at(glm::dot(from, right) / (half * aspect), -glm::dot(from, up) / half);
  return (at + 1.0f) * 0.5f * size;
}

}  // namespace bosquet::ui
