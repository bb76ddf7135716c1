// Trees in vector files: read, written, placed on the site and read again.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/random.h"
#include "exchange/inventory.h"
#include "exchange/reference_system.h"
#include "exchange/schedule.h"
#include "exchange/site_frame.h"
#include "exchange/tree_import.h"
#include "exchange/tree_records.h"
#include "exchange/vector_writer.h"
#include "scratch_folder.h"
#include "terrain/lattice.h"

namespace bosquet::exchange {
namespace {

const DVec2 kCorner(512345.0, 5400678.0);

scene::Georeference utm_site() {
  scene::Georeference place;
  place.south_west = kCorner;
  place.crs_wkt = *reference_system("EPSG:25832");
  return place;
}

scene::Document empty_site(DVec2 size, const scene::Georeference& place) {
  scene::Document document;
  terrain::Terrain ground;
  const auto lattice = *terrain::make_lattice(Vec2(size));
  ground.height = terrain::Heightfield(lattice);
  ground.exclusion = terrain::Mask(lattice, 0.0f);
  ground.density = terrain::Mask(lattice, 1.0f);
  document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground));
  document.place = place;
  return document;
}

Inventory inventory_of(const std::filesystem::path& file, const InventoryOptions& options = {}) {
  auto result = read_inventory(file, options);
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}

std::string refusal_of(const std::filesystem::path& file, const InventoryOptions& options = {}) {
  const auto result = read_inventory(file, options);
  return result ? "" : result.error().message;
}

InventoryOptions on(const scene::Georeference& place, DVec2 size) {
  InventoryOptions options;
  options.site = place;
  options.size_m = size;
  return options;
}

scene::Document document_with(const scene::Document& into, const std::filesystem::path& file,
                              const TreeImport& import = {}) {
  auto result = import_trees(into, file, import);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result->document);
}

// Runs a program and gives what it says, both streams.
std::string said_by(const std::string& command, int& status) {
  std::string out;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) out.append(buffer.data(), n);
  status = ::pclose(pipe);
  return out;
}

// Trees as a survey has them: coordinates of six and seven digits to the millimetre, names of all kinds.
std::string survey(int n, RandomStream& stream) {
  const char* const names[]{"Quercus robur",
                            "Winterlinde",
                            "Acer platanoides 'Globosum'",
                            "\"Birke, \"\"hell\"\"\"",
                            "Fagus sp.",
                            "\xc3\x89pic\xc3\xa9"
                            "a",
                            "",
                            "Hickory"};
  std::string text = "Baum-Nr,east_m,north_m,species,height_m,dbh_cm,crown_m,clear_stem_m,status\n";
  const auto maybe = [&](double value, int decimals, std::uint32_t of) {
    char number[32];
    std::snprintf(number, sizeof number, "%.*f", decimals, value);
    return stream.below(of) ? std::string(number) : std::string();
  };
  for (int i = 0; i < n; ++i) {
    const double east = 512345 + 0.001 * stream.below(200'000), north = 5400678 + 0.001 * stream.below(100'000);
    const double height = 3 + 0.1 * stream.below(200);
    char places[64];
    std::snprintf(places, sizeof places, "%.3f,%.3f", east, north);
    text += "B-" + std::to_string(i) + "," + places + "," + names[stream.below(8)] + "," + maybe(height, 1, 4) + "," +
            maybe(10 + stream.below(80), 0, 4) + "," + maybe(2 + 0.25 * stream.below(40), 2, 4) + "," +
            maybe(0.1 * stream.below(25), 1, 3) + "," +
            (stream.below(4) ? std::string(scene::kTreeStatusNames[stream.below(4)]) : std::string()) + "\n";
  }
  return text;
}

// The same tree, whatever its number and key. Scales that nobody measured (drawn, or inferred from another size) are no
// multiple of any length and may be off by their last bit.
void expect_same(scene::Tree a, scene::Tree b, const std::string& what) {
  EXPECT_FLOAT_EQ(a.scale_height, b.scale_height) << what;
  EXPECT_FLOAT_EQ(a.scale_width, b.scale_width) << what;
  a.scale_height = b.scale_height, a.scale_width = b.scale_width;
  EXPECT_EQ(a.trunk_diameter_m, b.trunk_diameter_m) << what;
  EXPECT_EQ(a.inventory_name, b.inventory_name) << what;
  EXPECT_EQ(a.inventory_id, b.inventory_id) << what;
  a.id = b.id, a.key = b.key, a.species = b.species;
  EXPECT_TRUE(a == b) << what;
}

TEST(VectorTrees, AnInventoryComesBackWholeThroughAGeoPackage) {
  const ScratchFolder folder;
  RandomStream stream(31, 7, Purpose::statistics);
  spit(folder / "survey.csv", survey(300, stream));
  const DVec2 size(200, 100);
  const Inventory before = inventory_of(folder / "survey.csv", on(utm_site(), size));
  ASSERT_EQ(before.trees.size(), 300u);
  ASSERT_TRUE(before.problems.empty()) << before.problems.front().reason;

  const scene::Document document = document_with(empty_site(size, utm_site()), folder / "survey.csv");
  const auto records = tree_records(document);
  const auto written = write_trees(folder / "trees.gpkg", records, document.place, size);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->bytes, std::filesystem::file_size(folder / "trees.gpkg"));

  const Inventory after = inventory_of(folder / "trees.gpkg", on(utm_site(), size));
  ASSERT_TRUE(after.problems.empty()) << after.problems.front().reason;
  ASSERT_EQ(after.trees.size(), before.trees.size());
  for (std::size_t i = 0; i < before.trees.size(); ++i) {
    const InventoryTree &a = before.trees[i], &b = after.trees[i];
    EXPECT_EQ(a.plan, b.plan) << i;
    EXPECT_EQ(a.species, b.name_kept.value_or("none"));
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.status.value_or(scene::TreeStatus::existing), b.status);
    EXPECT_EQ(a.clear_stem_m, b.clear_stem_m);
    EXPECT_EQ(a.trunk_diameter_m, b.trunk_diameter_m);
    if (a.height_m) {
      EXPECT_EQ(a.height_m, b.height_m);
    }
    if (a.crown_diameter_m) {
      EXPECT_EQ(a.crown_diameter_m, b.crown_diameter_m);
    }
  }
  // A document made of it has the same trees.
  const scene::Document again = document_with(empty_site(size, utm_site()), folder / "trees.gpkg");
  ASSERT_EQ(again.trees->size(), document.trees->size());
  for (std::size_t i = 0; i < again.trees->size(); ++i) {
    const scene::Tree &a = (*document.trees)[i], &b = (*again.trees)[i];
    EXPECT_EQ(document.species[a.species]->name, again.species[b.species]->name) << i;
    expect_same(a, b, std::to_string(i));
  }
}

TEST(VectorTrees, EveryFormatGivesTheTreesBack) {
  const ScratchFolder folder;
  RandomStream stream(32, 7, Purpose::statistics);
  spit(folder / "survey.csv", survey(60, stream));
  const DVec2 size(200, 100);
  const scene::Document document = document_with(empty_site(size, utm_site()), folder / "survey.csv");
  for (const char* name : {"trees.gpkg", "trees.shp", "trees.geojson"}) {
    ASSERT_TRUE(write_trees(folder / name, tree_records(document), document.place, size)) << name;
    const scene::Document again = document_with(empty_site(size, utm_site()), folder / name);
    ASSERT_EQ(again.trees->size(), 60u) << name;
    for (std::size_t i = 0; i < 60; ++i) {
      scene::Tree a = (*document.trees)[i], b = (*again.trees)[i];
      EXPECT_LE(glm::length(a.at - b.at), 0.0011f) << name;  // degrees are read to the millimetre
      a.at = b.at = Vec2(0.0f);
      expect_same(a, b, name + std::string(" ") + std::to_string(i));
    }
  }
}

TEST(VectorTrees, AnLStaysAnLThroughImportMapsAndSchedule) {
  const ScratchFolder folder;
  // The long leg to the north, the short one to the east; nothing else maps onto itself so.
  const std::vector<DVec2> letter{{20, 40}, {20, 25}, {20, 10}, {35, 10}};
  std::string text = "id,east,north,species\n";
  for (const DVec2& p : letter)
    text += "1," + std::to_string(kCorner.x + p.x) + "," + std::to_string(kCorner.y + p.y) + ",oak\n";
  spit(folder / "l.csv", text);
  const DVec2 size(60, 50);
  const scene::Document document = document_with(empty_site(size, utm_site()), folder / "l.csv");
  ASSERT_EQ(document.trees->size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ((*document.trees)[i].at, Vec2(letter[i]));

  const auto records = tree_records(document);
  ASSERT_TRUE(write_schedule(folder / "out.csv", records));
  for (const char* name : {"out.gpkg", "out.shp", "out.geojson"})
    ASSERT_TRUE(write_trees(folder / name, records, document.place, size)) << name;
  for (const char* name : {"out.csv", "out.gpkg", "out.shp", "out.geojson"}) {
    const Inventory back = inventory_of(folder / name, on(utm_site(), size));
    ASSERT_EQ(back.trees.size(), 4u) << name;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(glm::length(back.trees[i].plan - letter[i]), 0.0011) << name;
  }
  // As others see it: degrees in which east of the corner is east, and north is north.
  const auto json = nlohmann::json::parse(slurp(folder / "out.geojson"));
  const auto place = [&](std::size_t i) {
    const auto& c = json["features"][i]["geometry"]["coordinates"];
    return DVec2(c[0], c[1]);
  };
  EXPECT_GT(place(3).x, place(2).x);
  EXPECT_NEAR(place(3).y, place(2).y, 1e-5);
  EXPECT_GT(place(0).y, place(2).y);
  EXPECT_NEAR(place(2).x, 9.168, 0.01);
  EXPECT_NEAR(place(2).y, 48.758, 0.01);
}

TEST(VectorTrees, OgrinfoReadsWhatIsWritten) {
  const ScratchFolder folder;
  RandomStream stream(33, 7, Purpose::statistics);
  spit(folder / "survey.csv", survey(25, stream));
  const DVec2 size(200, 100);
  const scene::Document document = document_with(empty_site(size, utm_site()), folder / "survey.csv");
  for (const char* name : {"trees.gpkg", "trees.shp", "trees.geojson"}) {
    ASSERT_TRUE(write_trees(folder / name, tree_records(document), document.place, size));
    int status = 0;
    const std::string said = said_by("ogrinfo -al -so '" + (folder / name).string() + "'", status);
    EXPECT_EQ(status, 0) << said;
    EXPECT_NE(said.find("Layer name: trees"), std::string::npos) << said;
    EXPECT_NE(said.find("Geometry: Point"), std::string::npos) << said;
    EXPECT_NE(said.find("Feature Count: 25"), std::string::npos) << said;
    EXPECT_NE(said.find("status: String"), std::string::npos) << said;
    for (const char* complaint : {"Warning", "ERROR"}) EXPECT_EQ(said.find(complaint), std::string::npos) << said;
    if (std::string(name).ends_with(".gpkg")) {
      EXPECT_NE(said.find("Layer name: site"), std::string::npos) << said;
      EXPECT_NE(said.find("Extent: (512345.000000, 5400678.000000) - (512545.000000, 5400778.000000)"),
                std::string::npos)
          << said;
    }
  }
}

TEST(VectorTrees, WithoutAReferenceSystemPlacesStayMetres) {
  const ScratchFolder folder;
  spit(folder / "t.csv", "x,y,species\n12.5,3,oak\n150,99,birch\n");
  const scene::Document document = document_with(empty_site({200, 100}, {}), folder / "t.csv");
  for (const char* name : {"o.gpkg", "o.shp", "o.geojson"}) {
    const auto written = write_trees(folder / name, tree_records(document), document.place, {200, 100});
    ASSERT_TRUE(written) << name;
    EXPECT_EQ(written->warnings.size(), std::string(name) == "o.geojson" ? 1u : 0u);
    const Inventory back = inventory_of(folder / name, on({}, {200, 100}));
    ASSERT_EQ(back.trees.size(), 2u) << name;
    EXPECT_EQ(back.trees[0].plan, DVec2(12.5, 3)) << name;
    EXPECT_EQ(back.trees[1].plan, DVec2(150, 99)) << name;
    EXPECT_FALSE(back.place) << name;
  }
}

TEST(VectorTrees, AFailedWriteLeavesNothingBehind) {
  const ScratchFolder folder;
  EXPECT_FALSE(write_trees(folder / "no" / "trees.gpkg", {}, {}, {10, 10}));
  spit(folder / "keep.gpkg", "older");
  ASSERT_TRUE(write_trees(folder / "keep.gpkg", {}, {}, {10, 10}));
  EXPECT_NE(slurp(folder / "keep.gpkg"), "older");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(VectorTrees, DegreesLandOnTheSiteOfAKnownSystem) {
  // On UTM's central meridian the easting is 500,000, and the scale there 0.9996.
  scene::Georeference place = utm_site();
  const auto to_utm = *Reprojection::make(degrees_system(), place.crs_wkt);
  const DVec2 middle = to_utm({9, 48});
  EXPECT_DOUBLE_EQ(middle.x, 500000);
  place.south_west = middle - DVec2(100, 50);
  const auto inventory = parse_inventory("lon,lat,species\n9,48,oak\n9.001,48,oak\n9,48.0004,oak\n12,50,oak\n", "t.csv",
                                         on(place, {200, 100}));
  ASSERT_TRUE(inventory) << inventory.error().message;
  ASSERT_EQ(inventory->trees.size(), 3u);
  EXPECT_NEAR(inventory->trees[0].plan.x, 100, 0.0011);
  EXPECT_NEAR(inventory->trees[0].plan.y, 50, 0.0011);
  // A thousandth of a degree at latitude 48: a cos(48) / sqrt(1 - e^2 sin^2(48)) is 74.63 m, times 0.9996.
  EXPECT_NEAR(inventory->trees[1].plan.x - 100, 74.60, 0.02);
  EXPECT_NEAR(inventory->trees[2].plan.y - 50, 44.46, 0.02);
  ASSERT_EQ(inventory->problems.size(), 1u);
  EXPECT_EQ(inventory->problems[0].line, 5);
  EXPECT_FALSE(inventory->place);
}

TEST(VectorTrees, DegreesGiveASiteWithoutPlaceAPlaneOfItsOwn) {
  InventoryOptions options;
  options.size_m = DVec2(400, 400);
  const auto inventory = parse_inventory(
      "longitude;latitude;species\n13,3770;52,5160;oak\n13,3790;52,5160;oak\n13,3780;52,5175;oak\n", "t.csv", options);
  ASSERT_TRUE(inventory) << inventory.error().message;
  ASSERT_EQ(inventory->trees.size(), 3u);
  ASSERT_TRUE(inventory->place);
  EXPECT_NEAR(inventory->place->latitude_deg, 52.516, 0.002);
  EXPECT_NEAR(inventory->place->longitude_deg, 13.378, 0.002);
  const auto& t = inventory->trees;
  // East and north on the site, true to scale, in the site's middle.
  EXPECT_NEAR(t[1].plan.x - t[0].plan.x, 135.8, 0.3);
  EXPECT_NEAR(t[2].plan.y - t[0].plan.y, 166.9, 0.3);
  const DVec2 centre =
      0.5 * (glm::min(t[0].plan, glm::min(t[1].plan, t[2].plan)) + glm::max(t[0].plan, glm::max(t[1].plan, t[2].plan)));
  EXPECT_NEAR(centre.x, 200, 1.1);
  EXPECT_NEAR(centre.y, 200, 1.1);
  // The place leads back to the degrees.
  const auto back = *Reprojection::make(inventory->place->crs_wkt, degrees_system());
  EXPECT_NEAR(back(inventory->place->south_west + t[0].plan).x, 13.3770, 1e-7);
  EXPECT_NEAR(back(inventory->place->south_west + t[0].plan).y, 52.5160, 1e-7);
}

TEST(VectorTrees, AProjectedFileTellsASiteWithoutPlaceWhereItIs) {
  const ScratchFolder folder;
  const scene::Document document = [&] {
    spit(folder / "t.csv", "x,y\n512400,5400700\n512500,5400750\n");
    return document_with(empty_site({200, 100}, utm_site()), folder / "t.csv");
  }();
  ASSERT_TRUE(write_trees(folder / "t.gpkg", tree_records(document), document.place, {200, 100}));
  const scene::Document fresh = document_with({}, folder / "t.gpkg");
  EXPECT_TRUE(same_system(fresh.place.crs_wkt, utm_site().crs_wkt));
  for (std::size_t i = 0; i < 2; ++i) {
    const DVec2 surveyed = i == 0 ? DVec2(512400, 5400700) : DVec2(512500, 5400750);
    EXPECT_EQ((*fresh.trees)[i].at, Vec2(surveyed - fresh.place.south_west));
  }
  EXPECT_NEAR(fresh.place.longitude_deg, 9.17, 0.01);
  // Web Mercator is half as large again at this latitude: no plane to build on.
  InventoryOptions options;
  options.crs = "EPSG:3857", options.size_m = DVec2(400, 400);
  const auto web = parse_inventory("x,y\n1000000,6250000\n1000150,6250000\n", "t.csv", options);
  ASSERT_TRUE(web) << web.error().message;
  ASSERT_EQ(web->trees.size(), 2u);
  EXPECT_NEAR(web->trees[1].plan.x - web->trees[0].plan.x, 150 * std::cos(48.9 * M_PI / 180), 0.7);
}

TEST(VectorTrees, AnotherReferenceSystemIsReprojected) {
  // The same tree in Gauss-Krueger zone 3 (DHDN) and in UTM zone 32 (ETRS89), by its degrees on WGS 84.
  const auto gk = *Reprojection::make(degrees_system(), *reference_system("EPSG:31467"));
  const auto utm = *Reprojection::make(degrees_system(), utm_site().crs_wkt);
  const DVec2 degrees(9.17, 48.76), there = gk(degrees), here = utm(degrees);
  EXPECT_GT(there.x, 3.5e6);
  scene::Georeference place = utm_site();
  place.south_west = here - DVec2(10, 20);
  InventoryOptions options = on(place, {100, 100});
  options.crs = "EPSG:31467";
  char text[128];
  std::snprintf(text, sizeof text, "rechtswert;hochwert\n%.3f;%.3f\n", there.x, there.y);
  const auto inventory = parse_inventory(text, "t.csv", options);
  ASSERT_TRUE(inventory) << inventory.error().message;
  ASSERT_EQ(inventory->trees.size(), 1u);
  EXPECT_NEAR(inventory->trees[0].plan.x, 10, 0.01);
  EXPECT_NEAR(inventory->trees[0].plan.y, 20, 0.01);
  options.crs = "EPSG:99999999";
  const auto refused = parse_inventory(text, "t.csv", options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'EPSG:99999999' is no known reference system"), std::string::npos);
}

TEST(VectorTrees, CoordinatesOfNobodyKnowsWhereCountFromWhereMoreOfThemFit) {
  scene::Georeference place;
  place.south_west = kCorner;
  const auto map = parse_inventory("x,y\n512350,5400680\n512355,5400690\n", "t.csv", on(place, {50, 50}));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->trees.at(0).plan, DVec2(5, 2));
  const auto plan = parse_inventory("x,y\n5,2\n10,12\n", "t.csv", on(place, {50, 50}));
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->trees.at(0).plan, DVec2(5, 2));
  EXPECT_EQ(plan->notes.size(), 1u);
}

TEST(VectorTrees, GeoJsonInMetresIsNotTakenForDegrees) {
  const ScratchFolder folder;
  const auto feature = [](double x, double y) {
    return "{\"type\":\"Feature\",\"properties\":{\"species\":\"oak\"},\"geometry\":{\"type\":\"Point\","
           "\"coordinates\":[" +
           std::to_string(x) + "," + std::to_string(y) + "]}}";
  };
  spit(folder / "far.geojson", "{\"type\":\"FeatureCollection\",\"features\":[" + feature(512350, 5400680) + "]}");
  EXPECT_EQ(inventory_of(folder / "far.geojson", on(utm_site(), {50, 50})).trees.at(0).plan, DVec2(5, 2));
  spit(folder / "near.geojson",
       "{\"type\":\"FeatureCollection\",\"features\":[" + feature(5, 2) + "," + feature(40, 45) + "]}");
  InventoryOptions options;
  options.size_m = DVec2(50, 50);
  const Inventory near = inventory_of(folder / "near.geojson", options);
  EXPECT_EQ(near.trees.at(1).plan, DVec2(40, 45));
  EXPECT_EQ(near.notes.size(), 1u);
}

TEST(VectorTrees, FeaturesThatAreNoPointsAreReportedByNumber) {
  const ScratchFolder folder;
  spit(folder / "t.geojson",
       R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"species":"oak","height_m":"tall"},"geometry":{"type":"Point","coordinates":[9,48]}},
{"type":"Feature","properties":{"species":"oak"},"geometry":null},
{"type":"Feature","properties":{"species":"oak"},"geometry":{"type":"LineString","coordinates":[[9,48],[9,48.001]]}},
{"type":"Feature","properties":{"species":"elm"},"geometry":{"type":"MultiPoint","coordinates":[[9.0001,48],[9.0002,48]]}}]})");
  InventoryOptions options;
  options.size_m = DVec2(100, 100);
  const Inventory inventory = inventory_of(folder / "t.geojson", options);
  ASSERT_EQ(inventory.trees.size(), 3u);
  EXPECT_EQ(inventory.trees[2].species, "elm");
  ASSERT_EQ(inventory.problems.size(), 3u);
  const auto lines = problem_lines(inventory.problems, "t.geojson", inventory.features);
  EXPECT_EQ(lines[0], "t.geojson: feature 0: height_m is \"tall\", not a number; the tree is planted without it");
  EXPECT_EQ(lines[1], "t.geojson: feature 1: it is no point; the row is left out");
}

TEST(VectorTrees, FilesWithoutTreesAreRefusedWithTheReason) {
  const ScratchFolder folder;
  EXPECT_NE(refusal_of(folder / "none.gpkg").find("there is no file"), std::string::npos);
  spit(folder / "broken.gpkg", "SQLite format 3");
  EXPECT_NE(refusal_of(folder / "broken.gpkg").find("cannot read trees from"), std::string::npos);
  spit(folder / "broken.geojson", "{\"type\":\"FeatureCollection\",\"features\":[{");
  EXPECT_FALSE(refusal_of(folder / "broken.geojson").empty());
  spit(folder / "t.csv", "x,y\n1,1\n");
  const scene::Document document = document_with(empty_site({20, 20}, {}), folder / "t.csv");
  ASSERT_TRUE(write_trees(folder / "t.gpkg", tree_records(document), {}, {20, 20}));
  InventoryOptions options;
  options.layer = "shrubs";
  EXPECT_NE(refusal_of(folder / "t.gpkg", options).find("there is no layer 'shrubs'; the layers are trees, site"),
            std::string::npos);
}

// A drawing in millimetres with a point, a block, a circle, a line and a text.
std::string drawing() {
  const auto tag = [](int code, const std::string& value) { return std::to_string(code) + "\n" + value + "\n"; };
  std::string out = tag(0, "SECTION") + tag(2, "HEADER") + tag(9, "$INSUNITS") + tag(70, "4") + tag(0, "ENDSEC");
  out += tag(0, "SECTION") + tag(2, "BLOCKS") + tag(0, "BLOCK") + tag(8, "0") + tag(2, "LINDE") + tag(70, "0") +
         tag(10, "0") + tag(20, "0") + tag(30, "0") + tag(3, "LINDE") + tag(0, "CIRCLE") + tag(8, "0") + tag(10, "0") +
         tag(20, "0") + tag(30, "0") + tag(40, "1000") + tag(0, "ENDBLK") + tag(8, "0") + tag(0, "ENDSEC");
  out += tag(0, "SECTION") + tag(2, "ENTITIES");
  out += tag(0, "POINT") + tag(8, "Trees_Quercus robur") + tag(10, "5000") + tag(20, "2000") + tag(30, "0");
  out += tag(0, "INSERT") + tag(8, "Trees") + tag(2, "LINDE") + tag(66, "1") + tag(10, "10000") + tag(20, "4000") +
         tag(30, "0") + tag(0, "ATTRIB") + tag(8, "Trees") + tag(10, "10000") + tag(20, "4000") + tag(30, "0") +
         tag(40, "100") + tag(1, "11.5") + tag(2, "HEIGHT_M") + tag(0, "SEQEND") + tag(8, "Trees");
  out += tag(0, "CIRCLE") + tag(8, "Betula pendula") + tag(10, "20000") + tag(20, "30000") + tag(30, "0") +
         tag(40, "2500");
  out += tag(0, "LINE") + tag(8, "Path") + tag(10, "0") + tag(20, "0") + tag(30, "0") + tag(11, "1000") +
         tag(21, "1000") + tag(31, "0");
  out +=
      tag(0, "TEXT") + tag(8, "Notes") + tag(10, "1") + tag(20, "1") + tag(30, "0") + tag(40, "100") + tag(1, "oak!");
  return out + tag(0, "ENDSEC") + tag(0, "EOF");
}

TEST(VectorTrees, AFileThatBreaksOffIsToldWhereItDoes) {
  const ScratchFolder folder;
  std::string rows = "x,y\n";
  for (int n = 0; n < 400; ++n) rows += std::to_string(1 + n % 20) + "," + std::to_string(1 + n / 20) + "\n";
  spit(folder / "t.csv", rows);
  const scene::Document document = document_with(empty_site({30, 30}, utm_site()), folder / "t.csv");
  ASSERT_TRUE(write_trees(folder / "t.gpkg", tree_records(document), document.place, {30, 30}));
  const auto whole = read_inventory(folder / "t.gpkg");
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->trees.size(), 400u);
  // A page in the middle of the table.
  std::string bytes = slurp(folder / "t.gpkg");
  const std::size_t page = 4096, at = bytes.size() / 2 / page * page;
  bytes.replace(at, 2 * page, 2 * page, '\x5a');
  spit(folder / "t.gpkg", bytes);
  const auto read = read_inventory(folder / "t.gpkg");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_LT(read->trees.size(), 400u) << "nothing was lost: the page is another's";
  ASSERT_FALSE(read->problems.empty());
  EXPECT_NE(read->problems.back().reason.find("damaged from here on"), std::string::npos);
}

TEST(VectorTrees, PointsBlocksAndCirclesOfADrawingAreTrees) {
  const ScratchFolder folder;
  spit(folder / "plan.dxf", drawing());
  InventoryOptions options;
  options.size_m = DVec2(50, 50);
  const Inventory inventory = inventory_of(folder / "plan.dxf", options);
  ASSERT_EQ(inventory.trees.size(), 3u);
  EXPECT_TRUE(inventory.problems.empty());
  EXPECT_EQ(inventory.trees[0].plan, DVec2(5, 2));
  EXPECT_EQ(inventory.trees[0].species, "Trees_Quercus robur");
  EXPECT_FALSE(inventory.trees[0].crown_diameter_m);
  EXPECT_EQ(inventory.trees[1].plan, DVec2(10, 4));
  EXPECT_EQ(inventory.trees[1].species, "LINDE (Trees)");
  EXPECT_FLOAT_EQ(inventory.trees[1].height_m.value_or(0), 11.5f);
  EXPECT_NEAR(inventory.trees[2].plan.x, 20, 1e-6);
  EXPECT_NEAR(inventory.trees[2].plan.y, 30, 1e-6);
  EXPECT_NEAR(inventory.trees[2].crown_diameter_m.value_or(0), 5.0f, 0.01f);
  const scene::Document document = document_with(empty_site({50, 50}, {}), folder / "plan.dxf");
  std::vector<std::string> kinds;
  for (const scene::Tree& tree : *document.trees) kinds.push_back(document.species_of(tree).name);
  EXPECT_EQ(kinds, (std::vector<std::string>{"english_oak", "small_leaved_lime", "silver_birch"}));
}

TEST(TreeRecords, TreesToBeRemovedAreListedThoughTheyAreNotGrown) {
  const ScratchFolder folder;
  spit(folder / "t.csv",
       "x,y,species,height_m,status\n4,4,rowan,4,existing\n8,8,rowan,5,fell\n12,4,rowan,3.5,proposed\n");
  const scene::Document document = document_with(empty_site({16, 12}, {}), folder / "t.csv");
  const auto grown = scene::grow_scene(document, {}, nullptr);
  ASSERT_TRUE(grown) << grown.error().message;
  const auto records = tree_records(*grown);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_FALSE(records[1].grown);
  EXPECT_EQ(records[1].shown_height_m(), 5.0f);
  for (const std::size_t i : {0, 2}) {
    ASSERT_TRUE(records[i].grown);
    EXPECT_NEAR(records[i].grown->height_m, records[i].height_m, 0.15f * records[i].height_m);
  }
}

TEST(TreeRecords, MapCoordinatesAreTheShortestThatLeadBack) {
  EXPECT_EQ(map_coordinate(512345, static_cast<float>(512345.678 - 512345)), 512345.678);
  EXPECT_EQ(map_coordinate(0, 0.1f), 0.1);
  EXPECT_EQ(map_coordinate(0, 0.0f), 0.0);
  RandomStream stream(5, 6, Purpose::statistics);
  for (int i = 0; i < 5000; ++i) {
    const double origin = std::floor(stream.uniform(-6e6f, 6e6f));
    const float offset = stream.uniform(0.0f, 5000.0f);
    EXPECT_EQ(static_cast<float>(map_coordinate(origin, offset) - origin), offset);
  }
}

}  // namespace
}  // namespace bosquet::exchange
