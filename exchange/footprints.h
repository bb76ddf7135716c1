// Footprints: building outlines with heights from a vector file, to be extruded.
//
// Format    any that GDAL reads with polygons in it: GeoJSON, GeoPackage, Shapefile. The height comes from an attribute
//           by its usual names (height, height_m, hoehe, building:height, ...) or 3 m for each of building:levels; the
//           name from name or id
// Frame     plan, as exchange/shapes.h brings them onto the site: reprojected where both reference systems are known
// Decision  parts of a multipolygon are obstacles of their own; lines and points are left out and counted. An outline
//           that crosses itself is taken apart, and a height that is no number is named in a note
// Errors    those of exchange/shapes.h
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/polygon.h"
#include "core/result.h"
#include "core/vec.h"
#include "scene/document.h"

namespace bosquet::exchange {

struct Footprint {
  std::string name;
  Polygon outline;
  std::optional<float> height_m;
};

struct Footprints {
  std::vector<Footprint> all;
  std::optional<scene::Georeference> place;  ///< that the site gets by this file, when it had none
  std::vector<std::string> notes;
};

Result<Footprints> read_footprints(const std::filesystem::path& path, const scene::Georeference& site,
                                   std::optional<DVec2> size_m = {});

}  // namespace bosquet::exchange
