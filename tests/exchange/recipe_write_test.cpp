// Documents written as recipes and read back: nothing is lost, or it is told.
#include "exchange/recipe_write.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../scene/full_document.h"
#include "exchange/ground_rasters.h"
#include "exchange/mesh_file.h"
#include "exchange/recipe.h"
#include "exchange/reference_system.h"
#include "scene/document_digest.h"
#include "scene/site_edits.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

using scene::Document;

class RecipeWriteTest : public ::testing::Test {
 protected:
  ScratchFolder folder_;

  // A document with everything that the window can put into one.
  Document everything() {
    Document d = scene::full_document(60);
    d.place.crs_wkt = *reference_system("EPSG:25832");
    d.place.south_west = {512345.678, 5412345.1};
    d.space.keep_ticks = false;
    d.species = plausible(d.species);
    d.interactions = {{"english_oak", "own kind", distribution::KernelKind::clustering, 7.5f, 3.25f},
                      {"own kind", "silver_birch", distribution::KernelKind::inhibition, 2.125f, 6.0f}};
    // Meshes come from files, so they have corners of their own for each triangle.
    spit(folder_ / "shed.obj", "v 1 0 -2\nv 4.3 0 -2\nv 1 0 -5.7\nv 1.5 3.3 -3\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
    std::vector<scene::Obstacle> obstacles{d.obstacles[0], d.obstacles[1]};
    obstacles[1].low_y = obstacles[1].high_y = 0;
    obstacles[1].mesh = std::make_shared<const TriangleMesh>(*read_mesh(folder_ / "shed.obj"));
    d.obstacles = std::move(obstacles);
    d.sun.azimuth_deg = -123.45f;
    d.underlay.file = (folder_ / "pictures/plan.png").string();
    std::filesystem::create_directories(folder_ / "pictures");
    spit(folder_ / "pictures/plan.png", "its place alone is kept");
    return d;
  }

  // Species that a file may hold: the changed one of the full document has values that contradict each other.
  static std::vector<std::shared_ptr<const scene::Species>> plausible(
      const scene::SharedList<std::shared_ptr<const scene::Species>>& all) {
    std::vector<std::shared_ptr<const scene::Species>> out;
    for (const auto& species : all) {
      scene::Species s = *species;
      if (s.name == "own kind") {
        s.shape.trunk_height_m = 0.4f * s.shape.mature_height_m;
        s.growth = scene::builtin_species("rowan")->growth;
        s.look.leaf.outline = scene::builtin_species("rowan")->look.leaf.outline;
        s.look.leaf.cluster = scene::builtin_species("rowan")->look.leaf.cluster;
        s.planting.scale_min = 0.3f, s.planting.scale_max = 0.9f;
        s.sizes = scene::builtin_species("rowan")->sizes;
        s.look.leaf.summer = {0.1234f, 0.5f, 1.0f};
      }
      out.push_back(std::make_shared<const scene::Species>(std::move(s)));
    }
    return out;
  }

  Document again(const Document& document, std::vector<std::string>* warnings = nullptr) {
    auto written = write_recipe(document, folder_ / "out.toml");
    EXPECT_TRUE(written) << written.error().message;
    if (!written) return document;
    for (const std::string& w : written->warnings)
      if (warnings)
        warnings->push_back(w);
      else
        ADD_FAILURE() << w;
    auto recipe = read_recipe(folder_ / "out.toml");
    EXPECT_TRUE(recipe) << recipe.error().message;
    if (!recipe) return document;
    auto built = build_document(*recipe);
    EXPECT_TRUE(built) << built.error().message;
    if (!built) return document;
    if (!warnings)
      for (const std::string& w : built->warnings) ADD_FAILURE() << w;
    return std::move(built->document);
  }

  static void expect_equal(const Document& one, const Document& other) {
    const scene::SectionDigests a = scene::digest(one), b = scene::digest(other);
    for (std::size_t s = 0; s < a.of.size(); ++s) EXPECT_EQ(a.of[s], b.of[s]) << scene::kSectionNames[s];
  }
};

TEST_F(RecipeWriteTest, ADocumentWithEverythingComesBackWithTheSameDigests) {
  const Document document = everything();
  const Document back = again(document);
  expect_equal(document, back);
  // And a second time, of what was read.
  expect_equal(back, again(back));
}

TEST_F(RecipeWriteTest, ASiteThatNobodyPlacedOnEarthComesBackWithoutAWarning) {
  Document document = everything();
  document.place.crs_wkt.clear();
  document.plan.title = "no \x7f letter";
  expect_equal(document, again(document));  // which fails on any warning
}

TEST_F(RecipeWriteTest, AGroundWithoutAreasHasAMapOfItsMasksAlone) {
  Document d = everything();
  terrain::Terrain ground = terrain::make_terrain(d.terrain->height);
  d.terrain = std::make_shared<const terrain::Terrain>(ground);
  EXPECT_FALSE(has_map(ground));
  expect_equal(d, again(d));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out-files/map.tif"));

  terrain::Stroke stroke;
  stroke.kind = terrain::BrushKind::density, stroke.density = 0.4f, stroke.hardness = 0.2f;
  stroke.points = {{30, 40}, {60, 41}};
  d.terrain = std::make_shared<const terrain::Terrain>(terrain::apply(ground, stroke));
  expect_equal(d, again(d));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out-files/map.tif"));
}

TEST_F(RecipeWriteTest, DugPondsAndPathsComeBackAndLaterAreasLieOnThem) {
  Document d = everything();
  d.terrain = std::make_shared<const terrain::Terrain>(terrain::make_terrain(d.terrain->height));
  d = scene::dig_pond(d, "pond", {{{20, 20}, {35, 22}, {30, 40}}, {}}, {}).document;
  const Vec2 path[] = {{5, 5}, {60, 44}};
  d = scene::exclude_path(d, path, 2.5f, {"path", terrain::AreaKind::path, terrain::Cover::paving, {}}).document;
  const Document back = again(d);
  expect_equal(d, back);
  EXPECT_TRUE(back.terrain->under_water({28, 27}));
  EXPECT_EQ(back.terrain->area_at({50, 37})->name, "path");

  spit(
      folder_ / "out.toml",
      slurp(folder_ / "out.toml") +
          "\n[[terrain.area]]\nname = \"lawn\"\nkind = \"lawn\"\npolygon = [[40, 20], [90, 20], [90, 60], [40, 60]]\n");
  auto recipe = read_recipe(folder_ / "out.toml");
  ASSERT_TRUE(recipe) << recipe.error().message;
  const auto built = build_document(*recipe);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_EQ(built->document.terrain->area_at({50, 37})->name, "lawn");
}

TEST_F(RecipeWriteTest, HeightsComeBackToTheBitAnywhereOnEarth) {
  Document d = everything();
  // Flat ground at 0 beside a step: the least error of interpolation shows.
  auto lattice = terrain::make_lattice({2300.0f, 700.0f});
  d.terrain = std::make_shared<const terrain::Terrain>(
      terrain::make_terrain(terrain::Heightfield(*lattice, [](Vec2 p) { return p.x > 900.3f ? 7.77e3f : 0.0f; })));
  d.trees = std::make_shared<const scene::Trees>();
  d.place.south_west = {3456789.0123, 5987654.3219};
  expect_equal(d, again(d));
}

TEST_F(RecipeWriteTest, WhatNoRecipeHoldsIsTold) {
  Document d = everything();
  d.place.crs_wkt = *reference_system("EPSG:4326");
  d.interactions = {{"gone", "english_oak", distribution::KernelKind::clustering, 7.5f, 3.25f}};
  scene::Species twin = *d.species[0];
  d.species.push_back(std::make_shared<const scene::Species>(std::move(twin)));
  std::vector<std::string> warnings;
  again(d, &warnings);
  const auto told = [&](std::string_view what) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& w) { return w.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(told("reference system"));
  EXPECT_TRUE(told("'gone'"));
  EXPECT_TRUE(told("where names differ"));
}

TEST_F(RecipeWriteTest, AMapThatDoesNotFitIsRefusedWithWhatIsWrong) {
  Document d = everything();
  ASSERT_TRUE(write_recipe(d, folder_ / "out.toml"));
  terrain::Terrain small = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({40.0f, 30.0f})));
  auto other = read_map(folder_ / "out-files/map.tif", {}, small);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("300 x 180 cells; a map of this site has 80 x 60"), std::string::npos)
      << other.error().message;
  terrain::Terrain fresh = terrain::make_terrain(d.terrain->height);
  other = read_map(folder_ / "out-files/map.tif", {d.terrain->areas.all()[1]}, fresh);
  ASSERT_FALSE(other) << "its second area is not told";
  EXPECT_NE(other.error().message.find("allowed are numbers up to 1"), std::string::npos) << other.error().message;
  EXPECT_FALSE(read_map(folder_ / "shed.obj", {}, fresh));
}

}  // namespace
}  // namespace bosquet::exchange
