#include "ui/preferences.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace bosquet::ui {
namespace {

TEST(Preferences, AreReadAsTheyWereWritten) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bosquet-preferences-test";
  std::filesystem::remove_all(folder);
  const std::filesystem::path file = folder / "made" / "window.json";
  Preferences chosen{Units::feet, false, {}};
  note_recent(chosen, "/parks/a \"quoted\" park.bosquet");
  note_recent(chosen, "/parks/k\xc3\xbcnstlich.toml");
  write_preferences(chosen, file);
  EXPECT_EQ(read_preferences(file), chosen);
  // Where nothing can be written nothing happens.
  std::filesystem::create_directories(folder / "in the way");
  write_preferences(chosen, folder / "in the way");
  EXPECT_EQ(read_preferences(folder / "in the way"), Preferences{});
  std::filesystem::remove_all(folder);
}

TEST(Preferences, OfABrokenFileWhatCanBeUnderstoodHolds) {
  for (const char* text : {"", "{", "null", "[1, 2]", "\xff\xfe{}", R"({"units": 3, "dark": "no", "recent": 7})",
                           R"({"units": "cubits", "recent": [1, {"a": []}]})"})
    EXPECT_EQ(preferences_of(text), Preferences{}) << text;
  const Preferences some = preferences_of(R"({"units": "feet", "dark": 0, "recent": [null, "/a.toml"]})");
  EXPECT_EQ(some.units, Units::feet);
  EXPECT_TRUE(some.dark);
  EXPECT_EQ(some.recent, std::vector<std::filesystem::path>{"/a.toml"});
}

TEST(Preferences, TheFileOpenedLastIsTheFirstOfAFewRecentOnes) {
  Preferences chosen;
  for (int i = 0; i < 20; ++i) note_recent(chosen, "/parks/" + std::to_string(i) + ".toml");
  note_recent(chosen, "/parks/x/../12.toml");
  ASSERT_EQ(chosen.recent.size(), kMostRecent);
  EXPECT_EQ(chosen.recent[0], "/parks/12.toml");
  EXPECT_EQ(chosen.recent[1], "/parks/19.toml");
  EXPECT_EQ(std::count(chosen.recent.begin(), chosen.recent.end(), "/parks/12.toml"), 1);
}

}  // namespace
}  // namespace bosquet::ui
