#include <gtest/gtest.h>

#include "tests/ui/imgui_page.h"
#include "ui/widgets/slider.h"
#include "ui/widgets/units.h"

namespace bosquet::ui {
namespace {

TEST(Units, LengthsAreToldInMetresOrInFeetAndInches) {
  EXPECT_EQ(length_words(12.5f, Units::metres), "12.5 m");
  EXPECT_EQ(length_words(12.5f, Units::metres, 2), "12.50 m");
  EXPECT_EQ(length_words(0.3048f, Units::feet), "1' 0\"");
  EXPECT_EQ(length_words(1.8f, Units::feet), "5' 11\"");
  EXPECT_EQ(length_words(3.65f, Units::feet), "12' 0\"");  // 11' 11.7" is no 11' 12"
  EXPECT_EQ(length_words(-0.5f, Units::feet), "-1' 8\"");
  EXPECT_EQ(length_words(400.0f, Units::feet), "1312'");
  EXPECT_EQ(area_words(100.0f, Units::feet), "1076 ft\xc2\xb2");
}

TEST(Slider, ALengthInFeetIsDraggedInFeetAndKeptInMetres) {
  test::ImGuiPage page;
  float metres = 1, feet = 1;
  const auto draw = [&] {
    ImGui::SetNextItemWidth(300);
    length_slider("In metres", metres, 0, 10, Units::metres);
    ImGui::SetNextItemWidth(300);
    length_slider("In feet", feet, 0, 10, Units::feet);
  };
  page.drag({40, 16}, {158, 16}, draw);
  page.drag({40, 38}, {158, 38}, draw);
  EXPECT_NEAR(metres, 5, 0.1f);
  EXPECT_NEAR(feet, metres, 0.05f);
  page.drag({40, 38}, {900, 38}, draw);
  EXPECT_FLOAT_EQ(feet, 10);
}

}  // namespace
}  // namespace bosquet::ui
