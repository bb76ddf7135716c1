#include "exchange/gltf_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/random.h"
#include "exchange/mesh_order.h"
#include "exchange/tangents.h"
#include "sample_model.h"

namespace bosquet::exchange {
namespace {

// Misses of a first-in first-out cache of 16 vertices, per triangle.
double cache_misses(const std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> cache;
  std::size_t misses = 0;
  for (std::uint32_t i : indices) {
    if (std::find(cache.begin(), cache.end(), i) != cache.end()) continue;
    ++misses;
    cache.push_back(i);
    if (cache.size() > 16) cache.erase(cache.begin());
  }
  return 3.0 * static_cast<double>(misses) / static_cast<double>(indices.size());
}

TriangleMesh shuffled(TriangleMesh mesh) {
  RandomStream stream(5, 6, Purpose::statistics);
  for (std::size_t t = mesh.triangles() - 1; t > 0; --t) {
    const std::size_t other = stream.below(static_cast<std::uint32_t>(t + 1));
    for (std::size_t k = 0; k < 3; ++k) std::swap(mesh.indices[3 * t + k], mesh.indices[3 * other + k]);
  }
  return mesh;
}

TEST(MeshOrder, TheBestOrderReusesVerticesAndNumbersThemByFirstUse) {
  const TriangleMesh mesh = shuffled(tube(40, 40, 1, 3, 1));
  const MeshOrder order = best_order(mesh);
  EXPECT_GT(cache_misses(mesh.indices), 2.0);
  EXPECT_LT(cache_misses(order.indices), 0.9);  // 0.5 is the least possible for a grid
  std::uint32_t next = 0;
  for (std::uint32_t i : order.indices) {
    ASSERT_LE(i, next);
    if (i == next) ++next;
  }
  EXPECT_EQ(next, order.vertices.size());
}

TEST(MeshOrder, OrdersAreOfTheSameTriangles) {
  const TriangleMesh mesh = shuffled(tube(12, 9, 1, 3, 1));
  const auto faces = [](const std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>* vertices) {
    std::multiset<std::array<std::uint32_t, 3>> out;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      std::array<std::uint32_t, 3> f;
      for (std::size_t k = 0; k < 3; ++k) f[k] = vertices ? (*vertices)[indices[i + k]] : indices[i + k];
      std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
      out.insert(f);
    }
    return out;
  };
  for (const MeshOrder& order : {best_order(mesh), present_order(mesh)})
    EXPECT_EQ(faces(order.indices, &order.vertices), faces(mesh.indices, nullptr));
  EXPECT_EQ(present_order(mesh).indices, mesh.indices);
}

TEST(MeshOrder, UnusedVerticesAreLeftOutAndAnEmptyMeshStaysEmpty) {
  TriangleMesh mesh = tube(5, 2, 1, 1, 1);
  mesh.indices.resize(3);
  EXPECT_EQ(best_order(mesh).vertices.size(), 3u);
  EXPECT_EQ(present_order(mesh).vertices.size(), 3u);
  EXPECT_EQ(optimise(mesh).positions.size(), 3u);
  EXPECT_TRUE(optimise(TriangleMesh{}).empty());
}

TEST(Tangents, FollowGrowingUAndPointBitangentsUpTheImage) {
  // On the tube u grows against the clock seen from above and v falls upward.
  const TriangleMesh mesh = tube(64, 4, 1, 2, 1);
  const auto all = tangents(mesh);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3 t(all[i]), n = mesh.normals[i];
    EXPECT_NEAR(glm::length(t), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(t, n), 0.0f, 1e-5f);
    EXPECT_GT(glm::dot(t, glm::cross(kUp, n)), 0.998f);  // half a facet, 2.8 degrees, where the seam ends a fan
    EXPECT_GT(glm::dot(all[i].w * glm::cross(n, t), kUp), 0.99f);
  }
}

TEST(Tangents, MirroredCoordinatesTurnTheHandedness) {
  TriangleMesh mesh = tube(16, 2, 1, 2, 1);
  for (Vec2& uv : mesh.uvs) uv.x = -uv.x;
  for (const Vec4& t : tangents(mesh)) EXPECT_EQ(t.w, -1.0f);
  mesh = tube(16, 2, 1, 2, 1);
  for (const Vec4& t : tangents(mesh)) EXPECT_EQ(t.w, 1.0f);
}

TEST(Tangents, WithoutADirectionOfUAreSomeUnitPerpendicular) {
  TriangleMesh mesh = tube(16, 2, 1, 2, 1);
  std::fill(mesh.uvs.begin(), mesh.uvs.end(), Vec2(0.5f));
  const auto all = tangents(mesh);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(glm::length(Vec3(all[i])), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(Vec3(all[i]), mesh.normals[i]), 0.0f, 1e-5f);
  }
}

TEST(MeshLayout, PacksMeshesWithoutGapsOrOverlapsOnFourByteSteps) {
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 9; ++i) meshes.push_back(i % 2 ? tube(3 + i, 2, 1, 1, 2) : cards(3 + i));
  std::vector<MeshFacts> facts(meshes.size());
  std::uint64_t data = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    facts[m].mesh = &meshes[m];
    facts[m].textured = true;
    ASSERT_TRUE(measure(facts[m]));
    for (std::size_t s = 0; s < kStreams; ++s)
      data += facts[m].count(static_cast<Stream>(s)) * element_bytes(static_cast<Stream>(s));
  }
  const MeshLayout layout = lay_out(facts);
  ASSERT_EQ(layout.groups.size(), 1u);
  std::uint64_t at = 0, in_views = 0;
  for (const auto& view : layout.groups[0].views) {
    EXPECT_EQ(view.offset % 4, 0u);
    EXPECT_GE(view.offset, at);
    EXPECT_LT(view.offset - at, 4u);
    at = view.offset + view.length;
    in_views += view.length;
  }
  EXPECT_EQ(in_views, data);
  EXPECT_EQ(layout.bytes % 4, 0u);
  EXPECT_LT(layout.bytes - at, 4u);
}

TEST(MeshLayout, GroupsFollowEachOtherAndHoldAboutThirtyTwoMegabytes) {
  const TriangleMesh mesh = tube(300, 300, 1, 1, 2);  // some 4 MB
  std::vector<MeshFacts> facts(30);
  for (MeshFacts& f : facts) {
    f.mesh = &mesh;
    ASSERT_TRUE(measure(f));
  }
  const MeshLayout layout = lay_out(facts);
  ASSERT_GT(layout.groups.size(), 1u);
  std::uint64_t at = 0;
  std::size_t next = 0;
  for (const MeshGroup& group : layout.groups) {
    EXPECT_EQ(group.begin, at);
    EXPECT_EQ(group.first, next);
    EXPECT_LE(group.end - group.begin, 40u << 20);
    at = group.end, next = group.last;
  }
  EXPECT_EQ(at, layout.bytes);
  EXPECT_EQ(next, facts.size());
}

}  // namespace
}  // namespace bosquet::exchange
