// From a survey to a recipe, from there to schedules and maps, and back again, as a user types it.
#include <algorithm>

#include "tests/cli/program.h"

namespace bosquet {
namespace {

class Survey : public ProgramTest {
 protected:
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

TEST_F(Survey, GoesInByDegreesAndComesOutAsSchedulesAndMaps) {
  write("survey.csv",
        "Baum-Nr;lon;lat;Baumart;H\xc3\xb6he (m);Planung\n"
        "1;13,37700;52,51600;Sandbirke;4,5;Bestand\n2;13,37710;52,51600;Winterlinde;4;F\xc3\xa4llung\n"
        "3;13,37700;52,51610;Eberesche;hoch;\n4;Mitte;52,5;Eiche;;\n");
  const Ran made = bosquet("import park.toml --trees survey.csv");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("survey.csv:4: H\xc3\xb6he (m) is \"hoch\", not a number"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("survey.csv:5: lon is \"Mitte\", not a number; the row is left out"), std::string::npos);

  const Ran grown = bosquet("make park.toml -o p.csv -o p.species.csv -o p.gpkg -o p.geojson -o p.shp --quiet");
  ASSERT_EQ(grown.status, 0) << grown.err;
  const std::string schedule = file_text(folder_ / "p.csv"), species = file_text(folder_ / "p.species.csv");
  EXPECT_EQ(lines(schedule), 4) << schedule;
  EXPECT_EQ(lines(species), 4) << species;
  EXPECT_NE(schedule.find(",Tilia cordata,,to_remove,"), std::string::npos) << schedule;
  EXPECT_NE(species.find("Betula pendula,,1,0,1,0,0,"), std::string::npos) << species;
  const auto features = json("p.geojson")["features"];
  ASSERT_EQ(features.size(), 3u);
  EXPECT_NEAR(features[1]["geometry"]["coordinates"][0].get<double>(), 13.37710, 1e-7);
  EXPECT_NEAR(features[2]["geometry"]["coordinates"][1].get<double>(), 52.51610, 1e-7);
  EXPECT_EQ(features[1]["properties"]["inventory_id"], "2");
  EXPECT_TRUE(features[1]["properties"]["trunk_diameter_m"].is_null());
  EXPECT_TRUE(features[1]["properties"]["grown_trunk_m"].is_null());  // it is to be felled
  EXPECT_GT(features[0]["properties"]["grown_trunk_m"], 0.0);

  // The map is a survey as well: the same trees at the same places.
  ASSERT_EQ(bosquet("import again.toml --trees p.gpkg").status, 0);
  ASSERT_EQ(bosquet("make again.toml -o again.geojson --quiet").status, 0);
  const auto again = json("again.geojson")["features"];
  ASSERT_EQ(again.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    for (const int axis : {0, 1})
      EXPECT_NEAR(again[i]["geometry"]["coordinates"][axis].get<double>(),
                  features[i]["geometry"]["coordinates"][axis].get<double>(), 2e-8);
    for (const char* same : {"species", "status", "inventory_name", "inventory_id", "surveyed"})
      EXPECT_EQ(again[i]["properties"][same], features[i]["properties"][same]) << same;
    EXPECT_NEAR(again[i]["properties"]["height_m"].get<double>(), features[i]["properties"]["height_m"].get<double>(),
                1e-5);
  }
}

TEST_F(Survey, OfTheWrongKindIsRefusedInOneLine) {
  write("a.toml",
        "[site]\nsize_m = [9, 9]\n[[planting]]\nkind = \"inventory\"\nfile = \"a.csv\"\nunits = { height = \"yd\" }\n");
  write("b.toml", "[site]\nsize_m = [9, 9]\ncrs = \"EPSG:4326\"\n");
  write("c.toml", "[site]\nsize_m = [9, 9]\n[[planting]]\nkind = \"inventory\"\nfile = \"none.gpkg\"\n");
  write("a.csv", "x,y\n1,1\n");
  const std::pair<const char*, const char*> wrong[]{{"a.toml", "height = \"yd\" must be one of m, cm, mm, in, ft"},
                                                    {"b.toml", "is no plane in metres"},
                                                    {"c.toml", "there is no file"}};
  for (const auto& [recipe, message] : wrong) {
    const Ran ran = bosquet(std::string("make ") + recipe + " -o x.csv --quiet");
    EXPECT_EQ(ran.status, 1) << recipe;
    EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.csv"));
  }
}

}  // namespace
}  // namespace bosquet
