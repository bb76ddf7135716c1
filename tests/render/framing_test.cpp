#include "render/framing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "render/lens.h"

namespace bosquet::render {
namespace {

/// Largest |x| and |y| in clip space of the box's corners.
Vec2 reach(const scene::Camera& camera, const Box3& box, float aspect) {
  View view;
  view.camera = camera;
  view.width = static_cast<int>(1000 * aspect), view.height = 1000;
  const ViewVolume volume = make_view_volume(view, box);
  const Mat4 to_clip = relative_to_clip(volume, {});
  Vec2 most(0.0f);
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z);
    const Vec4 clip = to_clip * Vec4(corner - camera.eye, 1.0f);
    most = glm::max(most, glm::abs(Vec2(clip) / clip.w));
    EXPECT_GT(clip.w, 0);
  }
  return most;
}

RC_GTEST_PROP(Frame, ShowsTheWholeBoxAndTouchesTheMarginOnTheTightestSide, ()) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)); };
  const Vec3 low(number(-500, 500), number(-20, 20), number(-500, 500));
  const Box3 box{low, low + Vec3(number(1, 1000), number(0, 40), number(1, 1000))};
  const float aspect = number(50, 250) / 100, elevation = number(0, 90), azimuth = number(0, 360);
  const Vec2 most = reach(frame(box, aspect, elevation, azimuth), box, aspect);
  // The margin is 4 % of the picture, 8 % of the half.
  RC_ASSERT(std::max(most.x, most.y) < 0.925f);
  RC_ASSERT(std::max(most.x, most.y) > 0.915f);
}

TEST(Frame, LooksFromTheSouthDownByThirtyDegreesUnlessAsked) {
  const Box3 box{{0, 0, -100}, {100, 20, 0}};
  const scene::Camera camera = frame(box, 1.6f);
  const Vec3 line = glm::normalize(camera.target - camera.eye);
  EXPECT_NEAR(line.x, 0, 1e-5);
  EXPECT_NEAR(line.y, -0.5, 1e-5);
  EXPECT_LT(line.z, 0);
}

TEST(Frame, SeveralBoxesAreShownFromNearerThanTheOneAroundThem) {
  const std::array<Box3, 2> boxes{Box3{{0, 0, -2}, {100, 2, 0}}, Box3{{40, 0, -100}, {60, 20, -90}}};
  Box3 around = boxes[0];
  around.add(boxes[1]);
  const scene::Camera all = frame(boxes, 1.6f, 16.0f);
  for (const Box3& box : boxes) {
    const Vec2 most = reach(all, box, 1.6f);
    EXPECT_LT(std::max(most.x, most.y), 0.925f);
  }
  const scene::Camera one = frame(around, 1.6f, 16.0f);
  EXPECT_LT(glm::length(all.eye - around.centre()), glm::length(one.eye - around.centre()));
}

TEST(Frame, OfNothingIsStillACamera) {
  const scene::Camera camera = frame(Box3(), 1.6f);
  EXPECT_NE(camera.eye, camera.target);
}

TEST(LookAt, PlanTermsAreEastNorthAndHeight) {
  const scene::Camera camera = look_at_plan({10, 20, 3}, {10, 30, 3});
  EXPECT_EQ(camera.eye, Vec3(10, 3, -20));
  EXPECT_EQ(camera.target, Vec3(10, 3, -30));
}

TEST(CameraFromText, FindsNamesFirstAndReadsSixNumbers) {
  scene::Model model;
  model.cameras.push_back({"bank", {1, 2, 3}, {4, 5, 6}, 55});
  const Result<scene::Camera> named = camera_from_text("bank", model);
  ASSERT_TRUE(named);
  EXPECT_EQ(named->vertical_fov_deg, 55);
  const Result<scene::Camera> typed = camera_from_text("10,20,3, 10, 30,3.5", model);
  ASSERT_TRUE(typed) << typed.error().message;
  EXPECT_EQ(typed->eye, Vec3(10, 3, -20));
  EXPECT_EQ(typed->target, Vec3(10, 3.5f, -30));
}

TEST(CameraFromText, NamesTheCamerasThereAreInItsError) {
  scene::Model model;
  model.cameras.push_back({"bank", {1, 2, 3}, {4, 5, 6}, 55});
  for (const char* text : {"bnak", "", "1,2,3", "1,2,3,4,5,six", "1,2,3,4,5,6,7", "1,2,3,1,2,3", "nan,0,0,1,1,1"}) {
    const Result<scene::Camera> camera = camera_from_text(text, model);
    ASSERT_FALSE(camera) << text;
    EXPECT_NE(camera.error().message.find("\"bank\""), std::string::npos) << camera.error().message;
    EXPECT_NE(camera.error().message.find("x,y,z,tx,ty,tz"), std::string::npos) << camera.error().message;
  }
}

}  // namespace
}  // namespace bosquet::render
