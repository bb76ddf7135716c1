#include "ui/session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ui/import_files.h"

namespace bosquet::ui {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("bosquet-session-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

using SessionTest = Files;
using Import = Files;

TEST_F(SessionTest, TheExampleParkIsThereWithoutAnyFile) {
  const auto park = make_example();
  ASSERT_TRUE(park) << park.error().message;
  EXPECT_GT(park->trees->size(), 200u);
  EXPECT_FALSE(park->cameras.empty());
}

TEST_F(SessionTest, EveryTemplateIsMade) {
  for (const std::string& name : template_names()) {
    const auto made = make_template(name);
    EXPECT_TRUE(made) << name << ": " << made.error().message;
  }
  EXPECT_FALSE(make_template("Jungle"));
}

TEST_F(SessionTest, AFileThatCannotBeOpenedLeavesTheDocumentAsItWas) {
  Session session({.journal = false, .recovery_folder = folder_});
  const auto before = session.document();
  const auto opened = session.open(write("broken.toml", "[site\n"));
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("broken.toml"), std::string::npos) << opened.error().message;
  EXPECT_FALSE(session.open(write("broken.bosquet", "no database")));
  EXPECT_EQ(session.document(), before);
  EXPECT_FALSE(session.unsaved());
}

TEST_F(Import, TreesOfAnInventoryComeAsOneEdit) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const auto edit = import_file(*site, ImportKind::trees,
                                write("trees.csv", "x,y,species,height_m\n10,12,silver birch,9\n30,40,oak,14\n"));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->name, "Import 2 trees");
  EXPECT_EQ(edit->document.trees->size(), site->trees->size() + 2);
}

TEST_F(Import, BuildingsComeFromOutlines) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const auto edit = import_file(*site, ImportKind::buildings, write("houses.geojson", R"({"type": "FeatureCollection",
    "features": [{"type": "Feature", "properties": {"name": "barn", "height": 6},
      "geometry": {"type": "Polygon", "coordinates": [[[10, 10], [20, 10], [20, 18], [10, 18], [10, 10]]]}}]})"));
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->name, "Import a building");
  EXPECT_EQ(edit->document.obstacles.size(), site->obstacles.size() + 1);
}

TEST_F(Import, AFileThatIsNeitherIsNamed) {
  const auto site = make_template("Meadow");
  ASSERT_TRUE(site);
  const std::filesystem::path file = write("notes.txt", "hello");
  for (const ImportKind kind : {ImportKind::ground, ImportKind::trees, ImportKind::buildings}) {
    const auto edit = import_file(*site, kind, file);
    ASSERT_FALSE(edit);
    EXPECT_NE(edit.error().message.find("notes.txt"), std::string::npos) << edit.error().message;
  }
}

}  // namespace
}  // namespace bosquet::ui
