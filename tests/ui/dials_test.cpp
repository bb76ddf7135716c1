#include "ui/widgets/dials.h"

#include <gtest/gtest.h>

#include "scene/species.h"
#include "tests/ui/imgui_page.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/schematic_tree.h"

namespace bosquet::ui {
namespace {

constexpr float kSize = 200;
// Where the window's padding puts the first item.
constexpr float kPad = 8;

TEST(Dials, AnArrowDraggedLevelMeansNinetyDegrees) {
  test::ImGuiPage page;
  float angle = 30;
  const auto draw = [&] { tropism_arrow("arrow", angle, kSize); };
  const ImVec2 fork(kPad + 100 - 35, kPad + 110);
  page.drag({fork.x + 20, fork.y - 40}, {fork.x + 80, fork.y}, draw);
  EXPECT_FLOAT_EQ(angle, 90);
  page.drag({fork.x + 80, fork.y}, {fork.x + 1, fork.y + 90}, draw);
  EXPECT_NEAR(angle, 180, 1);
  page.drag({fork.x, fork.y + 60}, {fork.x, fork.y - 500}, draw);
  EXPECT_FLOAT_EQ(angle, 0);
}

TEST(Dials, TheNearerOfTwoAnglesIsDragged) {
  test::ImGuiPage page;
  float psi = 50, delta = 10;
  const auto draw = [&] { branching_angles("angles", psi, delta, kSize); };
  const ImVec2 fork(kPad + 100, kPad + 135);
  const auto at = [&](float degrees_from_upright, float reach) {
    const float a = radians(degrees_from_upright);
    return ImVec2(fork.x + reach * sin_cos(a).sin, fork.y - reach * sin_cos(a).cos);
  };
  page.drag(at(50, 89), at(80, 89), draw);
  EXPECT_NEAR(psi, 80, 1);
  EXPECT_FLOAT_EQ(delta, 10);
  page.drag(at(-10, 105), at(-30, 100), draw);
  EXPECT_NEAR(psi, 80, 1);
  EXPECT_NEAR(delta, 30, 1);
  page.drag(at(-30, 100), at(-89, 60), draw);
  EXPECT_FLOAT_EQ(delta, 45);
}

TEST(Dials, WeightsAlwaysSumToOne) {
  test::ImGuiPage page;
  float a = 0.5f, b = 0.2f, g = 0.3f;
  const auto draw = [&] { weights_triangle("weights", a, b, g, kSize); };
  for (const ImVec2 to : {ImVec2(108, 20), ImVec2(10, 190), ImVec2(205, 195), ImVec2(108, 130), ImVec2(-300, 50)}) {
    page.drag({108, 120}, to, draw);
    EXPECT_NEAR(a + b + g, 1.0f, 1e-6f);
    EXPECT_GE(std::min({a, b, g}), 0.0f);
  }
  page.drag({108, 120}, {108, 10}, draw);
  EXPECT_FLOAT_EQ(a, 1.0f);
}

TEST(Dials, TheBudEllipseKeepsItsAxisInside) {
  test::ImGuiPage page;
  float vertical = 1, level = 1, offset = 0;
  const auto draw = [&] { bud_ellipse("ellipse", vertical, level, offset, kSize); };
  const float unit = 100 / 2.2f;
  const ImVec2 centre(kPad + 100, kPad + 100);
  // The middle far up: it stops where the axis would leave the ellipse.
  page.drag(centre, {centre.x, centre.y - 400}, draw);
  EXPECT_LT(offset, vertical);
  EXPECT_GT(offset, 0.5f);
  // Then the top down: the same holds.
  page.drag({centre.x, centre.y - unit * (offset + vertical)}, {centre.x, centre.y + 300}, draw);
  EXPECT_GT(vertical, offset);
  page.drag({centre.x + unit * level, centre.y - unit * offset}, {centre.x + unit * 2, centre.y}, draw);
  EXPECT_NEAR(level, 2, 0.06f);
}

TEST(Fields, SayTheirNamesAsPeopleReadThem) {
  EXPECT_EQ(label_of("set_point_angle_deg", "deg"), "Set point angle");
  EXPECT_EQ(label_of("internode_length_m", "m"), "Internode length (m)");
  EXPECT_EQ(label_of("every_node"), "Every node");
}

TEST(Fields, ADragInASliderChangesItsNumberWithinTheRange) {
  test::ImGuiPage page;
  growth::Parameters p;
  bool changed = false;
  const auto draw = [&] {
    changed |= real_field(Real{"set_point_angle_deg", "deg", 0, 180, "Angle"}, p.set_point_angle_deg);
  };
  page.drag({100, 15}, {5000, 15}, draw);
  EXPECT_TRUE(changed);
  EXPECT_FLOAT_EQ(p.set_point_angle_deg, 180);
}

TEST(SchematicTree, GrowsAgainOnlyWhenTheParametersChanged) {
  growth::Parameters p;
  SchematicTree tree;
  tree.set(p);
  const std::size_t first = tree.skeleton().size();
  ASSERT_GT(first, 50u);
  const Vec3* before = tree.skeleton().distal.data();
  tree.set(p);
  EXPECT_EQ(tree.skeleton().distal.data(), before);
  p.branching_angle_deg = 85;
  tree.set(p);
  EXPECT_NE(tree.skeleton().distal.data(), before);
  // Wrong numbers are not grown.
  const std::size_t second = tree.skeleton().size();
  p.straightness = 5;
  tree.set(p);
  EXPECT_EQ(tree.skeleton().size(), second);
}

TEST(SchematicTree, EverySpeciesShowsAHabitOfSomeHundredInternodes) {
  for (const std::string& name : scene::builtin_species_names()) {
    const auto species = scene::builtin_species(name);
    ASSERT_TRUE(species);
    SchematicTree tree;
    tree.set(species->growth);
    EXPECT_GT(tree.skeleton().size(), 40u) << name;
    EXPECT_LT(tree.skeleton().size(), 20000u) << name;
  }
}

}  // namespace
}  // namespace bosquet::ui
