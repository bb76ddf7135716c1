// The patterns that planting makes, measured as the source's figures 6.6 to 6.9 show them.
//
// Confidence    at one distance a pattern without interaction lies above, or below, all of 199 random ones with
//               probability 1/200. Where five seeds are asked for, none skipped, a planting whose kernels did nothing
//               would pass with 3e-12 at each distance

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "distribution/pattern.h"
#include "distribution/sowing.h"

namespace bosquet::distribution {
namespace {

constexpr int kTrees = 120;
constexpr int kRuns = 199;
const Box2 kWindow{{0, 0}, {60, 60}};
const std::vector<double> kDistances{2, 4, 6, 8};

using K = std::vector<double>;

std::vector<Vec2> sown(const std::vector<Interaction>& interactions, std::uint64_t seed, std::uint32_t of_species,
                       int species_count) {
  std::vector<Species> list;
  Sowing what{.seed = seed, .block = 1, .first_index = 0, .mix = {}};
  for (int n = 0; n < species_count; ++n) {
    list.push_back({std::string(1, static_cast<char>('a' + n)), 0.2f, {.min_spacing_m = 0}});
    what.mix.push_back({static_cast<std::uint32_t>(n), 1});
  }
  auto planting = Planting::make(terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({60, 60}))), list,
                                 interactions, 0.25f);
  std::vector<Vec2> points;
  for (const StandingTree& tree : sow(*planting, what, kWindow, static_cast<std::size_t>(kTrees * species_count)).trees)
    if (tree.species == of_species) points.push_back(tree.at);
  return points;
}

// Least and largest K among random patterns of as many points.
struct Envelope {
  K low, high;
};
Envelope envelope() {
  static const Envelope made = [] {
    Envelope e{K(kDistances.size(), 1e9), K(kDistances.size(), 0)};
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      RandomStream stream(77, run, Purpose::statistics);
      std::vector<Vec2> points(kTrees);
      for (Vec2& p : points) p.x = stream.uniform(0, 60), p.y = stream.uniform(0, 60);
      const K k = ripley_k(points, kWindow, kDistances);
      for (std::size_t n = 0; n < k.size(); ++n) {
        e.low[n] = std::min(e.low[n], k[n]);
        e.high[n] = std::max(e.high[n], k[n]);
      }
    }
    return e;
  }();
  return made;
}

// The same of the cross-K of two kinds of points that take no notice of each other.
Envelope cross_envelope() {
  static const Envelope made = [] {
    Envelope e{K(kDistances.size(), 1e9), K(kDistances.size(), 0)};
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      RandomStream stream(78, run, Purpose::statistics);
      std::vector<Vec2> a(kTrees), b(kTrees);
      for (auto* points : {&a, &b})
        for (Vec2& p : *points) p.x = stream.uniform(0, 60), p.y = stream.uniform(0, 60);
      const K k = cross_k(a, b, kWindow, kDistances);
      for (std::size_t n = 0; n < k.size(); ++n) {
        e.low[n] = std::min(e.low[n], k[n]);
        e.high[n] = std::max(e.high[n], k[n]);
      }
    }
    return e;
  }();
  return made;
}

TEST(PlantingPatterns, ASpeciesThatDrawsItsOwnKindStandsInClusters) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const K k = ripley_k(sown({{"a", "a", KernelKind::clustering, 6, 20}}, seed, 0, 1), kWindow, kDistances);
    for (std::size_t n = 0; n < k.size(); ++n) {
      EXPECT_GT(k[n], std::numbers::pi * kDistances[n] * kDistances[n]);
      EXPECT_GT(k[n], envelope().high[n]) << kDistances[n] << " m, seed " << seed;
    }
  }
}

TEST(PlantingPatterns, ASpeciesThatKeepsItsOwnKindAwayIsMoreRegularThanChance) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const K k = ripley_k(sown({{"a", "a", KernelKind::inhibition, 5, 100}}, seed, 0, 1), kWindow, kDistances);
    for (std::size_t n = 0; n < 2; ++n) {  // within the kernel's radius
      EXPECT_LT(k[n], std::numbers::pi * kDistances[n] * kDistances[n]);
      EXPECT_LT(k[n], envelope().low[n]) << kDistances[n] << " m, seed " << seed;
    }
  }
}

TEST(PlantingPatterns, SpeciesThatInhibitEachOtherHaveACrossKBelowChance) {
  const std::vector<Interaction> apart{{"a", "b", KernelKind::inhibition, 6, 20},
                                       {"b", "a", KernelKind::inhibition, 6, 20}};
  std::vector<Interaction> clustered = apart;
  clustered.push_back({"a", "a", KernelKind::clustering, 6, 20});
  clustered.push_back({"b", "b", KernelKind::clustering, 6, 20});
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const auto& interactions : {apart, clustered}) {
      const K k = cross_k(sown(interactions, seed, 0, 2), sown(interactions, seed, 1, 2), kWindow, kDistances);
      for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_LT(k[n], std::numbers::pi * kDistances[n] * kDistances[n]);
        EXPECT_LT(k[n], cross_envelope().low[n]) << kDistances[n] << " m, seed " << seed;
      }
    }
}

TEST(PlantingPatterns, WithoutKernelsTreesStandAtRandom) {
  // The mean of 40 plantings, against the mean and spread of as many random patterns.
  for (std::size_t n = 0; n < kDistances.size(); ++n) {
    double mean = 0, squares = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const double k = ripley_k(sown({}, seed, 0, 1), kWindow, kDistances)[n];
      mean += k / 40, squares += k * k / 40;
    }
    const double exact = std::numbers::pi * kDistances[n] * kDistances[n];
    const double trunks = std::numbers::pi * 0.2 * 0.2;  // no two trunks overlap
    EXPECT_NEAR(mean, exact - trunks, 4 * std::sqrt((squares - mean * mean) / 40)) << kDistances[n] << " m";
  }
}

TEST(PlantingPatterns, AStrongerEffectClustersMore) {
  double before = 0;
  for (const float effect : {1.0f, 1.5f, 2.5f, 5.0f}) {
    double mean = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed)
      mean += ripley_k(sown({{"a", "a", KernelKind::clustering, 5, effect}}, seed, 0, 1), kWindow, kDistances)[1] / 10;
    EXPECT_GT(mean, 1.2 * before) << effect;
    before = mean;
  }
}

TEST(PlantingPatterns, ASpeciesThatInhibitsAnotherHasFewOfItNearby) {
  const std::vector<Interaction> apart{{"a", "b", KernelKind::inhibition, 5, 50},
                                       {"b", "a", KernelKind::inhibition, 5, 50}};
  double inhibited = 0, free = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    inhibited += cross_k(sown(apart, seed, 0, 2), sown(apart, seed, 1, 2), kWindow, kDistances)[0] / 10;
    free += cross_k(sown({}, seed, 0, 2), sown({}, seed, 1, 2), kWindow, kDistances)[0] / 10;
  }
  EXPECT_LT(inhibited, 0.5 * free);
}

}  // namespace
}  // namespace bosquet::distribution
