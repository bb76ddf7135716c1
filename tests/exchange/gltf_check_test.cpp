#include "exchange/gltf_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/random.h"
#include "exchange/gltf_info.h"
#include "exchange/gltf_writer.h"
#include "sample_model.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

using Json = nlohmann::ordered_json;

scene::Model leveled_model() {
  scene::Model model = sample_model();
  for (std::size_t i = 1; i < 4; ++i) {
    model.nodes[i].coverage = 0.5f;
    model.nodes[i].coarser = {{{model.nodes[i].parts[1]}, 0.1f}, {{model.nodes[i].parts[0]}, 0.0f}};
  }
  return model;
}

// Everything that a file may have: instances, packed data, levels.
GltfOptions all_at_once() {
  GltfOptions options;
  options.instancing = true, options.compression = Compression::meshopt, options.lod = LodFiles::msft;
  return options;
}

class GltfCheckTest : public ::testing::Test {
 protected:
  void SetUp() override { write(all_at_once()); }
  void write(const GltfOptions& options) { ASSERT_TRUE(write_gltf(leveled_model(), folder_ / "a.glb", options)); }

  GltfCheck checked(const char* name = "a.glb") {
    auto check = check_gltf(folder_ / name);
    EXPECT_TRUE(check) << check.error().message;
    return check ? *check : GltfCheck{};
  }

  // The file with its JSON changed.
  GltfCheck after(const std::function<void(Json&)>& change) {
    const std::string bytes = slurp(folder_ / "a.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    Json json = Json::parse(bytes.substr(20, length));
    change(json);
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = bytes.substr(0, 20) + text + bytes.substr(20 + length);
    const auto put = [&](std::size_t at, std::size_t value) {
      const auto word = static_cast<std::uint32_t>(value);
      std::memcpy(out.data() + at, &word, 4);
    };
    put(8, out.size()), put(12, text.size());
    spit(folder_ / "b.glb", out);
    return checked("b.glb");
  }

  // Whether some fault speaks of this.
  static ::testing::AssertionResult says(const GltfCheck& check, const std::string& words) {
    for (const std::string& fault : check.faults)
      if (fault.find(words) != std::string::npos) return ::testing::AssertionSuccess();
    std::string all;
    for (const std::string& fault : check.faults) all += "\n  " + fault;
    return ::testing::AssertionFailure() << "nothing about '" << words << "' in:" << all;
  }

  const ScratchFolder folder_;
};

TEST_F(GltfCheckTest, OurOwnFilesHaveNoFaults) {
  for (bool instancing : {false, true})
    for (Compression compression : {Compression::none, Compression::quantize, Compression::meshopt})
      for (LodFiles lod : {LodFiles::none, LodFiles::nodes, LodFiles::msft})
        for (const char* file : {"c.glb", "c.gltf"}) {
          GltfOptions options;
          options.instancing = instancing, options.compression = compression, options.lod = lod;
          ASSERT_TRUE(write_gltf(leveled_model(), folder_ / file, options));
          const GltfCheck check = checked(file);
          EXPECT_TRUE(check.good()) << file << ": " << check.faults.front();
          EXPECT_EQ(read_gltf_info(folder_ / file)->triangles, count(leveled_model()).triangles)
              << "coarser levels are not drawn beside the finest";
          EXPECT_EQ(check.instances > 0, instancing);
          EXPECT_EQ(check.packed_views > 0, compression == Compression::meshopt);
          EXPECT_EQ(check.nodes_with_levels, lod == LodFiles::msft ? 3u : 0u);
        }
}

TEST_F(GltfCheckTest, WindWeightsAreFourSharesOfOne) {
  ASSERT_TRUE(write_gltf(windy_model(), folder_ / "a.glb"));
  EXPECT_TRUE(checked().good());
  const auto trunk = [](Json& json) -> Json& { return json["meshes"][1]["primitives"][0]["attributes"]; };
  EXPECT_TRUE(
      says(after([&](Json& json) { json["accessors"][trunk(json)["_WIND"].get<std::size_t>()].erase("normalized"); }),
           "(_WIND): four floats, normalized bytes"));
  EXPECT_TRUE(says(after([&](Json& json) { trunk(json)["_WIND"] = trunk(json)["NORMAL"]; }), "(_WIND): four floats"));
  // Tangents are four floats, some below 0.
  EXPECT_TRUE(
      says(after([&](Json& json) { trunk(json)["_WIND"] = trunk(json)["TANGENT"]; }), "does not lie in 0 to 1"));
  EXPECT_TRUE(says(after([&](Json& json) {
                     --json["accessors"][trunk(json)["_WIND"].get<std::size_t>()]["count"].get_ref<std::int64_t&>();
                   }),
                   "_WIND has"));
}

TEST_F(GltfCheckTest, GarbageInPackedDataIsFound) {
  std::string bytes = slurp(folder_ / "a.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  // All of the packed positions' view.
  std::fill_n(bytes.begin() + 28 + length, 200, '\x55');
  spit(folder_ / "a.glb", bytes);
  EXPECT_TRUE(says(checked(), "cannot be unpacked"));
}

TEST_F(GltfCheckTest, FlippedBitsInPackedDataAreReadSafelyAndSometimesFound) {
  // The codecs have no checksums: a flip may unpack to other numbers within the bounds. Sanitizers watch the reading.
  const std::string bytes = slurp(folder_ / "a.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  RandomStream random(1, 2, Purpose::statistics);
  std::size_t found = 0;
  for (int k = 0; k < 200; ++k) {
    std::string bad = bytes;
    const std::size_t at =
        28 + length + random.below(std::min(4000u, static_cast<std::uint32_t>(bytes.size()) - 28 - length));
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    spit(folder_ / "b.glb", bad);
    found += !checked("b.glb").good();
  }
  EXPECT_GT(found, 5u);
}

TEST_F(GltfCheckTest, InstancesMustExistAgreeAndBeRequired) {
  const auto first = [](Json& json) -> Json& {
    for (Json& node : json["nodes"])
      if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing"))
        return node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    throw std::runtime_error("no instances");
  };
  EXPECT_TRUE(says(after([&](Json& j) { first(j)["TRANSLATION"] = 9999; }), "there is no accessor 9999"));
  EXPECT_TRUE(says(after([&](Json& j) { first(j)["TRANSLATION"] = -1; }), "there is no accessor -1"));
  EXPECT_TRUE(says(after([&](Json& j) { first(j)["ROTATION"] = first(j)["SCALE"]; }), "ROTATION has four floats"));
  EXPECT_TRUE(says(after([&](Json& j) { first(j)["Colour"] = first(j)["SCALE"]; }), "own names begin with _"));
  EXPECT_TRUE(
      says(after([&](Json& j) { j["accessors"][first(j)["SCALE"].get<std::size_t>()]["count"] = 3; }), "others for"));
  EXPECT_TRUE(says(after([&](Json& j) { first(j) = Json::object(); }), "there are no attributes"));
  EXPECT_TRUE(says(after([](Json& j) { j["extensionsRequired"] = {"EXT_meshopt_compression"}; }),
                   "EXT_mesh_gpu_instancing is not listed as required"));
  EXPECT_TRUE(says(after([](Json& j) { j["extensionsUsed"] = {"KHR_lights_punctual"}; }), "is not listed as used"));
  EXPECT_TRUE(says(after([&](Json& j) {
                     for (Json& node : j["nodes"])
                       if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing"))
                         node.erase("mesh");
                   }),
                   "the node has no mesh"));
}

TEST_F(GltfCheckTest, RotationsMustHaveUnitLength) {
  GltfOptions options;
  options.instancing = true;
  write(options);
  // Sizes taken for places are fine, quaternions that are no rotations not: let ROTATION read colours of vertices.
  EXPECT_TRUE(
      says(after([](Json& j) {
             for (Json& node : j["nodes"]) {
               if (!node.contains("extensions") || !node["extensions"].contains("EXT_mesh_gpu_instancing")) continue;
               Json& a = j["accessors"]
                          [node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"].get<std::size_t>()];
               a["byteOffset"] = a.value("byteOffset", 0) + 4;
               a["count"] = a["count"].get<int>() - 1;
             }
           }),
           "has length"));
}

TEST_F(GltfCheckTest, LevelsMustExistAndLeadNowhereBack) {
  const auto leveled = [](Json& json, std::size_t skip) -> Json& {
    for (Json& node : json["nodes"])
      if (node.contains("extensions") && node["extensions"].contains("MSFT_lod") && skip-- == 0) return node;
    throw std::runtime_error("no levels");
  };
  const auto ids = [&](Json& json) -> Json& { return leveled(json, 0)["extensions"]["MSFT_lod"]["ids"]; };
  EXPECT_TRUE(says(after([&](Json& j) { ids(j)[0] = 1000; }), "there is no node 1000"));
  EXPECT_TRUE(says(after([&](Json& j) { ids(j)[0] = ids(j)[1]; }), "stands there twice"));
  EXPECT_TRUE(says(after([&](Json& j) { ids(j) = Json::array(); }), "there are no ids"));
  EXPECT_TRUE(says(after([&](Json& j) {
                     const auto self =
                         std::find(j["nodes"].begin(), j["nodes"].end(), leveled(j, 0)) - j["nodes"].begin();
                     ids(j)[0] = self;
                   }),
                   "a coarser level of itself"));
  EXPECT_TRUE(says(after([&](Json& j) {
                     // The first tree's level has levels itself: the first tree.
                     const auto self =
                         std::find(j["nodes"].begin(), j["nodes"].end(), leveled(j, 0)) - j["nodes"].begin();
                     j["nodes"][ids(j)[0].get<std::size_t>()]["extensions"]["MSFT_lod"]["ids"] = {self};
                   }),
                   "lead back to it"));
  EXPECT_TRUE(says(after([&](Json& j) { leveled(j, 0)["extras"]["MSFT_screencoverage"] = {0.5}; }),
                   "1 screen coverages for 3 levels"));
  EXPECT_TRUE(says(after([&](Json& j) {
                     leveled(j, 1)["extras"]["MSFT_screencoverage"] = {0.1, 0.5, 0.0};
                   }),
                   "they fall from level to level"));
}

TEST_F(GltfCheckTest, WhatDoesNotFitIsFound) {
  write({});
  EXPECT_TRUE(says(after([](Json& j) { j["bufferViews"][0]["byteLength"] = 99'999'999; }), "of a buffer of"));
  EXPECT_TRUE(
      says(after([](Json& j) { j["bufferViews"][0]["byteOffset"] = 0xffff'ffff'ffff'fff0ull; }), "of a buffer of"));
  EXPECT_TRUE(says(after([](Json& j) { j["accessors"][0]["count"] = 0x7fff'ffff'ffff'ffffll; }), "do not fit a view"));
  EXPECT_TRUE(says(after([](Json& j) { j["accessors"][0]["count"] = 0; }), "count is missing or 0"));
  EXPECT_TRUE(says(after([](Json& j) { j["accessors"][0]["byteOffset"] = 2; }), "no multiple of 4"));
  EXPECT_TRUE(says(after([](Json& j) { j["accessors"][0]["componentType"] = 1; }), "no component type"));
  EXPECT_TRUE(says(after([](Json& j) { j["accessors"][0]["max"][0] = -5; }), "outside of"));
  EXPECT_TRUE(says(after([](Json& j) { j["buffers"][0]["byteLength"] = 99'999'999; }), "but there are only"));
  EXPECT_TRUE(says(after([](Json& j) { j["buffers"][0]["uri"] = "../../etc/hosts"; }), "does not lie beside"));
  EXPECT_TRUE(says(after([](Json& j) { j["nodes"][1]["mesh"] = 77; }), "there is no mesh 77"));
  EXPECT_TRUE(says(after([](Json& j) { j["nodes"][1]["children"] = {2}, j["nodes"][2]["children"] = {1}; }),
                   "it is below itself"));
  EXPECT_TRUE(says(after([](Json& j) { j["nodes"][1]["children"] = {2}, j["nodes"][0]["children"] = {2}; }),
                   "is a child of nodes"));
  EXPECT_TRUE(says(after([](Json& j) {
                     Json& primitive = j["meshes"][1]["primitives"][0];
                     primitive["attributes"]["POSITION"] = j["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
                   }),
                   "others"));
}

TEST_F(GltfCheckTest, PackedSizesMustAgree) {
  const auto packed = [](Json& j, std::size_t view) -> Json& {
    return j["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  };
  EXPECT_TRUE(says(after([&](Json& j) { packed(j, 0)["count"] = 1'000'000'000; }), "packed"));
  EXPECT_TRUE(says(after([&](Json& j) { packed(j, 0)["mode"] = "ZIP"; }), "no packing mode"));
  EXPECT_TRUE(says(after([&](Json& j) { packed(j, 0)["byteLength"] = 4; }), "cannot"));
  EXPECT_TRUE(says(after([&](Json& j) { packed(j, 0)["filter"] = "QUATERNION"; }), "filter"));
  // A bomb: gigabytes from a few bytes.
  EXPECT_TRUE(says(after([&](Json& j) {
                     const auto stride = packed(j, 0)["byteStride"].get<std::uint64_t>();
                     packed(j, 0)["count"] = 4'000'000'000ull,
                               j["bufferViews"][0]["byteLength"] = 4'000'000'000ull * stride;
                     j["buffers"][1]["byteLength"] = 8'000'000'000ull * stride;
                   }),
                   "cannot hold"));
}

TEST_F(GltfCheckTest, RandomlyDamagedJsonIsSafe) {
  const std::string bytes = slurp(folder_ / "a.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  RandomStream random(3, 4, Purpose::statistics);
  for (int k = 0; k < 300; ++k) {
    std::string bad = bytes;
    for (int n = 0; n < 4; ++n) bad[20 + random.below(length)] = "0123456789[]{},\""[random.below(16)];
    spit(folder_ / "b.glb", bad);
    (void)static_cast<bool>(check_gltf(folder_ / "b.glb"));
  }
}

TEST_F(GltfCheckTest, WhatIsNoGltfIsAnError) {
  spit(folder_ / "bad.glb", "glTF and nothing else");
  EXPECT_FALSE(check_gltf(folder_ / "bad.glb"));
  EXPECT_FALSE(check_gltf(folder_ / "none.glb"));
}

}  // namespace
}  // namespace bosquet::exchange
