// Projects on the command line: made of a recipe, grown, written as a recipe again, recovered.
#include "program.h"
#include "scene/document_digest.h"
#include "scene/journal.h"
#include "scene/project_file.h"

namespace bosquet {
namespace {

class ProjectCommandTest : public ProgramTest {
 protected:
  // Everything a recipe can have that makes a difference to skeletons, on a small site.
  void write_recipe() {
    write("a.toml", R"(
[site]
size_m = [30, 24]
seed = 9
[terrain]
water_level_m = -3.0
[terrain.noise]
amplitude_m = 1.5
[[species]]
name = "own_birch"
like = "silver_birch"
[species.growth]
apical_dominance = 0.52
[[species]]
name = "english_oak"
[[planting]]
name = "wood"
species = { own_birch = 2, english_oak = 1 }
count = 6
scale = [0.15, 0.25]
[[planting]]
name = "one"
kind = "single"
at = [20, 12]
species = { english_oak = 1 }
scale = 0.2
clear_stem_m = 0.8
[[obstacle]]
name = "house"
polygon = [[3, 3], [9, 3], [9, 8.5], [3, 8]]
height_m = 3
[[camera]]
name = "gate"
eye = [1, 1, 1.7]
target = [15, 12, 4]
[space]
voxel_m = 0.4
)");
  }
  std::string digest_of(const std::string& arguments) {
    const Ran ran = bosquet("make " + arguments + " --report r.json --quiet");
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.status == 0 ? json("r.json")["skeleton_digest"].get<std::string>() : "";
  }
};

TEST_F(ProjectCommandTest, ARecipeItsProjectAndTheProjectsRecipeGrowTheSameTrees) {
  write_recipe();
  const std::string recipe = digest_of("a.toml -o a.bosquet");
  EXPECT_EQ(recipe.size(), 16u);
  EXPECT_EQ(digest_of("a.bosquet -o b.toml"), recipe);
  EXPECT_EQ(digest_of("b.toml -o c.bosquet"), recipe);
  // Not the skeletons alone: trees with their ids and keys, ground, obstacles and settings are the same.
  const auto a = scene::read_project(folder_ / "a.bosquet"), c = scene::read_project(folder_ / "c.bosquet");
  ASSERT_TRUE(a && c);
  EXPECT_EQ(a->document.trees->to_vector(), c->document.trees->to_vector());
  const auto one = scene::digest(a->document), other = scene::digest(c->document);
  EXPECT_EQ(one[scene::Section::obstacles], other[scene::Section::obstacles]);
  EXPECT_EQ(a->document.space, c->document.space);
  const Ran info = bosquet("info a.bosquet");
  EXPECT_NE(info.out.find("project, site 30 x 24 m, 7 trees"), std::string::npos) << info.out << info.err;
}

TEST_F(ProjectCommandTest, AProjectIsNotWrittenOverByWhatIsMadeOfIt) {
  write_recipe();
  ASSERT_EQ(bosquet("make a.toml -o a.bosquet --quiet").status, 0);
  const std::string before = file_text(folder_ / "a.bosquet");
  const Ran ran = bosquet("make a.bosquet -o a.bosquet");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("this file is read"), std::string::npos) << ran.err;
  EXPECT_EQ(file_text(folder_ / "a.bosquet"), before);
}

TEST_F(ProjectCommandTest, AProjectOfAnotherDocumentAndEditedOnesAreReplacedOnlyWhenAskedTo) {
  write_recipe();
  shell("mkdir sub; sed 's/seed = 9/seed = 77/' a.toml > sub/other.toml");
  ASSERT_EQ(bosquet("make a.toml -o saved.bosquet --quiet").status, 0);
  const auto refused = [&](const std::string& line, const std::string& why) {
    const std::string before = file_text(folder_ / "saved.bosquet");
    const Ran ran = bosquet(line);
    EXPECT_EQ(ran.status, 1) << line;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("--replace"), std::string::npos) << ran.err;
    EXPECT_EQ(file_text(folder_ / "saved.bosquet"), before);
  };
  // The same recipe makes it anew, with another seed too; another recipe does not.
  EXPECT_EQ(bosquet("make a.toml -o saved.bosquet --quiet --seed 9").status, 0);
  refused("make sub/other.toml -o saved.bosquet -o x.csv", "saved.bosquet: is a project of 7 trees made from a.toml");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.csv")) << "it is refused before any work";
  EXPECT_EQ(bosquet("make sub/other.toml -o saved.bosquet --quiet --replace").status, 0);
  // Once it is edited, its own recipe must ask too.
  {
    auto file = scene::ProjectFile::open(folder_ / "saved.bosquet");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->made_from(), "sub/other.toml");
    scene::Document document = file->document();
    document.seed = 5;
    ASSERT_TRUE(file->save(document));
  }
  refused("make sub/other.toml -o saved.bosquet", "edited or saved by hand");
  // Recipes are people's work too.
  refused("export saved.bosquet -o a.toml", "a.toml: is a recipe");
}

TEST_F(ProjectCommandTest, ADamagedProjectIsGrownAsFarAsItGoesWithAWarning) {
  write_recipe();
  ASSERT_EQ(bosquet("make a.toml -o a.bosquet --quiet").status, 0);
  std::filesystem::resize_file(folder_ / "a.bosquet", std::filesystem::file_size(folder_ / "a.bosquet") - 4096);
  const Ran ran = bosquet("info a.bosquet");
  EXPECT_TRUE(ran.status == 1 || ran.err.find("damaged") != std::string::npos) << ran.out << ran.err;
}

TEST_F(ProjectCommandTest, TreesAndObstaclesAreImportedIntoAProject) {
  write("trees.csv", "x_m,y_m,species,height_m\n5,6,Quercus robur,12\n15,9,Betula pendula,8\n");
  write("houses.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":4,"name":"barn"},"geometry":
        {"type":"Polygon","coordinates":[[[1,1],[3,1],[3,3],[1,3],[1,1]]]}}]})");
  const Ran trees = bosquet("import p.bosquet --trees trees.csv");
  ASSERT_EQ(trees.status, 0) << trees.err;
  auto read = scene::read_project(folder_ / "p.bosquet");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->document.trees->size(), 2u);
  const Ran more = bosquet("import p.bosquet --trees trees.csv --quiet");
  EXPECT_TRUE(more.status == 0 || !more.err.empty());
  EXPECT_EQ(bosquet("import q.bosquet --obstacle houses.geojson").status, 1) << "there is no site yet";
  EXPECT_EQ(bosquet("import q.bosquet").status, 1);
}

// A raster of `columns` x `rows` cells of 2 m with its corner at (`east`, `north`): a slope to the east, 1 m a cell.
std::string slope(int columns, int rows, int east, int north, int from_m) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) + "\nxllcorner " +
                     std::to_string(east) + "\nyllcorner " + std::to_string(north) + "\ncellsize 2\n";
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) text += std::to_string(from_m + c) + (c + 1 < columns ? " " : "\n");
  return text;
}

TEST_F(ProjectCommandTest, AnElevationMakesTheSiteOfAProjectAndObstaclesStandOnIt) {
  write("hill.asc", slope(20, 15, 1000, 2000, 300));
  write("hut.obj", "v 4 0 -4\nv 8 0 -4\nv 8 0 -8\nv 6 3 -6\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
  write("houses.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":4,"name":"barn"},"geometry":
        {"type":"Polygon","coordinates":[[[1010,2010],[1014,2010],[1014,2014],[1010,2014],[1010,2010]]]}}],
        "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}})");
  const Ran ground = bosquet("import p.bosquet --dem hill.asc");
  ASSERT_EQ(ground.status, 0) << ground.err;
  EXPECT_NE(ground.out.find("heights from 300.0 to 319.0 m"), std::string::npos) << ground.out;
  ASSERT_EQ(bosquet("import p.bosquet --obstacle hut.obj").status, 0);
  const Ran houses = bosquet("import p.bosquet --obstacle houses.geojson");
  ASSERT_EQ(houses.status, 0) << houses.err;
  auto read = scene::read_project(folder_ / "p.bosquet");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(scene::lines(read->state).empty());
  const scene::Document d = read->document;
  EXPECT_EQ(d.terrain->size_m(), Vec2(40, 30));
  EXPECT_EQ(d.place.south_west, DVec2(1000, 2000));
  EXPECT_EQ(d.terrain->ground({21, 10}), 310.0f);
  ASSERT_EQ(d.obstacles.size(), 2u);
  EXPECT_EQ(d.obstacles[0].name, "hut");
  float lowest = 1e9f;
  for (const Vec3& p : d.obstacles[0].mesh->positions) lowest = std::min(lowest, p.y);
  EXPECT_EQ(lowest, 300.0f) << "on the ground at the site's corner";
  EXPECT_EQ(d.obstacles[1].name, "barn");
  EXPECT_EQ(d.obstacles[1].outline->bounds().low, Vec2(10, 10));
  const float mean = 0.25f * 2 * (d.terrain->ground({10, 10}) + d.terrain->ground({14, 10}));
  EXPECT_EQ(d.obstacles[1].high_y, mean + 4.0f);

  // Other heights under a site that is there: cut to it, and what stands on it goes along.
  write("higher.asc", slope(60, 60, 960, 1980, 500));
  const Ran higher = bosquet("import p.bosquet --dem higher.asc");
  ASSERT_EQ(higher.status, 0) << higher.err;
  EXPECT_NE(higher.err.find("2 obstacles go with the ground"), std::string::npos) << higher.err;
  read = scene::read_project(folder_ / "p.bosquet");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->document.terrain->size_m(), Vec2(40, 30));
  EXPECT_EQ(read->document.terrain->ground({21, 10}), 530.0f);
  EXPECT_EQ(read->document.obstacles[1].high_y, d.obstacles[1].high_y + 220.0f);
  EXPECT_EQ(read->document.obstacles[1].low_y, d.obstacles[1].low_y + 220.0f);

  // One that lies elsewhere is refused, and the project stays.
  write("far.asc", slope(20, 15, 9000, 2000, 300));
  const Ran far = bosquet("import p.bosquet --dem far.asc");
  EXPECT_EQ(far.status, 1);
  EXPECT_NE(far.err.find("does not cover the site"), std::string::npos) << far.err;
  EXPECT_EQ(scene::digest(scene::read_project(folder_ / "p.bosquet")->document), scene::digest(read->document));
}

TEST_F(ProjectCommandTest, WhatASessionLeftIsListedAndSaved) {
  write_recipe();
  ASSERT_EQ(bosquet("make a.toml -o a.bosquet --quiet").status, 0);
  const auto state = folder_ / "state" / "bosquet" / "recovery";
  scene::Document document = scene::read_project(folder_ / "a.bosquet")->document;
  {
    auto journal = scene::Journal::start(document, folder_ / "a.bosquet", state);
    ASSERT_TRUE(journal);
    document.seed = 1234;
    (*journal)->record(document, 1);
  }
  const std::string with = "XDG_STATE_HOME=state '" + std::string(BOSQUET_PROGRAM) + "' ";
  const Ran list = shell(with + "recover list");
  EXPECT_EQ(list.status, 0);
  EXPECT_NE(list.out.find("1 edit, of " + (folder_ / "a.bosquet").string()), std::string::npos) << list.out;
  const std::string name = list.out.substr(0, list.out.find(' '));
  EXPECT_EQ(shell(with + "recover nothing -o b.bosquet").status, 1);
  EXPECT_EQ(shell(with + "recover " + name).status, 1) << "where to?";
  EXPECT_EQ(shell(with + "recover " + name + " -o a.bosquet").status, 1) << "the saved one would be lost";
  const Ran saved = shell(with + "recover " + name + " -o b.bosquet");
  ASSERT_EQ(saved.status, 0) << saved.err;
  EXPECT_EQ(scene::read_project(folder_ / "b.bosquet")->document.seed, 1234u);
  EXPECT_NE(shell(with + "recover").out.find("nothing to recover"), std::string::npos);
  {
    auto journal = scene::Journal::start(document, folder_ / "a.toml", state);
    ASSERT_TRUE(journal);
    (*journal)->record(document, 1);
  }
  const Ran of_recipe = shell(with + "recover list");
  EXPECT_NE(of_recipe.out.find("1 edit, of the recipe " + (folder_ / "a.toml").string()), std::string::npos)
      << of_recipe.out;
}

}  // namespace
}  // namespace bosquet
