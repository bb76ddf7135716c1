#include <gtest/gtest.h>

#include <map>

#include "geometry/prism.h"

namespace bosquet::geometry {
namespace {

// An L with a courtyard in its broad arm.
Polygon court() {
  return {{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 16}, {0, 16}}, {{{11, 2}, {17, 2}, {17, 6}, {11, 6}}}};
}

double plan_area(const TriangleMesh& mesh, bool up) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
               c = mesh.positions[mesh.indices[t + 2]];
    const double twice = static_cast<double>(glm::cross(b - a, c - a).y);
    if ((twice > 0) == up) sum += 0.5 * std::fabs(twice);
  }
  return sum;
}

TEST(Prism, RoofAndFloorCoverTheOutlineAndNoHole) {
  const TriangleMesh mesh = prism(court(), 1.0f, 7.0f);
  EXPECT_NEAR(plan_area(mesh, true), 20 * 8 + 8 * 8 - 24, 1e-3);
  EXPECT_NEAR(plan_area(mesh, false), 20 * 8 + 8 * 8 - 24, 1e-3);
  // In turned outlines too.
  Polygon other = court();
  std::reverse(other.ring.begin(), other.ring.end());
  std::reverse(other.holes[0].begin(), other.holes[0].end());
  EXPECT_NEAR(plan_area(prism(other, 1.0f, 7.0f), true), 200, 1e-3);
}

TEST(Prism, ItsVolumeIsAreaTimesHeightSoItIsClosedAndFacesOutward) {
  const TriangleMesh mesh = prism(court(), 1.0f, 7.0f);
  double volume = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const DVec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]),
        c(mesh.positions[mesh.indices[t + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), DVec3(mesh.normals[mesh.indices[t]])), 0.0);
  }
  EXPECT_NEAR(volume, 200 * 6, 1e-3);
}

TEST(Prism, AnOutlineWithoutAreaIsEmpty) {
  EXPECT_TRUE(prism({{{0, 0}, {5, 0}, {9, 0}}, {}}, 0, 3).empty());
  EXPECT_TRUE(prism({{{0, 0}, {5, 0}}, {}}, 0, 3).empty());
}

}  // namespace
}  // namespace bosquet::geometry
