// Every example from its recipe to its file, judged by the Khronos validator and, for the river bank, by three.js.
#include "tests/cli/program.h"

namespace bosquet {
namespace {

struct Example {
  const char* name;
  std::size_t trees;
  std::uintmax_t most_bytes;
};

class Examples : public ProgramTest, public ::testing::WithParamInterface<Example> {
 protected:
  void SetUp() override {
    // One folder an example: a parameter's name holds a slash.
    folder_ = std::filesystem::temp_directory_path() /
              ("bosquet-example-" + std::filesystem::path(GetParam().name).stem().string());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
};

TEST_P(Examples, GrowsWithinItsSizeAndIsValidGltf) {
  const Example& example = GetParam();
  const Ran made = bosquet("make '" + source("examples/" + std::string(example.name) + ".toml") +
                           "' -o out.glb --report report.json --quiet");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(json("report.json")["trees"], example.trees);
  EXPECT_LT(std::filesystem::file_size(folder_ / "out.glb"), example.most_bytes);
  const Ran judged = shell("node '" + source("tests/web/validate.mjs") + "' out.glb");
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
}

constexpr std::uintmax_t kMega = 1'000'000;
INSTANTIATE_TEST_SUITE_P(
    All, Examples,
    ::testing::Values(Example{"riverbank", 252, 150 * kMega}, Example{"single_oak", 1, 100 * kMega},
                      Example{"single_birch", 1, 100 * kMega}, Example{"single_spruce", 1, 100 * kMega},
                      Example{"single_willow", 1, 100 * kMega}, Example{"facade", 7, 150 * kMega},
                      Example{"avenue", 665, 150 * kMega}, Example{"park", 283, 150 * kMega},
                      Example{"existing_site", 183, 150 * kMega}, Example{"giant", 13, 150 * kMega},
                      Example{"closed_stand", 99, 150 * kMega}, Example{"plots/plot_10", 10, 150 * kMega},
                      Example{"plots/plot_30", 30, 150 * kMega}, Example{"plots/plot_100", 100, 150 * kMega},
                      Example{"plots/plot_300", 300, 150 * kMega}, Example{"lansing_woods", 2251, 400 * kMega},
                      Example{"barro_colorado", 3604, 400 * kMega}),
    [](const auto& test) { return std::filesystem::path(test.param.name).stem().string(); });

}  // namespace
}  // namespace bosquet
