// Elevation: real ground from any raster that GDAL reads (GeoTIFF, ASCII grid, 16-bit PNG, ...).
//
// Grid      sample (column c, row r) is the height at the centre of a raster cell, at
//             origin + (c * cell_x_m, r * cell_y_m), row 0 in the south, stored at [r * columns + c]
// Frame     origin is in the raster's projected coordinates (east, north) in double; a raster in degrees, feet or
//           turned against north is reprojected to a transverse Mercator plane through its centre, in metres. Asked for
//           in a site's reference system, it is reprojected to that when it has another
// Units     metres; a band's own scale, offset and unit (feet) are applied
// Decision  without a coordinate reference system coordinates count as metres; without any georeference cells are
//           `pixel_m` wide and the south-west corner of the raster is (0, 0)
// Decision  cells without data are filled by a smooth (harmonic) surface through their rims, and counted
// Decision  of a window only the cells it needs are read, so a raster larger than memory serves a site
// Holds     reprojected heights are rounded to 1 mm, so that PROJ's last bits do not reach the site
// Errors    missing or damaged file, no band, no valid cell, absurd or too large: one message naming file, size, reason
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

/// A rectangle in a raster's or a site's coordinates.
struct MapRectangle {
  DVec2 low{0.0}, high{0.0};
};

struct Elevation {
  std::string file;  ///< its name, for messages
  int columns = 0, rows = 0;
  double cell_x_m = 1, cell_y_m = 1;
  DVec2 origin{0.0};           ///< centre of the south-western cell
  std::vector<float> samples;  ///< all finite
  std::uint64_t filled = 0;    ///< cells that had no data
  std::string crs_wkt;         ///< empty when unknown
  bool reprojected = false;
  bool georeferenced = false;  ///< false: (0, 0) is the raster's own corner
  MapRectangle whole;          ///< the file's, when a window of it was read
  int whole_columns = 0, whole_rows = 0;

  float at(int column, int row) const {
    return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
  /// The rectangle covered by the cells.
  DVec2 low_corner() const { return origin - 0.5 * DVec2(cell_x_m, cell_y_m); }
  DVec2 high_corner() const { return low_corner() + DVec2(columns * cell_x_m, rows * cell_y_m); }
};

struct ElevationOptions {
  double pixel_m = 1.0;                  ///< cell of a raster without georeference
  std::optional<DVec2> extent_m = {};    ///< of a raster without georeference, in place of pixel_m
  std::optional<DVec2> low_high_m = {};  ///< heights of the smallest and the largest number of a type of whole numbers
  std::string crs_wkt = {};  ///< the site's, to be reprojected to; empty: the raster's own, if it is in metres
  std::optional<MapRectangle> window =
      {};                     ///< what is needed, in the coordinates of the result; without it all is read
  double height_scale = 1.0;  ///< metres = height_scale * value + height_offset_m
  double height_offset_m = 0.0;
  std::uint64_t max_cells = 1u << 27;
};

Result<Elevation> read_elevation(const std::filesystem::path& path, const ElevationOptions& options = {});

/// Heights on the corners of a site's cells: (columns + 1) x (rows + 1) samples, row 0 in the south, as a heightfield
/// takes them. `south_west` is the site's corner in the raster's coordinates; size_m = columns * cell_m. Bilinear;
/// outside the outermost cell centres (half a cell) the nearest. Error when the file does not cover the site, which is
/// `site_m` large when its last cells overhang it and columns * cell_m else.
Result<std::vector<float>> heights_at_corners(const Elevation& elevation, DVec2 south_west, int columns, int rows,
                                              double cell_m, std::optional<DVec2> site_m = {});

/// Height at one place in the raster's coordinates, bilinear, clamped.
float height_at(const Elevation& elevation, DVec2 place);

}  // namespace bosquet::exchange
