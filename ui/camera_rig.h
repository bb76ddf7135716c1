// Camera rig: the camera that a hand turns, moves and walks with.
//
// Model     orbit: the eye stands `distance_m` from a target, seen from `azimuth` at `elevation`; walk: the target is
//           kWalkReach_m ahead of an eye that keeps its height above the ground
// Frame     world metres; azimuth from north clockwise, where the eye stands as seen from the target; elevation above
//           the horizon
// Holds     the eye stays above the ground; distance, elevation and field of view stay within their limits
#pragma once

#include <optional>

#include "core/vec.h"
#include "scene/model.h"
#include "terrain/terrain.h"

namespace bosquet::ui {

/// A ray of sight: world, direction unit.
struct SightRay {
  Vec3 origin{0.0f}, direction{0, 0, -1};
};

/// Named views, as on a numeric keypad.
enum class StandardView { south, north, east, west, top, oblique };

class CameraRig {
 public:
  static constexpr float kNearest_m = 0.5f, kFarthest_m = 50000.0f;
  static constexpr float kEyeHeight_m = 1.65f;  ///< of a walker
  static constexpr float kWalkReach_m = 5.0f;

  /// Where it looks from and to.
  scene::Camera camera() const;
  Vec3 eye() const;
  const Vec3& target() const { return target_; }
  float distance_m() const { return distance_m_; }
  float azimuth_deg() const { return azimuth_deg_; }
  float elevation_deg() const { return elevation_deg_; }
  bool walking() const { return walking_; }
  /// Seen from straight above in parallel; 0 when not, else the height of world shown.
  float plan_height_m() const { return plan_ ? plan_height_m_ : 0.0f; }

  /// Turns round the target by a drag of so many pixels in a view `height` pixels high; when walking, looks around.
  void orbit(Vec2 pixels, float height);
  /// Moves target and eye with the pointer, so that what lies under it stays under it.
  void pan(Vec2 pixels, float height);
  /// Nearer by notches above 0, toward a place under the pointer if there is one.
  void zoom(float notches, std::optional<Vec3> toward = {});
  /// All of a box in view, from where it is seen now.
  void frame(const Box3& box, float aspect);
  void look(StandardView view);
  /// The camera of a scene.
  void look(const scene::Camera& camera);
  void show_plan(bool plan);
  bool shows_plan() const { return plan_; }

  void walk(bool on, const terrain::Terrain& ground);
  /// A step in metres to the right and ahead, along the ground.
  void step(float right_m, float ahead_m, const terrain::Terrain& ground);

  /// Lifts the eye out of the ground, if it is in it.
  void keep_above(const terrain::Terrain& ground);

  /// The line of sight through a pixel of a view so many pixels wide and high.
  SightRay ray(Vec2 pixel, Vec2 size) const;
  /// Where a world point is in the view, in pixels; nothing behind the eye.
  std::optional<Vec2> project(const Vec3& world, Vec2 size) const;

 private:
  Vec3 toward_eye() const;
  void basis(Vec3& right, Vec3& up, Vec3& forward) const;

  Vec3 target_{0.0f};
  float distance_m_ = 60.0f;
  float azimuth_deg_ = 200.0f, elevation_deg_ = 25.0f;
  float fov_deg_ = 40.0f;
  bool walking_ = false;
  bool plan_ = false;
  float plan_height_m_ = 60.0f;
};

}  // namespace bosquet::ui
