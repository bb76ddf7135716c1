#include "exchange/tree_import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.h"
#include "exchange/inventory.h"
#include "growth/age.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

ImportedDocument imported(const scene::Document& into, const std::filesystem::path& file,
                          const TreeImport& import = {}) {
  auto result = import_trees(into, file, import);
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}

std::string kind(const scene::Document& document, std::size_t tree) {
  return document.species_of((*document.trees)[tree]).name;
}

bool warns(const std::vector<std::string>& warnings, std::string_view of) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& line) { return line.find(of) != std::string::npos; });
}

TEST(TreeImport, AnEmptyDocumentBecomesASiteAroundItsTrees) {
  const ScratchFolder folder;
  spit(folder / "t.csv", "x,y,species,height_m\n512400.5,5400700,oak,12\n512460,5400730.25,Waldkiefer,9\n");
  const ImportedDocument made = imported({}, folder / "t.csv");
  EXPECT_EQ(made.tally.trees, 2u);
  const DVec2 corner = made.document.place.south_west;
  EXPECT_EQ(corner, glm::floor(corner)) << "whole metres";
  EXPECT_EQ((*made.document.trees)[1].at, Vec2(DVec2(512460, 5400730.25) - corner));
  const Vec2 size = made.document.terrain->size_m();
  Box2 crowns;
  for (const scene::Tree& tree : *made.document.trees) {
    const Vec2 radius(0.5f * tree.scale_width * made.document.species_of(tree).shape.crown_width_m);
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(tree.at - radius, Vec2(0.0f)))) << "a crown is cut by the edge";
    EXPECT_TRUE(glm::all(glm::lessThanEqual(tree.at + radius, size)));
    crowns.add(tree.at - radius), crowns.add(tree.at + radius);
  }
  EXPECT_TRUE(glm::all(glm::lessThanEqual(size, crowns.size() + 4.0f))) << "no wider than they need";
  EXPECT_EQ(made.document.species.size(), 2u);  // only those that stand there
  EXPECT_EQ(kind(made.document, 0), "english_oak");
  EXPECT_EQ(kind(made.document, 1), "scots_pine");
  EXPECT_EQ((*made.document.trees)[0].status, scene::TreeStatus::existing);
}

TEST(TreeImport, ASecondFileJoinsTheFirstWithoutTouchingItsTrees) {
  const ScratchFolder folder;
  spit(folder / "a.csv", "x,y,species\n0,0,oak\n50,40,oak\n10,10,birch\n");
  spit(folder / "b.csv", "x,y,species\n20,20,oak\n10,10,lime\n70,10,lime\n");
  const ImportedDocument first = imported({}, folder / "a.csv"), second = imported(first.document, folder / "b.csv");
  ASSERT_EQ(second.document.trees->size(), 5u);  // (70, 10) is off the site
  EXPECT_TRUE(warns(second.warnings, "b.csv:4: position 81, 21 lies outside"));
  EXPECT_EQ(first.document.place.south_west, DVec2(-11)) << "room for the crown of the oak at 0, 0";
  EXPECT_EQ(words(second.tally, false), "2 trees of 3 rows; 1 left out; 1 moved aside from another's place");
  EXPECT_TRUE(warns(second.warnings, "b.csv:3: same place as a tree that stands there; moved from (21.00, 21.00)"));
  std::set<std::uint64_t> keys;
  for (std::size_t i = 0; i < 5; ++i) {
    const scene::Tree& tree = (*second.document.trees)[i];
    EXPECT_EQ(tree.id, static_cast<int>(i) + 1);
    EXPECT_TRUE(keys.insert(tree.key).second);
    if (i < 3) {
      EXPECT_EQ(tree, (*first.document.trees)[i]);
    }
  }
  EXPECT_EQ(kind(second.document, 4), "small_leaved_lime");
  // The same file once more: other trees, moved aside, none lost.
  const ImportedDocument third = imported(second.document, folder / "b.csv");
  EXPECT_EQ(third.document.trees->size(), 7u);
  EXPECT_EQ(third.document.next_tree_id, 8);
}

TEST(TreeImport, OwnSynonymsComeBeforeAllOthers) {
  const ScratchFolder folder;
  spit(folder / "s.csv", "name,species\nGew\xc3\xb6hnlicher Baum,Tilia cordata\noak,norway_maple\n");
  spit(folder / "t.csv", "x,y,species\n1,1,gewoehnlicher baum\n5,5,Oak\n9,9,Quercus robur\n");
  TreeImport import;
  import.synonyms = folder / "s.csv";
  const ImportedDocument made = imported({}, folder / "t.csv", import);
  EXPECT_EQ(kind(made.document, 0), "small_leaved_lime");
  EXPECT_EQ(kind(made.document, 1), "norway_maple");
  EXPECT_EQ(kind(made.document, 2), "english_oak");
  EXPECT_TRUE(made.warnings.empty()) << made.warnings.front();
}

TEST(TreeImport, SynonymsThatCannotBeAreRefusedByLine) {
  const ScratchFolder folder;
  spit(folder / "t.csv", "x,y,species\n1,1,oak\n");
  const auto refusal = [&](const char* text) {
    spit(folder / "s.csv", text);
    TreeImport import;
    import.synonyms = folder / "s.csv";
    const auto result = import_trees({}, folder / "t.csv", import);
    return result ? "" : result.error().message;
  };
  EXPECT_NE(refusal("name,species\nEiche,oakk\n").find("s.csv:2: 'oakk' is not a known species; known are"),
            std::string::npos);
  EXPECT_NE(refusal("Eiche,english_oak\nEICHE,olive\n").find("s.csv:2: 'EICHE' means two species"), std::string::npos);
  EXPECT_NE(refusal("Eiche\n").find("s.csv:1: a row needs a name and the species"), std::string::npos);
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  TreeImport import;
  import.synonyms = folder / "none.csv";
  EXPECT_FALSE(import_trees({}, folder / "t.csv", import));
  import = {};
  import.fallback = "triffid";
  EXPECT_FALSE(import_trees({}, folder / "t.csv", import));
}

TEST(TreeImport, EverySubstitutionIsNamedOnceWithItsCount) {
  const ScratchFolder folder;
  spit(folder / "t.csv",
       "x,y,species\n1,1,Acer platanoides 'Globosum'\n2,2,Acer rubrum\n3,3,Acer rubrum\n4,4,Abies "
       "alba\n5,5,\n6,6,Ginkgo\n");
  const ImportedDocument made = imported({}, folder / "t.csv");
  EXPECT_EQ(made.tally.trees, 6u);
  EXPECT_TRUE(warns(made.warnings, "'Acer platanoides 'Globosum'': 1 tree is drawn as norway_maple, its species"));
  EXPECT_TRUE(
      warns(made.warnings, "'Acer rubrum' is not a known species; 2 trees are drawn as norway_maple, of its genus"));
  EXPECT_TRUE(warns(made.warnings, "'Abies alba' is not a known species; 1 tree is drawn as norway_spruce, a conifer"));
  EXPECT_TRUE(warns(made.warnings,
                    "1 tree is drawn as english_oak for want of any name; another species is set by default_species"));
  EXPECT_EQ(made.tally.nameless, 1u);
  EXPECT_NE(words(made.tally, false).find("; 1 without a name, drawn as english_oak"), std::string::npos);
  EXPECT_TRUE(warns(made.warnings, "'Ginkgo' is not a known species; 1 tree is drawn as english_oak"));
  EXPECT_EQ((*made.document.trees)[1].inventory_name, "Acer rubrum");
}

TEST(TreeImport, SizesComeFromWhatIsGivenElseFromAgeElseFromTheRange) {
  const ScratchFolder folder;
  spit(folder / "t.csv",
       "x,y,species,height_m,dbh_cm,crown_m,age\n1,1,english_oak,11,,,\n2,2,english_oak,,,,30\n3,3,english_oak,,,,\n"
       "4,4,english_oak,11,,,900\n5,5,Quercus robur 'Fastigiata',11,,,\n6,6,Quercus robur 'Fastigiata',11,,6,\n"
       "7,7,english_oak,90,,,\n");
  const ImportedDocument made = imported({}, folder / "t.csv");
  const scene::Species& oak = *made.document.species[0];
  const auto tree = [&](std::size_t i) { return (*made.document.trees)[i]; };
  const auto scale = [&](float height) { return height / oak.shape.mature_height_m; };
  EXPECT_FLOAT_EQ(tree(0).scale_height, scale(11));
  EXPECT_TRUE(tree(0).measured);
  EXPECT_FLOAT_EQ(tree(1).scale_height, growth::height_share_at_age(oak.growth, 30));
  EXPECT_TRUE(tree(1).measured);
  EXPECT_FALSE(tree(2).measured);
  EXPECT_FLOAT_EQ(tree(3).scale_height, scale(11));  // what was measured counts
  EXPECT_FLOAT_EQ(tree(4).scale_width, scene::kColumnarWidth * tree(4).scale_height);
  EXPECT_FLOAT_EQ(tree(5).scale_width, 6 / oak.shape.crown_width_m);
  EXPECT_FLOAT_EQ(tree(6).scale_height, 2.0f);
  EXPECT_TRUE(warns(made.warnings, "t.csv:8: 90 m is more than twice the height of english_oak; cut to that"));
}

TEST(TreeImport, AFileWithoutATreeOnTheSiteIsRefused) {
  const ScratchFolder folder;
  spit(folder / "t.csv", "x,y,species\nwest,north,oak\n");
  const auto made = import_trees({}, folder / "t.csv");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("no row has a usable position on the site"), std::string::npos);
  EXPECT_NE(made.error().message.find("t.csv:2: x is \"west\", not a number"), std::string::npos);
}

TEST(TreeImport, TreesOfAnotherPlaceAreRefusedWithTheWayToASiteOfTheirOwn) {
  const ScratchFolder folder;
  spit(folder / "here.csv", "x,y,species\n0,0,oak\n");
  spit(folder / "t.csv", "x,y,species\n691010,5335020,oak\n");
  const auto made = import_trees(imported({}, folder / "here.csv").document, folder / "t.csv");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("lies outside the site"), std::string::npos);
  EXPECT_NE(made.error().message.find("bosquet import NAME.toml --trees FILE"), std::string::npos);
}

TEST(TreeImport, ASiteWithoutPlaceOnTheMapIsLaidRoundTreesOfMapCoordinatesWhenTheyFit) {
  const ScratchFolder folder;
  spit(folder / "t.csv", "x,y,species\n691010,5335020,silver_birch\n691030,5335050,silver_birch\n");
  const auto site = [](Vec2 size) {
    scene::Document document;
    document.terrain = std::make_shared<const terrain::Terrain>(
        terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(size))));
    document.trees = std::make_shared<const scene::Trees>();
    return document;
  };
  const ImportedDocument made = imported(site({100, 80}), folder / "t.csv");
  EXPECT_EQ(made.tally.trees, 2u);
  EXPECT_EQ(made.document.terrain->size_m(), Vec2(100, 80));
  const DVec2 corner = made.document.place.south_west;
  EXPECT_EQ(Vec2(DVec2(691010, 5335020) - corner), (*made.document.trees)[0].at);
  const Vec2 middle = 0.5f * ((*made.document.trees)[0].at + (*made.document.trees)[1].at);
  EXPECT_LE(glm::length(middle - Vec2(50, 40)), 2.0f);
  EXPECT_TRUE(warns(made.warnings, "the site had no place on the map; its south-west corner is now at 690"));

  const auto small = import_trees(site({20, 80}), folder / "t.csv");
  ASSERT_FALSE(small);
  EXPECT_NE(small.error().message.find("they fit a new site of"), std::string::npos) << small.error().message;
}

}  // namespace
}  // namespace bosquet::exchange
