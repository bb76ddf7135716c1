#include "exchange/elevation.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "exchange/fill_gaps.h"
#include "exchange/image_file.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

const std::filesystem::path kBarroColorado =
    std::filesystem::path(BOSQUET_SOURCE_DIR) / "examples/data/barro_colorado_elevation.tif";

// A GeoTIFF whose cell (c, r from the north) holds height(c, r).
struct Raster {
  int columns = 4, rows = 3;
  GDALDataType type = GDT_Float32;
  std::optional<std::array<double, 6>> transform = std::array<double, 6>{100, 10, 0, 230, 0, -10};
  std::string crs = {};
  std::optional<double> no_data = {};
  std::function<double(int, int)> height = {};
  std::function<void(GDALRasterBand&)> more = {};

  void write(const std::filesystem::path& path) const {
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDataset* dataset = driver->Create(path.c_str(), columns, rows, 1, type, nullptr);
    ASSERT_TRUE(dataset);
    if (transform) {
      auto t = *transform;
      dataset->SetGeoTransform(t.data());
    }
    if (!crs.empty()) {
      OGRSpatialReference reference;
      ASSERT_EQ(reference.SetFromUserInput(crs.c_str()), OGRERR_NONE);
      dataset->SetSpatialRef(&reference);
    }
    GDALRasterBand* band = dataset->GetRasterBand(1);
    if (no_data) band->SetNoDataValue(*no_data);
    if (more) more(*band);
    std::vector<double> line(static_cast<std::size_t>(columns));
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) line[static_cast<std::size_t>(c)] = height(c, r);
      ASSERT_EQ(band->RasterIO(GF_Write, 0, r, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0, nullptr),
                CE_None);
    }
    GDALClose(dataset);
  }
};

class ElevationFile : public ::testing::Test {
 protected:
  Elevation read(const Raster& raster, const ElevationOptions& options = {}) {
    raster.write(folder_ / "a.tif");
    auto result = read_elevation(folder_ / "a.tif", options);
    if (!result) throw std::runtime_error(result.error().message);
    return *std::move(result);
  }
  std::string refused(const Raster& raster, const ElevationOptions& options = {}) {
    raster.write(folder_ / "a.tif");
    const auto result = read_elevation(folder_ / "a.tif", options);
    return result ? "" : result.error().message;
  }
  const ScratchFolder folder_;
};

TEST(Elevation, BarroColoradosCellCentresStandOnThePlotsCorners) {
  const auto island = read_elevation(kBarroColorado);
  ASSERT_TRUE(island) << island.error().message;
  EXPECT_EQ(island->columns, 201);
  EXPECT_EQ(island->rows, 101);
  EXPECT_EQ(island->cell_x_m, 5.0);
  EXPECT_EQ(island->cell_y_m, 5.0);
  EXPECT_EQ(island->origin, DVec2(0, 0));
  EXPECT_EQ(island->low_corner(), DVec2(-2.5, -2.5));
  EXPECT_EQ(island->high_corner(), DVec2(1002.5, 502.5));
  EXPECT_EQ(island->filled, 0u);
  EXPECT_FALSE(island->reprojected);
  const auto [low, high] = std::minmax_element(island->samples.begin(), island->samples.end());
  EXPECT_NEAR(*low, 119.81, 0.01);
  EXPECT_NEAR(*high, 159.48, 0.01);
  // A heightfield of 5 m cells over the plot takes the survey's points as they are.
  const auto corners = heights_at_corners(*island, DVec2(0, 0), 200, 100, 5.0);
  ASSERT_TRUE(corners);
  EXPECT_EQ(*corners, island->samples);
}

TEST_F(ElevationFile, TheNorthernRowOfTheFileIsTheLastRowHere) {
  const Elevation e = read({.height = [](int c, int r) { return 10 * r + c; }});
  EXPECT_EQ(e.origin, DVec2(105, 205));
  EXPECT_EQ(e.at(0, 0), 20);  // south-west: the file's last row
  EXPECT_EQ(e.at(3, 2), 3);
}

TEST_F(ElevationFile, ASouthUpRasterReadsTheSame) {
  const Elevation e = read(
      {.transform = std::array<double, 6>{100, 10, 0, 200, 0, 10}, .height = [](int c, int r) { return 10 * r + c; }});
  EXPECT_EQ(e.origin, DVec2(105, 205));
  EXPECT_EQ(e.at(0, 0), 0);
  EXPECT_EQ(e.at(3, 2), 23);
}

TEST_F(ElevationFile, APlaneIsExactBetweenCentresAndLevelBeyondThem) {
  const Elevation e = read({.columns = 11, .rows = 8, .height = [](int c, int r) { return 2 * c + 0.5 * (7 - r); }});
  // Height = 0.2 per metre east, 0.05 per metre north from the south-western centre (105, 155).
  for (double x : {105.0, 133.3, 205.0})
    for (double y : {155.0, 171.9, 225.0}) EXPECT_NEAR(height_at(e, {x, y}), 0.2 * (x - 105) + 0.05 * (y - 155), 1e-5);
  EXPECT_EQ(height_at(e, {100, 150}), height_at(e, {105, 155}));
  EXPECT_EQ(height_at(e, {0, 155}), 0.0f);
}

TEST_F(ElevationFile, ARampKeepsItsHandednessOnTheSite) {
  // Rises to the east by 1 a cell, to the north by 100 a cell.
  const Elevation e = read(
      {.columns = 5, .rows = 5, .transform = std::array<double, 6>{0, 2, 0, 10, 0, -2}, .height = [](int c, int r) {
         return c + 100 * (4 - r);
       }});
  const auto heights = heights_at_corners(e, {1, 1}, 4, 4, 2.0);
  ASSERT_TRUE(heights);
  EXPECT_EQ((*heights)[0], 0);
  EXPECT_EQ((*heights)[4], 4) << "east";
  EXPECT_EQ((*heights)[4 * 5], 400) << "north";
}

TEST_F(ElevationFile, EveryUsualNumberTypeIsRead) {
  for (GDALDataType type : {GDT_Byte, GDT_Int16, GDT_UInt16, GDT_Int32, GDT_Float32, GDT_Float64}) {
    const Elevation e = read({.type = type, .height = [](int c, int r) { return 10 + c + r; }});
    EXPECT_EQ(e.at(0, 0), 12) << GDALGetDataTypeName(type);
  }
}

TEST_F(ElevationFile, NoDataOfEveryKindIsFilledAndCounted) {
  const auto holes = [](double mark) {
    return [mark](int c, int r) { return c > 3 && c < 8 && r > 3 && r < 7 ? mark : 5.0 * c - 3.0 * r; };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    GDALDataType type;
    double mark;
    bool declared;
  };
  for (const Case& c : {Case{GDT_Float32, -9999, true}, Case{GDT_Float32, -3.4028234663852886e38, true},
                        Case{GDT_Float32, nan, false}, Case{GDT_Float64, nan, true}, Case{GDT_Int16, -32768, false},
                        Case{GDT_Float32, std::numeric_limits<float>::infinity(), false}}) {
    Raster raster{.columns = 12, .rows = 12, .type = c.type, .height = holes(c.mark)};
    if (c.declared) raster.no_data = c.mark;
    const Elevation e = read(raster);
    EXPECT_EQ(e.filled, 12u) << c.mark;
    // A gap in a plane is that plane again; 1 cm is what the sweeps may leave.
    for (int r = 0; r < 12; ++r)
      for (int k = 0; k < 12; ++k) EXPECT_NEAR(e.at(k, r), 5.0 * k - 3.0 * (11 - r), 0.01) << c.mark;
  }
}

TEST_F(ElevationFile, ScaleOffsetAndFeetOfTheBandAreApplied) {
  const Elevation e =
      read({.type = GDT_Int16,
            .height = [](int c, int) { return 100 * c; },
            .more = [](GDALRasterBand& band) { band.SetScale(0.1), band.SetOffset(20), band.SetUnitType("ft"); }});
  EXPECT_NEAR(e.at(2, 0), (200 * 0.1 + 20) * 0.3048, 1e-5);
}

TEST_F(ElevationFile, DegreesBecomeMetresOnALocalPlane) {
  // 0.001 degrees at 60 north: 111.4 m in latitude, 55.8 m in longitude (WGS84).
  const Elevation e = read({.columns = 40,
                            .rows = 30,
                            .transform = std::array<double, 6>{10, 0.001, 0, 60.015, 0, -0.001},
                            .crs = "EPSG:4326",
                            .height = [](int c, int) { return 100 + c; }});
  EXPECT_TRUE(e.reprojected);
  EXPECT_FALSE(e.crs_wkt.empty());
  EXPECT_NEAR(e.high_corner().x - e.low_corner().x, 40 * 55.8, 60);
  EXPECT_NEAR(e.high_corner().y - e.low_corner().y, 30 * 111.4, 90);
  // The plane's origin is the raster's centre; from there 1 m of height for 55.8 m to the east.
  const float here = height_at(e, {0, 0});
  EXPECT_NEAR(here, 119.5, 0.3);
  EXPECT_NEAR(height_at(e, {558, 0}) - here, 10.0, 0.15);
  EXPECT_NEAR(height_at(e, {0, 500}) - here, 0.0, 0.05);
  for (float h : e.samples)
    EXPECT_NEAR(1000 * h, std::round(1000 * static_cast<double>(h)), 0.02) << "whole millimetres";
}

TEST_F(ElevationFile, ProjectedFeetBecomeMetres) {
  // New York Long Island in US survey feet.
  const Elevation e = read({.columns = 20,
                            .rows = 20,
                            .transform = std::array<double, 6>{990000, 100, 0, 210000, 0, -100},
                            .crs = "EPSG:2263",
                            .height = [](int c, int) { return c; }});
  EXPECT_TRUE(e.reprojected);
  EXPECT_NEAR(e.high_corner().x - e.low_corner().x, 2000 * 0.3048, 40);
}

TEST_F(ElevationFile, ProjectedMetresKeepTheirCoordinatesAndReference) {
  const Elevation e = read({.transform = std::array<double, 6>{512345.5, 1, 0, 5401234.5, 0, -1},
                            .crs = "EPSG:25832",
                            .height = [](int, int) { return 1; }});
  EXPECT_FALSE(e.reprojected);
  EXPECT_EQ(e.low_corner(), DVec2(512345.5, 5401231.5));
  EXPECT_NE(e.crs_wkt.find("25832"), std::string::npos);
}

TEST_F(ElevationFile, ATurnedRasterIsTurnedBackToNorth) {
  // 30 degrees; height is the distance to the east, whatever the cells' direction.
  const double c = std::cos(0.5), s = std::sin(0.5);
  const Elevation e = read(
      {.columns = 60, .rows = 60, .transform = std::array<double, 6>{0, c, s, 0, s, -c}, .height = [&](int x, int y) {
         return 100 + (x + 0.5) * c + (y + 0.5) * s;
       }});
  EXPECT_TRUE(e.reprojected);
  const DVec2 middle(30 * c + 30 * s, 30 * s - 30 * c);
  EXPECT_NEAR(height_at(e, middle), 100 + middle.x, 0.1);
  EXPECT_NEAR(height_at(e, middle + DVec2(10, 0)) - height_at(e, middle), 10, 0.2);
  EXPECT_NEAR(height_at(e, middle + DVec2(0, 10)) - height_at(e, middle), 0, 0.2);
}

TEST_F(ElevationFile, A16BitPngTakesItsCellAndScaleFromTheCaller) {
  Raster{.columns = 6,
         .rows = 5,
         .type = GDT_UInt16,
         .transform = std::nullopt,
         .height = [](int c, int r) { return 1000 * c + 7 * r; }}
      .write(folder_ / "a.tif");
  GDALDataset* tif = GDALDataset::FromHandle(GDALOpen((folder_ / "a.tif").c_str(), GA_ReadOnly));
  GDALClose(GetGDALDriverManager()->GetDriverByName("PNG")->CreateCopy((folder_ / "h.png").c_str(), tif, 0, nullptr,
                                                                       nullptr, nullptr));
  GDALClose(tif);
  const auto e = read_elevation(folder_ / "h.png", {.pixel_m = 2, .height_scale = 0.01, .height_offset_m = 50});
  ASSERT_TRUE(e) << e.error().message;
  EXPECT_EQ(e->low_corner(), DVec2(0, 0));
  EXPECT_EQ(e->high_corner(), DVec2(12, 10));
  EXPECT_NEAR(e->at(5, 4), 50 + 50.00, 1e-4);
  EXPECT_NEAR(e->at(0, 0), 50 + 0.28, 1e-4);
}

TEST_F(ElevationFile, RastersThatCannotServeAreRefusedByNameSizeAndReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string empty = refused({.height = [&](int, int) { return nan; }});
  EXPECT_NE(empty.find("a.tif (4 x 3 cells) holds no height"), std::string::npos) << empty;
  const std::string large = refused({.height = [](int, int) { return 1; }}, {.max_cells = 11});
  EXPECT_NE(large.find("a.tif has 4 x 3 cells; at most 11 cells are read"), std::string::npos) << large;

  spit(folder_ / "text.tif", "this is no raster");
  const auto text = read_elevation(folder_ / "text.tif");
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().message.find("text.tif is no raster that can be read"), std::string::npos);
  const auto missing = read_elevation(folder_ / "none.tif");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("there is no elevation file"), std::string::npos);
  EXPECT_FALSE(read_elevation(folder_.path()));
}

// GDAL opens a file that was cut off and only reading its rows fails.
TEST_F(ElevationFile, ATruncatedFileIsDamagedNotFlat) {
  Raster{.columns = 200, .rows = 200, .height = [](int c, int r) { return c * r + 1; }}.write(folder_ / "a.tif");
  const std::string whole = slurp(folder_ / "a.tif");
  spit(folder_ / "cut.tif", whole.substr(0, whole.size() / 2));
  const auto result = read_elevation(folder_ / "cut.tif");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("cut.tif"), std::string::npos) << result.error().message;
}

TEST_F(ElevationFile, ASiteBeyondTheRasterIsRefusedWithBothExtents) {
  const Elevation e = read({.height = [](int, int) { return 1; }});
  EXPECT_TRUE(heights_at_corners(e, {100, 200}, 4, 3, 10.0)) << "to the very edge of the cells";
  const auto beyond = heights_at_corners(e, {100, 200}, 5, 3, 10.0);
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().message.find("does not cover the site: it reaches from east 100 to 140 m"),
            std::string::npos)
      << beyond.error().message;
  EXPECT_FALSE(heights_at_corners(e, {99, 200}, 4, 3, 10.0));
  EXPECT_FALSE(heights_at_corners(e, {100, 199}, 4, 3, 10.0));
}

TEST_F(ElevationFile, ASingleCellIsAPlateau) {
  const Elevation e = read({.columns = 1, .rows = 1, .height = [](int, int) { return 7; }});
  const auto heights = heights_at_corners(e, {100, 220}, 2, 2, 5.0);
  ASSERT_TRUE(heights) << heights.error().message;
  for (float h : *heights) EXPECT_EQ(h, 7);
}

TEST(FillGaps, StaysWithinTheRimsHeightsAndTouchesNothingElse) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> samples(40 * 30);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<float>(i % 40) + static_cast<float>((i / 40) % 5);
  std::vector<float> holed = samples;
  for (std::size_t i = 0; i < holed.size(); ++i)
    if ((i % 40 > 10 && i % 40 < 31) || i / 40 > 20) holed[i] = nan;
  const std::vector<float> before = holed;
  fill_gaps(40, 30, holed);
  for (std::size_t i = 0; i < holed.size(); ++i) {
    if (!std::isnan(before[i])) {
      EXPECT_EQ(holed[i], before[i]);
    }
    EXPECT_GE(holed[i], 0.0f);
    EXPECT_LE(holed[i], 43.0f);
  }
}

TEST(FillGaps, OneHeightFillsAll) {
  std::vector<float> samples(100 * 7, std::numeric_limits<float>::quiet_NaN());
  samples[345] = 12.5f;
  fill_gaps(100, 7, samples);
  for (float h : samples) EXPECT_EQ(h, 12.5f);
}

}  // namespace
}  // namespace bosquet::exchange
