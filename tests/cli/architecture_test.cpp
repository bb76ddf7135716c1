// The walls of the house: which folder may include which, and what bit-equal stages may call.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace bosquet {
namespace {

using Names = std::set<std::string>;

// docs/architecture.md, the table of folders.
const std::map<std::string, Names> kMayInclude{
    {"core", {}},
    {"terrain", {"core"}},
    {"distribution", {"core", "terrain"}},
    {"crowns", {"core", "terrain"}},
    {"growth", {"core", "crowns"}},
    {"geometry", {"core", "terrain", "growth"}},
    {"scene", {"core", "terrain", "distribution", "crowns", "growth", "geometry"}},
    {"exchange", {"core", "terrain", "distribution", "crowns", "growth", "geometry", "scene"}},
    {"render", {"core", "terrain", "crowns", "growth", "geometry", "scene"}},
    {"ui", {"core", "terrain", "distribution", "crowns", "growth", "geometry", "scene", "exchange", "render"}},
    {"cli", {"core", "terrain", "distribution", "crowns", "growth", "geometry", "scene", "exchange", "render", "ui"}}};

void for_each_line(const std::string& folder,
                   const std::function<void(const std::string& file, int number, const std::string& line)>& visit) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::string(BOSQUET_SOURCE_DIR) + "/" + folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) visit(entry.path().string(), number, line);
  }
}

TEST(Architecture, NoIncludeRunsBackUp) {
  const std::regex include("^\\s*#include \"([a-z]+)/[^\"]+\"");
  int includes = 0;
  for (const auto& [folder, allowed] : kMayInclude)
    for_each_line(folder,
                  [&, own = folder, &may = allowed](const std::string& file, int number, const std::string& line) {
                    std::smatch match;
                    if (!std::regex_search(line, match, include)) return;
                    ++includes;
                    EXPECT_TRUE(match[1] == own || may.count(match[1])) << file << ":" << number << ": " << line;
                  });
  EXPECT_GT(includes, 100);
}

TEST(Architecture, BitEqualStagesCallNoFunctionWhoseBitsDependOnTheMachine) {
  const std::regex forbidden(
      "\\b(std|glm)::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|"
      "hypot|rotate|angleAxis|tgamma|lgamma|erf)f?\\(");
  for (const char* folder : {"terrain", "distribution", "crowns", "growth", "geometry", "scene"})
    for_each_line(folder, [&](const std::string& file, int number, const std::string& line) {
      if (std::filesystem::path(file).stem() == "pattern") return;  // statistics promise no bits
      EXPECT_FALSE(std::regex_search(line, forbidden)) << file << ":" << number << ": " << line;
    });
}

TEST(Architecture, HeavyHeadersStayInTheSourcesOfTheirFolders) {
  const std::map<std::string, std::string> home{{"openvdb/", "crowns"}, {"gdal", "exchange"}, {"tiny_gltf", "exchange"},
                                                {"toml++", "scene"},    {"CLI/", "cli"},      {"tbb/", "core"},
                                                {"GL/", "render"},      {"EGL/", "render"},  {"sqlite3", "scene"}};
  for (const auto& [folder, allowed] : kMayInclude)
    for_each_line(folder, [&, own = folder](const std::string& file, int number, const std::string& line) {
      if (line.rfind("#include <", 0) != 0) return;
      for (const auto& [header, owner] : home)
        if (line.find("<" + header) != std::string::npos) {
          EXPECT_EQ(own, owner) << file << ":" << number << ": " << line;
          EXPECT_TRUE(std::filesystem::path(file).extension() == ".cpp" || owner == "render")
              << file << ":" << number << ": " << line;
        }
    });
}

}  // namespace
}  // namespace bosquet
