// Frustum: quick test whether a box can be seen through a clip matrix.
#pragma once

#include "core/vec.h"

namespace bosquet::render {

/// False only when the box lies wholly outside one of the clip planes; `skip_near` leaves the near plane out (what is
/// between the sun and a shadow map's near plane still casts).
inline bool may_be_seen(const Mat4& world_to_clip, const Box3& box, bool skip_near = false) {
  int outside[6] = {0, 0, 0, 0, 0, 0};
  for (unsigned i = 0; i < 8; ++i) {
    const Vec4 p = world_to_clip * Vec4(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                        i & 4 ? box.high.z : box.low.z, 1.0f);
    outside[0] += p.x<-p.w, outside[1] += p.x> p.w;
    outside[2] += p.y<-p.w, outside[3] += p.y> p.w;
    outside[4] += p.z < -p.w && !skip_near, outside[5] += p.z > p.w;
  }
  for (const int count : outside)
    if (count == 8) return false;
  return true;
}

}  // namespace bosquet::render
