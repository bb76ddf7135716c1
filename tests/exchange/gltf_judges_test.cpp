// What judges nobody here wrote say of our files: the Khronos validator, and three.js in a browser.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "exchange/gltf_writer.h"
#include "exchange/image_file.h"
#include "sample_model.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

const std::filesystem::path kWeb = std::filesystem::path(BOSQUET_SOURCE_DIR) / "tests/web";

struct Said {
  int status = -1;
  std::string text;
};

// Runs node on one of the scripts; what it prints, errors included, and its exit status.
Said ask(const std::string& script, const std::string& arguments) {
  const std::string command = "node '" + (kWeb / script).string() + "' " + arguments + " 2>&1";
  Said said;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> part;
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) said.text.append(part.data(), n);
  const int status = ::pclose(pipe);
  said.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

class Judges : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(std::filesystem::exists(kWeb / "node_modules/gltf-validator"))
        << "the judges are not installed; run: npm ci --prefix tests/web";
  }
  const ScratchFolder folder_;
};

TEST_F(Judges, TheValidatorFindsNothingToComplainOf) {
  scene::Model many = sample_model();
  for (int i = 0; i < 5; ++i)
    many.nodes.push_back({"", Vec3(0.0f), {{std::make_shared<TriangleMesh>(tube(200, 100 + 90 * i, 1, 2, 1)), 0}}, {}});
  std::string files;
  const auto add = [&](const scene::Model& model, const std::string& name, const GltfOptions& options) {
    const auto written = write_gltf(model, folder_ / name, options);
    ASSERT_TRUE(written) << written.error().message;
    files += " " + quoted(folder_ / name);
  };
  GltfOptions plain, other;
  other.leaf_normal_maps = true, other.reorder = false, other.version = "1";
  add(sample_model(), "plain.glb", plain);
  add(sample_model(), "plain.gltf", plain);
  add(sample_model(), "other words é.gltf", other);
  add(many, "many.glb", other);
  add(scene::Model{}, "empty.glb", plain);
  const Said said = ask("validate.mjs", "--infos" + files);
  EXPECT_EQ(said.status, 0) << said.text;
}

// A model with coarser levels of its trees, as files may be asked to hold.
scene::Model model_with_levels() {
  scene::Model model = sample_model();
  const auto stump = std::make_shared<TriangleMesh>(tube(3, 1, 0.2f, 4.0f, 1.0f));
  const auto few = std::make_shared<TriangleMesh>(cards(6));
  for (std::size_t i = 1; i < 4; ++i) {
    model.nodes[i].coverage = 0.5f;
    model.nodes[i].coarser = {{{{stump, 0}, {few, 1}}, 0.1f}, {{{few, 1}}, 0.0f}};
  }
  return model;
}

// Every combination of options, by what the file's name says.
std::vector<std::pair<std::string, GltfOptions>> all_options() {
  std::vector<std::pair<std::string, GltfOptions>> all;
  for (bool instancing : {false, true})
    for (std::size_t c = 0; c < kCompressionNames.size(); ++c)
      for (std::size_t l = 0; l < kLodFilesNames.size(); ++l)
        for (const char* ending : {".glb", ".gltf"}) {
          GltfOptions options;
          options.instancing = instancing;
          options.compression = static_cast<Compression>(c);
          options.lod = static_cast<LodFiles>(l);
          options.leaf_normal_maps = l == 1;
          all.emplace_back(std::string(instancing ? "instanced-" : "baked-") + std::string(kCompressionNames[c]) + "-" +
                               std::string(kLodFilesNames[l]) + ending,
                           options);
        }
  return all;
}

TEST_F(Judges, EveryCombinationOfOptionsIsValidAndDecodesToThePlainTriangles) {
  const scene::Model model = model_with_levels();
  ASSERT_TRUE(write_gltf(model, folder_ / "plain.glb"));
  std::string files;
  for (const auto& [name, options] : all_options()) {
    const auto written = write_gltf(model, folder_ / name, options);
    ASSERT_TRUE(written) << name << ": " << written.error().message;
    files += " " + quoted(folder_ / name);
  }
  const Said valid = ask("validate.mjs", files);
  EXPECT_EQ(valid.status, 0) << valid.text;
  const Said same = ask("compare.mjs", quoted(folder_ / "plain.glb") + files);
  EXPECT_EQ(same.status, 0) << same.text;
}

TEST_F(Judges, WindWeightsAreValidAndComeThroughEveryCompression) {
  scene::Model model = windy_model();
  const auto trunk = std::make_shared<TriangleMesh>(*model.nodes[1].parts[0].mesh);
  for (std::size_t i = 1; i < 4; ++i) model.nodes[i].coarser = {{{{trunk, 0}}, 0.0f}};
  std::string files;
  for (std::size_t c = 0; c < kCompressionNames.size(); ++c)
    for (const char* ending : {".glb", ".gltf"}) {
      GltfOptions options;
      options.compression = static_cast<Compression>(c), options.lod = LodFiles::nodes;
      const std::filesystem::path file = folder_ / (std::string(kCompressionNames[c]) + ending);
      ASSERT_TRUE(write_gltf(model, file, options));
      files += " " + quoted(file);
    }
  const Said valid = ask("validate.mjs", files), same = ask("compare.mjs", files);
  EXPECT_EQ(valid.status, 0) << valid.text;
  EXPECT_EQ(same.status, 0) << same.text;
  // One weight of one vertex a step aside.
  TriangleMesh crown = *model.nodes[2].parts[1].mesh;
  crown.wind[40].z = static_cast<std::uint8_t>(crown.wind[40].z + 1);
  model.nodes[2].parts[1].mesh = std::make_shared<TriangleMesh>(crown);
  ASSERT_TRUE(write_gltf(model, folder_ / "other.glb"));
  const Said differs = ask("compare.mjs", quoted(folder_ / "none.glb") + " " + quoted(folder_ / "other.glb"));
  EXPECT_EQ(differs.status, 1) << differs.text;
  EXPECT_NE(differs.text.find("english_oak-2: no counterpart"), std::string::npos) << differs.text;
}

TEST_F(Judges, TheComparisonIsAwake) {
  scene::Model model = sample_model();
  ASSERT_TRUE(write_gltf(model, folder_ / "plain.glb"));
  GltfOptions options;
  options.instancing = true, options.compression = Compression::meshopt;
  const auto complaint = [&] {
    EXPECT_TRUE(write_gltf(model, folder_ / "other.glb", options));
    const Said said = ask("compare.mjs", quoted(folder_ / "plain.glb") + " " + quoted(folder_ / "other.glb"));
    EXPECT_EQ(said.status, 1) << said.text;
    return said.text;
  };
  // One corner of one leaf of one tree 3 mm aside; then a triangle less.
  TriangleMesh crown = *model.nodes[2].parts[1].mesh;
  crown.positions[40].x += 0.003f;
  model.nodes[2].parts[1].mesh = std::make_shared<TriangleMesh>(crown);
  EXPECT_NE(complaint().find("english_oak-2: no counterpart"), std::string::npos);
  crown.positions[40].x -= 0.003f;
  crown.indices.resize(crown.indices.size() - 3);
  model.nodes[2].parts[1].mesh = std::make_shared<TriangleMesh>(crown);
  EXPECT_NE(complaint().find("english_oak-2: 215 triangles"), std::string::npos);
}

TEST_F(Judges, ThreeJsShowsInstancedAndPackedLeavesWhereTheBakedOnesAre) {
  const scene::Model model = sample_model();
  const auto box = [&](const GltfOptions& options, double& triangles) {
    EXPECT_TRUE(write_gltf(model, folder_ / "a.glb", options));
    const Said said = ask("view.mjs", quoted(folder_ / "a.glb") + " " + quoted(folder_ / "a.png") + " --size 64x64");
    EXPECT_EQ(said.status, 0) << said.text;
    const auto report = nlohmann::json::parse(said.text, nullptr, false);
    triangles = report["triangles"];
    return std::pair{report["box"]["min"].get<std::array<double, 3>>(),
                     report["box"]["max"].get<std::array<double, 3>>()};
  };
  GltfOptions small;
  small.instancing = true, small.compression = Compression::meshopt;
  double plain_triangles = 0, triangles = 1;
  const auto plain = box({}, plain_triangles), packed = box(small, triangles);
  EXPECT_EQ(triangles, plain_triangles);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(packed.first[c], plain.first[c], 1e-3);
    EXPECT_NEAR(packed.second[c], plain.second[c], 1e-3);
  }
}

TEST_F(Judges, TheValidatorIsAwake) {
  ASSERT_TRUE(write_gltf(sample_model(), folder_ / "a.glb"));
  std::string bytes = slurp(folder_ / "a.glb");
  const auto at = bytes.find("\"MASK\"");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 6, "\"MUSK\"");
  spit(folder_ / "a.glb", bytes);
  const Said said = ask("validate.mjs", quoted(folder_ / "a.glb"));
  EXPECT_EQ(said.status, 1) << said.text;
}

TEST_F(Judges, ThreeJsSeesEveryTriangleInItsPlace) {
  const scene::Model model = sample_model();
  ASSERT_TRUE(write_gltf(model, folder_ / "a.glb"));
  const Said said = ask("view.mjs", quoted(folder_ / "a.glb") + " " + quoted(folder_ / "a.png") + " --size 320x240");
  ASSERT_EQ(said.status, 0) << said.text;
  const auto report = nlohmann::json::parse(said.text, nullptr, false);
  ASSERT_TRUE(report.is_object()) << said.text;
  EXPECT_EQ(report["triangles"], count(model).triangles);
  EXPECT_EQ(report["lights"], 1);
  EXPECT_EQ(report["cameras"], 2);
  // The L of trees: the second stands east of the first, the third north of it (z falls to the north).
  const auto place = [&](int tree) {
    return report["nodes"][static_cast<std::size_t>(tree)]["position"].get<std::array<double, 3>>();
  };
  EXPECT_NEAR(place(2)[0] - place(1)[0], 8, 1e-5);
  EXPECT_NEAR(place(3)[2] - place(1)[2], -4, 1e-5);
  Box3 box;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts)
      for (const Vec3& p : part.mesh->positions) box.add(p + node.translation);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(report["box"]["min"][c].get<double>(), box.low[static_cast<int>(c)], 1e-5);
    EXPECT_NEAR(report["box"]["max"][c].get<double>(), box.high[static_cast<int>(c)], 1e-5);
  }
}

// A square card with a round leaf on it fills pi/4 of the square: alpha was tested, at the right cutoff.
TEST_F(Judges, ThreeJsCutsLeavesOut) {
  scene::Model model;
  auto& leaf = model.materials.emplace_back();
  leaf.mask = leaf.double_sided = true;
  leaf.base_colour = filled_image(256, 4, [](int x, int y, std::uint8_t* p) {
    p[0] = p[1] = p[2] = 0;  // black leaves: the silhouette is white all the same
    const double dx = x - 127.5, dy = y - 127.5;
    p[3] = dx * dx + dy * dy < 128 * 128 ? 255 : 0;
  });
  TriangleMesh card;
  for (Vec2 c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    card.positions.push_back({c.x, c.y, 0});
    card.normals.push_back({0, 0, 1});
    card.uvs.push_back(0.5f * Vec2(c.x + 1, 1 - c.y));
  }
  card.indices = {0, 1, 2, 0, 2, 3};
  model.nodes.push_back({"card", Vec3(0.0f), {{std::make_shared<TriangleMesh>(card), 0}}, {}});
  ASSERT_TRUE(write_gltf(model, folder_ / "a.glb"));
  // From 10 m a field of view of 2 atan(1/5) shows 4 m: the card is half as wide as the picture.
  const Said said = ask("view.mjs", quoted(folder_ / "a.glb") + " " + quoted(folder_ / "a.png") +
                                        " --silhouette --size 200x200 --fov 22.6199 --camera 0,0,10,0,0,0");
  ASSERT_EQ(said.status, 0) << said.text;
  const auto picture = read_image(folder_ / "a.png");
  ASSERT_TRUE(picture) << picture.error().message;
  int white = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const int v = picture->at(x, y)[0];
      EXPECT_TRUE(v == 0 || v == 255);
      white += v == 255;
    }
  EXPECT_NEAR(white, kPi / 4 * 100 * 100, 0.02 * 100 * 100);  // a pixel's rim of the circle is 3 %
}

TEST_F(Judges, ThreeJsMovesWhatHasWindWeightsAndNothingElse) {
  // A post whose upper half gives way, a metre at the top; one without weights beside it.
  scene::Model model;
  model.materials.emplace_back();
  TriangleMesh post = tube(8, 2, 0.2f, 4.0f, 1.0f);
  const auto still = std::make_shared<TriangleMesh>(post);
  for (const Vec3& p : post.positions) post.wind.push_back({p.y > 3.0f ? 255 : 0, 0, 0, 0});
  model.nodes.push_back({"still", Vec3(-3, 0, 0), {{still, 0}}, {}});
  model.nodes.push_back({"windy", Vec3(0, 0, 0), {{std::make_shared<TriangleMesh>(post), 0}}, {{"wind_m", 1.0}}});
  GltfOptions options;
  options.compression = Compression::quantize;
  ASSERT_TRUE(write_gltf(model, folder_ / "a.glb", options));
  // From 20 m a field of view of 2 atan(1/4) shows 10 m: 20 pixels a metre. White columns of a row, from left to right.
  const auto row_at = [&](float height_m, const char* wind) {
    const Said said = ask("view.mjs", quoted(folder_ / "a.glb") + " " + quoted(folder_ / "a.png") +
                                          " --silhouette --size 200x200 --fov 28.0725 --camera 0,2,20,0,2,0" + wind);
    EXPECT_EQ(said.status, 0) << said.text;
    std::vector<double> at;  // the middle of each post
    const auto picture = read_image(folder_ / "a.png");
    EXPECT_TRUE(picture);
    const int y = static_cast<int>(100.0f - 20.0f * (height_m - 2.0f));
    for (int x = 1, from = 0; x < 200; ++x) {
      const bool before = picture->at(x - 1, y)[0] > 0, now = picture->at(x, y)[0] > 0;
      if (now && !before) from = x;
      if (before && !now) at.push_back(0.5 * (from + x));
    }
    return at;
  };
  // At second 0 a gust of force 1 takes the top 0.6 m east, the middle stays.
  const std::vector<double> low = row_at(1.0f, " --wind 0,1"), calm = row_at(3.9f, ""),
                            high = row_at(3.9f, " --wind 0,1");
  ASSERT_EQ(low.size(), 2u);
  ASSERT_EQ(calm.size(), 2u);
  ASSERT_EQ(high.size(), 2u);
  EXPECT_NEAR(calm[1], 100.0, 1.0);
  EXPECT_NEAR(low[1], 100.0, 1.0);
  EXPECT_NEAR(high[0], calm[0], 0.5);
  EXPECT_NEAR(high[1] - calm[1], 20.0 * 0.6 * 0.95, 1.5);  // just below the top
}

TEST_F(Judges, AFileThatCannotBeShownIsSaidSo) {
  spit(folder_ / "bad.glb", "glTF and nothing else");
  const Said said = ask("view.mjs", quoted(folder_ / "bad.glb") + " " + quoted(folder_ / "a.png"));
  EXPECT_EQ(said.status, 1) << said.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

}  // namespace
}  // namespace bosquet::exchange
