#include "exchange/ground_recipe.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <functional>

#include "exchange/recipe.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

using terrain::AreaKind;

void write_raster(const std::filesystem::path& path, const std::string& crs, std::array<double, 6> transform,
                  int columns, int rows, const std::function<double(int, int)>& height,
                  GDALDataType type = GDT_Float32) {
  GDALAllRegister();
  GDALDataset* data =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), columns, rows, 1, type, nullptr);
  ASSERT_TRUE(data);
  if (transform[1] != 0) data->SetGeoTransform(transform.data());
  OGRSpatialReference system;
  if (!crs.empty()) {
    ASSERT_EQ(system.SetFromUserInput(crs.c_str()), OGRERR_NONE);
  }
  if (!crs.empty()) data->SetSpatialRef(&system);
  std::vector<double> line(static_cast<std::size_t>(columns));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) line[static_cast<std::size_t>(c)] = height(c, r);
    ASSERT_EQ(data->GetRasterBand(1)->RasterIO(GF_Write, 0, r, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0,
                                               nullptr),
              CE_None);
  }
  GDALClose(data);
}

class GroundRecipeTest : public ::testing::Test {
 protected:
  Result<BuiltRecipe> try_build(const std::string& text) {
    auto recipe = parse_recipe(text, folder_ / "test.toml");
    if (!recipe) return recipe.error();
    return build_document(*recipe);
  }
  scene::Document build(const std::string& text) {
    auto built = try_build(text);
    if (!built) throw std::runtime_error(built.error().message);
    warnings_.clear();
    for (const std::string& w : built->warnings) warnings_ += w + "\n";
    return std::move(built->document);
  }
  std::string mistake(const std::string& text) {
    auto built = try_build(text);
    return built ? std::string() : built.error().message;
  }
  static std::string area(const scene::Document& document, Vec2 at) {
    const terrain::Area* found = document.terrain->area_at(at);
    return found ? found->name : "-";
  }
  const ScratchFolder folder_;
  std::string warnings_;
};

TEST_F(GroundRecipeTest, AreasOfEveryShapeAreKnownByNameKindAndCover) {
  spit(folder_ / "areas.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"name":"rose bed","kind":"Beet"},
     "geometry":{"type":"Polygon","coordinates":[[[40,30],[50,30],[50,36],[40,36],[40,30]]]}},
    {"type":"Feature","properties":{"name":"drive","kind":"service","width":"5"},
     "geometry":{"type":"LineString","coordinates":[[0,3],[60,3]]}},
    {"type":"Feature","properties":{"name":"odd","kind":"spaceport"},
     "geometry":{"type":"Polygon","coordinates":[[[52,10],[58,10],[58,14],[52,10]]]}}],
    "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}})");
  const scene::Document document = build(
      "[site]\nsize_m = [60, 40]\ncrs = 'EPSG:25832'\n"
      "[[terrain.area]]\nname = 'lawn'\nkind = 'lawn'\npolygon = [[5, 8], [35, 8], [35, 35], [5, 35]]\n"
      "[[terrain.area]]\nname = 'walk'\nkind = 'path'\ncover = 'paving'\npoints = [[0, 20], [60, 20]]\nwidth_m = 3\n"
      "[[terrain.area]]\nfile = 'areas.geojson'\n"
      "[[terrain.exclusion]]\nname = 'old'\npolygon = [[55, 30], [60, 30], [60, 40], [55, 40]]\n"
      "[[terrain.path]]\npoints = [[2, 0], [2, 40]]\n"
      "[[terrain.stroke]]\nkind = 'exclude'\narea = 'play'\narea_kind = 'other'\ncover = 'soil'\nradius_m = "
      "2\npoints = [[45, 12]]\n");
  EXPECT_EQ(area(document, {20, 30}), "lawn");
  EXPECT_EQ(area(document, {20, 20}), "walk");
  EXPECT_EQ(area(document, {45, 33}), "rose bed");
  EXPECT_EQ(area(document, {30, 1}), "drive");
  EXPECT_EQ(area(document, {57, 35}), "old");
  EXPECT_EQ(area(document, {2, 30}), "path");
  EXPECT_EQ(area(document, {45, 12}), "play");
  EXPECT_EQ(area(document, {50, 26}), "-");
  EXPECT_EQ(document.terrain->area_at({20, 20})->cover, terrain::Cover::paving);
  EXPECT_EQ(document.terrain->area_at({20, 30})->cover, terrain::Cover::grass);
  EXPECT_EQ(document.terrain->area_at({45, 33})->kind, AreaKind::bed);
  EXPECT_EQ(document.terrain->area_at({30, 1})->kind, AreaKind::path);
  EXPECT_NE(warnings_.find("'spaceport' is no known kind of area; 1 shapes are taken as other"), std::string::npos)
      << warnings_;
}

TEST_F(GroundRecipeTest, ACurvePassesThroughItsPointsAndRoundsTheirCorners) {
  const auto recipe = [](bool curve) {
    return fmt::format(
        "[site]\nsize_m = [40, 40]\n[[terrain.path]]\nwidth_m = 1.5\ncurve = {0}\npoints = [[4, 20], [20, 34], [36, "
        "20]]\n[[terrain.area]]\nname = 'lawn'\ncurve = {0}\npolygon = [[12, 4], [28, 4], [28, 16], [12, 16]]\n",
        curve);
  };
  const scene::Document straight = build(recipe(false)), curved = build(recipe(true));
  for (const scene::Document* document : {&straight, &curved})
    for (const Vec2 p : {Vec2(4.5f, 20.5f), Vec2(20, 33.7f), Vec2(35.5f, 20.5f)}) EXPECT_EQ(area(*document, p), "path");
  EXPECT_EQ(area(straight, {12, 27}), "path");
  EXPECT_EQ(area(curved, {12, 27}), "-");
  EXPECT_EQ(area(curved, {10.4f, 27}), "path");
  EXPECT_EQ(area(straight, {20, 17.5f}), "-");  // an outline bulges between its corners
  EXPECT_EQ(area(curved, {20, 17.5f}), "lawn");
}

TEST_F(GroundRecipeTest, TreesStandBesideLawnsAndPondsNotInThem) {
  const scene::Document document = build(
      "[site]\nsize_m = [60, 40]\n"
      "[[terrain.area]]\nname = 'lawn'\nkind = 'lawn'\npolygon = [[0, 0], [30, 0], [30, 40], [0, 40]]\n"
      "[[terrain.area]]\nname = 'mere'\nkind = 'water'\npolygon = [[35, 10], [55, 10], [55, 30], [35, 30]]\ndepth_m = "
      "2\n[[planting]]\nspecies = { silver_birch = 1 }\ncount = 60\nscale = [0.1, 0.2]\n");
  EXPECT_EQ(document.trees->size(), 60u);
  for (const scene::Tree& tree : *document.trees) {
    EXPECT_GT(tree.at.x, 29.7f);
    EXPECT_FALSE(document.terrain->under_water(tree.at));
  }
  EXPECT_TRUE(document.terrain->under_water({45, 20}));
  EXPECT_NEAR(document.terrain->ground({45, 20}), -2.1f, 1e-4f);
}

TEST_F(GroundRecipeTest, TheSiteIsAsLargeAsItsElevationAndKeepsItsPlace) {
  // 10 m cells, rising to the east by 1 a cell and to the north by 10.
  write_raster(folder_ / "dem.tif", "EPSG:25832", {512000, 10, 0, 5401200, 0, -10}, 30, 20,
               [](int c, int r) { return c + 10 * (19 - r); });
  const scene::Document document = build("[site]\n[terrain]\ndem = 'dem.tif'\n");
  EXPECT_EQ(document.terrain->size_m(), Vec2(300, 200));
  EXPECT_EQ(document.place.south_west, DVec2(512000, 5401000));
  EXPECT_NE(document.place.crs_wkt.find("25832"), std::string::npos);
  EXPECT_NEAR(document.place.latitude_deg, 48.76, 0.01);  // for the sun
  EXPECT_NEAR(document.place.longitude_deg, 9.165, 0.01);
  EXPECT_NEAR(document.terrain->ground({155, 105}), 15 + 100, 1e-3f);
  EXPECT_NEAR(document.terrain->ground({255, 105}) - document.terrain->ground({155, 105}), 10, 1e-3f);
  EXPECT_NEAR(document.terrain->ground({155, 155}) - document.terrain->ground({155, 105}), 50, 1e-3f);
}

TEST_F(GroundRecipeTest, ASiteInItsOwnSystemTakesARasterInAnother) {
  // The height is the easting in zone 32, so that it tells where each place came from.
  const double west = 600000, south = 5400000;
  write_raster(folder_ / "dem.tif", "EPSG:25832", {west, 1, 0, south + 200, 0, -1}, 200, 200,
               [&](int c, int) { return c + 0.5; });
  OGRSpatialReference from, to;
  from.importFromEPSG(25832), to.importFromEPSG(25833);
  const std::unique_ptr<OGRCoordinateTransformation> way(OGRCreateCoordinateTransformation(&from, &to));
  double x = west + 60, y = south + 60;
  ASSERT_TRUE(way->Transform(1, &x, &y));
  const scene::Document document =
      build("[site]\nsize_m = [40, 40]\ncrs = 'EPSG:25833'\nsouth_west = [" + std::to_string(x) + ", " +
            std::to_string(y) + "]\n[terrain]\ndem = 'dem.tif'\n");
  EXPECT_NEAR(document.terrain->ground({0, 0}), 60, 0.3f);
  EXPECT_NE(document.place.crs_wkt.find("25833"), std::string::npos);
  EXPECT_NE(warnings_.find("reprojected to"), std::string::npos) << warnings_;
}

TEST_F(GroundRecipeTest, OnlyTheCellsThatASiteNeedsAreRead) {
  // A raster of 8000 x 8000 cells would not be damaged where the site lies: gaps elsewhere are not filled or counted.
  write_raster(folder_ / "dem.tif", "EPSG:25832", {0, 1, 0, 600, 0, -1}, 600, 600,
               [](int c, int r) { return r < 300 ? std::nan("") : c; });
  build("[site]\nsize_m = [50, 50]\nsouth_west = [100, 100]\n[terrain]\ndem = 'dem.tif'\n");
  EXPECT_EQ(warnings_, "");
  build("[site]\nsize_m = [50, 50]\nsouth_west = [100, 280]\n[terrain]\ndem = 'dem.tif'\n");
  EXPECT_NE(warnings_.find("cells without data were filled"), std::string::npos) << warnings_;
  EXPECT_NE(mistake("[site]\nsize_m = [50, 50]\nsouth_west = [100, 400]\n[terrain]\ndem = 'dem.tif'\n")
                .find("holds no height where the site lies"),
            std::string::npos);
  EXPECT_NE(mistake("[site]\nsize_m = [50, 50]\nsouth_west = [580, 100]\n[terrain]\ndem = 'dem.tif'\n")
                .find("(600 x 600 cells) does not cover the site: it reaches from east 0 to 600 m"),
            std::string::npos);
}

TEST_F(GroundRecipeTest, AHeightMapTakesItsExtentAndHeightsFromTheRecipe) {
  write_raster(
      folder_ / "map.tif", "", {}, 65, 33, [](int c, int) { return 65535.0 * c / 64; }, GDT_UInt16);
  GDALDataset* tif = GDALDataset::FromHandle(GDALOpen((folder_ / "map.tif").c_str(), GA_ReadOnly));
  GDALClose(GetGDALDriverManager()->GetDriverByName("PNG")->CreateCopy((folder_ / "map.png").c_str(), tif, 0, nullptr,
                                                                       nullptr, nullptr));
  GDALClose(tif);
  const scene::Document document =
      build("[site]\n[terrain]\ndem = 'map.png'\ndem_size_m = [130, 66]\ndem_heights_m = [20, 84]\n");
  EXPECT_EQ(document.terrain->size_m(), Vec2(130, 66));
  EXPECT_NEAR(document.terrain->ground({1, 30}), 20, 1e-3f);
  EXPECT_NEAR(document.terrain->ground({129, 30}), 84, 1e-3f);
  EXPECT_NEAR(document.terrain->ground({65, 30}), 52, 1e-3f);
  write_raster(folder_ / "float.tif", "", {}, 8, 8, [](int c, int) { return c; });
  EXPECT_NE(mistake("[site]\n[terrain]\ndem = 'float.tif'\ndem_heights_m = [20, 84]\n").find("for 8 and 16 bits"),
            std::string::npos);
}

TEST_F(GroundRecipeTest, ABoundaryMakesTheSiteAndKeepsTreesInside) {
  spit(folder_ / "plot.geojson", R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
    [[[500020,5400010],[500080,5400010],[500050,5400070],[500020,5400010]]]},
    "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}})");
  const scene::Document document = build(
      "[site]\ncrs = 'EPSG:25832'\nboundary_file = 'plot.geojson'\n"
      "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 40\nscale = [0.1, 0.2]\n");
  EXPECT_EQ(document.terrain->size_m(), Vec2(60, 60));
  EXPECT_EQ(document.place.south_west, DVec2(500020, 5400010));
  const Polygon plot{{{0, 0}, {60, 0}, {30, 60}}, {}};
  for (const scene::Tree& tree : *document.trees) {
    bool inside = plot.contains(tree.at);
    for (const Vec2 d : {Vec2(0.3f, 0), Vec2(-0.3f, 0), Vec2(0, 0.3f), Vec2(0, -0.3f)})
      inside = inside || plot.contains(tree.at + d);
    EXPECT_TRUE(inside) << tree.at.x << ' ' << tree.at.y;
  }
  EXPECT_EQ(area(document, {2, 50}), "outside");
}

TEST_F(GroundRecipeTest, APolygonThatCrossesItselfIsWarnedAbout) {
  build(
      "[site]\nsize_m = [30, 30]\n[[terrain.exclusion]]\nname = 'bow'\npolygon = [[5, 5], [25, 25], [25, 5], [5, "
      "25]]\n");
  EXPECT_NE(warnings_.find("'bow' crosses itself"), std::string::npos) << warnings_;
  EXPECT_NE(mistake("[site]\nsize_m = [30, 30]\n[[terrain.exclusion]]\npolygon = [[5, 5], [25, 5], [15, 5]]\n")
                .find("has no area"),
            std::string::npos);
}

TEST_F(GroundRecipeTest, APondsLevelAboveItsRimIsLoweredWithAWarning) {
  const scene::Document document = build(
      "[site]\nsize_m = [40, 40]\n[[terrain.area]]\nname = 'mere'\nkind = 'water'\nlevel_m = 3\n"
      "polygon = [[10, 10], [30, 10], [30, 30], [10, 30]]\n");
  EXPECT_NE(warnings_.find("water 'mere': its level 3 m would run out"), std::string::npos) << warnings_;
  EXPECT_NEAR(*document.terrain->water_level({20, 20}), -0.1f, 1e-5f);
}

TEST_F(GroundRecipeTest, MistakesAreToldByLine) {
  const std::string site = "[site]\nsize_m = [30, 30]\n";
  const auto has = [&](const std::string& text, const std::string& words) {
    const std::string message = mistake(site + text);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  has("[[terrain.area]]\nname = 'x'\n", "needs one of polygon");
  has("[[terrain.area]]\npolygon = [[1, 1], [2, 2]]\n", "needs at least three points");
  has("[[terrain.area]]\nkind = 'lake'\npolygon = [[1, 1], [2, 2], [3, 1]]\n",
      "test.toml:4: kind = \"lake\" is not known");
  has("[[terrain.area]]\nkind = 'lawn'\ndepth_m = 2\npolygon = [[1, 1], [2, 2], [3, 1]]\n",
      "depth_m is for areas of kind water");
  has("[[terrain.area]]\nkind = 'water'\npoints = [[1, 1], [2, 2]]\n", "water needs a polygon");
  has("[[terrain.area]]\nwhere = 'a = 1'\npolygon = [[1, 1], [2, 2], [3, 1]]\n", "where is for areas from a file");
  has("[[terrain.area]]\nfile = 'none.gpkg'\n", "there is no file");
  has("[[terrain.stroke]]\nkind = 'raise'\narea = 'x'\npoints = [[1, 1]]\n", "area is for strokes of kind exclude");
  has("[terrain]\ndem_size_m = [5, 5]\n", "dem_size_m needs dem");
  EXPECT_NE(mistake("[site]\nseed = 1\n").find("size_m = [east, north] in metres is missing"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::exchange
