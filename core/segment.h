// Segment: a straight piece of wood, as stages before growth see a tree that is already there.
#pragma once

#include "core/vec.h"

namespace bosquet {

struct Segment {
  Vec3 from, to;  ///< world, metres
  float radius;   ///< metres
};

}  // namespace bosquet
