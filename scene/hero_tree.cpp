#include "scene/hero_tree.h"

#include <utility>

#include "core/scalar.h"

namespace bosquet::scene {

growth::Skeleton placed(growth::Skeleton skeleton, float scale, float rotation_deg) {
  const SinCos turn = sin_cos(radians(rotation_deg));
  for (Vec3& p : skeleton.distal)
    p = scale * Vec3{turn.cos * p.x + turn.sin * p.z, p.y, turn.cos * p.z - turn.sin * p.x};
  for (float& r : skeleton.radius) r *= scale;
  skeleton.internode_length_m *= scale;
  skeleton.tip_diameter_m *= scale;
  return skeleton;
}

}  // namespace bosquet::scene
