#include "exchange/gltf_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "gltf_read_back.h"
#include "sample_model.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

using Corner = std::array<float, 6>;
using Triangle = std::array<Corner, 3>;

// Triangles with their positions and normals, each beginning with its least corner (winding kept), sorted: the same
// list for any order of triangles and vertices.
std::vector<Triangle> soup(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                           const std::vector<std::uint32_t>& indices) {
  std::vector<Triangle> out;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = indices[i + k];
      t[k] = {positions[v].x, positions[v].y, positions[v].z, normals[v].x, normals[v].y, normals[v].z};
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  return out;
}
std::vector<Triangle> soup(const TriangleMesh& m) { return soup(m.positions, m.normals, m.indices); }
std::vector<Triangle> soup(const ReadPrimitive& p) { return soup(p.positions, p.normals, p.indices); }

Vec3 turned(const glm::dvec4& q, const DVec3& v) {
  const DVec3 u(q.x, q.y, q.z), t = 2.0 * glm::cross(u, v);
  return Vec3(v + q.w * t + glm::cross(u, t));
}

const ReadNode& named(const ReadBack& back, const std::string& name) {
  for (const ReadNode& node : back.nodes)
    if (node.name == name) return node;
  throw std::runtime_error("no node " + name);
}

TEST(GltfWriter, TinygltfReadsTheSameTrianglesBackFromBothKindsOfFile) {
  const ScratchFolder folder;
  const scene::Model model = sample_model();
  for (const char* file : {"a.glb", "b.gltf"})
    for (bool reorder : {true, false}) {
      GltfOptions options;
      options.reorder = reorder;
      const auto bytes = write_gltf(model, folder / file, options);
      ASSERT_TRUE(bytes) << bytes.error().message;
      const ReadBack back = read_back(folder / file);
      ASSERT_EQ(back.error, "");
      EXPECT_EQ(back.warning, "");
      for (const scene::Node& node : model.nodes) {
        const ReadNode& read = named(back, node.name);
        const auto& primitives = back.meshes.at(static_cast<std::size_t>(read.mesh));
        ASSERT_EQ(primitives.size(), node.parts.size());
        for (std::size_t k = 0; k < node.parts.size(); ++k)
          EXPECT_EQ(soup(primitives[k]), soup(*node.parts[k].mesh)) << file << " " << node.name << " part " << k;
      }
    }
}

TEST(GltfWriter, WindWeightsComeBackByteForByteOnWhatHasThem) {
  const ScratchFolder folder;
  const scene::Model model = windy_model();
  GltfOptions options;
  options.reorder = false;
  ASSERT_TRUE(write_gltf(model, folder / "a.glb", options));
  const ReadBack back = read_back(folder / "a.glb");
  ASSERT_EQ(back.error, "");
  for (const scene::Node& node : model.nodes) {
    const auto& primitives = back.meshes.at(static_cast<std::size_t>(named(back, node.name).mesh));
    for (std::size_t k = 0; k < node.parts.size(); ++k) {
      const std::vector<Rgba8>& given = node.parts[k].mesh->wind;
      ASSERT_EQ(primitives[k].wind.size(), given.size()) << node.name;
      for (std::size_t v = 0; v < given.size(); ++v)
        EXPECT_EQ(glm::round(primitives[k].wind[v] * 255.0f), Vec4(given[v])) << node.name << " vertex " << v;
    }
  }
}

TEST(GltfWriter, WindWeightsGoWithTheirVerticesIntoTheBestOrder) {
  const ScratchFolder folder;
  const scene::Model model = windy_model();
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  // No two vertices of the trunk are at one place with one texture coordinate.
  const TriangleMesh& trunk = *model.nodes[1].parts[0].mesh;
  const ReadPrimitive& read = back.meshes.at(static_cast<std::size_t>(named(back, model.nodes[1].name).mesh)).front();
  ASSERT_EQ(read.positions.size(), trunk.positions.size());
  EXPECT_NE(read.positions, trunk.positions);
  for (std::size_t v = 0; v < read.positions.size(); ++v) {
    std::size_t same = 0;
    while (trunk.positions[same] != read.positions[v] || trunk.uvs[same] != read.uvs[v]) ++same;
    EXPECT_EQ(glm::round(read.wind[v] * 255.0f), Vec4(trunk.wind[same]));
  }
}

TEST(GltfWriter, WindWeightsOfInstancesAreRefused) {
  const ScratchFolder folder;
  GltfOptions options;
  options.instancing = true;
  const auto written = write_gltf(windy_model(), folder / "a.glb", options);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, kNoWindOfInstances);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

TEST(GltfWriter, NodesKeepNamesPlacesAndExtras) {
  const ScratchFolder folder;
  GltfOptions options;
  options.version = "1.2.3";
  ASSERT_TRUE(write_gltf(sample_model(), folder / "a.glb", options));
  const ReadBack back = read_back(folder / "a.glb");
  EXPECT_EQ(back.generator, "Bosquet 1.2.3");
  EXPECT_EQ(back.scene_seed, "12");
  const ReadNode& third = named(back, "english_oak-3");
  EXPECT_EQ(third.species, "english_oak");
  EXPECT_EQ(third.height_m, 6.0);
  EXPECT_EQ(third.id, 3.0);
  // 2 m east, 6 m north: x = 2, z = -6.
  EXPECT_EQ(Vec3(third.translation), Vec3(2.0f, 0.1f, -6.0f));
  EXPECT_EQ(back.scene_nodes, back.nodes.size());
}

TEST(GltfWriter, TranslationsAndVerticesComeBackBitForBit) {
  const ScratchFolder folder;
  scene::Model model = sample_model();
  const Vec3 place(98765.4321f, -0.1f, -1.0f / 3.0f);
  model.nodes[1].translation = place;
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  EXPECT_EQ(Vec3(named(read_back(folder / "a.glb"), "english_oak-1").translation), place);
}

TEST(GltfWriter, PartsUsedTwiceAreStoredOnce) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_gltf(sample_model(), folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  EXPECT_EQ(named(back, "english_oak-1").mesh, named(back, "english_oak-3").mesh);
  EXPECT_EQ(back.meshes.size(), 2u);  // the ground's and the trees'

  // The same trunk under another material: another mesh over the same vertices.
  scene::Model model = sample_model();
  model.nodes[2].parts[0].material = 2;
  ASSERT_TRUE(write_gltf(model, folder / "b.glb"));
  const ReadBack other = read_back(folder / "b.glb");
  const auto& one = other.meshes[static_cast<std::size_t>(named(other, "english_oak-1").mesh)][0];
  const auto& two = other.meshes[static_cast<std::size_t>(named(other, "english_oak-2").mesh)][0];
  EXPECT_EQ(one.position_accessor, two.position_accessor);
  EXPECT_NE(one.material, two.material);
  EXPECT_FALSE(one.uvs.empty());
  EXPECT_TRUE(two.uvs.empty()) << "a material without texture needs no coordinates";
}

TEST(GltfWriter, StatedBoundsAreThoseOfTheUsedVertices) {
  const ScratchFolder folder;
  scene::Model model = sample_model();
  TriangleMesh mesh = cards(5);
  mesh.positions.push_back(Vec3(1000));  // no triangle uses it
  mesh.normals.push_back(kUp), mesh.uvs.push_back(Vec2(7)), mesh.colours.push_back(Rgba8(255));
  model.nodes[1].parts = {{std::make_shared<TriangleMesh>(mesh), 1}};
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  const auto& p = back.meshes[static_cast<std::size_t>(named(back, "english_oak-1").mesh)][0];
  EXPECT_EQ(p.positions.size(), 20u);
  Box3 box;
  for (const Vec3& v : p.positions) box.add(v);
  EXPECT_EQ(Vec3(p.low), box.low);
  EXPECT_EQ(Vec3(p.high), box.high);
  EXPECT_TRUE(p.short_uvs);
}

TEST(GltfWriter, ShortTextureCoordinatesAreWithinHalfAStep) {
  const ScratchFolder folder;
  scene::Model model = sample_model();
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i) {
    const float f = static_cast<float>(i) / 299.0f;
    mesh.positions.push_back({static_cast<float>(i), 0, static_cast<float>(i % 7)});
    mesh.normals.push_back(kUp);
    mesh.uvs.push_back({f * f, 1 - f});
    mesh.indices.push_back(static_cast<std::uint32_t>(i));
  }
  model.nodes[1].parts = {{std::make_shared<TriangleMesh>(mesh), 1}};
  GltfOptions options;
  options.reorder = false;
  ASSERT_TRUE(write_gltf(model, folder / "a.glb", options));
  const ReadBack back = read_back(folder / "a.glb");
  const auto& p = back.meshes[static_cast<std::size_t>(named(back, "english_oak-1").mesh)][0];
  ASSERT_TRUE(p.short_uvs);
  for (std::size_t i = 0; i < 300; ++i) {
    // Half a step of 1/65535, and the float rounding of coordinate times 65535.
    EXPECT_NEAR(p.uvs[i].x, mesh.uvs[i].x, 0.5001 / 65535);
    EXPECT_NEAR(p.uvs[i].y, mesh.uvs[i].y, 0.5001 / 65535);
  }
}

TEST(GltfWriter, RepeatingCoordinatesStayFloats) {
  const ScratchFolder folder;
  const scene::Model model = sample_model();
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  const auto& trunk = back.meshes[static_cast<std::size_t>(named(back, "english_oak-1").mesh)][0];
  EXPECT_FALSE(trunk.short_uvs);
  EXPECT_EQ(std::max_element(trunk.uvs.begin(), trunk.uvs.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; })->x, 3.0f);
}

TEST(GltfWriter, IndicesAreShortUpToTheLastNumberBeforeTheRestartValue) {
  const ScratchFolder folder;
  for (std::size_t vertices : {65'535u, 65'536u}) {
    scene::Model model = sample_model();
    TriangleMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) {
      mesh.positions.push_back({static_cast<float>(i % 256), static_cast<float>(i / 256), 0});
      mesh.normals.push_back({0, 0, 1});
    }
    for (std::size_t i = 0; i + 2 < vertices; i += 2)
      for (std::size_t k = 0; k < 3; ++k) mesh.indices.push_back(static_cast<std::uint32_t>(i + k));
    if (vertices % 2 == 0)  // all used
      for (std::size_t k : {vertices - 3, vertices - 2, vertices - 1})
        mesh.indices.push_back(static_cast<std::uint32_t>(k));
    model.nodes[1].parts = {{std::make_shared<TriangleMesh>(mesh), 2}};
    ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
    const ReadBack back = read_back(folder / "a.glb");
    const auto& p = back.meshes[static_cast<std::size_t>(named(back, "english_oak-1").mesh)][0];
    EXPECT_EQ(p.positions.size(), vertices);
    EXPECT_EQ(p.short_indices, vertices == 65'535);
    EXPECT_EQ(soup(p), soup(mesh));
    EXPECT_LT(*std::max_element(p.indices.begin(), p.indices.end()), vertices);
  }
}

TEST(GltfWriter, MaterialsSayWhatTheSurfaceIs) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_gltf(sample_model(), folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  ASSERT_EQ(back.materials.size(), 3u) << "an unused material is not written";
  const auto by_name = [&](const std::string& name) {
    return *std::find_if(back.materials.begin(), back.materials.end(),
                         [&](const ReadMaterial& m) { return m.name == name; });
  };
  const ReadMaterial bark = by_name("oak bark"), leaf = by_name("oak leaf"), ground = by_name("ground");
  EXPECT_EQ(bark.alpha_mode, "OPAQUE");
  EXPECT_EQ(bark.colour_mime, "image/jpeg");
  EXPECT_EQ(bark.colour_wrap, 10497) << "bark repeats";
  EXPECT_TRUE(bark.has_normal);
  EXPECT_FLOAT_EQ(static_cast<float>(bark.roughness), 0.9f);
  EXPECT_EQ(bark.metallic, 0.0);
  EXPECT_EQ(leaf.alpha_mode, "MASK");
  EXPECT_FLOAT_EQ(static_cast<float>(leaf.alpha_cutoff), 0.4f);
  EXPECT_TRUE(leaf.double_sided);
  EXPECT_EQ(leaf.colour_mime, "image/png");
  EXPECT_EQ(leaf.colour_width, 32);
  EXPECT_EQ(leaf.colour_wrap, 33071) << "cards end at the image's edge";
  EXPECT_FALSE(leaf.has_normal) << "only when asked for";
  EXPECT_FALSE(ground.has_colour);
  EXPECT_EQ(back.images, 3u);

  GltfOptions options;
  options.leaf_normal_maps = true;
  ASSERT_TRUE(write_gltf(sample_model(), folder / "b.glb", options));
  EXPECT_EQ(read_back(folder / "b.glb").images, 4u);
}

TEST(GltfWriter, CamerasLookFromTheEyeToTheTargetWithNorthUpInPlan) {
  const ScratchFolder folder;
  const scene::Model model = sample_model();
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  for (const scene::Camera& camera : model.cameras) {
    const ReadNode& node = named(back, camera.name);
    EXPECT_EQ(Vec3(node.translation), camera.eye);
    const Vec3 ahead = turned(node.rotation, {0, 0, -1}), wanted = glm::normalize(camera.target - camera.eye);
    EXPECT_LT(glm::length(ahead - wanted), 1e-6f) << camera.name;
    EXPECT_NEAR(back.camera_fov.at(static_cast<std::size_t>(node.camera)), radians(camera.vertical_fov_deg), 1e-7);
    const Vec3 up = turned(node.rotation, {0, 1, 0});
    if (camera.name == "plan")
      EXPECT_LT(glm::length(up - Vec3(0, 0, -1)), 1e-6f);
    else
      EXPECT_GT(up.y, 0.9f);
  }
}

TEST(GltfWriter, CamerasInEveryDirectionKeepTheHorizonLevel) {
  const ScratchFolder folder;
  scene::Model model;
  for (float x : {-3.0f, -0.5f, 0.0f, 0.5f, 3.0f})
    for (float y : {-2.0f, 0.1f, 1.0f, 9.0f})
      for (float z : {-2.0f, 0.7f, 4.0f})
        model.cameras.push_back({std::to_string(model.cameras.size()), {x, y, z}, {0, 0, 0}, 40.0f});
  ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
  const ReadBack back = read_back(folder / "a.glb");
  for (const scene::Camera& camera : model.cameras) {
    const ReadNode& node = named(back, camera.name);
    EXPECT_LT(glm::length(turned(node.rotation, {0, 0, -1}) - glm::normalize(-camera.eye)), 1e-6f) << camera.name;
    EXPECT_NEAR(turned(node.rotation, {1, 0, 0}).y, 0.0f, 1e-6f) << camera.name;
    EXPECT_GT(turned(node.rotation, {0, 1, 0}).y, 0.0f) << camera.name;
  }
}

TEST(GltfWriter, NormalMapsKeepTheirColourAtFullResolution) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_gltf(sample_model(), folder / "a.gltf"));
  // The start-of-frame segment: marker, length, precision, height, width, count, then id and sampling of luminance.
  const auto sampling = [&](const std::string& file) {
    const std::string jpeg = slurp(folder / file);
    return static_cast<int>(jpeg.at(jpeg.find("\xff\xc0") + 11));
  };
  EXPECT_EQ(sampling("a-oak_bark-normal.jpg"), 0x11);
  EXPECT_EQ(sampling("a-oak_bark-colour.jpg"), 0x22);
}

TEST(GltfWriter, TheSunShinesFromWhereItStands) {
  const ScratchFolder folder;
  scene::Model model = sample_model();
  for (const auto& [azimuth, elevation] : {std::pair{180.0f, 30.0f}, {225.0f, 40.0f}, {0.0f, 90.0f}, {90.0f, 5.0f}}) {
    model.sun = {azimuth, elevation};
    ASSERT_TRUE(write_gltf(model, folder / "a.glb"));
    const ReadNode node = named(read_back(folder / "a.glb"), "sun");
    EXPECT_TRUE(node.light);
    EXPECT_LT(glm::length(turned(node.rotation, {0, 0, -1}) + model.sun.direction()), 1e-6f) << azimuth;
  }
}

TEST(GltfWriter, SameModelSameBytesForAnyNumberOfThreads) {
  const ScratchFolder folder;
  scene::Model model = sample_model();
  for (int i = 0; i < 20; ++i) {
    scene::Node node{"tree", Vec3(0.0f), {{std::make_shared<TriangleMesh>(tube(5 + i, 40, 1, 2, 1.5f)), 0}}, {}};
    model.nodes.push_back(node);
  }
  std::string first;
  for (int threads : {1, 2, 3, 8}) {
    run_with_threads(threads, [&] { ASSERT_TRUE(write_gltf(model, folder / "a.glb")); });
    if (first.empty()) first = slurp(folder / "a.glb");
    EXPECT_EQ(slurp(folder / "a.glb"), first) << threads;
  }
  const TextureCache cache(folder / "cache");
  GltfOptions cached;
  cached.textures = &cache;
  for (int round = 0; round < 2; ++round) {  // cold, then warm
    ASSERT_TRUE(write_gltf(model, folder / "a.glb", cached));
    EXPECT_EQ(slurp(folder / "a.glb"), first);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "cache"), {}), 3);
}

TEST(GltfWriter, AFileTooLargeIsRefusedBeforeAnythingIsWritten) {
  const ScratchFolder folder;
  const auto whole = write_gltf(sample_model(), folder / "a.glb");
  ASSERT_TRUE(whole);
  GltfOptions options;
  options.max_glb_bytes = whole->bytes;
  EXPECT_TRUE(write_gltf(sample_model(), folder / "b.glb", options));
  options.max_glb_bytes = whole->bytes - 1;
  const auto refused = write_gltf(sample_model(), folder / "c.glb", options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::input);
  EXPECT_NE(refused.error().message.find("--max-triangles"), std::string::npos) << refused.error().message;
  EXPECT_FALSE(std::filesystem::exists(folder / "c.glb"));
  EXPECT_TRUE(write_gltf(sample_model(), folder / "c.gltf", options)) << "a .bin has no such end";
}

TEST(GltfWriter, ReturnsTheBytesOfAllFiles) {
  const ScratchFolder folder;
  const auto bytes = write_gltf(sample_model(), folder / "two words é.gltf");
  ASSERT_TRUE(bytes);
  std::uint64_t sum = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) sum += entry.file_size();
  EXPECT_EQ(bytes->bytes, sum);
  EXPECT_EQ(folder.entries(), 5u);  // .gltf, .bin, three images
  EXPECT_EQ(read_back(folder / "two words é.gltf").error, "");
}

TEST(GltfWriter, CancellingLeavesNoFile) {
  const ScratchFolder folder;
  Progress progress;
  progress.cancel();
  GltfOptions options;
  options.progress = &progress;
  for (const char* file : {"a.glb", "a.gltf"}) {
    const auto written = write_gltf(sample_model(), folder / file, options);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::cannot_finish);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(GltfWriter, BrokenMeshesAreNamedAndNotWritten) {
  const ScratchFolder folder;
  const auto error_for = [&](const auto& spoil) {
    scene::Model model = sample_model();
    auto mesh = std::make_shared<TriangleMesh>(*model.nodes[2].parts[0].mesh);
    spoil(*mesh);
    model.nodes[2].parts[0].mesh = mesh;
    const auto written = write_gltf(model, folder / "a.glb");
    EXPECT_FALSE(written);
    return written ? std::string() : written.error().message;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& message :
       {error_for([&](TriangleMesh& m) { m.positions[3].y = nan; }),
        error_for([&](TriangleMesh& m) { m.normals[3].x = nan; }),
        error_for([&](TriangleMesh& m) { m.indices[4] = 4000; }),
        error_for([&](TriangleMesh& m) { m.indices.pop_back(); }),
        error_for([&](TriangleMesh& m) { m.uvs.pop_back(); }), error_for([&](TriangleMesh& m) { m.uvs.clear(); })})
    EXPECT_NE(message.find("english_oak-2"), std::string::npos) << message;
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(GltfWriter, AnEmptyModelIsAValidFile) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_gltf(scene::Model{}, folder / "a.glb"));
  EXPECT_EQ(read_back(folder / "a.glb").error, "");
  ASSERT_TRUE(write_gltf(scene::Model{}, folder / "b.gltf"));
  EXPECT_EQ(folder.entries(), 2u) << "no .bin without bytes";
}

TEST(GltfWriter, OtherEndingsAreRefused) {
  const auto written = write_gltf(scene::Model{}, "a.obj");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find(".glb or .gltf"), std::string::npos);
}

TEST(GltfWriter, CountsWhatIsDrawnAndWhatIsStored) {
  const ModelCount n = count(sample_model());
  EXPECT_EQ(n.triangles, 2u + 3 * (8 * 6 * 2 + 60 * 2));
  EXPECT_EQ(n.vertices, 4u + 9 * 7 + 60 * 4);
}

}  // namespace
}  // namespace bosquet::exchange
