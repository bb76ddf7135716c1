// Every mistake a user can make gets one message (what, where, what is allowed) and status 1, and loses nothing.
#include "tests/cli/program.h"

namespace bosquet {
namespace {

class BadInput : public ProgramTest {
 protected:
  /// make of this recipe text must fail with status 1, say every part, and leave no output behind.
  void refuses(const std::string& recipe, const std::vector<std::string>& parts) {
    write("bad.toml", recipe);
    std::filesystem::remove(folder_ / "out.glb");
    const Ran ran = bosquet("make bad.toml -o out.glb --quiet");
    EXPECT_EQ(ran.status, 1) << recipe << ran.err;
    for (const std::string& part : parts)
      EXPECT_NE(ran.err.find(part), std::string::npos) << "'" << part << "' is missing in: " << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.glb"));
  }
  static constexpr const char* kSite = "[site]\nsize_m = [20, 20]\n";
};

TEST_F(BadInput, AnUnknownKeyIsToldWithFileLineAndSuggestion) {
  refuses("[site]\nsize_m = [20, 20]\nsede = 4\n", {"bad.toml:3:", "unknown key 'sede'", "did you mean 'seed'?"});
  refuses("[stie]\nsize_m = [20, 20]\n", {"bad.toml", "site"});
}

TEST_F(BadInput, AWrongTypeIsToldWithWhatIsAllowed) {
  refuses("[site]\nsize_m = \"large\"\n", {"bad.toml:2:", "size_m", "2 numbers"});
  refuses(std::string(kSite) + "[[planting]]\nspecies = { english_oak = 1 }\ncount = \"many\"\n",
          {"bad.toml:5:", "count", "whole number"});
}

TEST_F(BadInput, AParameterOutOfRangeIsToldWithItsRange) {
  refuses(std::string(kSite) + "[[species]]\nname = \"english_oak\"\n[species.growth]\nbranching_angle_deg = 400\n",
          {"bad.toml:6:", "branching_angle_deg = 400", "10 to 120 deg"});
  refuses(std::string(kSite) + "[[species]]\nname = \"english_oak\"\n[species.growth]\nstraightness = 0.9\n",
          {"straightness", "1"});
}

TEST_F(BadInput, AnUnknownSpeciesNamesTheKnownOnes) {
  refuses(std::string(kSite) + "[[planting]]\nspecies = { english_aok = 1 }\ncount = 1\n",
          {"bad.toml:4:", "english_aok", "english_oak"});
  refuses(std::string(kSite) + "[[planting]]\nspecies = { oak = 1 }\ncount = 1\n",
          {"bad.toml:4:", "unknown species 'oak'; did you mean 'english_oak'?"});
}

TEST_F(BadInput, AMissingFileIsNamed) {
  const Ran ran = bosquet("make nowhere.toml -o out.glb");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("nowhere.toml"), std::string::npos);
  refuses(std::string(kSite) + "[terrain]\ndem = \"no.tif\"\n", {"no.tif"});
  refuses(std::string(kSite) + "[[planting]]\nkind = \"inventory\"\nfile = \"no.csv\"\n", {"no.csv"});
}

TEST_F(BadInput, AMissingPlanPictureIsToldWhateverIsMade) {
  write("plan.toml", std::string(kSite) +
                         "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 1\nscale = [0.2, 0.3]\n"
                         "[underlay]\nfile = \"gone.png\"\nwidth_m = 20\n");
  const Ran other = bosquet("make plan.toml -o out.csv");
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_NE(other.err.find("plan.toml: [underlay] there is no file"), std::string::npos) << other.err;
  const Ran sheet = bosquet("make plan.toml -o out.plan.png");
  EXPECT_EQ(sheet.status, 1);
  EXPECT_NE(sheet.err.find("plan.toml: [underlay] there is no file"), std::string::npos) << sheet.err;
}

TEST_F(BadInput, ASiteOfZeroOrAbsurdSizeIsRefused) {
  refuses("[site]\nsize_m = [0, 20]\n", {"bad.toml:2:", "1 to 200000 m"});
  refuses("[site]\nsize_m = [20, 1e9]\n", {"bad.toml:2:", "1 to 200000 m"});
  refuses("[site]\nsize_m = [20, -5]\n", {"bad.toml:2:", "1 to 200000 m"});
}

TEST_F(BadInput, AnOutputFolderThatIsNotThereIsToldBeforeAnyWork) {
  write("fine.toml", std::string(kSite) + "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 1\n");
  const Ran ran = bosquet("make fine.toml -o nowhere/out.glb");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("the folder nowhere does not exist"), std::string::npos);
  const Ran unknown = bosquet("make fine.toml -o out.docx");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find(".csv .species.csv .gpkg .geojson .shp"), std::string::npos);
}

TEST_F(BadInput, ARasterWithoutDataIsRefusedByName) {
  // An ESRI grid whose cells all are no-data.
  write("empty.asc",
        "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n-9999 -9999 -9999\n-9999 -9999 "
        "-9999\n-9999 -9999 -9999\n");
  refuses(std::string(kSite) + "[terrain]\ndem = \"empty.asc\"\n", {"empty.asc"});
  write("damaged.tif", "II*\0 this is no raster");
  refuses(std::string(kSite) + "[terrain]\ndem = \"damaged.tif\"\n", {"damaged.tif"});
  write("small.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n1 2\n3 4\n");
  refuses(std::string(kSite) + "[terrain]\ndem = \"small.asc\"\n", {"small.asc"});
}

TEST_F(BadInput, AnInventoryKeepsItsGoodRowsAndListsTheBadOnes) {
  write("trees.csv",
        "x_m,y_m,species,dbh_cm\n5,5,silver_birch,20\n5,5,silver_birch,20\n8,x,silver_birch,20\n10,10,silver_birch,"
        "thick\n"
        "99,5,silver_birch,20\n15,12,hickory,\n");
  write("stand.toml",
        std::string(kSite) + "[[planting]]\nkind = \"inventory\"\nfile = \"trees.csv\"\nscale = [0.2, 0.3]\n");
  const Ran ran = bosquet("make stand.toml -o out.csv --report report.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const nlohmann::json report = json("report.json");
  EXPECT_EQ(report["trees"], 4);
  const std::string warnings = report["warnings"].dump();
  EXPECT_NE(warnings.find("trees.csv:3"), std::string::npos) << warnings;  // the second tree at one place, moved
  EXPECT_NE(warnings.find("moved"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("trees.csv:4"), std::string::npos) << warnings;  // text in a number column
  EXPECT_NE(warnings.find("trees.csv:5"), std::string::npos) << warnings;  // text as a diameter: planted
  EXPECT_NE(warnings.find("trees.csv:6"), std::string::npos) << warnings;  // outside
  EXPECT_NE(warnings.find("'hickory'"), std::string::npos) << warnings;
}

TEST_F(BadInput, WhenThereIsNoRoomLeftPlantingStopsAndSaysSo) {
  write("full.toml",
        "[site]\nsize_m = [4, 4]\n[[planting]]\nspecies = { silver_birch = 1 }\ncount = 5000\nscale = [0.05, 0.06]\n");
  const Ran ran = bosquet("make full.toml -o out.csv --report report.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_LT(json("report.json")["trees"], 5000);
  EXPECT_NE(json("report.json")["warnings"].dump().find("of 5000 trees"), std::string::npos);
  refuses(
      "[site]\nsize_m = [10, 10]\n[[terrain.exclusion]]\npolygon = [[-5, -5], [15, -5], [15, 15], [-5, 15]]\n"
      "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 5\n",
      {"no tree could be planted"});
}

TEST_F(BadInput, MistakesOnTheCommandLineHaveStatusOne) {
  for (const char* line :
       {"mak x.toml", "make", "render x.toml -o out.png --size 10", "render x.toml -o out.png --view trunks",
        "make x.toml -o out.glb --detail 99", "info picture.png", "species show elephant_tree"}) {
    const Ran ran = bosquet(line);
    EXPECT_EQ(ran.status, 1) << line;
    EXPECT_FALSE(ran.err.empty()) << line;
  }
  EXPECT_EQ(bosquet("--help").status, 0);
  EXPECT_EQ(bosquet("--version").status, 0);
}

TEST_F(BadInput, AFullDiskLeavesTheOldFileUntouchedWithStatusTwo) {
  write("fine.toml",
        std::string(kSite) + "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 2\nscale = [0.2, 0.3]\n");
  write("out.glb", "precious");
  // A file size limit makes writes fail as a full disk does; what is printed goes through a pipe, which has none.
  const Ran ran = shell(std::string("(ulimit -f 4; '") + BOSQUET_PROGRAM +
                        "' make fine.toml -o out.glb --quiet; echo status $?) 2>&1 | cat");
  EXPECT_NE(ran.out.find("status 2"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("file size limit is reached"), std::string::npos) << ran.out;
  EXPECT_EQ(file_text(folder_ / "out.glb"), "precious");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files += entry.is_regular_file();
  EXPECT_EQ(files, 4u) << "no hidden part is left";
}

TEST_F(BadInput, NumbersAndWordsOfOptionsAreToldWithWhatIsAllowed) {
  write("fine.toml", std::string(kSite) + "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 1\n");
  const std::pair<const char*, const char*> lines[] = {{"--seed -1", "whole number from 0"},
                                                       {"--max-triangles -1", "whole number from 0"},
                                                       {"--seed 18446744073709551616", "0 to 18446744073709551615"},
                                                       {"--season monsoon", "autumn, bare, spring, summer, winter"},
                                                       {"--detail nan", "0.25 to 4"},
                                                       {"--figure 3m", "east,north in metres"},
                                                       {"--figure 500,2", "outside the site"},
                                                       {"extra.csv", "extra.csv"}};
  write("extra.csv", "precious");
  for (const auto& [option, said] : lines) {
    const Ran ran = bosquet(std::string("make fine.toml -o out.csv ") + option);
    EXPECT_EQ(ran.status, 1) << option;
    EXPECT_NE(ran.err.find(said), std::string::npos) << option << ": " << ran.err;
  }
  EXPECT_EQ(file_text(folder_ / "extra.csv"), "precious");
}

TEST_F(BadInput, AMistypedWordIsToldAloneWithTheNearestRightOne) {
  const auto says = [&](const std::string& line, const std::string& what) {
    const Ran ran = bosquet(line);
    EXPECT_EQ(ran.status, 1) << line;
    EXPECT_NE(ran.err.find(what), std::string::npos) << line << ": " << ran.err;
  };
  says("mkae x.toml -o x.glb", "there is no command 'mkae'; did you mean 'make'?");
  says("make x.toml --yaer 5 -o x.glb", "'make' has no option --yaer; did you mean '--year'?");
  says("make x.toml --otput x.glb", "'make' has no option --otput; did you mean '--output'?");
  says("species gallry -o x.png", "'species' has no command 'gallry'; did you mean 'gallery'?");
  says("species", "'species' needs one of: list, show, calibrate, gallery");
  says("make my park.toml -o x.glb", "'park.toml' is a word too many for 'make'; a name with spaces needs quotes");
  says("park.toml", "bosquet ui park.toml");
  says("help", "'help' is an option: --help");
  says("make x.toml -o x.glb --detail 0,8", "0.25 to 4; decimals stand behind a point: 0.8");
  says("make x.toml -o x.glb --max-triangles 1000000001", "0 to 1000000000");
  says("make 'my survey.gpkg' -o x.glb", "bosquet import NAME.toml --trees 'my survey.gpkg'");
  says("import ground.tif", "bosquet import NAME.toml --dem ground.tif");
  says("make x.toml -o .", ".: is a folder; name a file in it");
  says("make x.toml -o park", "park: has no ending, which tells what to write");
  says("make x.toml -o park.glb --tree 1", "needs an output that it goes into, -o NAME.tree.json");
  says("make x.toml -o park.glb --wind on --instancing on", "give --wind on or --instancing on, not both");
  says("render x.toml -o park.plan.png --view shapes", "is a plan sheet, which knows no --view");
}

TEST_F(BadInput, AFileThatIsReadOnlyOrASpeciesFileOfOnesOwnIsNotReplaced) {
  write("site.toml", std::string(kSite) + "[[planting]]\nspecies = { rowan = 1 }\ncount = 1\n");
  for (const char* name : {"park.glb", "park.csv", "park.shp", "park.vdb", "park.bosquet"}) {
    write(name, "kept");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_read);
    const Ran ran = bosquet("make site.toml --quiet --replace -o " + std::string(name));
    EXPECT_EQ(ran.status, 1) << name;
    EXPECT_NE(ran.err.find(std::string(name) + ": it is read-only"), std::string::npos) << ran.err;
    EXPECT_EQ(file_text(folder_ / name), "kept") << name;
  }
  write("mine.toml", "mine");
  const Ran ran = bosquet("species calibrate rowan --trees 1 --quick -o mine.toml");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("mine.toml: is there already and would be lost"), std::string::npos) << ran.err;
  EXPECT_EQ(file_text(folder_ / "mine.toml"), "mine");
  EXPECT_EQ(bosquet("species calibrate rowan --trees 1 --quick -o mine.toml --replace").status, 0);
  EXPECT_NE(file_text(folder_ / "mine.toml").find("Sorbus aucuparia"), std::string::npos);
}

}  // namespace
}  // namespace bosquet
