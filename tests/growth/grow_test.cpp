#include "growth/grow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/parallel.h"
#include "core/scalar.h"
#include "growth/digest.h"
#include "growth/measure.h"
#include "growth/tree.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

/// A region whose voxels are claimed where `inside` says so, of 0.25 m voxels.
template <class Inside>
crowns::CrownRegion region_where(float half_m, float height_m, const Inside& inside) {
  crowns::CrownRegion r;
  r.voxel_m = r.layer_m = 0.25f;
  r.low = {-half_m, 0.0f, -half_m};
  r.cells = IVec3(static_cast<int>(2 * half_m / 0.25f), static_cast<int>(height_m / 0.25f),
                  static_cast<int>(2 * half_m / 0.25f));
  r.bits.assign((r.index({0, r.cells.y, 0}) + 63) / 64, 0);
  for (int y = 0; y < r.cells.y; ++y) {
    for (int z = 0; z < r.cells.z; ++z) {
      for (int x = 0; x < r.cells.x; ++x) {
        if (inside(r.low + 0.25f * (Vec3(x, y, z) + 0.5f))) r.claim({x, y, z});
      }
    }
  }
  return r;
}

TEST(Grow, AParentPrecedesItsChildrenAndIsBornNoLater) {
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.15f;
  const Skeleton s = grow(sample_input(p, 1));
  ASSERT_GT(s.size(), 500u);
  bool fell = false;
  for (std::size_t i = 0; i < s.size(); ++i) {
    ASSERT_LT(s.parent[i], static_cast<std::int32_t>(i));
    if (s.parent[i] < 0) continue;
    const auto parent = static_cast<std::size_t>(s.parent[i]);
    EXPECT_LE(s.born[parent], s.born[i]);
    EXPECT_GE(s.shed[parent], s.shed[i]) << "what stands on fallen wood has fallen";
    EXPECT_EQ(s.order[i], s.order[parent] + (s.axis[i] == s.axis[parent] ? 0 : 1));
    fell = fell || !s.alive(i);
  }
  EXPECT_TRUE(fell);
}

TEST(Grow, EveryInternodeHasTheTreesLength) {
  Parameters p = sample_parameters();
  p.deflection_angle_deg = 20.0f;  // turning wood must not stretch it
  const Skeleton s = grow(sample_input(p, 1));
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_NEAR(glm::length(s.distal[i] - s.proximal(i)), s.internode_length_m, 1e-5f);
  }
}

TEST(Grow, ATreeStopsWithinAnInternodeOfItsHeight) {
  const Parameters p = sample_parameters();
  for (const float height : {3.0f, 7.5f, 12.0f}) {
    const Skeleton s = grow(sample_input(p, 1, height));
    EXPECT_GE(measure(s).height_m, height);
    EXPECT_LE(measure(s).height_m, height + s.internode_length_m);
  }
}

TEST(Grow, ASmallTreeIsMadeOfSmallerInternodesAndTwigs) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 1, 2.0f));
  EXPECT_FLOAT_EQ(s.internode_length_m, 0.05f);
  EXPECT_FLOAT_EQ(s.tip_diameter_m, p.tip_diameter_m * 0.2f);
}

TEST(Grow, EqualInputsGiveEqualBitsForAnyNumberOfThreads) {
  const Parameters p = sample_parameters();
  constexpr std::size_t kTrees = 12;
  const auto stand = [&](int threads) {
    std::vector<std::uint64_t> digests(kTrees);
    run_with_threads(threads, [&] {
      parallel_for(kTrees, [&](std::size_t i) {
        GrowthInput input = sample_input(p, 9, 6.0f + static_cast<float>(i % 3));
        input.key = i;
        digests[i] = digest(grow(input));
      });
    });
    return digests;
  };
  const std::vector<std::uint64_t> alone = stand(1);
  EXPECT_EQ(std::set<std::uint64_t>(alone.begin(), alone.end()).size(), kTrees) << "trees differ from each other";
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(stand(threads), alone) << threads << " threads";
}

TEST(Grow, ATreeDoesNotDependOnTheOneGrownBefore) {
  const Parameters p = sample_parameters();
  Parameters other = p;
  other.occupancy_radius = 4.0f, other.perception_angle_deg = 90.0f, other.light_sensitivity = 2.5f;
  const std::uint64_t first = digest(grow(sample_input(p, 5)));
  grow(sample_input(other, 6, 15.0f));
  EXPECT_EQ(digest(grow(sample_input(p, 5))), first);
}

/// Changes the n-th described number, choice or switch, one step within its range, and says its name.
struct Nudge {
  int n = -1;  ///< none
  int at = 0;
  std::string name{};
  bool now(std::string_view key) {
    if (at++ != n) return false;
    name = key;
    return true;
  }
  void operator()(const Real& info, float& v) {
    if (v == std::numeric_limits<float>::lowest()) v = static_cast<float>(info.low);  // a key that was not given
    const float step = 0.01f * static_cast<float>(info.high - info.low);
    if (now(info.name)) v = v + step <= static_cast<float>(info.high) ? v + step : v - step;
  }
  void operator()(const Whole& info, int& v) {
    if (v == std::numeric_limits<int>::lowest()) v = info.low;
    if (now(info.name)) v = v < info.high ? v + 1 : v - 1;
  }
  void operator()(const Switch& info, bool& v) {
    if (now(info.name)) v = !v;
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& info, Enum& v) {
    if (now(info.name)) v = static_cast<Enum>((static_cast<int>(v) + 1) % static_cast<int>(info.names.size()));
  }
  template <class Item>
  void operator()(const Tables&, std::vector<Item>& items) {
    for (Item& item : items) describe(item, *this);
  }
};

TEST(Grow, TheHashSeesEveryParameterAlsoOfPhasesAndOrders) {
  Parameters base = sample_parameters();
  base.phases.resize(1), base.orders.resize(1);
  Nudge none;
  describe(base, none);  // gives every key of the phase and the order
  const std::uint64_t before = hash(sample_input(base, 5));
  std::set<std::uint64_t> hashes{before};
  for (int n = 0; n < none.at; ++n) {
    Parameters p = base;
    Nudge nudge{.n = n};
    describe(p, nudge);
    EXPECT_TRUE(hashes.insert(hash(sample_input(p, 5))).second) << nudge.name;
  }
  EXPECT_GT(none.at, 60);
  // A key that is given as it would be anyway is another input, though the tree may be the same.
  Parameters ungiven = base;
  ungiven.orders[0].change.straightness.reset();
  EXPECT_NE(hash(sample_input(ungiven, 5)), before);
}

TEST(Grow, TheHashSeesEveryInputAndNothingElse) {
  const Parameters p = sample_parameters();
  std::set<std::uint64_t> hashes;
  std::size_t inputs = 0;
  const auto add = [&](const GrowthInput& input) { hashes.insert(hash(input)), ++inputs; };
  GrowthInput input = sample_input(p, 5);
  add(input);
  input.max_height_m += 0.5f, add(input);
  input.seed = 6, add(input);
  input.key = 7, add(input);
  input.detail = 2.0f, add(input);
  input.clear_stem_m = 1.0f, add(input);
  for (const Vec3& v : {Vec3{0.5f, 0.0f, 0.0f}, Vec3{0.0f, 0.0f, 0.5f}}) input.asymmetry = v, add(input);
  auto region = region_where(3.0f, 12.0f, [](const Vec3& v) { return v.x > 0.0f; });
  input.region = &region, add(input);
  region.claim({0, 3, 0}), add(input);
  region.low.x += 0.25f, add(input);
  region.voxel_m = 0.5f, add(input);
  region.layer_m = 0.5f, add(input);
  Transmittance light;
  light.cells = {1, 1, 1}, light.level = {3};
  input.light = &light, add(input);
  light.level[0] = 4, add(input);
  light.low.y = 1.0f, add(input);
  light.cell_m = 2.0f, add(input);
  const std::vector<Vec3> markers{{0, 1, 0}, {0, 2, 0}};
  input.markers = markers, add(input);
  input.markers = std::span(markers).first(1), add(input);
  EXPECT_EQ(hashes.size(), inputs);

  // Where the parts lie in memory, and what was grown before, is nothing to it.
  const Parameters same_parameters = p;
  const crowns::CrownRegion same_region = region;
  const Transmittance same_light = light;
  const std::vector<Vec3> same_markers(markers.begin(), markers.begin() + 1);
  GrowthInput same = input;
  same.parameters = &same_parameters, same.region = &same_region, same.light = &same_light;
  same.markers = same_markers;
  grow(sample_input(p, 1, 4.0f));
  EXPECT_EQ(hash(same), hash(input));
}

TEST(Grow, InAShaftBetweenNeighboursATreeGrowsUpToItsHeightAndStaysNearlyUpright) {
  const Parameters p = sample_parameters();
  const crowns::CrownRegion shaft =
      region_where(2.0f, 14.0f, [](const Vec3& q) { return std::max(std::abs(q.x), std::abs(q.z)) < 0.25f; });
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    GrowthInput input = sample_input(p, seed);
    input.region = &shaft;
    input.asymmetry = {1.0f, 0.0f, 0.0f};  // pressed against a border where it has no room to lean
    const Skeleton s = grow(input);
    float top = 0.0f, astray = 0.0f;
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (!s.alive(i)) continue;
      top = std::max(top, s.distal[i].y);
      if (s.order[i] == 0)
        astray = std::max(astray, std::sqrt(s.distal[i].x * s.distal[i].x + s.distal[i].z * s.distal[i].z));
    }
    EXPECT_GE(top, 0.8f * input.max_height_m) << "seed " << seed;
    EXPECT_LT(astray, 2.5f) << "seed " << seed;
  }
}

TEST(Grow, ATreeWhoseFootHasNoRoomGrowsIntoTheRoomAbove) {
  const Parameters p = sample_parameters();
  const crowns::CrownRegion above =
      region_where(2.0f, 14.0f, [](const Vec3& q) { return q.y > 1.0f && q.x * q.x + q.z * q.z < 2.0f; });
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    GrowthInput input = sample_input(p, seed);
    input.region = &above;
    EXPECT_GE(measure(grow(input)).height_m, 0.8f * input.max_height_m) << "seed " << seed;
  }
}

TEST(Grow, ATreeInDeepShadeKeepsALivingTop) {
  Parameters p = sample_parameters();
  p.shedding_threshold = 0.55f;
  const Transmittance shade{{-6.0f, 0.0f, -6.0f}, 12.0f, {1, 2, 1}, {1, 1}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    GrowthInput input = sample_input(p, seed);
    input.light = &shade;
    const Skeleton s = grow(input);
    const float height = measure(s).height_m;
    int top = 0;
    for (std::size_t i = 0; i < s.size(); ++i) top += s.alive(i) && s.order[i] > 0 && s.distal[i].y > 0.8f * height;
    EXPECT_GE(top, 10) << "seed " << seed;
  }
}

TEST(Grow, InternodesEndInTheirRegionOrJustOutside) {
  const Parameters p = sample_parameters();
  const auto inside = [](const Vec3& v) { return v.x * v.x + v.z * v.z < 2.0f * 2.0f; };
  const auto region = region_where(3.0f, 13.0f, inside);
  GrowthInput input = sample_input(p, 2);
  input.region = &region;
  const Skeleton s = grow(input);
  ASSERT_GT(s.size(), 300u);
  int outside = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    outside += region.contains(s.distal[i]) ? 0 : 1;
    const float across = std::sqrt(s.distal[i].x * s.distal[i].x + s.distal[i].z * s.distal[i].z);
    EXPECT_LT(across, 2.0f + 2.0f * s.internode_length_m + 0.36f) << "two internodes and half a voxel's diagonal";
  }
  RecordProperty("outside_per_mille", static_cast<int>(1000 * outside / static_cast<int>(s.size())));
  EXPECT_LE(outside, static_cast<int>(s.size()) / 100);
}

TEST(Grow, NothingGrowsUndergroundNorOnAClearStem) {
  Parameters p = sample_parameters();
  p.set_point_angle_deg = 180.0f, p.max_shoot_length = 6;
  GrowthInput input = sample_input(p, 2);
  for (const Vec3& end : grow(input).distal) EXPECT_GE(end.y, 0.0f);
  p = sample_parameters();
  input.clear_stem_m = 3.0f;
  const Skeleton s = grow(input);
  EXPECT_GE(measure(s).height_m, 12.0f);
  for (std::size_t i = 0; i < s.size(); ++i) EXPECT_TRUE(s.order[i] == 0 || s.distal[i].y >= 3.0f);
}

TEST(Grow, APlanarTreeStaysInItsPlaneHoweverItsBudsStand) {
  for (const Phyllotaxis phyllotaxis :
       {Phyllotaxis::spiral, Phyllotaxis::distichous, Phyllotaxis::decussate, Phyllotaxis::whorled}) {
    Parameters p = sample_parameters();
    p.planar = true, p.phyllotaxis = phyllotaxis, p.deflection_angle_deg = 10.0f;
    const GrowthInput input = sample_input(p, 2);
    Tree tree;
    plant(tree, input);
    while (!tree.finished) grow_season(tree);
    ASSERT_GT(tree.wood.size(), 200u);
    float left = 0.0f, right = 0.0f;
    for (const Vec3& end : tree.wood.distal) {
      EXPECT_EQ(end.z, 0.0f);
      left = std::min(left, end.x), right = std::max(right, end.x);
    }
    EXPECT_LT(left, -1.0f);
    EXPECT_GT(right, 1.0f);
    for (const Bud& bud : tree.buds.each) EXPECT_EQ(bud.direction.z, 0.0f);
  }
}

/// Lateral buds as they were made, node by node along the trunk: unit vectors across it.
std::vector<std::vector<Vec3>> trunk_nodes(const Parameters& p) {
  const GrowthInput input = sample_input(p, 4);
  Tree tree;
  plant(tree, input);
  std::vector<std::vector<Vec3>> nodes;
  std::size_t seen = 0;
  while (!tree.finished) {
    grow_season(tree);
    for (std::size_t b = seen; b < tree.buds.size(); ++b) {
      if (tree.buds.origin[b].carrier < 0) continue;
      const auto carrier = static_cast<std::size_t>(tree.buds.origin[b].carrier);
      if (tree.wood.order[carrier] != 0) continue;
      const Vec3 h = tree.internodes.parts[carrier].heading;
      if (static_cast<std::size_t>(tree.internodes.parts[carrier].first_bud) == b) nodes.emplace_back();
      nodes.back().push_back(glm::normalize(tree.buds[b].direction - glm::dot(tree.buds[b].direction, h) * h));
    }
    seen = tree.buds.size();
  }
  return nodes;
}

float angle_deg(const Vec3& a, const Vec3& b) { return degrees(std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f))); }

/// A trunk as straight as can be, on which azimuths are easy to tell.
Parameters straight_trunk() {
  Parameters p = sample_parameters();
  p.straightness = 0.97f, p.tropism = 0.03f, p.space = 0.0f, p.apical_dominance = 0.54f;
  return p;
}

TEST(Phyllotaxis, BudsOfASpiralTurnByTheAngleGiven) {
  Parameters p = straight_trunk();
  p.phyllotactic_angle_deg = 100.0f;
  const auto nodes = trunk_nodes(p);
  ASSERT_GT(nodes.size(), 20u);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    ASSERT_EQ(nodes[i].size(), 1u);
    EXPECT_NEAR(angle_deg(nodes[i][0], nodes[i + 1][0]), 100.0f, 3.0f) << i;
  }
}

TEST(Phyllotaxis, DistichousBudsStandOnAlternatingSides) {
  Parameters p = straight_trunk();
  p.phyllotaxis = Phyllotaxis::distichous;
  const auto nodes = trunk_nodes(p);
  ASSERT_GT(nodes.size(), 20u);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    ASSERT_EQ(nodes[i].size(), 1u);
    EXPECT_NEAR(angle_deg(nodes[i][0], nodes[i + 1][0]), 180.0f, 3.0f) << i;
  }
}

TEST(Phyllotaxis, DecussateBudsStandOppositeAndPairsCross) {
  Parameters p = straight_trunk();
  p.phyllotaxis = Phyllotaxis::decussate;
  const auto nodes = trunk_nodes(p);
  ASSERT_GT(nodes.size(), 20u);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    ASSERT_EQ(nodes[i].size(), 2u);
    EXPECT_NEAR(angle_deg(nodes[i][0], nodes[i][1]), 180.0f, 0.1f) << i;
    EXPECT_NEAR(angle_deg(nodes[i][0], nodes[i + 1][0]), 90.0f, 3.0f) << i;
  }
}

TEST(Phyllotaxis, AWhorlStandsInTheGapsOfTheOneBelow) {
  for (const int whorl : {3, 5}) {
    Parameters p = straight_trunk();
    p.phyllotaxis = Phyllotaxis::whorled, p.whorl = whorl;
    const auto nodes = trunk_nodes(p);
    const float gap = 360.0f / static_cast<float>(whorl);
    ASSERT_GT(nodes.size(), 20u);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      ASSERT_EQ(nodes[i].size(), static_cast<std::size_t>(whorl));
      for (int k = 0; k < whorl; ++k) {
        const auto a = static_cast<std::size_t>(k), b = static_cast<std::size_t>((k + 1) % whorl);
        EXPECT_NEAR(angle_deg(nodes[i][a], nodes[i][b]), gap, 0.1f);
        float nearest_above = 360.0f;
        for (const Vec3& above : nodes[i + 1]) nearest_above = std::min(nearest_above, angle_deg(nodes[i][a], above));
        EXPECT_NEAR(nearest_above, 0.5f * gap, 3.0f) << i;
      }
    }
  }
}

TEST(Grow, SeveralStemsRiseFromOneBaseLeaningApartEvenly) {
  Parameters p = sample_parameters();
  p.stems = 5, p.stem_spread_deg = 30.0f;
  const GrowthInput input = sample_input(p, 2, 5.0f);
  Tree tree;
  plant(tree, input);
  std::vector<Vec3> ways;
  for (const Bud& bud : tree.buds.each) ways.push_back(bud.direction);
  ASSERT_EQ(ways.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const float lean = degrees(std::acos(ways[i].y));
    EXPECT_GE(lean, 0.59f * p.stem_spread_deg);
    EXPECT_LE(lean, 1.01f * p.stem_spread_deg);
    const auto level = [](const Vec3& v) { return glm::normalize(Vec3{v.x, 0.0f, v.z}); };
    EXPECT_NEAR(degrees(std::acos(glm::dot(level(ways[i]), level(ways[(i + 1) % 5])))), 72.0f, 0.1f);
  }
  while (!tree.finished) grow_season(tree);
  const Skeleton& s = tree.wood;
  std::set<std::uint32_t> axes;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.parent[i] >= 0) continue;
    EXPECT_EQ(s.order[i], 0);
    axes.insert(s.axis[i]);
  }
  EXPECT_EQ(axes.size(), 5u) << "each its own axis";
}

TEST(Grow, WhorlsStandAtShootEndsOnly) {
  Parameters p = sample_parameters();
  p.buds_at = BudsAt::shoot_end, p.whorl = 4, p.scattered = 0.0f, p.max_shoot_length = 5, p.apical_dominance = 0.54f;
  const Skeleton s = grow(sample_input(p, 2));
  int branches = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.parent[i] < 0 || s.axis[i] == s.axis[static_cast<std::size_t>(s.parent[i])]) continue;
    // The continuation of the axis past the branch was born in a later season than the node below it.
    const auto node = static_cast<std::size_t>(s.parent[i]);
    for (std::size_t k = node + 1; k < s.size(); ++k) {
      if (s.parent[k] == s.parent[i] && s.axis[k] == s.axis[node]) {
        EXPECT_GT(s.born[k], s.born[node]);
        ++branches;
      }
    }
  }
  EXPECT_GT(branches, 20);
}

TEST(Grow, ABoleHasNoBranches) {
  Parameters p = sample_parameters();
  p.bole = 0.25f;
  const Skeleton s = grow(sample_input(p, 2));
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.order[i] > 0) {
      EXPECT_TRUE(s.order[static_cast<std::size_t>(s.parent[i])] > 0 || s.proximal(i).y >= 3.0f);
    }
  }
}

TEST(Grow, AGrownTrunkHasLostTheBranchesBelowItsLiftedCrown) {
  Parameters p = sample_parameters();
  const Skeleton whole = grow(sample_input(p, 2));
  p.crown_lift = 0.5f;
  const Skeleton lifted = grow(sample_input(p, 2));
  const auto branches_below = [](const Skeleton& s, float share, int season) {
    int count = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const auto at = static_cast<std::size_t>(std::max(0, s.parent[i]));
      const bool foot = s.order[i] == 1 && s.parent[i] >= 0 && s.order[at] == 0;
      count += foot && s.born[i] <= season && s.shed[i] > season && s.proximal(i).y < share * 12.0f;
    }
    return count;
  };
  // Each branch falls between 0.6 and 1.2 of the lifted height.
  EXPECT_GT(branches_below(whole, 0.25f, whole.seasons), 0);
  EXPECT_EQ(branches_below(lifted, 0.25f, lifted.seasons), 0);
  EXPECT_GT(branches_below(lifted, 0.8f, lifted.seasons), 0);
  EXPECT_GT(branches_below(lifted, 0.25f, lifted.seasons / 4), 0) << "a young tree has them";
}

TEST(Grow, SaggingAxesHangTheLowerTheFartherTheyReach) {
  Parameters p = sample_parameters();
  const auto mean_rise = [&p](float sag, bool far) {
    p.sag_deg_per_m = sag;
    double rise = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Skeleton s = grow(sample_input(p, seed));
      for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 foot = s.proximal(i), way = s.distal[i] - foot;
        const float reach = std::sqrt(foot.x * foot.x + foot.z * foot.z);
        if (s.order[i] != 1 || (reach > 1.0f) != far) continue;
        rise += way.y / std::sqrt(glm::dot(way, way)), ++count;
      }
    }
    return rise / count;
  };
  EXPECT_LT(mean_rise(20.0f, true), mean_rise(20.0f, false) - 0.05);
  EXPECT_LT(mean_rise(20.0f, true), mean_rise(0.0f, true) - 0.15);
}

TEST(Grow, ACancelledTreeEndsAtOnce) {
  const Parameters p = sample_parameters();
  Progress progress;
  progress.cancel();
  EXPECT_EQ(grow(sample_input(p, 1), &progress).size(), 0u);
}

TEST(Grow, VigorLeavingAForkEqualsVigorArriving) {
  const Parameters p = sample_parameters();
  const GrowthInput input = sample_input(p, 1);
  Tree tree;
  plant(tree, input);
  while (tree.season < 12) grow_season(tree);
  sense(tree);
  share_vigor(tree);
  choose_growing(tree);
  fill_in_vigor(tree);
  std::vector<double> leaving(tree.wood.size(), 0.0);  // through the ways that stand on a node
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    if (tree.buds[b].node >= 0) leaving[static_cast<std::size_t>(tree.buds[b].node)] += tree.buds[b].flow;
  }
  int forks = 0;
  for (std::size_t i = tree.wood.size(); i-- > 0;) {
    const double arriving = tree.wood.vigor[i];
    if (leaving[i] > 1.01 * tree.internodes[i].rate[kMain] && tree.internodes[i].rate[kMain] > 0.0f) ++forks;
    EXPECT_NEAR(leaving[i], arriving, 1e-4 * arriving) << "internode " << i;
    if (tree.wood.parent[i] >= 0) leaving[static_cast<std::size_t>(tree.wood.parent[i])] += arriving;
  }
  EXPECT_GT(forks, 50);
}

TEST(Grow, DeflectionAsWideAsBranchingMakesSymmetricForks) {
  Parameters p = sample_parameters();
  p.straightness = 1.0f, p.tropism = 0.0f, p.space = 0.0f;
  p.branching_angle_deg = p.deflection_angle_deg = 40.0f;
  std::vector<float> differences;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Skeleton s = grow(sample_input(p, seed));
    for (std::size_t lateral = 0; lateral < s.size(); ++lateral) {
      if (s.parent[lateral] < 0) continue;
      const auto node = static_cast<std::size_t>(s.parent[lateral]);
      if (s.axis[lateral] == s.axis[node]) continue;
      for (std::size_t main = node + 1; main < s.size(); ++main) {
        if (s.parent[main] != s.parent[lateral] || s.axis[main] != s.axis[node]) continue;
        if (s.born[lateral] != s.born[main] + 1) continue;  // only last season's wood turns
        const auto heading = [&](std::size_t i) { return glm::normalize(s.distal[i] - s.proximal(i)); };
        const float turn = std::acos(std::clamp(glm::dot(heading(main), heading(node)), -1.0f, 1.0f));
        const float branch = std::acos(std::clamp(glm::dot(heading(lateral), heading(node)), -1.0f, 1.0f));
        differences.push_back(std::abs(degrees(turn - branch)));
      }
    }
  }
  ASSERT_GT(differences.size(), 30u);
  std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                   differences.end());
  EXPECT_LE(differences[differences.size() / 2], 2.0f);
}

}  // namespace
}  // namespace bosquet::growth
