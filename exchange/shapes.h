// Shapes: polygons and lines of a vector file as outlines on the site.
//
// Format    whatever GDAL reads with polygons or lines in it: GeoJSON, GeoPackage, Shapefile, DXF (closed lines of which
//           are polygons). Curves become chords; parts of a multipolygon are shapes of their own
// Frame     plan, by exchange/site_frame.h: reprojected into the site's reference system where both are known
// Decision  a polygon that crosses itself is taken apart by the even-odd rule (GEOS, "make valid"), and named in a note
// Decision  rings are cut to the site and kMargin_m around it, so that a country's border costs no more than a lawn's;
//           shapes that lie wholly off that are left out and counted
// Errors    no such file, nothing that GDAL reads, a file that breaks off, no such layer, an attribute filter that does
//           not parse, no polygon or line at all
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

inline constexpr double kMargin_m = 1000.0;

struct ShapeOptions {
  std::string layer = {};                    ///< empty: all
  std::string where = {};                    ///< condition on attributes, as in SQL; empty: none
  std::vector<std::string> attributes = {};  ///< to be read, by name whatever its case
  bool lines = true;                         ///< whether lines are wanted, too
  bool clip = true;                          ///< to the site and its margin
  std::optional<DVec2> size_m = {};          ///< of the site; without it nothing is cut
  bool makes_site = false;                   ///< the site's corner moves to the south-west of the shapes
};

struct Shape {
  std::size_t feature = 0;                         ///< its number in the file, from 1
  std::string name;                                ///< by the attribute name or id; may be empty
  std::vector<std::optional<std::string>> values;  ///< of the attributes asked for
  Polygon polygon;                                 ///< empty for a line
  std::vector<Vec2> line;                          ///< empty for a polygon
};

struct Shapes {
  std::vector<Shape> all;
  std::optional<scene::Georeference> place;  ///< that the site gets by this file, when it had none
  std::vector<std::string> notes;
};

Result<Shapes> read_shapes(const std::filesystem::path& path, const scene::Georeference& site,
                           const ShapeOptions& options = {});

/// The polygon taken apart so that no part crosses itself; one part, as it was, when it does not. None: it has no area.
std::vector<Polygon> untangled(const Polygon& polygon);

}  // namespace bosquet::exchange
