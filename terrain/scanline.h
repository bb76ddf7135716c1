// Scanline: where a polygon is inside along a line of constant north.
//
// Model     crossings of a ring with the line are paired from west to east (even-odd); a ring's edge includes its lower
//           end and not its upper one, so a vertex on the line counts once. What lies in a hole is outside
#pragma once

#include <functional>

#include "core/polygon.h"

namespace bosquet::terrain {

/// Calls span(west, east, sign) for each run inside the ring (sign +1) and inside each hole (sign -1).
void scan_polygon(const Polygon& polygon, float north, const std::function<void(float, float, int)>& span);

}  // namespace bosquet::terrain
