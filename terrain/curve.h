// Curve: a line drawn through a few points without corners.
//
// Source    centripetal Catmull-Rom splines (Catmull and Rom 1974; Yuksel et al. 2011: no cusps and no loops of their own
//           within a span); evaluated as Barry and Goldman 1988 do, by repeated interpolation
// Decision  where a line begins and ends it goes on straight; points on one another count once
// Units     metres, plan (east, north)
#pragma once

#include <vector>

#include "core/vec.h"

namespace bosquet::terrain {

/// Points along the curve through `points`, half a metre apart or less; a ring when `closed`, its first point not repeated.
/// Two points, or none that differ, come back as they are.
std::vector<Vec2> curve_through(const std::vector<Vec2>& points, bool closed);

}  // namespace bosquet::terrain
