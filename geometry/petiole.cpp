#include "geometry/petiole.h"

namespace bosquet::geometry {

Across::Across(const Vec3& twig) {
  const Vec3 level = unit(glm::cross(twig, kUp), Vec3{1, 0, 0});
  side = unit(level - glm::dot(level, twig) * twig, Vec3{0, 0, 1});
  over = glm::cross(side, twig);
}

LeafFrames stalk(const Vec3x4& twig, const Vec3x4& radial, const SinCos& angle) {
  const Vec3x4 heading = all4(angle.cos) * twig + all4(angle.sin) * radial;
  const Vec3x4 up = unit(twig - dot(twig, heading) * heading, radial);
  return {heading, cross(up, heading), up};
}

LeafFrame stalk(const Vec3& twig, const Vec3& radial, const SinCos& angle) {
  return stalk(all4(twig), all4(radial), angle).lane(0);
}

Hanging hanging(const Vec3x4& heading, const SinCos& droop, const Vec3x4& out) {
  const Float4 none = all4(0.0f);
  const Vec3x4 otherwise = unit({out.x, none, out.z}, all4(Vec3{1, 0, 0}));
  const Vec3x4 away = unit({heading.x, none, heading.z}, otherwise);
  const Float4 cos = all4(droop.cos), sin = all4(droop.sin);
  return {cos * away - sin * all4(kUp), cos * all4(kUp) + sin * away};
}

LeafFrames sunk(const LeafFrames& frame, const Vec3x4& heading, Float4 softness) {
  LeafFrames f;
  f.heading = unit(mix(frame.heading, heading, softness / (1.0f + softness)), frame.heading);
  f.up = unit(frame.up - dot(frame.up, f.heading) * f.heading, frame.left);
  f.left = cross(f.up, f.heading);
  return f;
}

LeafFrames turn_petiole(LeafFrames f, const Vec3x4& toward, Float4 twist, Float4 bend, Float4 turn, float fineness) {
  // Steps small enough that the first-order turn is stable.
  const Int4 steps = 2 + growth::whole(fineness * (2.0f + 2.0f * max(max(twist, bend), turn)));
  const Float4 ds = 1.0f / __builtin_convertvector(steps, Float4);
  const auto nearly_unit = [](const Vec3x4& v) {  // a step of Newton's for the inverse root; exactly at the end
    return (1.5f - 0.5f * dot(v, v)) * v;
  };
  const Float4 twist_step = -twist * ds, bend_step = bend * ds, turn_step = -turn * ds;
  for (Int4 k{}; growth::any(k < steps); k += 1) {
    const Int4 going = k < steps;
    const Float4 ht = dot(f.heading, toward), lt = dot(f.left, toward);
    // L.(T x (H x T)) = L.H (T.T) - (L.T)(H.T), and L.H = 0.
    const Float4 about_h = twist_step * lt, about_l = bend_step * ht, about_u = turn_step * lt * ht;
    const Vec3x4 heading = nearly_unit(f.heading - about_l * f.up + about_u * f.left);
    const Vec3x4 turned = f.up - about_h * f.left + about_l * f.heading;
    const Vec3x4 up = nearly_unit(turned - dot(turned, heading) * heading);
    f.left = select(going, cross(up, heading), f.left);
    f.heading = select(going, heading, f.heading), f.up = select(going, up, f.up);
  }
  f.heading = unit(f.heading, f.heading);
  f.up = unit(f.up - dot(f.up, f.heading) * f.heading, f.up);
  f.left = cross(f.up, f.heading);
  return f;
}

LeafFrame turn_petiole(const LeafFrame& frame, const Vec3& toward, float twist, float bend, float turn,
                       float fineness) {
  return turn_petiole(all4(frame), all4(toward), all4(twist), all4(bend), all4(turn), fineness).lane(0);
}

}  // namespace bosquet::geometry
