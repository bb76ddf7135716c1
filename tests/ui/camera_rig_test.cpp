#include "ui/camera_rig.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "terrain/terrain.h"
#include "ui/pick.h"

namespace bosquet::ui {
namespace {

constexpr Vec2 kView{800, 600};

terrain::Terrain flat(float size = 100) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({size, size})));
}

CameraRig looking_at(const Vec3& target, const Vec3& eye) {
  scene::Camera camera;
  camera.eye = eye;
  camera.target = target;
  CameraRig rig;
  rig.look(camera);
  return rig;
}

TEST(CameraRig, LooksWhereTheCameraItWasGivenLooks) {
  const CameraRig rig = looking_at({10, 2, -30}, {40, 20, -5});
  EXPECT_LT(glm::length(rig.eye() - Vec3(40, 20, -5)), 1e-3f);
  EXPECT_LT(glm::length(rig.target() - Vec3(10, 2, -30)), 1e-3f);
}

TEST(CameraRig, StandsSouthOfTheTargetInTheViewFromTheSouth) {
  CameraRig rig;
  rig.look(StandardView::south);
  EXPECT_GT(rig.eye().z, rig.target().z);
  EXPECT_NEAR(rig.eye().x, rig.target().x, 1e-3f);
  rig.look(StandardView::east);
  EXPECT_GT(rig.eye().x, rig.target().x);
}

RC_GTEST_PROP(CameraRig, TheRayThroughAPixelIsSeenAtThatPixel, ()) {
  CameraRig rig = looking_at({50, 0, -50}, {50, 30, 10});
  rig.orbit({static_cast<float>(*rc::gen::inRange(-400, 400)), static_cast<float>(*rc::gen::inRange(-100, 100))}, 600);
  if (*rc::gen::arbitrary<bool>()) rig.show_plan(true);
  const Vec2 pixel(static_cast<float>(*rc::gen::inRange(0, 800)), static_cast<float>(*rc::gen::inRange(0, 600)));
  const SightRay ray = rig.ray(pixel, kView);
  const auto seen = rig.project(ray.origin + 37.0f * ray.direction, kView);
  RC_ASSERT(seen.has_value());
  RC_ASSERT(glm::length(*seen - pixel) < 0.05f);
}

TEST(CameraRig, PanningKeepsWhatLiesUnderThePointerThere) {
  CameraRig rig = looking_at({50, 0, -50}, {50, 40, -10});
  // At the distance of the target.
  const SightRay before = rig.ray({400, 300}, kView);
  const Vec3 held = before.origin + rig.distance_m() * before.direction;
  rig.pan({120, -60}, kView.y);
  EXPECT_LT(glm::length(*rig.project(held, kView) - Vec2(520, 240)), 0.1f);
}

TEST(CameraRig, ZoomingKeepsWhatLiesUnderThePointerThere) {
  for (const bool plan : {false, true}) {
    CameraRig rig = looking_at({50, 0, -50}, {50, 40, -10});
    rig.show_plan(plan);
    const Vec2 pixel(650, 420);
    const Vec3 held = *ground_hit(flat(), rig.ray(pixel, kView));
    rig.zoom(3, held);
    EXPECT_LT(glm::length(*rig.project(held, kView) - pixel), 0.2f);
  }
}

TEST(CameraRig, FramingShowsAllOfABox) {
  const Box3 box{{0, 0, -100}, {60, 25, 0}};
  for (const float aspect : {0.5f, 1.0f, 1.8f}) {
    CameraRig rig;
    rig.frame(box, aspect);
    const Vec2 view(600 * aspect, 600);
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z);
      const auto seen = rig.project(corner, view);
      ASSERT_TRUE(seen);
      EXPECT_TRUE(seen->x >= 0 && seen->y >= 0 && seen->x <= view.x && seen->y <= view.y) << aspect;
    }
  }
}

TEST(CameraRig, AWalkerKeepsAtEyeHeightAndGoesWhereItLooks) {
  const terrain::Terrain ground = flat();
  CameraRig rig = looking_at({50, 0, -50}, {50, 40, -10});
  rig.walk(true, ground);
  EXPECT_NEAR(rig.eye().y, CameraRig::kEyeHeight_m, 1e-3f);
  const Vec3 from = rig.eye(), ahead = glm::normalize(rig.target() - from);
  rig.step(0, 3, ground);
  EXPECT_NEAR(glm::dot(rig.eye() - from, ahead), 3.0f, 1e-3f);
  EXPECT_NEAR(rig.eye().y, CameraRig::kEyeHeight_m, 1e-3f);
  // Looking around does not move it.
  const Vec3 standing = rig.eye();
  rig.orbit({100, 20}, 600);
  EXPECT_LT(glm::length(rig.eye() - standing), 1e-3f);
}

TEST(CameraRig, TheEyeIsLiftedOutOfTheGround) {
  CameraRig rig = looking_at({50, 0, -50}, {50, -10, -10});
  rig.keep_above(flat());
  EXPECT_GT(rig.eye().y, 0.0f);
}

TEST(CameraRig, TheEyeIsLiftedOutOfTheLandAroundTheSiteToo) {
  CameraRig rig = looking_at({50, 0, -50}, {50, -10, 400});
  ASSERT_FALSE(terrain::on_site(flat(), to_plan(rig.eye())));
  rig.keep_above(flat());
  EXPECT_GT(rig.eye().y, 0.0f);
}

}  // namespace
}  // namespace bosquet::ui
