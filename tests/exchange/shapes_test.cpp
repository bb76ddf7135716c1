#include "exchange/shapes.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include "exchange/reference_system.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

// One layer of polygons and lines given as WKT, in any vector format.
struct Drawing {
  struct Feature {
    std::string wkt, name, kind;
  };
  std::string driver = "GPKG", crs = "EPSG:25832";
  std::vector<Feature> features;

  void write(const std::filesystem::path& path) const {
    GDALAllRegister();
    GDALDataset* data =
        GetGDALDriverManager()->GetDriverByName(driver.c_str())->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    ASSERT_TRUE(data);
    OGRSpatialReference system;
    if (!crs.empty()) {
      ASSERT_EQ(system.SetFromUserInput(crs.c_str()), OGRERR_NONE);
    }
    OGRLayer* layer = data->CreateLayer("areas", crs.empty() ? nullptr : &system, wkbUnknown, nullptr);
    ASSERT_TRUE(layer);
    if (driver != "DXF") {
      OGRFieldDefn name("name", OFTString), kind("kind", OFTString);
      layer->CreateField(&name), layer->CreateField(&kind);
    }
    for (const Feature& f : features) {
      OGRFeature* feature = OGRFeature::CreateFeature(layer->GetLayerDefn());
      if (driver != "DXF") feature->SetField("name", f.name.c_str()), feature->SetField("kind", f.kind.c_str());
      OGRGeometry* shape = nullptr;
      ASSERT_EQ(OGRGeometryFactory::createFromWkt(f.wkt.c_str(), nullptr, &shape), OGRERR_NONE) << f.wkt;
      feature->SetGeometryDirectly(shape);
      ASSERT_EQ(layer->CreateFeature(feature), OGRERR_NONE);
      OGRFeature::DestroyFeature(feature);
    }
    GDALClose(data);
  }
};

scene::Georeference utm(DVec2 corner) {
  scene::Georeference place;
  place.crs_wkt = *reference_system("EPSG:25832");
  place.south_west = corner;
  return place;
}

std::string notes_of(const Shapes& shapes) {
  std::string all;
  for (const std::string& note : shapes.notes) all += note + "\n";
  return all;
}

// An L keeps its handedness: its long arm goes north, its short one east.
TEST(Shapes, EveryFormatBringsAnLOntoTheSiteAsItIs) {
  const ScratchFolder folder;
  const std::string l =
      "POLYGON ((500010 5400010,500020 5400010,500020 5400014,500014 5400014,500014 5400040,"
      "500010 5400040,500010 5400010))";
  for (const auto& [driver, file] : {std::pair{"GPKG", "l.gpkg"}, {"ESRI Shapefile", "l.shp"}, {"GML", "l.gml"}}) {
    Drawing{driver, "EPSG:25832", {{l, "lawn", "lawn"}}}.write(folder / file);
    const auto read = read_shapes(folder / file, utm({500000, 5400000}), {.size_m = DVec2(60, 60)});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->all.size(), 1u) << file;
    const Polygon& shape = read->all[0].polygon;
    EXPECT_EQ(shape.ring.size(), 6u) << file;
    EXPECT_EQ(shape.bounds().low, Vec2(10, 10));
    EXPECT_EQ(shape.bounds().high, Vec2(20, 40));
    EXPECT_TRUE(shape.contains({12, 38}));
    EXPECT_TRUE(shape.contains({18, 12}));
    EXPECT_FALSE(shape.contains({18, 38}));
    EXPECT_EQ(read->all[0].name, "lawn");
  }
}

TEST(Shapes, ClosedLinesOfADrawingArePolygonsAndOpenOnesLines) {
  const ScratchFolder folder;
  Drawing{"DXF", "", {{"POLYGON ((1 1,9 1,9 5,1 5,1 1))", "", ""}, {"LINESTRING (0 10,20 12)", "", ""}}}.write(folder /
                                                                                                               "d.dxf");
  const auto read = read_shapes(folder / "d.dxf", {}, {.size_m = DVec2(30, 30)});
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->all.size(), 2u);
  int polygons = 0, lines = 0;
  for (const Shape& shape : read->all) polygons += shape.polygon.ring.size() == 4, lines += shape.line.size() == 2;
  EXPECT_EQ(polygons, 1);
  EXPECT_EQ(lines, 1);
}

TEST(Shapes, AreReprojectedIntoTheSitesSystem) {
  const ScratchFolder folder;
  // The same square in the zone to the east and in degrees comes to lie where it lies in the site's own system.
  const auto corner = *Reprojection::make(*reference_system("EPSG:25832"), *reference_system("EPSG:25833"));
  const auto degrees = *Reprojection::make(*reference_system("EPSG:25832"), degrees_system());
  for (const auto* way : {&corner, &degrees}) {
    std::string wkt = "POLYGON ((";
    for (const DVec2 p : {DVec2(20, 20), DVec2(40, 20), DVec2(40, 50), DVec2(20, 50), DVec2(20, 20)}) {
      const DVec2 q = (*way)(DVec2(600000, 5400000) + p);
      wkt += std::to_string(q.x) + " " + std::to_string(q.y) + ",";
    }
    wkt.back() = ')';
    const bool zone = way == &corner;
    Drawing{"GPKG", zone ? "EPSG:25833" : "EPSG:4326", {{wkt + ")", "a", "lawn"}}}.write(folder /
                                                                                         (zone ? "z.gpkg" : "d.gpkg"));
    const auto read =
        read_shapes(folder / (zone ? "z.gpkg" : "d.gpkg"), utm({600000, 5400000}), {.size_m = DVec2(60, 60)});
    ASSERT_TRUE(read) << read.error().message;
    const Box2 box = read->all[0].polygon.bounds();
    EXPECT_LT(glm::distance(box.low, Vec2(20, 20)), 0.1f);  // std::to_string gives 6 decimals: 0.1 m in degrees
    EXPECT_LT(glm::distance(box.high, Vec2(40, 50)), 0.1f);
    EXPECT_FALSE(read->place) << "the site keeps its own place";
  }
}

TEST(Shapes, ALayerAndAConditionChooseAmongThem) {
  const ScratchFolder folder;
  Drawing{"GPKG", "", {{"POLYGON ((1 1,9 1,9 5,1 1))", "a", "lawn"}, {"POLYGON ((1 1,9 1,9 5,1 1))", "b", "path"}}}
      .write(folder / "a.gpkg");
  const auto paths = read_shapes(folder / "a.gpkg", {}, {.where = "kind = 'path'", .attributes = {"KIND", "none"}});
  ASSERT_TRUE(paths) << paths.error().message;
  ASSERT_EQ(paths->all.size(), 1u);
  EXPECT_EQ(paths->all[0].name, "b");
  EXPECT_EQ(paths->all[0].values[0], "path");
  EXPECT_FALSE(paths->all[0].values[1]);
  const auto refused = [&](const ShapeOptions& options) {
    const auto read = read_shapes(folder / "a.gpkg", {}, options);
    return read ? std::string("read") : read.error().message;
  };
  EXPECT_NE(refused({.layer = "trees"}).find("has no layer 'trees'; it has areas"), std::string::npos);
  EXPECT_NE(refused({.where = "kind === 'path'"}).find("cannot be asked of layer areas"), std::string::npos);
  EXPECT_NE(refused({.where = "kind = 'moon'"}).find("has no polygon or line where kind = 'moon'"), std::string::npos);
}

TEST(Shapes, WhatCannotServeIsCountedNotPassedOverInSilence) {
  const ScratchFolder folder;
  Drawing{"GPKG",
          "",
          {{"POLYGON ((5 5,25 25,25 5,5 25,5 5))", "bow tie", "lawn"},
           {"POLYGON ((900000 5,900010 5,900010 9,900000 5))", "far", "lawn"},
           {"POLYGON ((5 5,5 5,5 5,5 5))", "point", "lawn"},
           {"POINT (3 3)", "well", "lawn"},
           {"MULTIPOLYGON (((1 1,3 1,3 3,1 1)),((11 1,13 1,13 3,11 1)))", "two", "lawn"}}}
      .write(folder / "a.gpkg");
  const auto read = read_shapes(folder / "a.gpkg", {}, {.size_m = DVec2(30, 30)});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->all.size(), 4u);  // two halves of the tie, two parts
  const std::string notes = notes_of(*read);
  EXPECT_NE(notes.find("1 outlines cross themselves ('bow tie')"), std::string::npos) << notes;
  EXPECT_NE(notes.find("1 shapes lie off the site"), std::string::npos) << notes;
  EXPECT_NE(notes.find("1 shapes have no area"), std::string::npos) << notes;
  EXPECT_NE(notes.find("1 shapes are no polygons or lines"), std::string::npos) << notes;
  double area = 0;
  for (float y = 0.25f; y < 30; y += 0.5f)
    for (float x = 0.25f; x < 30; x += 0.5f)
      for (int n = 0; n < 2; ++n) area += read->all[static_cast<std::size_t>(n)].polygon.contains({x, y}) ? 0.25 : 0;
  EXPECT_NEAR(area, 200, 12);  // half of the square of 20 m
}

// A country's border around the site costs what the site needs of it, and covers it all the same.
TEST(Shapes, AHugeOutlineIsCutToTheSitesSurroundings) {
  const ScratchFolder folder;
  Drawing{"GPKG", "", {{"POLYGON ((-400000 -300000,500000 -300000,500000 20,-400000 20,-400000 -300000))", "land", ""}}}
      .write(folder / "a.gpkg");
  const auto read = read_shapes(folder / "a.gpkg", {}, {.size_m = DVec2(30, 30)});
  ASSERT_TRUE(read) << read.error().message;
  const Polygon& land = read->all[0].polygon;
  EXPECT_EQ(land.bounds().low, Vec2(-1000, -1000));
  EXPECT_EQ(land.bounds().high, Vec2(1030, 20));
  EXPECT_TRUE(land.contains({15, 19}));
  EXPECT_FALSE(land.contains({15, 21}));
  EXPECT_TRUE(read->notes.empty()) << notes_of(*read);
}

// Formerly a table that broke off gave the features before the break, and no word.
TEST(Shapes, AFileThatBreaksOffIsDamaged) {
  const ScratchFolder folder;
  Drawing many{"ESRI Shapefile", "EPSG:25832", {}};
  for (int n = 0; n < 200; ++n) {
    const std::string x = std::to_string(500000 + n), y = std::to_string(5400000 + n), x2 = std::to_string(500030 + n);
    many.features.push_back(
        {"POLYGON ((" + x + " " + y + "," + x2 + " " + y + "," + x2 + " 5400900," + x + " " + y + "))", "a", "lawn"});
  }
  many.write(folder / "a.shp");
  const std::string whole = slurp(folder / "a.shp");
  spit(folder / "a.shp", whole.substr(0, whole.size() / 2));
  const auto read = read_shapes(folder / "a.shp", utm({500000, 5400000}));
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("a.shp is damaged after feature"), std::string::npos) << read.error().message;
  const auto missing = read_shapes(folder / "none.gpkg", {});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("there is no file"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::exchange
