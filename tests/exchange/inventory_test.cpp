#include "exchange/inventory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <set>

#include "core/random.h"
#include "exchange/csv.h"
#include "exchange/number_text.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

const std::filesystem::path kData = std::filesystem::path(BOSQUET_SOURCE_DIR) / "examples" / "data";

Inventory parsed(std::string_view text, const InventoryOptions& options = {}) {
  auto result = parse_inventory(text, "trees.csv", options);
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}
std::string refused(std::string_view text, const InventoryOptions& options = {}) {
  const auto result = parse_inventory(text, "trees.csv", options);
  return result ? "" : result.error().message;
}

TEST(Inventory, LansingWoodsHas2251TreesOfSixKinds) {
  InventoryOptions options;
  options.size_m = DVec2(281.7, 281.7);
  const auto woods = read_inventory(kData / "lansing_woods.csv", options);
  ASSERT_TRUE(woods) << woods.error().message;
  EXPECT_EQ(woods->trees.size(), 2251u);
  EXPECT_TRUE(woods->problems.empty());
  std::set<std::string> kinds;
  for (const InventoryTree& tree : woods->trees) kinds.insert(tree.species);
  EXPECT_EQ(kinds, (std::set<std::string>{"blackoak", "hickory", "maple", "misc", "redoak", "whiteoak"}));
  EXPECT_EQ(woods->trees[0].plan, DVec2(21.97, 25.63));
  EXPECT_EQ(woods->trees[0].line, 2);
}

TEST(Inventory, TheSaxonSprucesHaveTrunksInMetres) {
  const auto spruces = read_inventory(kData / "spruces_saxonia.csv");
  ASSERT_TRUE(spruces) << spruces.error().message;
  ASSERT_EQ(spruces->trees.size(), 134u);
  for (const InventoryTree& tree : spruces->trees) {
    ASSERT_TRUE(tree.trunk_diameter_m);
    EXPECT_GT(*tree.trunk_diameter_m, 0.1f);
    EXPECT_LT(*tree.trunk_diameter_m, 0.5f);
  }
}

TEST(Inventory, SeparatorsQuotesMarksAndLineEndsOfAllKindsMeanTheSame) {
  for (const char* text : {
           "x_m,y_m,species,height_m\n1.5,2,\"oak, red\",10.5\n3,4,ash,\n",
           "\xef\xbb\xbfx_m,y_m,species,height_m\r\n1.5,2,\"oak, red\",10.5\r\n3,4,ash,\r\n",
           "x_m;y_m;species;height_m\n1,5;2;oak, red;10,5\n3;4;ash;\n",
           "x_m\ty_m\tspecies\theight_m\n1.5\t2\toak, red\t10.5\n3\t4\tash\n",
           "x_m,y_m,species,height_m\r1.5,2,\"oak, red\",10.5\r3,4,ash,",
           "\"x_m\" , \"y_m\",species,height_m\n 1.5 ,+2,\"oak, red\", 10.5\n\n  \n3,4,ash,\n\n",
       }) {
    const Inventory inventory = parsed(text);
    ASSERT_EQ(inventory.trees.size(), 2u) << text;
    EXPECT_TRUE(inventory.problems.empty()) << text;
    EXPECT_EQ(inventory.trees[0].plan, DVec2(1.5, 2)) << text;
    EXPECT_EQ(inventory.trees[0].species, "oak, red") << text;
    EXPECT_FLOAT_EQ(inventory.trees[0].height_m.value_or(0), 10.5f) << text;
    EXPECT_FALSE(inventory.trees[1].height_m) << text;
  }
}

TEST(Inventory, ColumnsAreFoundByUsualNamesInAnyCase) {
  const Inventory inventory =
      parsed("Tree ID,Easting (m),NORTHING (M),Botanical Name,DBH (cm),Crown Spread_m\nA-1,5,6,Tilia cordata,31,7\n");
  EXPECT_EQ(inventory.columns.east, "Easting (m)");
  EXPECT_EQ(inventory.columns.height, "");
  ASSERT_EQ(inventory.trees.size(), 1u);
  const InventoryTree& tree = inventory.trees[0];
  EXPECT_EQ(tree.id, "A-1");
  EXPECT_EQ(tree.species, "Tilia cordata");
  EXPECT_FLOAT_EQ(*tree.trunk_diameter_m, 0.31f);
  EXPECT_FLOAT_EQ(*tree.crown_diameter_m, 7.0f);
}

TEST(Inventory, UnitsComeFromTheColumnsName) {
  const auto trunk = [](const char* column, const char* value) {
    const Inventory i = parsed(std::string("x,y,") + column + "\n1,1," + value + "\n");
    return i.trees.at(0).trunk_diameter_m.value_or(-1);
  };
  EXPECT_FLOAT_EQ(trunk("dbh_m", "0.4"), 0.4f);
  EXPECT_FLOAT_EQ(trunk("dbh_cm", "40"), 0.4f);
  EXPECT_FLOAT_EQ(trunk("dbh_mm", "400"), 0.4f);
  EXPECT_FLOAT_EQ(trunk("diameter_in", "10"), 0.254f);
  EXPECT_NEAR(trunk("Stammumfang_cm", "125.66"), 0.4f, 1e-4f);  // a girth
  const Inventory feet = parsed("x_ft,y_ft,height_ft\n100,10,50\n");
  EXPECT_NEAR(feet.trees[0].plan.x, 30.48, 1e-9);
  EXPECT_NEAR(*feet.trees[0].height_m, 15.24f, 1e-5f);
}

TEST(Inventory, ATrunkColumnWithoutUnitIsMetresOnlyWhenAllFit) {
  const Inventory cm = parsed("x,y,dbh\n1,1,2\n2,2,45\n");
  EXPECT_FLOAT_EQ(*cm.trees[1].trunk_diameter_m, 0.45f);
  EXPECT_FLOAT_EQ(*cm.trees[0].trunk_diameter_m, 0.02f);
  ASSERT_EQ(cm.notes.size(), 1u);
  EXPECT_EQ(cm.notes[0], "column dbh names no unit; taken as cm");
  const Inventory m = parsed("x,y,dbh\n1,1,0.2\n2,2,1.5\n");
  EXPECT_FLOAT_EQ(*m.trees[1].trunk_diameter_m, 1.5f);
  EXPECT_EQ(m.notes[0], "column dbh names no unit; taken as m");
}

TEST(Inventory, NamedColumnsStandBeforeGuessedOnes) {
  InventoryOptions options;
  options.columns.species = "Art";
  options.columns.trunk_diameter = "d_cm";
  const Inventory inventory = parsed("x,y,species,Art,d_cm\n1,2,wrong,Fagus,20\n", options);
  EXPECT_EQ(inventory.trees[0].species, "Fagus");
  EXPECT_FLOAT_EQ(*inventory.trees[0].trunk_diameter_m, 0.2f);
  options.columns.species = "Gattung";
  EXPECT_EQ(refused("x,y,species\n1,2,a\n", options),
            "trees.csv: there is no column \"Gattung\" for species; the columns are x, y, species");
}

TEST(Inventory, EveryBadRowIsNamedByItsLineAndTheGoodOnesStay) {
  InventoryOptions options;
  options.size_m = DVec2(100, 50);
  const Inventory inventory = parsed(
      "x_m,y_m,species,height_m,dbh_cm\n"
      "1,1,oak,10,20\n"      // 2
      "abc,1,oak,10,20\n"    // 3
      ",1,oak,10,20\n"       // 4
      "1,101,oak,10,20\n"    // 5
      "-0.5,1,oak,10,20\n"   // 6
      "2,2,oak,tall,20\n"    // 7 kept
      "3,3,oak,-4,20\n"      // 8 kept
      "4,4,oak,900,20\n"     // 9 kept
      "5,5,oak,10,20,7,8\n"  // 10
      "6,6,oak,nan,inf\n"    // 11 kept: nan is missing, inf no number
      "1e999,6,oak,10,20\n"  // 12
      "100,50,oak,10,20\n"   // 13 the far corner belongs to the site
      "7,7\n",               // 14 the rest is missing
      options);
  std::vector<int> trees, lost, kept;
  for (const auto& t : inventory.trees) trees.push_back(t.line);
  for (const auto& p : inventory.problems) (p.kept ? kept : lost).push_back(p.line);
  EXPECT_EQ(trees, (std::vector<int>{2, 7, 8, 9, 11, 13, 14}));
  EXPECT_EQ(lost, (std::vector<int>{3, 4, 5, 6, 10, 12}));
  EXPECT_EQ(kept, (std::vector<int>{7, 8, 9, 11}));
  EXPECT_FALSE(inventory.trees[1].height_m);
  EXPECT_TRUE(inventory.trees[1].trunk_diameter_m);

  const auto lines = problem_lines(inventory.problems, "trees.csv");
  EXPECT_EQ(lines[0], "trees.csv:3: x_m is \"abc\", not a number; the row is left out");
  EXPECT_EQ(lines[1], "trees.csv:4: x_m is missing; the row is left out");
  EXPECT_EQ(lines[2], "trees.csv:5: position 1, 101 lies outside the site of 100 x 50 m; the row is left out");
  EXPECT_EQ(lines[4], "trees.csv:7: height_m is \"tall\", not a number; the tree is planted without it");
  EXPECT_EQ(lines[5], "trees.csv:8: height_m is -4, not above 0; the tree is planted without it");
  EXPECT_EQ(
      lines[6],
      "trees.csv:9: height_m is 900, which would be 900 m; at most 130 m are possible; the tree is planted without it");
  EXPECT_EQ(lines[7], "trees.csv:10: 7 fields, but the header has 5; the row is left out");
}

TEST(Inventory, LineNumbersCountBreaksInsideQuotes) {
  const Inventory inventory = parsed("x,y,species\n1,1,\"two\nlines\"\nbad,1,oak\n");
  ASSERT_EQ(inventory.problems.size(), 1u);
  EXPECT_EQ(inventory.problems[0].line, 4);
  EXPECT_EQ(inventory.trees[0].species, "two\nlines");
}

TEST(Inventory, ManyProblemsFoldButKeepAllTheirLines) {
  std::string text = "x,y\n";
  for (int i = 0; i < 143; ++i) text += "?!,1\n";
  const auto lines = problem_lines(parsed(text).problems, "trees.csv");
  ASSERT_EQ(lines.size(), 21u);
  EXPECT_TRUE(lines.back().starts_with("trees.csv: and 123 more, in lines 22, 23,")) << lines.back();
  EXPECT_TRUE(lines.back().ends_with(", 144"));
}

TEST(Inventory, PositionsAreMovedInDoubleBeforeAnythingIsRounded) {
  InventoryOptions options;
  options.south_west = DVec2(3512345.25, 5401234.5);
  const Inventory inventory = parsed("rechtswert;hochwert\n3512345,375;5401236,000\n", options);
  EXPECT_EQ(inventory.trees[0].plan, DVec2(0.125, 1.5));
}

TEST(Inventory, FilesThatAreNoInventoriesAreRefusedWithTheReason) {
  EXPECT_EQ(refused(""), "trees.csv is empty: a header row and a row for each tree are needed");
  EXPECT_NE(refused("a,b\n1,2\n")
                .find("no columns for the position found among a, b; usual names are x_m and y_m, or lon and lat"),
            std::string::npos);
  EXPECT_NE(refused("lon,y,species\n8,47,oak\n").find("no columns for the position"), std::string::npos);
  EXPECT_NE(refused(std::string_view("x,y\0,z", 6)).find("no text file"), std::string::npos);
  EXPECT_NE(refused("\xff\xfex\0y").find("UTF-16"), std::string::npos);
  const auto missing = read_inventory("/no/such/trees.csv");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "there is no file /no/such/trees.csv");
}

TEST(Inventory, Latin1IsTurnedIntoUtf8AndSaid) {
  const Inventory inventory = parsed("x,y,baumart\n1,2,S\xe4ulenhainbuche\n");
  EXPECT_EQ(inventory.trees[0].species, "S\xc3\xa4ulenhainbuche");
  EXPECT_EQ(inventory.notes, std::vector<std::string>{"not UTF-8, read as Latin-1"});
}

TEST(Inventory, ANumberBecomesTheSameInEveryLocale) {
  const char* german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  (void)german;  // where it is not installed the test still checks the reading
  EXPECT_EQ(parsed("x,y\n1.5,2.25\n").trees[0].plan, DVec2(1.5, 2.25));
  std::setlocale(LC_NUMERIC, "C");
}

TEST(Inventory, AnyTextIsReadOrRefusedButNeverHarmful) {
  const std::string alphabet = "x,y;\t\"\n\r1.5e-+\xc3\xa4\xff _m";
  RandomStream stream(11, 12, Purpose::statistics);
  for (int i = 0; i < 3000; ++i) {
    std::string text = i % 2 ? "x,y,species,dbh\n" : "";
    for (std::uint32_t n = stream.below(60); n > 0; --n)
      text += alphabet[stream.below(static_cast<std::uint32_t>(alphabet.size()))];
    const auto result = parse_inventory(text, "trees.csv");
    EXPECT_TRUE(result || !result.error().message.empty());
    if (!result) continue;
    for (const auto& tree : result->trees) EXPECT_TRUE(std::isfinite(tree.plan.x) && std::isfinite(tree.plan.y));
  }
}

TEST(Inventory, AnUnclosedQuoteCostsItsRowAlone) {
  for (const char* text : {"x,y,species,note\n1,1,oak,\"fine\"\n2,2,\"oak,\n3,3,ash,\n4,4,\"elm\",\n",
                           "x,y,species,note\n1,1,oak,\n2,2,\"oak,\n3,3,ash,\n4,4,elm,\n"}) {
    const Inventory inventory = parsed(text);
    ASSERT_EQ(inventory.trees.size(), 3u) << text;
    EXPECT_EQ(inventory.trees[1].species, "ash");
    EXPECT_EQ(inventory.trees[2].species, "elm");
    ASSERT_EQ(inventory.problems.size(), 1u);
    EXPECT_EQ(inventory.problems[0].line, 3);
    EXPECT_EQ(inventory.problems[0].reason, "a quote is not closed");
  }
}

TEST(Inventory, ColumnsAreFoundInGermanAndFrench) {
  const Inventory german = parsed(
      "Baumnummer;Rechtswert;Hochwert;Baumart;H\xc3\xb6he (m);Stammumfang (cm);Kronendurchmesser "
      "(m);Planung;Kronenansatz\n"
      "17;3,5;4;Stieleiche;12,5;125,66;8;zu f\xc3\xa4llen;2,5\n");
  ASSERT_EQ(german.trees.size(), 1u);
  const InventoryTree& a = german.trees[0];
  EXPECT_EQ(a.id, "17");
  EXPECT_EQ(a.plan, DVec2(3.5, 4));
  EXPECT_FLOAT_EQ(a.height_m.value_or(0), 12.5f);
  EXPECT_NEAR(a.trunk_diameter_m.value_or(0), 0.4f, 1e-4f);
  EXPECT_FLOAT_EQ(a.crown_diameter_m.value_or(0), 8.0f);
  EXPECT_EQ(a.status, scene::TreeStatus::to_remove);
  EXPECT_FLOAT_EQ(a.clear_stem_m.value_or(0), 2.5f);

  const Inventory french = parsed(
      "Num\xc3\xa9ro,X,Y,Esp\xc3\xa8"
      "ce,Hauteur (m),Circonf\xc3\xa9rence (cm),Diam\xc3\xa8tre couronne (m),Statut,\xc3\x82ge (ans)\n"
      "3,1,2,Tilleul,15,94.2478,6,prot\xc3\xa9g\xc3\xa9,60\n");
  ASSERT_EQ(french.trees.size(), 1u);
  const InventoryTree& b = french.trees[0];
  EXPECT_EQ(b.id, "3");
  EXPECT_EQ(b.species, "Tilleul");
  EXPECT_FLOAT_EQ(b.height_m.value_or(0), 15.0f);
  EXPECT_NEAR(b.trunk_diameter_m.value_or(0), 0.3f, 1e-5f);
  EXPECT_FLOAT_EQ(b.crown_diameter_m.value_or(0), 6.0f);
  EXPECT_EQ(b.status, scene::TreeStatus::to_protect);
  EXPECT_FLOAT_EQ(b.age_years.value_or(0), 60.0f);
}

TEST(Inventory, GenusSpeciesAndCultivarMayStandInColumnsOfTheirOwn) {
  const Inventory inventory =
      parsed("x,y,Gattung,Art,Sorte\n1,1,Acer,platanoides,Globosum\n2,2,Tilia,,\n3,3,Quercus,Quercus robur,\n");
  ASSERT_EQ(inventory.trees.size(), 3u);
  EXPECT_EQ(inventory.trees[0].species, "Acer platanoides 'Globosum'");
  EXPECT_EQ(inventory.trees[1].species, "Tilia");
  EXPECT_EQ(inventory.trees[2].species, "Quercus robur");
}

TEST(Inventory, UnitsMayBeSaidOrStandBehindTheNumber) {
  InventoryOptions options;
  options.units = {.position = "mm", .height = "ft", .trunk_diameter = "in", .crown_diameter = "", .clear_stem = ""};
  const Inventory said = parsed("x,y,height,dbh_cm\n1500,2500,10,10\n", options);
  EXPECT_EQ(said.trees.at(0).plan, DVec2(1.5, 2.5));
  EXPECT_NEAR(*said.trees[0].height_m, 3.048f, 1e-5f);
  EXPECT_NEAR(*said.trees[0].trunk_diameter_m, 0.254f, 1e-6f);

  const Inventory behind = parsed("x,y,height,dbh\n1,1,12 m,40 cm\n2,2,30',16\"\n3,3,9,0.3m\n4,4,8 furlongs,\n");
  ASSERT_EQ(behind.trees.size(), 4u);
  EXPECT_FLOAT_EQ(*behind.trees[0].height_m, 12.0f);
  EXPECT_FLOAT_EQ(*behind.trees[0].trunk_diameter_m, 0.4f);
  EXPECT_NEAR(*behind.trees[1].height_m, 9.144f, 1e-5f);
  EXPECT_NEAR(*behind.trees[1].trunk_diameter_m, 0.4064f, 1e-6f);
  EXPECT_FLOAT_EQ(*behind.trees[2].trunk_diameter_m, 0.3f);
  ASSERT_EQ(behind.problems.size(), 1u);
  EXPECT_EQ(behind.problems[0].reason, "height is \"8 furlongs\", not a number");

  options.units.height = "furlong";
  EXPECT_NE(refused("x,y,height\n1,1,2\n", options).find("none of m, cm, mm, in, ft"), std::string::npos);
}

TEST(Inventory, AClearStemAsHighAsItsTreeAndAnUnknownStatusAreReported) {
  const Inventory inventory = parsed("x,y,height_m,clear_stem_m,status,age\n1,1,8,9,dreamt of,-4\n2,2,8,0,,\n");
  ASSERT_EQ(inventory.trees.size(), 2u);
  EXPECT_FALSE(inventory.trees[0].clear_stem_m || inventory.trees[0].status || inventory.trees[0].age_years);
  EXPECT_FALSE(inventory.trees[1].clear_stem_m);
  ASSERT_EQ(inventory.problems.size(), 3u);
  for (const RowProblem& problem : inventory.problems) EXPECT_TRUE(problem.line == 2 && problem.kept);
}

TEST(Inventory, NumbersThatMayHaveThousandsAreNotGuessedAt) {
  const auto heights = [](const std::string& text) {
    const Inventory read = *parse_inventory(text, "t.csv");
    std::vector<float> out;
    for (const InventoryTree& tree : read.trees) out.push_back(tree.height_m.value_or(0));
    for (const RowProblem& p : read.problems) EXPECT_TRUE(p.reason.find("which may be") != std::string::npos);
    return std::pair(out, read.problems.size());
  };
  using Heights = std::vector<float>;
  // Decimal commas: 1.234 may be a thousand.
  EXPECT_EQ(heights("x;y;height\n1;1;12,5\n2;2;1.234\n3;3;8,25\n"), std::pair(Heights({12.5f, 0, 8.25f}), 1ul));
  EXPECT_EQ(heights("x,y,height\n1,1,\"12,5\"\n2,2,1.234\n"), std::pair(Heights({12.5f, 0}), 1ul));
  // Decimal points: 1,234 may be.
  EXPECT_EQ(heights("x;y;height\n1;1;12.5\n2;2;1,234\n"), std::pair(Heights({12.5f, 0}), 1ul));
  // Numbers that cannot have thousands tell what their column's marks mean.
  EXPECT_EQ(heights("x;y;height\n1;1;1,5\n2.1255;2;9,125\n4.250;4;10\n"), std::pair(Heights({1.5f, 9.125f, 10}), 0ul));
  EXPECT_EQ(heights("x;y;height\n1;1;1.234\n2;2;3.5\n"), std::pair(Heights({1.234f, 3.5f}), 0ul));
  EXPECT_EQ(heights("x;y;height\n1;1;0.750\n2;2;3,5\n"), std::pair(Heights({0.75f, 3.5f}), 0ul));
  const Inventory told = *parse_inventory("x;y;h\xc3\xb6he\n10,5;1;12,5\n4.321;2;1.234\n3,5;2;1.234\n", "t.csv");
  ASSERT_EQ(told.problems.size(), 2u);
  EXPECT_EQ(told.problems[0].line, 3);
  EXPECT_FALSE(told.problems[0].kept) << "a place cannot be guessed";
  EXPECT_EQ(told.problems[1].line, 4);
  EXPECT_EQ(told.problems[1].reason,
            "h\xc3\xb6he is \"1.234\", which may be 1234 or 1,234: the file's decimals stand behind a comma");
}

TEST(NumberText, MarksOfDecimalsAndThousandsAreToldApart) {
  const auto value = [](std::string_view text, bool comma = false) {
    const NumberText number = read_number(text, {comma, false, false});
    return number.reading == NumberReading::number ? number.value : std::nan("");
  };
  EXPECT_EQ(value("12.5"), 12.5);
  EXPECT_EQ(value("12,5"), 12.5);
  EXPECT_EQ(value("12,5", true), 12.5);
  EXPECT_EQ(value("1,234", true), 1.234);
  EXPECT_TRUE(std::isnan(value("1,234")));  // 1234 or 1.234: nobody knows
  EXPECT_EQ(value("1,234.5"), 1234.5);
  EXPECT_EQ(value("1.234,5", true), 1234.5);
  EXPECT_EQ(value("5'401'234.25"), 5401234.25);
  EXPECT_EQ(value("5 401 234,25", true), 5401234.25);
  EXPECT_EQ(value("5\xc2\xa0"
                  "401\xc2\xa0"
                  "234,25",
                  true),
            5401234.25);
  EXPECT_EQ(value("3.512.345"), 3512345);
  EXPECT_EQ(value("-1e3"), -1000);
  for (const char* text : {"1.2.3", "1,23,456", "12 34", "abc", "1e999", "nan m", "0x10", "--5", ",", ".", "5 6 7"})
    EXPECT_TRUE(std::isnan(value(text))) << text;
  for (const char* text : {"", "NA", "n/a", "?", "-", "unbekannt"})
    EXPECT_EQ(read_number(text, {}).reading, NumberReading::missing) << text;
}

TEST(Csv, EscapedQuotesAndEmptyFieldsComeOutAsWritten) {
  CsvReader reader("a,\"b \"\"c\"\"\",,\n\"\",x\n\"open", ',');
  std::vector<std::string> fields;
  ASSERT_TRUE(reader.next(fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"a", "b \"c\"", "", ""}));
  EXPECT_EQ(reader.line(), 1);
  ASSERT_TRUE(reader.next(fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"", "x"}));
  ASSERT_TRUE(reader.next(fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"open"}));
  EXPECT_EQ(reader.line(), 3);
  EXPECT_TRUE(reader.unclosed_quote());
  EXPECT_FALSE(reader.next(fields));
}

}  // namespace
}  // namespace bosquet::exchange
