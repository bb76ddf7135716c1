#include "exchange/world_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "exchange/image_file.h"
#include "exchange/recipe.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

class WorldFile : public ::testing::Test {
 protected:
  // A plan of 400 by 200 pixels with a world file beside it.
  std::filesystem::path plan(const std::string& numbers, const std::string& name = "plan.pgw") {
    EXPECT_TRUE(write_image(folder_ / "plan.png", Image(400, 200, 3)));
    std::ofstream(folder_ / name) << numbers;
    return folder_ / "plan.png";
  }
  ScratchFolder folder_;
};

// Half a metre a pixel; the picture's corners are at 500010, 5400020 and 500210, 5400120.
constexpr const char* kLaid = "0.5\n0.0\n0.0\n-0.5\n500010.25\n5400119.75\n";

TEST_F(WorldFile, TellsThePlaceOfThePicture) {
  const auto place = read_world_file(*world_file_of(plan(kLaid)), 400, 200);
  ASSERT_TRUE(place) << place.error().message;
  EXPECT_EQ(place->south_west, DVec2(500010, 5400020));
  EXPECT_EQ(place->width, 200);
  EXPECT_TRUE(place->notes.empty());
}

TEST_F(WorldFile, IsFoundByAnyOfItsUsualNames) {
  EXPECT_FALSE(world_file_of(folder_ / "plan.png"));
  for (const char* name : {"plan.wld", "PLAN.PNGW", "plan.PGW"}) {
    plan(kLaid, name);
    EXPECT_EQ(world_file_of(folder_ / "plan.png"), folder_ / name);
  }
  plan(kLaid, "map.jgw");
  EXPECT_EQ(world_file_of(folder_ / "map.jpg"), folder_ / "map.jgw");
  EXPECT_EQ(world_file_of(folder_ / "map.jpeg"), folder_ / "map.jgw");
  EXPECT_FALSE(world_file_of(folder_ / "map.png"));
}

TEST_F(WorldFile, ATurnedPictureKeepsItsMiddleAndIsToldOf) {
  // By 30 degrees about the upper left pixel.
  const auto place =
      read_world_file(*world_file_of(plan("0.4330127 0.25 0.25 -0.4330127\r\n+1000 2000\r\n")), 400, 200);
  ASSERT_TRUE(place) << place.error().message;
  EXPECT_NEAR(place->width, 200, 1e-4);
  const DVec2 middle = place->south_west + 0.5 * DVec2(200, 100);
  EXPECT_NEAR(middle.x, 1000 + 0.4330127 * 199.5 + 0.25 * 99.5, 1e-4);
  EXPECT_NEAR(middle.y, 2000 + 0.25 * 199.5 - 0.4330127 * 99.5, 1e-4);
  ASSERT_EQ(place->notes.size(), 1u);
  EXPECT_NE(place->notes[0].find("turned by 30.00 degrees"), std::string::npos) << place->notes[0];
}

TEST_F(WorldFile, ThatIsNoneIsNamed) {
  for (const char* text : {"", "1 2 3", "0.5 0 0 -0.5 10 20 30", "0,5 0 0 -0,5 10 20", "nan 0 0 -1 0 0", "1 0 0 1 0 0",
                           "0 0 0 0 0 0", "1e-5 0 0 -1e-5 9.1 48.7", "1e9 0 0 -1e9 0 0"}) {
    const auto place = read_world_file(*world_file_of(plan(text)), 400, 200);
    ASSERT_FALSE(place) << text;
    EXPECT_NE(place.error().message.find("plan.pgw"), std::string::npos) << place.error().message;
  }
}

TEST_F(WorldFile, LaysTheUnderlayOfARecipeThatGivesNoWidth) {
  plan(kLaid);
  const auto built = [&](const std::string& site, const std::string& more) {
    std::ofstream(folder_ / "site.toml") << "[site]\nsize_m = [150, 100]\n" + site +
                                                "[underlay]\nfile = \"plan.png\"\n" + more;
    const auto recipe = read_recipe(folder_ / "site.toml");
    EXPECT_TRUE(recipe) << recipe.error().message;
    auto document = build_document(*recipe);
    EXPECT_TRUE(document) << document.error().message;
    return std::move(*document);
  };
  const std::string here = "south_west = [500030, 5400000]\ncrs = \"EPSG:25832\"\n";
  const BuiltRecipe on_map = built(here, "");
  EXPECT_EQ(on_map.document.underlay.south_west, DVec2(-20, 20));
  EXPECT_EQ(on_map.document.underlay.width_m, 200);
  EXPECT_TRUE(on_map.warnings.empty()) << on_map.warnings[0];
  // What the recipe says holds.
  EXPECT_EQ(built(here, "south_west = [3, 4]\n").document.underlay.south_west, DVec2(3, 4));
  EXPECT_EQ(built(here, "width_m = 70\n").document.underlay.south_west, DVec2(0, 0));
  const BuiltRecipe nowhere = built("", "");
  EXPECT_EQ(nowhere.document.underlay.south_west, DVec2(0, 0));
  EXPECT_EQ(nowhere.document.underlay.width_m, 200);
  ASSERT_EQ(nowhere.warnings.size(), 1u);
  EXPECT_NE(nowhere.warnings[0].find("which lies nowhere on the map"), std::string::npos) << nowhere.warnings[0];
  std::filesystem::remove(folder_ / "plan.pgw");
  const auto lacks = read_recipe(folder_ / "site.toml");
  ASSERT_FALSE(lacks);
  EXPECT_NE(lacks.error().message.find("world file"), std::string::npos) << lacks.error().message;
}

}  // namespace
}  // namespace bosquet::exchange
