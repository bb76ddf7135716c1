#include "scene/toml_table.h"

#include <gtest/gtest.h>

#include <array>

namespace bosquet::scene {
namespace {

enum class Shade { light, dark };
constexpr std::array<std::string_view, 2> kShadeNames{"light", "dark"};

struct Leaf {
  float length_m = 0.1f;
};
template <class Visitor>
void describe(Leaf& p, Visitor& visit) {
  visit(Real{"length_m", "m", 0.01, 1, "Length"}, p.length_m);
}

struct Sample {
  float angle_deg = 45.0f;
  int lobes = 3;
  bool evergreen = false;
  Shade shade = Shade::light;
  Vec3 colour{0.0f};
  std::string name = "none";
  std::vector<Leaf> leaves;
};
template <class Visitor>
void describe(Sample& p, Visitor& visit) {
  visit(Real{"angle_deg", "deg", 10, 120, "Angle"}, p.angle_deg);
  visit(Whole{"lobes", 1, 9, "Lobes"}, p.lobes);
  visit(Switch{"evergreen", "Keeps its leaves"}, p.evergreen);
  visit(Choice{"shade", kShadeNames, "Shade"}, p.shade);
  visit(Colour{"colour", "Colour"}, p.colour);
  visit(Text{"name", "Name"}, p.name);
  visit(Tables{"leaf", "Leaves"}, p.leaves);
}

Sample read(std::string_view text) {
  auto file = TomlFile::parse(text, "sample.toml");
  EXPECT_TRUE(file);
  Sample sample;
  TomlTable root = file->root();
  describe(sample, root);
  root.finish();
  auto fine = file->check();
  EXPECT_TRUE(fine) << fine.error().message;
  return sample;
}

std::string mistake_in(std::string_view text) {
  auto file = TomlFile::parse(text, "sample.toml");
  if (!file) return file.error().message;
  Sample sample;
  TomlTable root = file->root();
  describe(sample, root);
  root.finish();
  auto fine = file->check();
  return fine ? "" : fine.error().message;
}

TEST(TomlTable, ReadsEveryKindOfDescribedField) {
  const Sample s = read(
      "angle_deg = 60\nlobes = 5\nevergreen = true\nshade = 'dark'\ncolour = 'FF8000'\nname = 'oak'\n"
      "[[leaf]]\nlength_m = 0.2\n[[leaf]]\n");
  EXPECT_EQ(s.angle_deg, 60.0f);
  EXPECT_EQ(s.lobes, 5);
  EXPECT_TRUE(s.evergreen);
  EXPECT_EQ(s.shade, Shade::dark);
  EXPECT_EQ(s.colour, Vec3(1.0f, 128.0f / 255.0f, 0.0f));
  EXPECT_EQ(s.name, "oak");
  ASSERT_EQ(s.leaves.size(), 2u);
  EXPECT_EQ(s.leaves[0].length_m, 0.2f);
  EXPECT_EQ(s.leaves[1].length_m, 0.1f);
}

TEST(TomlTable, AKeyThatIsNotGivenKeepsItsDefault) {
  const Sample s = read("");
  EXPECT_EQ(s.angle_deg, 45.0f);
  EXPECT_EQ(s.lobes, 3);
}

TEST(TomlTable, AMistakeNamesFileLineKeyAndWhatIsAllowed) {
  EXPECT_EQ(mistake_in("lobes = 5\nangle_deg = 400\n"),
            "sample.toml:2: angle_deg = 400 is out of range; allowed: 10 to 120 deg");
  EXPECT_EQ(mistake_in("angle_deg = 'steep'"),
            "sample.toml:1: angle_deg must be a number from 10 to 120 deg, not a text");
  EXPECT_EQ(mistake_in("lobes = 2.5"), "sample.toml:1: lobes must be a whole number from 1 to 9, not 2.5");
  EXPECT_EQ(mistake_in("angle_deg = nan"), "sample.toml:1: angle_deg = nan is out of range; allowed: 10 to 120 deg");
  EXPECT_EQ(mistake_in("shade = 'dim'"), "sample.toml:1: shade = \"dim\" is not known; allowed: light, dark");
  EXPECT_EQ(mistake_in("colour = 'green'"),
            "sample.toml:1: colour = \"green\" must be a colour of six hex digits, like \"4F6B2C\"");
}

TEST(TomlTable, AMisspeltKeyIsRefusedWithTheNameThatWasMeant) {
  EXPECT_EQ(mistake_in("\nevergren = true"), "sample.toml:2: unknown key 'evergren'; did you mean 'evergreen'?");
  EXPECT_EQ(mistake_in("[[leaf]]\nlenght_m = 0.2"), "sample.toml:2: unknown key 'lenght_m'; did you mean 'length_m'?");
  EXPECT_NE(mistake_in("zzzzzzzzzzz = 1").find("known here: angle_deg"), std::string::npos);
}

TEST(TomlTable, TextThatIsNoTomlIsToldByLine) {
  EXPECT_EQ(mistake_in("a = 1\nb = \n").rfind("sample.toml:2: ", 0), 0u);
}

TEST(TomlTable, AbsurdNestingIsRefusedBeforeParsing) {
  EXPECT_NE(mistake_in("a = " + std::string(100'000, '[')).find("nest more than 64 deep"), std::string::npos);
  std::string dots = "a";
  for (int i = 0; i < 50'000; ++i) dots += ".a";
  EXPECT_NE(mistake_in(dots + " = 1").find("a key of more than"), std::string::npos);
}

TEST(TomlTable, BracketsAndDotsInCommentsTextsAndNumbersAreNoNesting) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "# from [0, 1)\n";
  text += "name = '[[[['\nmany = [";
  for (int i = 0; i < 3000; ++i) text += "1.5, ";
  EXPECT_TRUE(TomlFile::parse(text + "]\n", "sample.toml"));
}

TEST(TomlTable, PointsAndWeightsAreChecked) {
  auto file =
      TomlFile::parse("line = [[1, 2], [3, 4]]\nbad = [[1, 2], [3]]\nmix = { oak = 2, birch = 1 }\n", "sample.toml");
  TomlTable root = file->root();
  EXPECT_EQ(root.points("line"), (std::vector<Vec2>{{1, 2}, {3, 4}}));
  EXPECT_EQ(root.weights("mix")->size(), 2u);
  EXPECT_TRUE(file->check());
  EXPECT_FALSE(root.points("bad"));
  EXPECT_EQ(file->check().error().message,
            "sample.toml:2: bad must be a list of points in metres, like [[10, 20], [30, 25]]");
}

}  // namespace
}  // namespace bosquet::scene
