#include "exchange/elevation.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "exchange/fill_gaps.h"
#include "exchange/gdal_scope.h"

namespace bosquet::exchange {
namespace {

constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937.0;
// Metres; what lies beyond is no ground but a no-data value that the file does not declare (-32768).
constexpr double kLowest = -12'000, kHighest = 100'000;

void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

// Where cells lie: east = t[0] + column * t[1] + row * t[2], north = t[3] + column * t[4] + row * t[5], from corners.
struct Georeference {
  double t[6] = {0, 1, 0, 0, 0, -1};
  bool present = false;
  bool turned = false;
};

Georeference georeference(GDALDataset& dataset, const ElevationOptions& options) {
  Georeference geo;
  geo.present = dataset.GetGeoTransform(geo.t) == CE_None;
  if (!geo.present) {
    const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
    const DVec2 extent = options.extent_m.value_or(options.pixel_m * DVec2(columns, rows));
    const double fresh[6] = {0, extent.x / columns, 0, extent.y, 0, -extent.y / rows};
    std::copy(fresh, fresh + 6, geo.t);
  }
  geo.turned = geo.t[2] != 0 || geo.t[4] != 0 || geo.t[1] < 0;
  return geo;
}

bool sane(const double (&t)[6]) {
  return std::all_of(t, t + 6, [](double v) { return std::isfinite(v); }) && t[1] * t[5] - t[2] * t[4] != 0;
}

// A plane in metres that touches the ground at the raster's centre.
std::optional<std::string> local_plane(const OGRSpatialReference& crs, const double (&t)[6], int columns, int rows) {
  OGRSpatialReference degrees;
  degrees.SetWellKnownGeogCS("WGS84");
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference from(crs);
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_degrees(OGRCreateCoordinateTransformation(&from, &degrees));
  double x = t[0] + 0.5 * columns * t[1] + 0.5 * rows * t[2], y = t[3] + 0.5 * columns * t[4] + 0.5 * rows * t[5];
  if (!to_degrees || !to_degrees->Transform(1, &x, &y)) return std::nullopt;
  return fmt::format("+proj=tmerc +lat_0={:.9f} +lon_0={:.9f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs", y, x);
}

// Warped to `target` (or, without a reference system, only turned to the north); no-data becomes NaN. Nothing is
// computed before it is read.
Dataset warped(GDALDataset& dataset, const std::string& source_crs, const std::optional<std::string>& target) {
  std::vector<const char*> words{"-of",     "VRT",        "-r",  "bilinear", "-ot",
                                 "Float64", "-dstnodata", "nan", "-wo",      "NUM_THREADS=1"};
  if (target) words.insert(words.end(), {"-s_srs", source_crs.c_str(), "-t_srs", target->c_str()});
  words.push_back(nullptr);
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(const_cast<char**>(words.data()), nullptr);
  GDALDatasetH source = &dataset;
  int misuse = 0;
  Dataset out(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, &misuse)));
  GDALWarpAppOptionsFree(options);
  return out;
}

// Columns and rows of a raster that are read.
struct CellWindow {
  int column = 0, row = 0, columns = 0, rows = 0;
};

// The cells around a rectangle, two more to each side for interpolation and gaps; empty when it lies off the raster.
CellWindow cells_of(const MapRectangle& window, const double (&t)[6], int columns, int rows) {
  const auto along = [](double a, double b, int n, int& first, int& count) {
    if (a > b) std::swap(a, b);
    const double low = std::clamp(std::floor(a) - 2, 0.0, static_cast<double>(n));
    const double high = std::clamp(std::ceil(b) + 2, 0.0, static_cast<double>(n));
    first = static_cast<int>(low), count = std::max(0, static_cast<int>(high - low));
  };
  CellWindow out;
  along((window.low.x - t[0]) / t[1], (window.high.x - t[0]) / t[1], columns, out.column, out.columns);
  along((window.low.y - t[3]) / t[5], (window.high.y - t[3]) / t[5], rows, out.row, out.rows);
  return out;
}

std::string wkt_of(const OGRSpatialReference& crs) {
  char* wkt = nullptr;
  std::string out;
  if (crs.exportToWkt(&wkt) == OGRERR_NONE && wkt) out = wkt;
  CPLFree(wkt);
  return out;
}

double metres_per_unit(GDALRasterBand& band) {
  const std::string unit = band.GetUnitType() ? band.GetUnitType() : "";
  if (unit == "ft" || unit == "foot" || unit == "feet") return kFoot;
  if (unit == "US survey foot" || unit == "ftUS" || unit == "us_survey_foot") return kSurveyFoot;
  return 1;
}

// Rows of the band from south to north; what has no data, or cannot be a height, becomes NaN.
Result<std::vector<float>> read_band(GDALDataset& dataset, GDALRasterBand& band, const std::string& name,
                                     const ElevationOptions& options, const CellWindow& window, bool south_up,
                                     bool rounded) {
  const int columns = window.columns, rows = window.rows;
  int has_nodata = 0, has_scale = 0, has_offset = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  const double scale = band.GetScale(&has_scale), offset = band.GetOffset(&has_offset);
  const double factor = (has_scale ? scale : 1) * metres_per_unit(band) * options.height_scale;
  const double shift =
      (has_offset ? offset : 0) * metres_per_unit(band) * options.height_scale + options.height_offset_m;
  GDALRasterBand* mask = band.GetMaskFlags() & GMF_PER_DATASET ? band.GetMaskBand() : nullptr;

  std::vector<float> samples(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<double> line(static_cast<std::size_t>(columns));
  std::vector<std::uint8_t> valid(line.size(), 255);
  for (int r = 0; r < rows; ++r) {
    const int c0 = window.column, r0 = window.row + r;
    if (band.RasterIO(GF_Read, c0, r0, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0, nullptr) != CE_None ||
        (mask &&
         mask->RasterIO(GF_Read, c0, r0, columns, 1, valid.data(), columns, 1, GDT_Byte, 0, 0, nullptr) != CE_None))
      return Error{fmt::format("{} ({} x {} cells) is damaged at row {}{}", name, dataset.GetRasterXSize(),
                               dataset.GetRasterYSize(), r0 + 1, GdalMessages::last())};
    const auto out_row = static_cast<std::size_t>(south_up ? r : rows - 1 - r);
    float* out = samples.data() + out_row * line.size();
    for (std::size_t c = 0; c < line.size(); ++c) {
      double height = factor * line[c] + shift;
      // float32 files often give their no-data value as a longer decimal than they hold.
      const bool empty =
          valid[c] == 0 ||
          (has_nodata && (line[c] == nodata || static_cast<float>(line[c]) == static_cast<float>(nodata)));
      if (rounded) height = std::round(1000 * height) / 1000;
      out[c] = empty || !(height >= kLowest && height <= kHighest) ? std::numeric_limits<float>::quiet_NaN()
                                                                   : static_cast<float>(height);
    }
  }
  return samples;
}

}  // namespace

Result<Elevation> read_elevation(const std::filesystem::path& path, const ElevationOptions& options) {
  const std::string name = path.string();
  std::error_code ec;
  if (!std::filesystem::exists(path, ec)) return Error{fmt::format("there is no elevation file {}", name)};
  if (!std::filesystem::is_regular_file(path, ec)) return Error{fmt::format("elevation {} is no regular file", name)};
  register_drivers();
  const GdalMessages messages;
  Dataset dataset(
      GDALDataset::FromHandle(GDALOpenEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr)));
  if (!dataset) return Error{fmt::format("{} is no raster that can be read{}", name, GdalMessages::last())};
  int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  if (dataset->GetRasterCount() < 1)
    return Error{fmt::format("{} ({} x {} cells) holds no band of heights", name, columns, rows)};

  // A scale or unit of the band is lost when warped, so it is asked for first.
  GDALRasterBand* band = dataset->GetRasterBand(1);
  if (GDALDataTypeIsComplex(band->GetRasterDataType()))
    return Error{fmt::format("{} ({} x {} cells) holds complex numbers, no heights", name, columns, rows)};
  ElevationOptions heights = options;
  if (options.low_high_m) {
    const GDALDataType type = band->GetRasterDataType();
    if (!GDALDataTypeIsInteger(type) || GDALGetDataTypeSizeBits(type) > 16)
      return Error{fmt::format("{} holds {} numbers: heights of its smallest and largest number are for 8 and 16 bits",
                               name, GDALGetDataTypeName(type))};
    const int bits = GDALGetDataTypeSizeBits(type);
    const double numbers = std::exp2(bits) - 1, smallest = GDALDataTypeIsSigned(type) ? -std::exp2(bits - 1) : 0;
    heights.height_scale = (options.low_high_m->y - options.low_high_m->x) / numbers;
    heights.height_offset_m = options.low_high_m->x - smallest * heights.height_scale;
    band->SetScale(1), band->SetOffset(0), band->SetUnitType("");
  }
  Georeference geo = georeference(*dataset, options);
  if (!sane(geo.t)) return Error{fmt::format("{}: its georeference gives cells without area", name)};
  // Nobody knows where a system of its own is, so it counts as metres (or its unit) that cannot be reprojected.
  const OGRSpatialReference* crs = dataset->GetSpatialRef();
  const bool on_earth = crs && (crs->IsGeographic() || crs->IsProjected());
  const bool in_metres = !crs || (!crs->IsGeographic() && std::abs(crs->GetLinearUnits() - 1) < 1e-9);

  Elevation out;
  out.file = name;
  out.georeferenced = geo.present;
  OGRSpatialReference wanted;
  if (!options.crs_wkt.empty()) {
    wanted.SetFromUserInput(options.crs_wkt.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    wanted.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }
  const char* const same[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT", nullptr};
  const bool elsewhere = !options.crs_wkt.empty() && on_earth && !crs->IsSame(&wanted, same);
  Dataset plane;
  if (!in_metres || geo.turned || elsewhere) {
    out.reprojected = true;
    std::optional<std::string> target;
    const std::string source = crs ? wkt_of(*crs) : std::string();
    if (elsewhere) {
      target = options.crs_wkt;
    } else if (crs && on_earth) {
      target = in_metres ? source : local_plane(*crs, geo.t, columns, rows);
      if (!target)
        return Error{fmt::format("{}: its place on the earth cannot be worked out{}", name, GdalMessages::last())};
    } else if (!in_metres) {
      return Error{fmt::format("{}: its reference system '{}' has no place on the earth and no metres", name,
                               crs->GetName() ? crs->GetName() : "")};
    }
    int has_scale = 0, has_offset = 0;
    const double unit = metres_per_unit(*band), scale = band->GetScale(&has_scale),
                 offset = band->GetOffset(&has_offset);
    const double per_value = heights.height_scale;
    heights.height_scale = per_value * unit * (has_scale ? scale : 1);
    heights.height_offset_m += per_value * unit * (has_offset ? offset : 0);
    plane = warped(*dataset, source, target);
    if (!plane) return Error{fmt::format("{} cannot be brought into metres{}", name, GdalMessages::last())};
    columns = plane->GetRasterXSize(), rows = plane->GetRasterYSize();
    geo = georeference(*plane, options);
    band = plane->GetRasterBand(1);
    band->SetScale(1), band->SetOffset(0), band->SetUnitType("");
    crs = plane->GetSpatialRef();
  }

  CellWindow window{0, 0, columns, rows};
  if (options.window) {
    const CellWindow needed = cells_of(*options.window, geo.t, columns, rows);
    // Beside the raster one cell is read, and heights_at_corners() tells both extents.
    window = needed.columns > 0 && needed.rows > 0 ? needed : CellWindow{0, 0, 1, 1};
  }
  if (static_cast<std::uint64_t>(window.columns) * static_cast<std::uint64_t>(window.rows) > options.max_cells)
    return Error{
        fmt::format("{} has {} x {} cells; at most {} cells are read: cut it to the site or make it coarser "
                    "(gdal_translate)",
                    name, window.columns, window.rows, options.max_cells)};
  const bool south_up = geo.t[5] > 0;
  auto samples = read_band(plane ? *plane : *dataset, *band, name, heights, window, south_up, out.reprojected && crs);
  if (!samples) return samples.error();
  out.columns = window.columns, out.rows = window.rows;
  out.cell_x_m = std::abs(geo.t[1]), out.cell_y_m = std::abs(geo.t[5]);
  const double west = geo.t[0] + window.column * geo.t[1];
  const double south = geo.t[3] + (south_up ? window.row : window.row + window.rows) * geo.t[5];
  out.origin = {west + 0.5 * out.cell_x_m, south + 0.5 * out.cell_y_m};
  out.whole_columns = columns, out.whole_rows = rows;
  const double whole_south = south_up ? geo.t[3] : geo.t[3] + rows * geo.t[5];
  out.whole.low = {geo.t[0], whole_south};
  out.whole.high = out.whole.low + DVec2(columns * out.cell_x_m, rows * out.cell_y_m);
  out.samples = *std::move(samples);
  out.filled = static_cast<std::uint64_t>(
      std::count_if(out.samples.begin(), out.samples.end(), [](float v) { return std::isnan(v); }));
  if (out.filled == out.samples.size())
    return Error{fmt::format("{} ({} x {} cells) holds no height{}: all its cells are without data", name, columns,
                             rows, options.window ? " where the site lies" : "")};
  if (out.filled > 0) fill_gaps(out.columns, out.rows, out.samples);
  if (crs) out.crs_wkt = wkt_of(*crs);
  return out;
}

float height_at(const Elevation& elevation, DVec2 place) {
  // A millionth of a cell off a sample is rounding in large coordinates: it is the sample.
  const auto along = [](double cells, int count) {
    const double whole = std::round(cells);
    return std::clamp(std::abs(cells - whole) < 1e-6 ? whole : cells, 0.0, count - 1.0);
  };
  const double x = along((place.x - elevation.origin.x) / elevation.cell_x_m, elevation.columns);
  const double y = along((place.y - elevation.origin.y) / elevation.cell_y_m, elevation.rows);
  const int c = std::min(static_cast<int>(x), std::max(0, elevation.columns - 2));
  const int r = std::min(static_cast<int>(y), std::max(0, elevation.rows - 2));
  const int c2 = std::min(c + 1, elevation.columns - 1), r2 = std::min(r + 1, elevation.rows - 1);
  const double fx = x - c, fy = y - r;
  const double south = elevation.at(c, r) * (1 - fx) + elevation.at(c2, r) * fx;
  const double north = elevation.at(c, r2) * (1 - fx) + elevation.at(c2, r2) * fx;
  return static_cast<float>(south * (1 - fy) + north * fy);
}

Result<std::vector<float>> heights_at_corners(const Elevation& elevation, DVec2 south_west, int columns, int rows,
                                              double cell_m, std::optional<DVec2> site_m) {
  assert(columns > 0 && rows > 0 && cell_m > 0);
  const DVec2 north_east = south_west + site_m.value_or(cell_m * DVec2(columns, rows)), low = elevation.whole.low,
              high = elevation.whole.high;
  // A thousandth of a cell is rounding in the file's corners.
  const double slack_x = 1e-3 * elevation.cell_x_m, slack_y = 1e-3 * elevation.cell_y_m;
  if (south_west.x < low.x - slack_x || south_west.y < low.y - slack_y || north_east.x > high.x + slack_x ||
      north_east.y > high.y + slack_y)
    return Error{fmt::format(
        "{} ({} x {} cells) does not cover the site: it reaches from east {:.10g} to {:.10g} m and north {:.10g} to "
        "{:.10g} m, the site from {:.10g} to {:.10g} and {:.10g} to {:.10g}",
        elevation.file, elevation.whole_columns, elevation.whole_rows, low.x, high.x, low.y, high.y, south_west.x,
        north_east.x, south_west.y, north_east.y)};
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1));
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) out.push_back(height_at(elevation, south_west + cell_m * DVec2(i, j)));
  return out;
}

}  // namespace bosquet::exchange
