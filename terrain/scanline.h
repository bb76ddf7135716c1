// Scanline: where a polygon is inside along a line of constant north, and how far it covers the cells of a site.
//
// Model     crossings of a ring with the line are paired from west to east (even-odd); a ring's edge includes its lower
//           end and not its upper one, so a vertex on the line counts once. What lies in a hole is outside
// Cost      along a row as many steps as the polygon has edges
#pragma once

#include <functional>

#include "core/polygon.h"
#include "terrain/lattice.h"

namespace bosquet::terrain {

/// Calls span(west, east, sign) for each run inside the ring (sign +1) and inside each hole (sign -1).
void scan_polygon(const Polygon& polygon, float north, const std::function<void(float, float, int)>& span);

/// Calls visit(i, j, share) for the cells that the polygon may cover, row by row from the south, with the share covered:
/// exact along eight lines through a row, the mean of those across it.
void visit_covered(const Polygon& polygon, const Lattice& lattice, const std::function<void(int, int, float)>& visit);

}  // namespace bosquet::terrain
