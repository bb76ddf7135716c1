#include <gtest/gtest.h>

#include <fstream>

#include "crowns/mesh_solid.h"
#include "exchange/footprints.h"
#include "exchange/gltf_writer.h"
#include "exchange/mesh_file.h"
#include "exchange/recipe.h"
#include "geometry/prism.h"
#include "scene/standing.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

std::filesystem::path write(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

constexpr const char* kBox =
    "# a box\nv 0 0 0\nv 4 0 0\nv 4 0 -6\nv 0 0 -6\nv 0 3 0\nv 4 3 0\nv 4 3 -6\nv 0 3 -6\nvn 0 1 0\n"
    "f 5//1 6//1 7//1 8//1\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf -5 -8 -4 -1\n";

TEST(MeshFile, AnObjFileIsReadWithPolygonsAndEveryWayOfCounting) {
  const ScratchFolder folder;
  const auto mesh = read_mesh(write(folder, "box.obj", kBox));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles(), 12u);
  EXPECT_TRUE(crowns::is_closed(*mesh));
  EXPECT_EQ(mesh->bounds().low, Vec3(0, 0, -6));
  EXPECT_EQ(mesh->bounds().high, Vec3(4, 3, 0));
}

TEST(MeshFile, AGltfFileIsReadWithItsNodesPlaces) {
  // What our own writer makes is read back where it stood.
  const ScratchFolder folder;
  const Polygon court{{{0, 0}, {20, 0}, {20, 8}, {0, 8}}, {{{3, 2}, {6, 2}, {6, 5}}}};
  scene::Model model;
  model.materials.emplace_back().surface = scene::Surface::obstacle;
  scene::Node node;
  node.name = "court";
  node.translation = {10, 2, -30};
  node.parts.push_back({std::make_shared<const TriangleMesh>(geometry::prism(court, 0, 5)), 0});
  model.nodes.push_back(node);
  for (const char* name : {"court.glb", "court.gltf"}) {
    ASSERT_TRUE(write_gltf(model, folder / name, {}));
    const auto mesh = read_mesh(folder / name);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangles(), node.parts[0].mesh->triangles());
    EXPECT_LT(glm::distance(mesh->bounds().low, Vec3(10, 2, -38)), 1e-3f);
    EXPECT_LT(glm::distance(mesh->bounds().high, Vec3(30, 7, -30)), 1e-3f);
    EXPECT_TRUE(crowns::is_closed(*mesh));
  }
}

TEST(MeshFile, WhatIsNoMeshIsRefusedByNameAndLine) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& text) {
    const auto mesh = read_mesh(write(folder, name, text));
    return mesh ? std::string("read") : mesh.error().message;
  };
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n").find("a.obj:4"), std::string::npos);
  EXPECT_NE(refusal("b.obj", "v 0 0 zero\n").find("b.obj:1: 'zero'"), std::string::npos);
  EXPECT_NE(refusal("c.obj", "v 1e39 0 0\n").find("c.obj:1"), std::string::npos);
  EXPECT_NE(refusal("d.obj", "v 0 0 0\nf 0 0 0\n").find("d.obj:2"), std::string::npos);
  EXPECT_NE(refusal("e.obj", "").find("no triangles"), std::string::npos);
  EXPECT_NE(refusal("f.glb", "glTF is what it says").find("f.glb"), std::string::npos);
  EXPECT_NE(refusal("g.gltf", std::string(100'000, '[')).find("g.gltf"), std::string::npos);
  EXPECT_NE(refusal("h.stl", "solid").find("known: .glb .gltf .obj"), std::string::npos);
  EXPECT_NE(read_mesh(folder / "nothing.glb").error().message.find("there is no file"), std::string::npos);
  // A triangle whose indices lie beyond its vertices, and positions beyond their buffer.
  const std::string head =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)";
  EXPECT_NE(
      refusal("i.gltf", head + R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,
    "count":3000,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12,
    "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})")
          .find("i.gltf"),
      std::string::npos);
}

scene::Georeference at(DVec2 south_west) {
  scene::Georeference place;
  place.south_west = south_west;
  return place;
}

constexpr const char* kTown = R"({"type":"FeatureCollection","features":[
  {"type":"Feature","properties":{"name":"school","height":11.5},
   "geometry":{"type":"Polygon","coordinates":[[[510,210],[530,210],[530,220],[510,220],[510,210]],
                                               [[515,213],[520,213],[520,216],[515,216],[515,213]]]}},
  {"type":"Feature","properties":{"building:levels":"3"},
   "geometry":{"type":"MultiPolygon","coordinates":[[[[540,210],[545,210],[545,215],[540,210]]],
                                                    [[[550,210],[555,210],[555,215],[550,210]]]]}},
  {"type":"Feature","properties":{"name":"well"},"geometry":{"type":"Point","coordinates":[520,230]}}]})";

TEST(Footprints, OutlinesComeWithHolesHeightsAndParts) {
  const ScratchFolder folder;
  const auto read = read_footprints(write(folder, "town.geojson", kTown), at({500, 200}));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->all.size(), 3u);
  EXPECT_EQ(read->all[0].name, "school");
  EXPECT_EQ(read->all[0].height_m, 11.5f);
  EXPECT_EQ(read->all[0].outline.ring.size(), 4u);
  EXPECT_EQ(read->all[0].outline.bounds().low, Vec2(10, 10));
  EXPECT_TRUE(read->all[0].outline.contains({12, 12}));
  EXPECT_FALSE(read->all[0].outline.contains({18, 14}));
  EXPECT_EQ(read->all[1].height_m, 9.0f);
  EXPECT_TRUE(read->all[2].outline.contains({54, 11}));
  ASSERT_EQ(read->notes.size(), 1u);
}

TEST(Footprints, WhatHasNoOutlinesIsRefused) {
  const ScratchFolder folder;
  EXPECT_FALSE(read_footprints(folder / "nothing.geojson", {}));
  EXPECT_FALSE(read_footprints(write(folder, "a.geojson", "{\"type\":"), {}));
  const auto point =
      read_footprints(write(folder, "b.geojson",
                            R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[5,2]}})"),
                      {});
  ASSERT_FALSE(point);
  EXPECT_NE(point.error().message.find("no polygon"), std::string::npos);
}

TEST(Footprints, OutlinesInDegreesPlaceASiteThatHadNoPlace) {
  const ScratchFolder folder;
  // At 60 degrees north a thousandth of a degree is 111.4 m to the north and 55.8 m to the east (WGS 84).
  const auto read = read_footprints(
      write(folder, "c.geojson", R"({"type":"Feature","properties":{"height":"tall"},"geometry":{"type":"Polygon",
        "coordinates":[[[10,60],[10.001,60],[10.001,60.001],[10,60.001],[10,60]]]}})"),
      {}, DVec2(100, 200));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read->place);
  EXPECT_NEAR(read->place->latitude_deg, 60.0005, 0.001);
  const Box2 box = read->all[0].outline.bounds();
  EXPECT_NEAR(box.size().x, 55.8, 0.1);
  EXPECT_NEAR(box.size().y, 111.4, 0.1);
  EXPECT_GT(box.low.x, 0);
  EXPECT_LT(box.high.y, 200);
  // What stands in place of a height is told, not taken for one.
  EXPECT_FALSE(read->all[0].height_m);
  std::string notes;
  for (const std::string& note : read->notes) notes += note + "\n";
  EXPECT_NE(notes.find("'tall' of building 1"), std::string::npos) << notes;
}

TEST(Footprints, HeightsMayHaveADecimalCommaAndAUnit) {
  const ScratchFolder folder;
  for (const auto& [text, metres] : {std::pair{"8,5", 8.5f}, {"12 m", 12.0f}, {"30 ft", 9.144f}}) {
    const auto read = read_footprints(
        write(folder, "h.geojson",
              std::string(R"({"type":"Feature","properties":{"height":")") + text +
                  R"("},"geometry":{"type":"Polygon","coordinates":[[[501,1],[509,1],[509,9],[501,1]]]}})"),
        at({500, 0}));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FLOAT_EQ(read->all.at(0).height_m.value_or(0), metres) << text;
  }
}

TEST(Footprints, AnOutlineThatCrossesItselfIsTakenApartAndNamed) {
  const ScratchFolder folder;
  const auto read = read_footprints(
      write(folder, "bow.geojson", R"({"type":"Feature","properties":{"name":"bow"},"geometry":{"type":"Polygon",
        "coordinates":[[[500,0],[520,20],[520,0],[500,20],[500,0]]]}})"),
      at({500, 0}));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->all.size(), 2u);
  for (const Footprint& part : read->all) EXPECT_EQ(part.outline.ring.size(), 3u);
  ASSERT_FALSE(read->notes.empty());
  EXPECT_NE(read->notes.back().find("'bow'"), std::string::npos) << read->notes.back();
}

constexpr const char* kHead = "[site]\nsize_m = [60, 40]\nsouth_west = [500, 200]\n";

Result<BuiltRecipe> build(const ScratchFolder& folder, const std::string& text) {
  auto recipe = parse_recipe(kHead + text, folder / "test.toml");
  if (!recipe) return recipe.error();
  return build_document(*recipe);
}

TEST(RecipeObstacle, MeshesOutlinesAndPolygonsStandWhereTheyAreSaidTo) {
  const ScratchFolder folder;
  write(folder, "box.obj", kBox), write(folder, "town.geojson", kTown);
  const auto built =
      build(folder,
            "[[obstacle]]\nname = 'shed'\nfile = 'box.obj'\nat = [30, 20]\nrotation_deg = 90\nscale = 2\n"
            "[[obstacle]]\nfile = 'town.geojson'\nheight_m = 5\n"
            "[[obstacle]]\npolygon = [[1, 1], [5, 1], [5, 4]]\nheight_m = 6\n");
  ASSERT_TRUE(built) << built.error().message;
  const auto& all = built->document.obstacles;
  ASSERT_EQ(all.size(), 5u);
  // The box ran 4 m east and 6 m north of its origin; turned to the left it runs 12 m west and 8 m north.
  EXPECT_LT(glm::distance(all[0].mesh->bounds().low, Vec3(18, 0, -28)), 1e-3f);
  EXPECT_LT(glm::distance(all[0].mesh->bounds().high, Vec3(30, 6, -20)), 1e-3f);
  EXPECT_EQ(all[1].high_y, 11.5f);
  EXPECT_EQ(all[4].high_y, 6.0f);
  for (std::size_t n = 0; n < all.size(); ++n) EXPECT_EQ(all[n].id, -1 - static_cast<int>(n));
}

TEST(RecipeObstacle, TreesInsideAndObstaclesOffTheSiteAreWarnedAbout) {
  const ScratchFolder folder;
  const auto built =
      build(folder,
            "[[obstacle]]\nname = 'barn'\npolygon = [[10, 10], [20, 10], [20, 20], [10, 20]]\n"
            "[[obstacle]]\nname = 'far'\npolygon = [[90, 10], [99, 10], [99, 20]]\n"
            "[[planting]]\nkind = 'single'\nspecies = { silver_birch = 1 }\nat = [15, 15]\nscale = 0.2\n"
            "[[planting]]\nkind = 'single'\nspecies = { silver_birch = 1 }\nat = [40, 15]\nscale = 0.2\n");
  ASSERT_TRUE(built) << built.error().message;
  const auto grown = scene::grow_scene(built->document, {}, nullptr);
  ASSERT_TRUE(grown) << grown.error().message;
  std::string all;
  for (const std::string& w : grown->warnings) all += w + "\n";
  EXPECT_NE(all.find("tree 1 in obstacle 'barn'"), std::string::npos) << all;
  EXPECT_NE(all.find("obstacle 'far' lies off the site"), std::string::npos) << all;
  EXPECT_EQ(all.find("tree 2"), std::string::npos) << all;
  ASSERT_EQ(grown->trees.size(), 2u);
  EXPECT_LT(grown->trees[0].measures.crown_diameter_m, grown->trees[1].measures.crown_diameter_m);
}

TEST(RecipeObstacle, NothingIsSownIntoBuildingsOrUnderMeshes) {
  const ScratchFolder folder;
  write(folder, "box.obj", kBox);
  const std::string birches = "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 60\nscale = [0.1, 0.2]\n";
  for (const char* house : {"[[obstacle]]\npolygon = [[10, 5], [50, 5], [50, 35], [10, 35]]\n",
                            "[[obstacle]]\nfile = 'box.obj'\nat = [10, 5]\nscale = 5\n"}) {  // 20 x 30 m
    const bool mesh = std::string(house).find("obj") != std::string::npos;
    const Box2 inside{{10, 5}, {mesh ? 30.0f : 50.0f, 35}};
    const auto built = build(folder, house + birches);
    ASSERT_TRUE(built) << built.error().message;
    EXPECT_EQ(built->document.trees->size(), 60u);
    for (const scene::Tree& tree : *built->document.trees) EXPECT_FALSE(inside.contains(tree.at)) << house;
  }
}

TEST(RecipeObstacle, MistakesAreToldBeforeAnyWork) {
  const ScratchFolder folder;
  const auto mistake = [&](const std::string& text) {
    const auto built = build(folder, text);
    return built ? std::string() : built.error().message;
  };
  EXPECT_NE(mistake("[[obstacle]]\nname = 'x'\n").find("either file"), std::string::npos);
  EXPECT_NE(mistake("[[obstacle]]\npolygon = [[1, 1], [5, 1]]\n").find("three points"), std::string::npos);
  EXPECT_NE(mistake("[[obstacle]]\npolygon = [[1, 1], [5, 1], [5, 4]]\nscale = 2\n").find("meshes"), std::string::npos);
  EXPECT_NE(mistake("[[obstacle]]\npolygon = [[1, 1], [5, 1], [9, 1]]\n").find("no area"), std::string::npos);
  EXPECT_NE(mistake("[[obstacle]]\nname = 'x'\nfile = 'none.glb'\n").find("none.glb"), std::string::npos);
}

TEST(RecipeObstacle, OutlinesThatCrossThemselvesAndNamesGivenTwiceAreWarnedAbout) {
  const ScratchFolder folder;
  const auto built = build(folder,
                           "[[obstacle]]\nname = 'bow'\nid = -7\npolygon = [[1, 1], [9, 9], [9, 1], [1, 9]]\n"
                           "[[obstacle]]\nname = 'bow'\npolygon = [[20, 1], [25, 1], [25, 4]]\n");
  ASSERT_TRUE(built) << built.error().message;
  ASSERT_EQ(built->document.obstacles.size(), 3u);
  EXPECT_EQ(built->document.obstacles[1].id, -7);
  std::string warnings;
  for (const std::string& w : built->warnings) warnings += w + "\n";
  EXPECT_NE(warnings.find("obstacle 'bow': its outline crosses itself and makes 2 parts"), std::string::npos);
  EXPECT_NE(warnings.find("two obstacles are named 'bow'"), std::string::npos) << warnings;
}

}  // namespace
}  // namespace bosquet::exchange
