#include "render/atmosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bosquet::render {
namespace {

TEST(Atmosphere, IsFiniteAndNeverNegativeForAnySunAndDust) {
  for (const float elevation : {-20.0f, -1.0f, 0.0f, 0.5f, 12.0f, 47.0f, 90.0f})
    for (const float turbidity : {1.0f, 2.5f, 10.0f}) {
      const Atmosphere air = make_atmosphere({77.0f, elevation}, turbidity, Vec3(0.2f));
      const auto sound = [](const Vec3& v) {
        return std::isfinite(v.x + v.y + v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0;
      };
      EXPECT_TRUE(std::all_of(air.radiance.begin(), air.radiance.end(), sound)) << elevation << " " << turbidity;
      EXPECT_TRUE(sound(air.sun_irradiance) && sound(air.sky_irradiance)) << elevation << " " << turbidity;
      EXPECT_LE(std::max({air.sun_irradiance.r, air.sun_irradiance.g, air.sun_irradiance.b}), kSunAtTop);
    }
}

TEST(Atmosphere, HasABlueZenithAPaleHorizonAndARedLowSun) {
  const Atmosphere noon = make_atmosphere({180, 60}, 2.2f, Vec3(0.15f));
  const Vec3 zenith = noon.sky(glm::normalize(Vec3(0, 1, -0.6f)));
  EXPECT_GT(zenith.b, 1.5f * zenith.r);
  const Vec3 horizon = noon.sky(glm::normalize(Vec3(0, 0.03f, -1)));
  EXPECT_LT(horizon.b / horizon.r, 0.7f * zenith.b / zenith.r);
  EXPECT_GT(luminance(horizon), luminance(zenith));
  const Atmosphere evening = make_atmosphere({270, 4}, 2.2f, Vec3(0.15f));
  EXPECT_GT(evening.sun_irradiance.r, 2 * evening.sun_irradiance.g);
}

TEST(Atmosphere, SkyGivesTheShareOfDaylightThatIsMeasured) {
  // Clear days: 10 to 25 % of the light on level ground comes from the sky with the sun at 45 deg, more when low.
  const auto share = [](float elevation) {
    const Atmosphere air = make_atmosphere({180, elevation}, 2.2f, Vec3(0.15f));
    const float sky = luminance(air.sky_irradiance);
    return sky / (sky + luminance(air.sun_irradiance) * air.to_sun.y);
  };
  EXPECT_GT(share(45), 0.10f);
  EXPECT_LT(share(45), 0.25f);
  EXPECT_GT(share(10), 1.5f * share(45));
}

TEST(Atmosphere, AmbientLightOnLevelGroundIsTheSkysIrradiance) {
  const Atmosphere air = make_atmosphere({140, 35}, 2.2f, Vec3(0.15f));
  const Vec3 up = air.ambient_irradiance(kUp);
  // Nine terms hold a cosine-weighted environment within 3 % (Ramamoorthi and Hanrahan 2001), a little more here where
  // the ground below is darker than the sky.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(up[c], air.sky_irradiance[c], 0.08f * air.sky_irradiance[c]);
  // What faces down gets the light the ground sends back, and is not black.
  const Vec3 down = air.ambient_irradiance(-kUp);
  const float ground = 0.15f * luminance(air.sky_irradiance + air.sun_irradiance * air.to_sun.y);
  EXPECT_NEAR(luminance(down), ground, 0.15f * ground);
}

TEST(Atmosphere, IsTheSameOnBothSidesOfTheSun) {
  const Atmosphere air = make_atmosphere({180, 30}, 2.2f, Vec3(0.15f));
  const Vec3 east = air.sky(glm::normalize(Vec3(0.7f, 0.3f, 0.4f))),
             west = air.sky(glm::normalize(Vec3(-0.7f, 0.3f, 0.4f)));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(east[c], west[c], 1e-3f * east[c]);
}

}  // namespace
}  // namespace bosquet::render
