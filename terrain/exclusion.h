// Exclusion: areas and paths on which nothing is planted, as polygons and lines.
//
// Frame     plan (east, north) metres
// Model     a cell is barred as far as the area covers it (terrain/mask.h); it belongs to the area as terrain/area.h says
// Holds     the result shares every tile that is not touched
#pragma once

#include <span>

#include "core/polygon.h"
#include "core/vec.h"
#include "terrain/terrain.h"

namespace bosquet::terrain {

/// The terrain with nothing planted inside a polygon (its holes stay free), which becomes `area`.
Terrain exclude(const Terrain& terrain, const Polygon& polygon, const Area& area = {});

/// The terrain with nothing planted outside a polygon.
Terrain exclude_outside(const Terrain& terrain, const Polygon& polygon, const Area& area = {});

/// The terrain with nothing planted within half of `width_m` of a polyline; at least a cell's diagonal wide, so that a
/// narrow path has no gaps.
Terrain exclude_path(const Terrain& terrain, std::span<const Vec2> path, float width_m, const Area& area = {});

}  // namespace bosquet::terrain
