// The commands as a user types them, on a small site.
#include <csignal>

#include "tests/cli/program.h"

namespace bosquet {
namespace {

class Commands : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("grove.toml",
          "[site]\nsize_m = [16, 12]\nseed = 5\n[[planting]]\nname = \"grove\"\nspecies = { silver_birch = 2, "
          "norway_spruce = 1 }\ncount = 9\n"
          "scale = [0.2, 0.4]\n[export]\nmax_triangles = 40000\n");
  }
};

TEST_F(Commands, MakeWritesEveryOutputAndAReport) {
  const Ran ran = bosquet("make grove.toml -o g.glb -o g.png -o g.csv -o g.vdb --report r.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  for (const char* file : {"g.glb", "g.png", "g.csv", "g.vdb"})
    EXPECT_GT(std::filesystem::file_size(folder_ / file), 100u) << file;
  const nlohmann::json r = json("r.json");
  EXPECT_EQ(r["trees"], 9);
  EXPECT_GT(r["internodes"], 100);
  EXPECT_GT(r["leaves"], 100);
  EXPECT_GT(r["voxels"], 100);
  EXPECT_GT(r["triangles"], 1000);
  EXPECT_LE(r["triangles"], 40000);
  EXPECT_EQ(r["bytes"]["g.glb"], std::filesystem::file_size(folder_ / "g.glb"));
  EXPECT_EQ(r["seed"], 5);
  EXPECT_EQ(r["skeleton_digest"].get<std::string>().size(), 16u);
  for (const char* stage :
       {"terrain", "distribution", "crowns", "light", "growth", "geometry", "textures", "export", "total"})
    EXPECT_TRUE(r["seconds"].contains(stage)) << stage;
}

TEST_F(Commands, TheSameRecipeGivesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(bosquet("make grove.toml -o one.glb -o one.csv --threads 1 --quiet").status, 0);
  for (const char* threads : {"2", "8"}) {
    ASSERT_EQ(bosquet(std::string("make grove.toml -o more.glb -o more.csv --quiet --threads ") + threads).status, 0);
    EXPECT_TRUE(file_text(folder_ / "one.glb") == file_text(folder_ / "more.glb")) << threads;
    EXPECT_EQ(file_text(folder_ / "one.csv"), file_text(folder_ / "more.csv")) << threads;
  }
}

// The release and the dev build run this test, on whatever machine: the digest is the promise that they agree. A change of
// growth, planting, regions or the two species changes it, and with it every user's forest.
TEST_F(Commands, TheSkeletonsHaveTheSameBitsInEveryBuild) {
  ASSERT_EQ(bosquet("make grove.toml -o g.csv --report r.json --quiet").status, 0);
  EXPECT_EQ(json("r.json")["skeleton_digest"], "b2794ecdb17cb9c8");
}

TEST_F(Commands, SeveralYearsGiveASetOfFilesForEach) {
  const Ran ran = bosquet("make grove.toml -o g.csv -o g.plan.png --year 5,60 --report r.json --quiet");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_LT(json("r-5.json")["internodes"], json("r-60.json")["internodes"]);
  EXPECT_EQ(json("r-5.json")["skeleton_digest"], json("r-60.json")["skeleton_digest"]);
  for (const char* file : {"g-5.csv", "g-60.csv", "g-5.plan.png", "g-60.plan.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
  // One of them is the file that its year alone gives.
  ASSERT_EQ(bosquet("make grove.toml -o alone.csv --year 5 --quiet").status, 0);
  EXPECT_EQ(file_text(folder_ / "alone.csv"), file_text(folder_ / "g-5.csv"));
  EXPECT_EQ(bosquet("stats grove.toml --year 5,60").status, 1);
}

TEST_F(Commands, SeveralYearsAreToldInTheOrderAskedFor) {
  const Ran ran = bosquet("make grove.toml -o g.csv --year 15,60,5");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const std::size_t first = ran.out.find("g-15.csv"), second = ran.out.find("g-60.csv"),
                    third = ran.out.find("g-5.csv");
  ASSERT_NE(third, std::string::npos) << ran.out;
  EXPECT_LT(first, second) << ran.out;
  EXPECT_LT(second, third) << ran.out;
}

TEST_F(Commands, WinterIsAnotherNameOfBare) {
  ASSERT_EQ(bosquet("make grove.toml -o bare.glb --season bare --quiet").status, 0);
  ASSERT_EQ(bosquet("make grove.toml -o winter.glb --season winter --quiet").status, 0);
  EXPECT_EQ(file_text(folder_ / "bare.glb"), file_text(folder_ / "winter.glb"));
  ASSERT_EQ(bosquet("make grove.toml -o autumn.glb --season autumn --quiet").status, 0);
  EXPECT_NE(file_text(folder_ / "bare.glb"), file_text(folder_ / "autumn.glb"));
}

TEST_F(Commands, SeedsAndSunsOfTheCommandAreThoseOfRecipes) {
  const std::string grove = file_text(folder_ / "grove.toml");
  write("seed.toml",
        std::string(grove).replace(grove.find("seed ="), grove.find('\n', grove.find("seed =")) - grove.find("seed ="),
                                   "seed = \"18446744073709551615\""));
  ASSERT_EQ(bosquet("make seed.toml -o recipe.csv --quiet").status, 0);
  ASSERT_EQ(bosquet("make grove.toml -o option.csv --seed 18446744073709551615 --quiet").status, 0);
  EXPECT_EQ(file_text(folder_ / "recipe.csv"), file_text(folder_ / "option.csv"));
  for (const char* height : {"0", "90"}) {
    write("sun.toml", grove + "[sun]\nelevation_deg = " + height + "\n");
    EXPECT_EQ(bosquet("info sun.toml").status, 0) << height;
    const Ran ran = bosquet(std::string("make grove.toml -o sun.csv --quiet --sun 200,") + height);
    EXPECT_EQ(ran.status, 0) << ran.err;
  }
}

TEST_F(Commands, PicturesOfSeveralYearsHaveTheCameraOfTheOldest) {
  // The same tree at the same age, once beside what it will be and once alone: seen from afar it is small.
  write("one.toml",
        "[site]\nsize_m = [10, 10]\n[[planting]]\nkind = \"single\"\nat = [5, 5]\nspecies = { silver_birch = 1 }\n"
        "scale = 0.4\n");
  ASSERT_EQ(bosquet("make one.toml -o set.png --year 4,60 --size 160x90 --quiet").status, 0);
  ASSERT_EQ(bosquet("make one.toml -o old.png --year 60 --size 160x90 --quiet").status, 0);
  ASSERT_EQ(bosquet("make one.toml -o young.png --year 4 --size 160x90 --quiet").status, 0);
  EXPECT_EQ(file_text(folder_ / "set-60.png"), file_text(folder_ / "old.png"));
  EXPECT_NE(file_text(folder_ / "set-4.png"), file_text(folder_ / "young.png"));
}

TEST_F(Commands, TreesNearerThanTheRecipesClearanceAreNamed) {
  write("near.toml", file_text(folder_ / "grove.toml") + "[clearance]\nedge_m = 6\n");
  const Ran ran = bosquet("make near.toml -o g.svg -o g.dxf --report r.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("m from the edge of the site; the rule is 6 m"), std::string::npos) << ran.err;
  EXPECT_EQ(json("r.json")["warnings"].size(), 9u) << "no place of a site of 12 m is 6 m from its edge";
}

TEST_F(Commands, WithoutAWindowTheCommandSaysSoInOneLine) {
#ifdef BOSQUET_WITH_WINDOW
  setenv("DISPLAY", "", 1);
  const int status = 2;
  const char* words = "no display";
#else
  const int status = 1;
  const char* words = "no window";
#endif
  for (const char* line : {"", "ui"}) {
    const Ran ran = bosquet(line);
    EXPECT_EQ(ran.status, status);
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1);
  }
}

TEST_F(Commands, NothingThatTheRecipeReadsIsReplaced) {
  write("trees.csv", "x_m,y_m,species\n5,5,silver_birch\n");
  write("stand.toml",
        "[site]\nsize_m = [16, 12]\n[[planting]]\nkind = \"inventory\"\nfile = \"trees.csv\"\nscale = [0.1, 0.2]\n");
  const std::string survey = file_text(folder_ / "trees.csv");
  EXPECT_EQ(bosquet("make stand.toml -o trees.csv").status, 1);
  EXPECT_EQ(bosquet("make stand.toml -o out.csv --report stand.toml").status, 1);
  EXPECT_EQ(file_text(folder_ / "trees.csv"), survey);
}

TEST_F(Commands, ATerminalSeesABarAndNoAbort) {
  // script(1) gives the program a terminal.
  const Ran ran = shell(std::string("script -qec \"'") + BOSQUET_PROGRAM + "' make grove.toml -o g.csv\" /dev/null");
  EXPECT_EQ(ran.status, 0) << ran.out;
  EXPECT_NE(ran.out.find("9 trees"), std::string::npos) << ran.out;
}

TEST_F(Commands, GroundExactlyAsLargeAsTheSiteCoversIt) {
  // 6 x 5 cells of 1.3 m: 7.8 x 6.5 m, no multiple of the ground's cells of half a metre.
  write("odd.asc",
        "ncols 6\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1.3\nNODATA_value -1\n"
        "1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n");
  ASSERT_EQ(bosquet("import odd.toml --dem odd.asc").status, 0);
  const Ran info = bosquet("info odd.toml");
  EXPECT_EQ(info.status, 0) << info.err;
}

TEST_F(Commands, ASecondImportKeepsThePlaceOfTheFirst) {
  write("utm.csv", "x_m,y_m,species\n500010,5600010,silver_birch\n500030,5600020,oak\n");
  write("more.csv", "x_m,y_m,species\n500015,5600012,oak\n");
  ASSERT_EQ(bosquet("import p.toml --trees utm.csv").status, 0);
  ASSERT_EQ(bosquet("import p.toml --trees more.csv").status, 0);
  EXPECT_EQ(nlohmann::json::parse(bosquet("info p.toml --json").out)["trees"], 3);
}

TEST_F(Commands, AnotherSeedGivesAnotherForest) {
  ASSERT_EQ(bosquet("make grove.toml -o a.csv --report a.json --quiet").status, 0);
  ASSERT_EQ(bosquet("make grove.toml -o b.csv --report b.json --seed 6 --quiet").status, 0);
  EXPECT_NE(json("a.json")["skeleton_digest"], json("b.json")["skeleton_digest"]);
}

TEST_F(Commands, InfoNamesEveryTreeWithItsSizes) {
  ASSERT_EQ(bosquet("make grove.toml -o g.glb --quiet").status, 0);
  const Ran text = bosquet("info g.glb");
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("silver_birch-"), std::string::npos);
  EXPECT_NE(text.out.find("Picea abies"), std::string::npos);
  const Ran ran = bosquet("info g.glb --json");
  const auto info = nlohmann::json::parse(ran.out);
  int trees = 0;
  for (const auto& node : info["nodes"]) {
    if (!node["extras"].contains("height_m")) continue;
    ++trees;
    EXPECT_GT(node["extras"]["height_m"], 2.0);
    EXPECT_GT(node["extras"]["trunk_diameter_m"], 0.0);
    EXPECT_GT(node["extras"]["crown_diameter_m"], 0.2);
  }
  EXPECT_EQ(trees, 9);
  const Ran recipe = bosquet("info grove.toml --json");
  EXPECT_EQ(nlohmann::json::parse(recipe.out)["trees"], 9);
}

TEST_F(Commands, RenderDrawsEveryView) {
  for (const char* view : {"trees", "shapes", "regions", "arrows", "plan"}) {
    const Ran ran = bosquet(std::string("render grove.toml -o v.png --size 320x240 --quiet --view ") + view);
    ASSERT_EQ(ran.status, 0) << view << ran.err;
    EXPECT_GT(std::filesystem::file_size(folder_ / "v.png"), 1000u) << view;
  }
}

TEST_F(Commands, StatsMeasureThePatternsOfBasesAndCrowns) {
  const Ran ran = bosquet("stats grove.toml --json --quiet");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto stats = nlohmann::json::parse(ran.out);
  EXPECT_EQ(stats["bases"]["n"], 9);
  EXPECT_EQ(stats["bases"]["K_plain"].size(), stats["t_m"].size());
  EXPECT_EQ(stats["crown_centroids"]["nearest_m"].size(), 9u);
  EXPECT_TRUE(stats["cross"].contains("silver_birch->norway_spruce"));
  for (const char* points : {"bases", "crown_centroids"})
    for (const char* key : {"K_plain", "K_isotropic", "L", "g"})
      EXPECT_EQ(stats[points][key].size(), stats["t_m"].size()) << points << ' ' << key;
  EXPECT_EQ(stats["window_m"].size(), 2u);
}

TEST_F(Commands, OneTreeHasNoPattern) {
  write(
      "one.toml",
      "[site]\nsize_m = [9, 9]\n[[planting]]\nkind = \"single\"\nspecies = { silver_birch = 1 }\nat = [4, 4]\nscale = "
      "0.2\n");
  const Ran ran = bosquet("stats one.toml --quiet");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out.find("a pattern needs two trees"), std::string::npos) << ran.out;
  const auto stats = nlohmann::json::parse(bosquet("stats one.toml --json --quiet").out);
  EXPECT_EQ(stats["bases"]["n"], 1);
  EXPECT_TRUE(stats["bases"]["K_isotropic"].empty());
  EXPECT_TRUE(stats["crown_centroids"]["g"].empty());
}

TEST_F(Commands, LightOnAndOffGrowDifferentForests) {
  const auto digest = [&](const std::string& options) {
    EXPECT_EQ(bosquet("make grove.toml -o g.csv --report r.json --quiet " + options).status, 0);
    return json("r.json")["skeleton_digest"].get<std::string>();
  };
  const std::string on = digest("--light on"), off = digest("--light off");
  EXPECT_EQ(on, digest(""));
  EXPECT_NE(on, off);
}

TEST_F(Commands, ImportMakesARecipeFromAnInventoryAndItsGround) {
  write("trees.csv", "x_m,y_m,species\n1,1,silver_birch\n9,7,oak\n");
  write("hill.asc", "ncols 6\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -1\n" +
                        std::string("1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n"));
  const Ran made = bosquet("import park.toml --dem hill.asc --trees trees.csv");
  ASSERT_EQ(made.status, 0) << made.err;
  const auto info = nlohmann::json::parse(bosquet("info park.toml --json").out);
  EXPECT_EQ(info["trees"], 2);
  EXPECT_EQ(info["site_m"][0], 12.0);
  EXPECT_EQ(info["site_m"][1], 10.0);
  const std::string before = file_text(folder_ / "park.toml");
  EXPECT_EQ(bosquet("import park.toml --trees missing.csv").status, 1);
  EXPECT_EQ(file_text(folder_ / "park.toml"), before);
}

TEST_F(Commands, AnImportTellsWhatBecameOfEveryRowAndAQuotedWayOn) {
  std::filesystem::create_directory(folder_ / "mein park");
  write("mein park/B\xc3\xa4ume.csv",
        "Rechtswert;Hochwert;Baumart;H\xc3\xb6he;Kronendurchmesser;Ma\xc3\x9fnahme\n5;5;Stieleiche;12,5;8;erhalten\n"
        "5;5;Bergahorn;9,5;6;erhalten\n20;5;Bergahorn;1.234;6;F\xc3\xa4llung\nwest;5;Stieleiche;9;6;erhalten\n");
  const Ran made = bosquet("import 'mein park/park.toml' --trees 'mein park/B\xc3\xa4ume.csv'");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("3 trees of 4 rows; 1 left out; 1 moved aside from another's place; 1 to be removed"),
            std::string::npos)
      << made.out;
  EXPECT_NE(made.out.find("bosquet make 'mein park/park.toml' -o OUT.glb"), std::string::npos) << made.out;
  EXPECT_NE(made.err.find("'Bergahorn' is not a known species; 2 trees are drawn as norway_maple"), std::string::npos);
  EXPECT_NE(made.err.find("ume.csv:4: H\xc3\xb6he is \"1.234\", which may be 1234 or 1,234"), std::string::npos)
      << made.err;
  const Ran grown = bosquet("make 'mein park/park.toml' -o x.csv");
  EXPECT_NE(grown.out.find("2 trees, "), std::string::npos) << grown.out;
  EXPECT_NE(grown.out.find("1 tree more to be removed, so not grown"), std::string::npos) << grown.out;
}

TEST_F(Commands, SpeciesAreListedAndShown) {
  const Ran list = bosquet("species list");
  for (const char* name : {"english_oak", "silver_birch", "norway_spruce", "weeping_willow"})
    EXPECT_NE(list.out.find(name), std::string::npos);
  EXPECT_NE(bosquet("species show norway_spruce").out.find("[growth]"), std::string::npos);
}

TEST_F(Commands, CalibrateHoldsASpeciesAgainstItsRowsAndWritesWhatItMeasured) {
  const std::string rows = "[[size]]\nage_years = 60\nheight_m = 6\ncrown_m = 30\ntrunk_cm = 15\n";
  const std::string text =
      "name = \"shrub\"\n[shape]  # measured\ncrown_width_m = 1\nmature_height_m = 7\n[growth]\n"
      "internode_length_m = 0.17\n" +
      rows;
  write("shrub.toml", text);
  const Ran ran = bosquet("species calibrate shrub.toml --trees 2 --quick -o tuned.toml");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out.find("FAIL: at 60 years crown -"), std::string::npos) << ran.out;
  const std::string tuned = file_text(folder_ / "tuned.toml");
  EXPECT_NE(tuned.find("[shape]  # measured\n"), std::string::npos);
  EXPECT_EQ(tuned.find("crown_width_m = 1\n"), std::string::npos) << tuned;
  EXPECT_NE(tuned.find("pipe_exponent = "), std::string::npos);
  EXPECT_NE(tuned.find(rows), std::string::npos);
  EXPECT_EQ(file_text(folder_ / "shrub.toml"), text);
  // What it wrote is what it measures.
  bosquet("species calibrate tuned.toml --trees 2 --quick -o again.toml");
  EXPECT_EQ(file_text(folder_ / "again.toml"), tuned);
}

TEST_F(Commands, SpeciesCommandsRefuseWhatTheyCannotRead) {
  EXPECT_NE(bosquet("species calibrate english_oka").err.find("did you mean 'english_oak'?"), std::string::npos);
  EXPECT_EQ(bosquet("species calibrate missing.toml").status, 1);
  EXPECT_EQ(bosquet("species gallery english_oak -o sheet.gif").status, 1);
  EXPECT_EQ(bosquet("species gallery english_oak -o missing/sheet.png").status, 1);
  EXPECT_EQ(bosquet("species gallery english_oak --ages 0 -o sheet.png").status, 1);
  write("bad.toml", "name = \"bad\"\n[[size]]\nage_years = 10\n");
  EXPECT_NE(bosquet("species show bad.toml").err.find("bad.toml:2: this [[size]] lacks 'height_m'"), std::string::npos);
}

TEST_F(Commands, AGalleryIsAPictureOfItsSize) {
  const Ran ran = bosquet("species gallery silver_birch --ages 6 --size 400x300 -o sheet.png --quiet");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(file_text(folder_ / "sheet.png").substr(16, 4), std::string("\0\0\x01\x90", 4));  // the width, 400
}

TEST_F(Commands, AnInterruptEndsCleanlyWithStatusTwoAndNoHalfFile) {
  write("large.toml",
        "[site]\nsize_m = [300, 300]\n[[planting]]\nspecies = { english_oak = 1 }\ncount = 1500\nscale = [0.8, 1.0]\n");
  // Not before it is the program that catches the signal, which a shell lets its background jobs ignore.
  const Ran ran = shell(std::string("'") + BOSQUET_PROGRAM +
                        "' make large.toml -o large.glb --quiet & pid=$!; "
                        "until grep -q '^Name:.bosquet$' /proc/$pid/status && "
                        "grep -q '^SigCgt:.*[2367abef]$' /proc/$pid/status; do sleep 0.02; done; "
                        "sleep 0.3; kill -INT $pid; wait $pid");
  EXPECT_EQ(ran.status, 2) << ran.err;
  EXPECT_NE(ran.err.find("cancelled"), std::string::npos) << ran.err;
  std::size_t files = 0;  // the recipes and what was printed, no output nor a hidden part of one
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files += entry.is_regular_file();
  EXPECT_EQ(files, 4u);
}

}  // namespace
}  // namespace bosquet
