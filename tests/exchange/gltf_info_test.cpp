#include "exchange/gltf_info.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "exchange/gltf_writer.h"
#include "sample_model.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

TEST(GltfInfo, SaysWhatTheWriterPutIn) {
  const ScratchFolder folder;
  const scene::Model model = sample_model();
  for (const char* file : {"a.glb", "a.gltf"}) {
    const auto bytes = write_gltf(model, folder / file, {.version = "9"});
    ASSERT_TRUE(bytes);
    const auto info = read_gltf_info(folder / file);
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->generator, "Bosquet 9");
    EXPECT_EQ(info->triangles, count(model).triangles);
    EXPECT_EQ(info->vertices, count(model).vertices);
    EXPECT_EQ(info->file_bytes, std::filesystem::file_size(folder / file));
    EXPECT_EQ(info->meshes, 2u);
    EXPECT_EQ(info->materials, 3u);
    EXPECT_EQ(info->images, 3u);
    EXPECT_EQ(info->cameras, 2u);
    EXPECT_EQ(info->lights, 1u);
    EXPECT_EQ(info->extensions_used, std::vector<std::string>{"KHR_lights_punctual"});
    EXPECT_EQ(info->extras, (scene::Extras{{"seed", 12.0}, {"site", std::string("test \"site\"")}}));
    ASSERT_EQ(info->nodes.size(), model.nodes.size() + 3);
    const GltfNode& tree = info->nodes[3];
    EXPECT_EQ(tree.name, "english_oak-3");
    EXPECT_EQ(tree.triangles, 216u);
    EXPECT_EQ(Vec3(tree.translation), Vec3(2, 0.1f, -6));
    EXPECT_EQ(tree.extras, (scene::Extras{{"height_m", 6.0}, {"id", 3.0}, {"species", std::string("english_oak")}}));
  }
}

TEST(GltfInfo, CountsTheMeshesThatHaveWindWeights) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_gltf(sample_model(), folder / "still.glb"));
  EXPECT_EQ(read_gltf_info(folder / "still.glb")->wind_meshes, 0u);
  ASSERT_TRUE(write_gltf(windy_model(), folder / "windy.glb"));
  EXPECT_EQ(read_gltf_info(folder / "windy.glb")->wind_meshes, 1u);  // that all trees share
}

class Hostile : public ::testing::Test {
 protected:
  std::string message(std::string_view content) {
    spit(folder_ / "bad.gltf", content);
    const auto info = read_gltf_info(folder_ / "bad.gltf");
    return info ? "" : info.error().message;
  }
  Result<GltfInfo> info(std::string_view content) {
    spit(folder_ / "bad.gltf", content);
    return read_gltf_info(folder_ / "bad.gltf");
  }
  const ScratchFolder folder_;
};

TEST_F(Hostile, WhatIsNoGltfIsRefusedByName) {
  for (std::string_view content : {"", "x", "{", "[]", "{}", R"({"asset":{}})", R"({"asset":{"version":"1.0"}})",
                                   R"({"asset":{"version":2}})", "glTF", "glTF\x02\x00\x00\x00", "\xff\xfe\x00"})
    EXPECT_NE(message(content).find("bad.gltf"), std::string::npos) << content;
  const auto missing = read_gltf_info(folder_ / "none.glb");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("there is no file"), std::string::npos);
  EXPECT_FALSE(read_gltf_info(folder_.path()));
}

TEST_F(Hostile, DeepNestingIsRefused) {
  std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(1'000'000, '[');
  EXPECT_NE(message(deep).find("nested"), std::string::npos);
  // Brackets in a text nest nothing.
  EXPECT_EQ(message(R"({"asset":{"version":"2.0","generator":")" + std::string(1000, '[') + R"("}})"), "");
}

TEST_F(Hostile, IndicesOutOfRangeAndWrongTypesCountNothing) {
  const auto result = info(R"({"asset":{"version":"2.0"},"scene":99,"scenes":{"a":1},
    "accessors":[{"count":-4},{"count":1e300},{"count":18446744073709551615},{"count":"9"}, 7],
    "meshes":[{"primitives":[{"attributes":{"POSITION":12}},{"attributes":{"POSITION":-1}},{"attributes":[0]},
                              {"attributes":{"POSITION":2}},{"attributes":{"POSITION":2},"indices":2},{"mode":{}} ,5]}, 3],
    "nodes":[{"mesh":0,"translation":[1,"x",3]},{"mesh":0},{"mesh":7},{"mesh":-1},{"mesh":"0"},{"name":5,"extras":[1]},8]})");
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->nodes.size(), 7u);
  EXPECT_EQ(result->nodes[0].translation, DVec3(1, 0, 3));
  EXPECT_EQ(result->triangles, 18446744073709551615ull) << "sums saturate";
  EXPECT_EQ(result->nodes[2].triangles, 0u);
  EXPECT_EQ(result->vertices, 18446744073709551615ull);
}

TEST_F(Hostile, AnyByteOfAGoodFileMayBeWrong) {
  ASSERT_TRUE(write_gltf(sample_model(), folder_ / "good.glb"));
  const std::string good = slurp(folder_ / "good.glb");
  RandomStream stream(8, 9, Purpose::statistics);
  for (int i = 0; i < 500; ++i) {
    std::string bad = good;
    // Mostly the header and the JSON, which is all that is read.
    bad[stream.below(static_cast<std::uint32_t>(std::min<std::size_t>(bad.size(), 4000)))] ^=
        static_cast<char>(1 + stream.below(255));
    if (i % 5 == 0) bad.resize(stream.below(static_cast<std::uint32_t>(bad.size())));
    const auto result = info(bad);
    EXPECT_TRUE(result || !result.error().message.empty());
  }
}

}  // namespace
}  // namespace bosquet::exchange
