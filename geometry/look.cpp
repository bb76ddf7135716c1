#include "geometry/look.h"

#include "geometry/noise.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {

Vec3 bark_reference(const Look& look) {
  const BarkLook& bark = look.bark;
  return glm::max(glm::max(linear_from_srgb(bark.colour), linear_from_srgb(bark.young_colour)),
                  glm::max(linear_from_srgb(bark.base_colour), linear_from_srgb(look.leaf.twig_colour)));
}

Vec3 bark_tint(const Look& look, float diameter_m, float height_m) {
  const BarkLook& bark = look.bark;
  const float young = 0.01f * bark.young_diameter_cm, twig = 0.002f * look.leaf.twig_mm;
  const float age = smooth_step(young, 2.0f * young, diameter_m);
  Vec3 colour = glm::mix(linear_from_srgb(bark.young_colour), linear_from_srgb(bark.colour), age);
  if (bark.base_height_m > 0.0f) {
    const float foot = 1.0f - smooth_step(0.4f * bark.base_height_m, bark.base_height_m, height_m);
    colour = glm::mix(colour, linear_from_srgb(bark.base_colour), foot * age);
  }
  const float branch = smooth_step(twig, 4.0f * twig, diameter_m);
  colour = glm::mix(linear_from_srgb(look.leaf.twig_colour), colour, branch);
  return glm::min(colour / glm::max(bark_reference(look), Vec3(1e-4f)), Vec3(1.0f));
}

}  // namespace bosquet::geometry
