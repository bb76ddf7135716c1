#include "render/shadow_cascades.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "render/lens.h"

namespace bosquet::render {
namespace {

RC_GTEST_PROP(Cascades, HoldEveryVisiblePointOfTheSceneInTheFirstThatReachesIt, ()) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)); };
  const Box3 scene{{0, -2, -number(10, 300)}, {number(10, 300), number(3, 40), 0}};
  View view;
  view.camera.eye = {number(-100, 400), number(1, 120), number(-200, 200)};
  view.camera.target = scene.centre();
  RC_PRE(view.camera.eye != view.camera.target);
  view.orthographic_height_m = *rc::gen::element(0.0f, 60.0f);
  const ViewVolume volume = make_view_volume(view, scene);
  const Vec3 to_sun = scene::Sun{number(0, 360), number(3, 91)}.direction();
  const std::vector<Cascade> cascades = fit_cascades(volume, scene, to_sun, 3, 1024);
  const Mat4 to_clip = relative_to_clip(volume, {});

  for (int i = 0; i < 200; ++i) {
    const Vec3 share(number(0, 1001) / 1000, number(0, 1001) / 1000, number(0, 1001) / 1000);
    const Vec3 point = scene.low + share * scene.size();
    const Vec4 seen = to_clip * Vec4(point - volume.eye, 1.0f);
    if (seen.w <= 0 || std::abs(seen.x) > seen.w || std::abs(seen.y) > seen.w || std::abs(seen.z) > seen.w) continue;
    const float depth = glm::dot(point - volume.eye, volume.forward);
    std::size_t c = 0;
    while (c + 1 < cascades.size() && depth > cascades[c].far_depth) ++c;
    const Vec4 in_map = cascades[c].world_to_clip * Vec4(point, 1.0f);
    RC_ASSERT(std::abs(in_map.x) <= 1.0f && std::abs(in_map.y) <= 1.0f && std::abs(in_map.z) <= 1.0f);
  }
}

TEST(Cascades, NearOnesAreFiner) {
  View view;
  view.camera.eye = {50, 2, 0};
  view.camera.target = {50, 2, -100};
  const Box3 scene{{0, 0, -300}, {100, 20, 0}};
  const auto cascades = fit_cascades(make_view_volume(view, scene), scene, scene::Sun{150, 40}.direction(), 3, 1024);
  EXPECT_LT(cascades[0].texel_m, 0.5f * cascades[1].texel_m);
  EXPECT_LE(cascades[1].texel_m, cascades[2].texel_m);
  EXPECT_GE(cascades[2].far_depth, 300);
}

}  // namespace
}  // namespace bosquet::render
