// Regions: parts of a site that a tool works in.
//
// Frame     plan (east, north) metres
#pragma once

#include <variant>

#include "core/polygon.h"
#include "core/vec.h"

namespace bosquet::distribution {

struct Disc {
  Vec2 centre{0.0f};
  float radius_m = 1.0f;
};

using Region = std::variant<Box2, Disc, Polygon>;

bool contains(const Region& region, Vec2 at);
Box2 bounds(const Region& region);
float area_m2(const Region& region);  ///< holes taken off

}  // namespace bosquet::distribution
