#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "geometry/branch_mesh.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

constexpr float kLeastArea = 1e-9f;  // a thousandth of a square millimetre

BranchCurves curves_of(const growth::Skeleton& s) {
  return branch_curves(s, s.radius, thickest_paths(s, s.radius, standing(s, -1)));
}

/// An unbranched upright stem of `n` internodes of half a metre, `radius` thick all along.
growth::Skeleton pole(int n, float radius) {
  growth::Skeleton s;
  for (int i = 0; i < n; ++i) {
    s.parent.push_back(i - 1);
    s.axis.push_back(0);
    s.order.push_back(0);
    s.distal.push_back({0, 0.5f * static_cast<float>(i + 1), 0});
    s.radius.push_back(radius);
    s.born.push_back(static_cast<std::uint16_t>(i));
    s.shed.push_back(growth::kNever);
    s.light.push_back(1);
    s.vigor.push_back(1);
  }
  s.seasons = n;
  s.internode_length_m = 0.5f;
  return s;
}

/// How far `p` lies outside the surface of a curve, metres; below 0 inside.
float outside(const BranchCurves& curves, const BranchCurve& curve, const Vec3& p) {
  const auto samples = curves.of(curve);
  float least = 1e9f;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Vec3 a = samples[k - 1].centre, step = samples[k].centre - a;
    const float t = std::clamp(glm::dot(p - a, step) / glm::dot(step, step), 0.0f, 1.0f);
    least = std::min(least, glm::length(p - a - t * step) - glm::mix(samples[k - 1].radius, samples[k].radius, t));
  }
  return least;
}

TEST(BranchMesh, IsSoundForEveryHabitAndCoarseness) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const BranchCurves curves = curves_of(s);
    for (const float coarseness : {1.0f, 3.0f, 8.0f, 200.0f}) {
      const BranchPlan plan = plan_branches(curves, coarseness);
      const TriangleMesh mesh = mesh_branches(curves, plan, {}, 1, 2);
      EXPECT_EQ(mesh.triangles(), plan.triangles);
      EXPECT_EQ(mesh.positions.size(), plan.vertices);
      expect_sound(mesh, kLeastArea);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(BranchMesh, TrianglesFaceOutward) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const BranchCurves curves = curves_of(s);
    const TriangleMesh mesh = mesh_branches(curves, plan_branches(curves, 1.0f), {}, 1, 2);
    // Where a limb bends more sharply than it is thick a few triangles at the inner side may turn over.
    EXPECT_GT(share_facing_their_normals(mesh), 0.995);
  }
}

TEST(BranchMesh, IsClosedButForBasesInsideTheParentOrUnderTheGround) {
  for (std::size_t habit = 0; habit < 7; ++habit) {
    const growth::Skeleton s = test_skeletons()[habit];
    const BranchCurves curves = curves_of(s);
    const TriangleMesh mesh = mesh_branches(curves, plan_branches(curves, 2.0f), {}, 1, 2);

    // Vertices at one place are one; an edge that has no opposite is open.
    std::map<std::tuple<float, float, float>, std::uint32_t> place;
    std::vector<std::uint32_t> weld(mesh.positions.size());
    for (std::size_t v = 0; v < weld.size(); ++v) {
      const Vec3 p = mesh.positions[v];
      weld[v] = place.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(v)).first->second;
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        ++edges[{weld[mesh.indices[3 * t + k]], weld[mesh.indices[3 * t + (k + 1) % 3]]}];
    std::size_t open = 0;
    for (const auto& [edge, times] : edges) {
      ASSERT_EQ(times, 1) << "two triangles on one side of an edge";
      if (edges.count({edge.second, edge.first})) continue;
      ++open;
      const Vec3 p = mesh.positions[edge.first];
      bool hidden = p.y < 0.0f;
      for (const BranchCurve& curve : curves.curves) {
        if (hidden) break;
        if (curve.count == 0) continue;
        const float radius = curves.of(curve)[0].radius;
        hidden = outside(curves, curve, p) < 0.05f * radius;
      }
      EXPECT_TRUE(hidden) << "habit " << habit << " at " << p.x << ' ' << p.y << ' ' << p.z;
    }
    EXPECT_GE(open, 3u) << "a stem's foot is open";
  }
}

TEST(BranchMesh, ChildRingsBeginInsideTheParentsRadius) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const BranchCurves curves = curves_of(s);
    for (const BranchCurve& child : curves.curves) {
      if (child.parent < 0 || child.count == 0) continue;
      const BranchCurve& parent = curves.curves[static_cast<std::size_t>(child.parent)];
      if (parent.count == 0) continue;
      const BranchSample& base = curves.of(child)[0];
      EXPECT_LT(outside(curves, parent, base.centre), 0.0f);
      // Its rim too, but for a tenth of its radius where the parent bends away.
      for (int k = 0; k < 8; ++k) {
        const Vec3 rim = base.centre + base.radius * across(base.tangent, 0.25f * kPi * static_cast<float>(k));
        EXPECT_LT(outside(curves, parent, rim), 0.1f * base.radius);
      }
    }
  }
}

TEST(BranchMesh, ACollarWidensTowardTheParent) {
  const growth::Skeleton s = test_skeleton({}, 2);
  const BranchCurves curves = curves_of(s);
  int collars = 0;
  for (const BranchCurve& c : curves.curves) {
    if (c.parent < 0 || c.count < 4) continue;
    const auto samples = curves.of(c);
    for (std::size_t k = 1; k < samples.size(); ++k) EXPECT_LE(samples[k].radius, samples[k - 1].radius * 1.0001f);
    collars += samples[0].radius > 1.1f * samples[0].wood;
  }
  EXPECT_GT(collars, 20);
}

TEST(BranchMesh, StraightWoodNeedsFewRings) {
  const BranchCurves curves = curves_of(pole(40, 0.2f));
  const BranchPlan plan = plan_branches(curves, 1.0f);
  // 20 m of pole: at most a ring every metre and those of the root flare, each of at most kMostSides sides.
  EXPECT_LT(plan.triangles, 2u * kMostSides * 30u);
  const auto samples = curves.of(curves.curves[0]);
  EXPECT_LT(std::count_if(samples.begin(), samples.end(), [](const BranchSample& b) { return b.matters > 1.0f; }), 30);
}

TEST(BranchMesh, TheRootFlareEndsBelowBreastHeightAndTheFootIsUnderTheGround) {
  const BranchCurves curves = curves_of(pole(10, 0.4f));
  const auto samples = curves.of(curves.curves[0]);
  EXPECT_LT(samples.front().centre.y, -0.3f);
  for (const BranchSample& b : samples) {
    if (b.centre.y <= 0.0f) {
      EXPECT_GT(b.radius, 1.2f * b.wood);
    } else if (b.centre.y >= 1.3f) {
      EXPECT_EQ(b.radius, b.wood);
    }
  }
}

TEST(BranchMesh, BarkIsDrawnAtTrueScale) {
  // A pole just three tiles around: three repeats, and along it a tile for each tile length.
  Look look;
  look.bark.tile_m = 0.5f;
  const float radius = 3.0f * look.bark.tile_m / (2.0f * kPi);
  const BranchCurves curves = curves_of(pole(10, radius));
  const TriangleMesh mesh = mesh_branches(curves, plan_branches(curves, 1.0f), look, 1, 2);
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* i = mesh.indices.data() + 3 * t;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = i[k], b = i[(k + 1) % 3];
      const Vec3 d = mesh.positions[b] - mesh.positions[a];
      if (mesh.positions[a].y < 1.3f || mesh.positions[b].y < 1.3f || mesh.positions[b].y >= 5.0f ||
          mesh.positions[a].y >= 5.0f)
        continue;
      EXPECT_NEAR(mesh.uvs[b].y - mesh.uvs[a].y, -d.y / look.bark.tile_m, 1e-3f);
      if (std::abs(d.y) > 1e-4f) continue;
      // Around: the chord is shorter than the arc by less than 1 % from 20 sides up.
      const float arc = std::abs(mesh.uvs[b].x - mesh.uvs[a].x) * look.bark.tile_m;
      EXPECT_NEAR(arc, glm::length(d), 0.01f * arc);
    }
  }
}

TEST(BranchMesh, BarkIsStretchedNeitherAlongNorAround) {
  Look look;
  const growth::Skeleton s = test_skeleton({}, 5);
  const BranchCurves curves = curves_of(s);
  // The trunk alone, above the flare.
  const TriangleMesh mesh = [&] {
    BranchCurves trunk{{curves.curves[0]}, curves.samples, curves.tip_radius};
    return mesh_branches(trunk, plan_branches(trunk, 1.0f), look, 1, 2);
  }();
  const float repeats = std::max(1.0f, std::floor(2.0f * kPi * s.radius[0] / look.bark.tile_m + 0.5f));
  int checked = 0;
  float mean = 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* i = mesh.indices.data() + 3 * t;
    if (std::min({mesh.positions[i[0]].y, mesh.positions[i[1]].y, mesh.positions[i[2]].y}) < 1.3f) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = i[k], b = i[(k + 1) % 3], c = i[(k + 2) % 3];
      if (std::abs(mesh.uvs[a].y - mesh.uvs[b].y) > 1e-6f) continue;          // a-b goes around, c lies along
      const float share = std::abs(mesh.uvs[b].x - mesh.uvs[a].x) / repeats;  // of the whole way around
      const float arc = glm::length(mesh.positions[b] - mesh.positions[a]) * kPi * share / sin_cos(kPi * share).sin;
      const Vec3 e = glm::normalize(mesh.positions[b] - mesh.positions[a]), d = mesh.positions[c] - mesh.positions[a];
      const float along = glm::length(d - glm::dot(d, e) * e);
      if (arc / (share * repeats) < 0.1f * look.bark.tile_m) continue;  // as fine as bark gets
      const float around_scale = arc / (share * repeats), along_scale = along / std::abs(mesh.uvs[c].y - mesh.uvs[a].y);
      // Taper within a strip and the longer way outside a bend are what remains.
      EXPECT_NEAR(around_scale / along_scale, 1.0f, 0.35f);
      mean += around_scale / along_scale;
      ++checked;
    }
  }
  ASSERT_GT(checked, 100);
  EXPECT_NEAR(mean / static_cast<float>(checked), 1.0f, 0.03f);
}

TEST(BranchMesh, CoarserIsNeverMore) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const BranchCurves curves = curves_of(s);
    std::size_t last = plan_branches(curves, 1.0f).triangles;
    for (const float coarseness : {2.0f, 4.0f, 8.0f, 32.0f}) {
      const std::size_t now = plan_branches(curves, coarseness).triangles;
      EXPECT_LE(now, last);
      last = now;
    }
  }
}

TEST(BranchMesh, ABudgetIsKeptAndDropsNoBranchBeforeTheBranchesItBears) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const BranchCurves curves = curves_of(s);
    const auto stems = static_cast<std::size_t>(
        std::count_if(curves.curves.begin(), curves.curves.end(), [](const BranchCurve& c) { return c.parent < 0; }));
    for (const std::size_t budget : {100u, 300u, 1000u, 5000u, 20000u, 100000u}) {
      const BranchPlan plan = plan_branches_within(curves, budget);
      EXPECT_LE(plan.triangles, std::max(budget, kLeastStemTriangles * stems));
      for (std::size_t c = 0; c < curves.curves.size(); ++c)
        if (plan.keep[c] && curves.curves[c].parent >= 0) {
          EXPECT_TRUE(plan.keep[static_cast<std::size_t>(curves.curves[c].parent)]);
        }
      const TriangleMesh mesh = mesh_branches(curves, plan, {}, 1, 2);
      EXPECT_EQ(mesh.triangles(), plan.triangles);
      EXPECT_EQ(mesh.positions.size(), plan.vertices);
      // A budget is used: at least half of it, where there is enough to show.
      if (plan_branches(curves, 1.0f).triangles > 2 * budget) {
        EXPECT_GT(2 * plan.triangles, budget);
      }
    }
  }
}

TEST(BranchMesh, OcclusionGrowsWithLight) {
  EXPECT_FLOAT_EQ(occlusion(0.0f), kDeepShade);
  EXPECT_FLOAT_EQ(occlusion(1.0f), 1.0f);
  for (int k = 1; k <= 10; ++k)
    EXPECT_GT(occlusion(0.1f * static_cast<float>(k)), occlusion(0.1f * static_cast<float>(k - 1)));
}

TEST(BranchMesh, WoodWithoutLengthIsLeftOut) {
  growth::Skeleton s = pole(4, 0.1f);
  s.parent.push_back(1);  // a bud that never grew
  s.axis.push_back(1), s.order.push_back(1), s.distal.push_back(s.distal[1]), s.radius.push_back(0.01f);
  s.born.push_back(2), s.shed.push_back(growth::kNever), s.light.push_back(1), s.vigor.push_back(0);
  const BranchCurves curves = curves_of(s);
  expect_sound(mesh_branches(curves, plan_branches(curves, 1.0f), {}, 1, 2), kLeastArea);
}

}  // namespace
}  // namespace bosquet::geometry
