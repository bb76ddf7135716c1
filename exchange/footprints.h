// Footprints: building outlines with heights from a vector file, to be extruded.
//
// Format    any that GDAL reads with polygons in it: GeoJSON, GeoPackage, Shapefile. The height comes from an attribute
//           by its usual names (height, height_m, hoehe, building:height, ...) or 3 m for each of building:levels; the
//           name from name or id
// Frame     plan: (east, north) from the site's south-west corner, after `south_west` is subtracted in double. Files in
//           degrees are refused
// Decision  parts of a multipolygon are obstacles of their own; lines and points are left out and counted
// Errors    what is no such file, or has no polygon
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/polygon.h"
#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

struct Footprint {
  std::string name;
  Polygon outline;
  std::optional<float> height_m;
};

struct Footprints {
  std::vector<Footprint> all;
  std::vector<std::string> notes;
};

Result<Footprints> read_footprints(const std::filesystem::path& path, DVec2 south_west);

}  // namespace bosquet::exchange
