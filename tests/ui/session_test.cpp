#include "ui/session.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "exchange/gltf_info.h"
#include "exchange/image_file.h"
#include "exchange/tree_file.h"
#include "growth/grow.h"
#include "scene/grown_scene.h"
#include "tests/scene/sample_document.h"
#include "ui/export_job.h"
#include "ui/file_chooser.h"
#include "ui/import_files.h"
#include "ui/tools/standing_edits.h"

namespace bosquet::ui {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("bosquet-session-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

using SessionTest = Files;
using Import = Files;

TEST_F(SessionTest, TheExampleParkIsThereWithoutAnyFile) {
  const auto park = make_example();
  ASSERT_TRUE(park) << park.error().message;
  EXPECT_GT(park->trees->size(), 200u);
  EXPECT_FALSE(park->cameras.empty());
}

TEST_F(SessionTest, EveryTemplateIsMade) {
  for (const std::string& name : template_names()) {
    const auto made = make_template(name);
    EXPECT_TRUE(made) << name << ": " << made.error().message;
  }
  EXPECT_FALSE(make_template("Jungle"));
}

TEST_F(SessionTest, AFileThatCannotBeOpenedLeavesTheDocumentAsItWas) {
  Session session({.journal = false, .recovery_folder = folder_});
  const auto before = session.document();
  const auto opened = session.open(write("broken.toml", "[site\n"));
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("broken.toml"), std::string::npos) << opened.error().message;
  EXPECT_FALSE(session.open(write("broken.bosquet", "no database")));
  EXPECT_EQ(session.document(), before);
  EXPECT_FALSE(session.unsaved());
}

TEST_F(Import, TreesOfAnInventoryComeAsOneEdit) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const auto edit = import_file(*site, ImportKind::trees,
                                write("trees.csv", "x,y,species,height_m\n10,12,silver birch,9\n30,40,oak,14\n"));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->name, "Import 2 trees");
  EXPECT_EQ(edit->document.trees->size(), site->trees->size() + 2);
}

TEST_F(Import, BuildingsComeFromOutlines) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const auto edit = import_file(*site, ImportKind::buildings, write("houses.geojson", R"({"type": "FeatureCollection",
    "features": [{"type": "Feature", "properties": {"name": "barn", "height": 6},
      "geometry": {"type": "Polygon", "coordinates": [[[10, 10], [20, 10], [20, 18], [10, 18], [10, 10]]]}}]})"));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->name, "Import a building");
  ASSERT_EQ(edit->document.obstacles.size(), site->obstacles.size() + 1);
  const scene::Obstacle& barn = edit->document.obstacles.back();
  ASSERT_TRUE(barn.outline);
  const Box2 box = barn.outline->bounds();
  EXPECT_EQ(box.low, Vec2(10, 10));
  EXPECT_EQ(box.high, Vec2(20, 18));
  EXPECT_EQ(edit->document.place, site->place);
}

TEST_F(Import, TheFirstOutlinesWithAReferenceSystemGiveTheSiteItsPlace) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const auto houses = [&](const std::string& name, double east) {
    return write(name, fmt::format(R"({{"type": "FeatureCollection",
      "crs": {{"type": "name", "properties": {{"name": "urn:ogc:def:crs:EPSG::25832"}}}},
      "features": [{{"type": "Feature", "properties": {{"height": 6}}, "geometry": {{"type": "Polygon", "coordinates":
        [[[{0}, 5540010], [{1}, 5540010], [{1}, 5540018], [{0}, 5540018], [{0}, 5540010]]]}}}}]}})",
                                   east, east + 10));
  };
  const auto first = import_file(*site, ImportKind::buildings, houses("first.geojson", 500010));
  ASSERT_TRUE(first) << first.error().message;
  const scene::Georeference& place = first->document.place;
  EXPECT_NE(place.crs_wkt.find("25832"), std::string::npos) << place.crs_wkt;
  // The second file lies beside the first as it does on the map.
  const auto second = import_file(first->document, ImportKind::buildings, houses("second.geojson", 500025));
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->document.place, place);
  const Box2 a = first->document.obstacles.back().outline->bounds();
  const Box2 b = second->document.obstacles.back().outline->bounds();
  EXPECT_NEAR(b.low.x - a.low.x, 15, 1e-3);
  EXPECT_NEAR(b.low.y, a.low.y, 1e-3);
}

// A grid of 200 x 200 cells of 1 m that rises to the east, in UTM zone 32 where `placed`.
class GroundImport : public Files {
 protected:
  std::filesystem::path grid(bool placed) const {
    if (!placed) {
      Image image(200, 200, 1);
      for (int r = 0; r < 200; ++r)
        for (int c = 0; c < 200; ++c) image.at(c, r)[0] = static_cast<std::uint8_t>(c);
      EXPECT_TRUE(exchange::write_image(folder_ / "plain.png", image));
      return folder_ / "plain.png";
    }
    std::string text = "ncols 200\nnrows 200\nxllcorner 500000\nyllcorner 5540000\ncellsize 1\n";
    for (int r = 0; r < 200; ++r)
      for (int c = 0; c < 200; ++c) text += std::to_string(c) + (c < 199 ? ' ' : '\n');
    write("ground.prj",
          "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_1980\","
          "6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION["
          "\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER["
          "\"Central_Meridian\",9.0],PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT["
          "\"Meter\",1.0]]");
    return write("ground.asc", text);
  }
  static scene::Document site(const std::string& system) {
    scene::Document document = *make_template("Meadow");
    document.place.south_west = {500010, 5540020};
    document.place.crs_wkt = system;
    return document;
  }
};

TEST_F(GroundImport, HeightsComeFromUnderTheSite) {
  const scene::Document before = site("EPSG:25832");
  const auto edit = import_file(before, ImportKind::ground, grid(true));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->document.place.south_west, before.place.south_west);
  EXPECT_NEAR(edit->document.terrain->ground(Vec2(20, 30)), 29.5f, 1e-3f);
}

TEST_F(GroundImport, HeightsOfAnotherPlaceAreRefused) {
  // The same numbers in the next zone are 430 km away.
  const auto edit = import_file(site("EPSG:25833"), ImportKind::ground, grid(true));
  ASSERT_FALSE(edit);
  EXPECT_NE(edit.error().message.find("ground.asc"), std::string::npos) << edit.error().message;
}

TEST_F(GroundImport, ARasterThatSaysNothingOfItsPlaceBeginsAtTheSitesCorner) {
  const scene::Document before = site("EPSG:25832");
  const auto edit = import_file(before, ImportKind::ground, grid(false));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->document.place, before.place);
  EXPECT_NEAR(edit->document.terrain->ground(Vec2(20, 30)), 19.5f, 1e-3f);
}

TEST(ImportWords, TellWhatCameWhatItDisplacedAndHowManyNotesThereAre) {
  scene::Edited edit;
  edit.name = "Import 2 trees";
  EXPECT_EQ(import_words(edit, "a/trees.csv"), "Import 2 trees from trees.csv");
  edit.displaced = {3, 4};
  edit.notes = {"one", "two", "three", "four", "five"};
  EXPECT_EQ(import_words(edit, "a/trees.csv"),
            "Import 2 trees from trees.csv\n2 trees stand now on a path, in water or under a building\n"
            "one\ntwo\nthree\nand 2 more");
}

TEST_F(Import, ASavedTreeComesIntoTheHandWithItsSpecies) {
  const auto meadow = make_template("Meadow");
  ASSERT_TRUE(meadow);
  exchange::SavedTree tree;
  tree.species = "european_beech";  // that the meadow does not have
  tree.key = 5;
  growth::GrowthInput input;
  growth::Parameters small = meadow->species[0]->growth;
  small.max_seasons = 8;
  input.parameters = &small;
  input.max_height_m = 3;
  tree.skeleton = growth::grow(input);
  const std::filesystem::path file = folder_ / "Old beech.tree.json";
  ASSERT_TRUE(exchange::write_tree(tree, small, file));
  const auto hero = read_hero(*meadow, file);
  ASSERT_TRUE(hero) << hero.error().message;
  EXPECT_EQ(hero->name, "Old beech");
  const auto placed = place_hero(*meadow, *hero, {20, 20}, 0);
  ASSERT_TRUE(placed) << placed.error().message;
  const scene::HeroTree& there = placed->document.heroes[0];
  EXPECT_EQ(placed->document.species[there.species]->name, "european_beech");
  EXPECT_EQ(there.skeleton->distal, tree.skeleton.distal);

  tree.species = "triffid";
  ASSERT_TRUE(exchange::write_tree(tree, small, file));
  const auto unknown = read_hero(*meadow, file);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("triffid"), std::string::npos);
}

TEST_F(Import, APlanPictureIsAsWideAsTheSiteAtFirstOrLiesWhereItsWorldFileSays) {
  const auto meadow = make_template("Meadow");
  ASSERT_TRUE(meadow);
  ASSERT_TRUE(exchange::write_image(folder_ / "plan.png", Image(20, 10, 3)));
  const auto edit = import_file(*meadow, ImportKind::underlay, folder_ / "plan.png");
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->document.underlay.file, (folder_ / "plan.png").string());
  EXPECT_EQ(edit->document.underlay.width_m, meadow->terrain->size_m().x);
  EXPECT_FALSE(import_file(*meadow, ImportKind::underlay, write("no.png", "no picture")));
  // A world file beside it tells its place.
  const auto image = exchange::read_image(folder_ / "plan.png");
  ASSERT_TRUE(image);
  write("plan.pgw", fmt::format("0.5\n0\n0\n-0.5\n10.25\n{}\n", 5 + 0.5 * image->height - 0.25));
  const auto laid = import_file(*meadow, ImportKind::underlay, folder_ / "plan.png");
  ASSERT_TRUE(laid) << laid.error().message;
  EXPECT_EQ(laid->document.underlay.south_west, DVec2(10, 5));
  EXPECT_FLOAT_EQ(laid->document.underlay.width_m, 0.5f * static_cast<float>(image->width));
}

TEST_F(Import, AnExportIsAsLargeAsItWasToldToBe) {
  const auto grown = scene::grow_scene(scene::sample_document("rowan", {{10, 10}, {20, 14}}, {30, 30}), {}, nullptr);
  ASSERT_TRUE(grown);
  const scene::GrownScene& scene = *grown;
  const exchange::SceneFileOptions options{"Avenue", 2};
  for (int k = 0; k < kExportKinds; ++k) {
    const auto kind = static_cast<ExportKind>(k);
    const std::string ending(export_kind(kind).ending);
    const std::filesystem::path file = folder_ / ("avenue" + ending);
    if (kind == ExportKind::scene || kind == ExportKind::picture) continue;
    ExportProbe probe;
    probe.ask(
        1, kind, [&] { return scene; }, options);
    while (probe.words().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto written = exchange::write_scene_file(scene, options, file);
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(probe.words(), "About " + bytes_words(written->bytes)) << ending;
    EXPECT_TRUE(std::filesystem::exists(file));
    std::filesystem::remove(file);
  }
  EXPECT_FALSE(exchange::write_scene_file(scene, options, folder_ / "avenue.docx"));
  EXPECT_FALSE(exchange::write_scene_file(scene, {"Avenue", 3}, folder_ / "avenue.tree.json"));
}

TEST_F(Import, OnlyASceneForEnginesHasWindWeights) {
  const auto grown = scene::grow_scene(scene::sample_document("rowan", {{15, 15}}, {30, 30}), {}, nullptr);
  ASSERT_TRUE(grown);
  for (const auto preset :
       {ExportPreset::everything, ExportPreset::blender, ExportPreset::engines, ExportPreset::web}) {
    ExportOrder order;
    order.scene = *grown;
    order.settings.preset = preset, order.settings.max_triangles = 20'000;
    order.target = folder_ / "scene.glb";
    ExportJob job;
    job.start(std::move(order));
    std::optional<std::string> said;
    while (!(said = job.finished())) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto info = exchange::read_gltf_info(folder_ / "scene.glb");
    ASSERT_TRUE(info) << *said;
    EXPECT_EQ(info->wind_meshes > 0, preset == ExportPreset::engines) << *said;
  }
}

TEST_F(Import, APictureIsWrittenOfWhatTheCameraSees) {
  const auto grown = scene::grow_scene(scene::sample_document("rowan", {{15, 15}}, {30, 30}), {}, nullptr);
  ASSERT_TRUE(grown);
  const auto green = [&](const Vec3& target) {
    ExportOrder order;
    order.scene = *grown;
    order.settings.max_triangles = 50'000;
    order.view.camera = {"", to_world({15, 3}, 4), target, 40};
    order.view.width = 160, order.view.height = 120;
    order.target = folder_ / "picture.png";
    ExportJob job;
    job.start(std::move(order));
    std::optional<std::string> said;
    while (!(said = job.finished())) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_TRUE(said->starts_with("Exported picture.png: 160 x 120 pixels")) << *said;
    const auto image = exchange::read_image(folder_ / "picture.png");
    EXPECT_TRUE(image);
    std::size_t count = 0;
    for (int y = 0; image && y < image->height; ++y)
      for (int x = 0; x < image->width; ++x) count += image->at(x, y)[1] > image->at(x, y)[2];
    return count;
  };
  EXPECT_GT(green(to_world({15, 15}, 4)), 500u);
  EXPECT_LT(green(to_world({15, 15}, 200)), 50u);  // sky
}

TEST(FileChooser, ANameToSaveUnderEndsAsWhatIsWritten) {
  const auto named = [](const char* file, std::vector<std::string> endings) {
    return with_ending(file, endings).string();
  };
  EXPECT_EQ(named("/a/park", {".glb", ".gltf"}), "/a/park.glb");
  EXPECT_EQ(named("/a/park.GLTF", {".glb", ".gltf"}), "/a/park.GLTF");
  EXPECT_EQ(named("/a/park.v2", {".bosquet"}), "/a/park.v2.bosquet");
  EXPECT_EQ(named("/a/list.csv", {".species.csv"}), "/a/list.species.csv");
  EXPECT_EQ(named("/a/list.species.csv", {".species.csv"}), "/a/list.species.csv");
  EXPECT_EQ(named("/a/anything.txt", {}), "/a/anything.txt");
}

TEST_F(Import, AFileThatIsNeitherIsNamed) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const std::filesystem::path file = write("notes.txt", "hello");
  for (const ImportKind kind : {ImportKind::ground, ImportKind::trees, ImportKind::buildings}) {
    const auto edit = import_file(*site, kind, file);
    ASSERT_FALSE(edit);
    EXPECT_NE(edit.error().message.find("notes.txt"), std::string::npos) << edit.error().message;
  }
}

}  // namespace
}  // namespace bosquet::ui
