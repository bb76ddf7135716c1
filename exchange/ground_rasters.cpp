#include "exchange/ground_rasters.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>

#include <array>
#include <cstdint>

#include "exchange/gdal_scope.h"

namespace bosquet::exchange {
namespace {

using std::filesystem::path;

enum MapBand { kBarred, kDensity, kTop, kUnder, kCover, kPond, kMapBands };
constexpr int kMaskBands = 2, kAreaBands = 5;

template <class T>
bool everywhere(const terrain::TiledGrid<T>& grid, T value) {
  for (int j = 0; j < grid.size().y; ++j)
    for (int i = 0; i < grid.size().x; ++i)
      if (!(grid.at(i, j) == value)) return false;
  return true;
}

// A new raster whose cell (0, 0) has its south-west corner at `corner`, filled row by row.
template <class Value, class Row>
Result<void> write_raster(const path& target, IVec2 size, int bands, GDALDataType type, const char* predictor,
                          DVec2 corner, double cell, const std::string& crs_wkt, const Row& row) {
  GDALAllRegister();
  const GdalMessages quiet;
  const char* options[] = {"COMPRESS=DEFLATE", predictor, "INTERLEAVE=BAND", nullptr};
  GDALDatasetH set = nullptr;
  if (GDALDriverH driver = GDALGetDriverByName("GTiff"))
    set = GDALCreate(driver, target.c_str(), size.x, size.y, bands, type, const_cast<char**>(options));
  bool fine = set != nullptr;
  if (set) {
    double frame[] = {corner.x, cell, 0, corner.y + size.y * cell, 0, -cell};
    fine = GDALSetGeoTransform(set, frame) == CE_None;
    // A system that GDAL does not know stands in the recipe all the same.
    if (!crs_wkt.empty() && GDALSetProjection(set, crs_wkt.c_str()) != CE_None) CPLErrorReset();
    std::vector<Value> values(static_cast<std::size_t>(size.x));
    for (int band = 0; band < bands && fine; ++band)
      for (int r = 0; r < size.y && fine; ++r) {
        row(band, size.y - 1 - r, values.data());
        fine = GDALRasterIO(GDALGetRasterBand(set, band + 1), GF_Write, 0, r, size.x, 1, values.data(), size.x, 1, type,
                            0, 0) == CE_None;
      }
    GDALFlushCache(set);
    fine = fine && CPLGetLastErrorType() < CE_Failure;
    GDALClose(set);
    fine = fine && CPLGetLastErrorType() < CE_Failure;
  }
  if (!fine) return cannot_finish(fmt::format("{}: cannot be written", target.string()));
  return {};
}

}  // namespace

bool has_map(const terrain::Terrain& ground) {
  return !ground.areas.empty() || ground.has_ponds() || !everywhere<std::uint8_t>(ground.exclusion.grid(), 0) ||
         !everywhere<std::uint8_t>(ground.density.grid(), 255);
}

Result<void> write_heights(const terrain::Terrain& ground, const scene::Georeference& place, const path& target) {
  const terrain::Heightfield& height = ground.height;
  const IVec2 size = height.cells() + 1;
  const auto cell = static_cast<double>(height.cell_m());
  return write_raster<float>(target, size, 1, GDT_Float32, "PREDICTOR=3", place.south_west - 0.5 * cell, cell,
                             place.crs_wkt, [&](int, int j, float* out) {
                               for (int i = 0; i < size.x; ++i) out[i] = height.sample(i, j);
                             });
}

Result<void> write_map(const terrain::Terrain& ground, const scene::Georeference& place, const path& target) {
  const IVec2 size = ground.height.cells();
  const auto cell = static_cast<double>(ground.height.cell_m());
  const int bands = ground.has_ponds() ? kMapBands : ground.areas.empty() ? kMaskBands : kAreaBands;
  return write_raster<std::uint16_t>(target, size, bands, GDT_UInt16, "PREDICTOR=2", place.south_west, cell,
                                     place.crs_wkt, [&](int band, int j, std::uint16_t* out) {
                                       for (int i = 0; i < size.x; ++i) switch (band) {
                                           case kBarred:
                                             out[i] = ground.exclusion.grid().at(i, j);
                                             break;
                                           case kDensity:
                                             out[i] = ground.density.grid().at(i, j);
                                             break;
                                           case kTop:
                                             out[i] = ground.areas.cell(i, j).top;
                                             break;
                                           case kUnder:
                                             out[i] = ground.areas.cell(i, j).under;
                                             break;
                                           case kCover:
                                             out[i] = ground.areas.cell(i, j).cover;
                                             break;
                                           default:
                                             out[i] = ground.ponds.at(i, j);
                                         }
                                     });
}

Result<void> read_map(const path& file, const std::vector<terrain::Area>& areas, terrain::Terrain& ground) {
  GDALAllRegister();
  const GdalMessages quiet;
  GDALDatasetH set = GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr);
  if (!set) return Error{fmt::format("{} is no raster that can be read", file.string())};
  struct Closing {
    GDALDatasetH set;
    ~Closing() { GDALClose(set); }
  } const closing{set};
  const IVec2 size = ground.height.cells();
  const int bands = GDALGetRasterCount(set);
  if (IVec2 has{GDALGetRasterXSize(set), GDALGetRasterYSize(set)}; has != size)
    return Error{fmt::format("{} has {} x {} cells; a map of this site has {} x {}", file.string(), has.x, has.y,
                             size.x, size.y)};
  if (bands != kMaskBands && bands != kAreaBands && bands != kMapBands)
    return Error{fmt::format("{} has {} bands; a map of the ground has 2, 5 or 6", file.string(), bands)};

  std::vector<terrain::AreaId> ids{0};
  for (const terrain::Area& area : areas) ids.push_back(ground.areas.add(ground.height.lattice(), area));
  if (bands > kMaskBands && areas.empty())
    return Error{fmt::format("{} numbers areas, of which the recipe names none", file.string())};
  if (bands == kMapBands) ground.ponds = terrain::TiledGrid<terrain::AreaId>(size, 0);
  terrain::TileEditor<std::uint8_t> barred(ground.exclusion.grid()), density(ground.density.grid());
  std::optional<terrain::TileEditor<terrain::AreaCell>> area_cells;
  std::optional<terrain::TileEditor<terrain::AreaId>> ponds;
  if (bands > kMaskBands) area_cells.emplace(ground.areas.grid());
  if (bands == kMapBands) ponds.emplace(ground.ponds);

  std::array<std::vector<std::uint16_t>, kMapBands> rows;
  rows.fill(std::vector<std::uint16_t>(static_cast<std::size_t>(size.x)));
  for (int r = 0; r < size.y; ++r) {
    const int j = size.y - 1 - r;
    for (int band = 0; band < bands; ++band) {
      std::vector<std::uint16_t>& row = rows[static_cast<std::size_t>(band)];
      if (GDALRasterIO(GDALGetRasterBand(set, band + 1), GF_Read, 0, r, size.x, 1, row.data(), size.x, 1, GDT_UInt16, 0,
                       0) != CE_None)
        return Error{fmt::format("{} is damaged at row {}", file.string(), r + 1)};
      const bool share = band == kBarred || band == kDensity || band == kCover;
      const std::size_t count = share ? 256 : ids.size();
      for (int i = 0; i < size.x; ++i)
        if (row[static_cast<std::size_t>(i)] >= count)
          return Error{fmt::format("{}: {} in band {}, row {}, column {}; allowed are numbers up to {}", file.string(),
                                   row[static_cast<std::size_t>(i)], band + 1, r + 1, i + 1, count - 1)};
    }
    for (int i = 0; i < size.x; ++i) {
      const auto value = [&](MapBand band) { return rows[band][static_cast<std::size_t>(i)]; };
      // Tiles in which nothing stands stay the shared ones.
      if (value(kBarred) != 0) barred.set(i, j, static_cast<std::uint8_t>(value(kBarred)));
      if (value(kDensity) != 255) density.set(i, j, static_cast<std::uint8_t>(value(kDensity)));
      const terrain::AreaCell cell{ids[value(kTop)], ids[value(kUnder)], static_cast<std::uint8_t>(value(kCover))};
      if (area_cells && cell != terrain::AreaCell{}) area_cells->set(i, j, cell);
      if (ponds && value(kPond) != 0) ponds->set(i, j, ids[value(kPond)]);
    }
  }
  return {};
}

}  // namespace bosquet::exchange
