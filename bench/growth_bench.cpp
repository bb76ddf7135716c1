// Growth benchmarks: internodes kept for each second of one core.
//
// single    one free-standing tree of each built-in habit, again and again
// stand     300 trees on 30 x 30 m, each in the Voronoi cell of its base as a region of 0.25 m voxels, light of others
//           off, kappa >= 1, n_max <= 4, h_max 18 m: the hard case of the bar of 1,000,000 internodes kept a second
//           and core
// Counters  internodes/s; and markers tested, living buds visited and shadow updates for each internode kept, so that a
//           faster program can be told from one that does less
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "growth/grow.h"

namespace {

using namespace bosquet;
using namespace bosquet::growth;

Parameters broad() {
  Parameters p;
  p.internode_length_m = 0.2f;
  p.occupancy_radius = 2.2f, p.perception_depth = 2.2f;
  p.light_sensitivity = 1.0f, p.apical_dominance = 0.5f, p.max_shoot_length = 4;
  p.straightness = 0.4f, p.tropism = 0.2f, p.space = 0.4f, p.set_point_angle_deg = 45.0f;
  return p;
}

struct Totals {
  std::size_t kept = 0;
  std::size_t tall = 0;
  GrowthWork work;
  void add(const Skeleton& s, const GrowthWork& w, float height_m) {
    float top = 0.0f;
    for (std::size_t i = 0; i < s.size(); ++i) kept += s.alive(i), top = std::max(top, s.distal[i].y);
    tall += top >= 0.8f * height_m;
    work.markers_tested += w.markers_tested, work.bud_visits += w.bud_visits, work.shadow_updates += w.shadow_updates;
  }
  void report(benchmark::State& state) const {
    const auto n = static_cast<double>(kept);
    state.counters["internodes/s"] = benchmark::Counter(n, benchmark::Counter::kIsRate);
    state.counters["kept"] = benchmark::Counter(n, benchmark::Counter::kAvgIterations);
    state.counters["markers"] = static_cast<double>(work.markers_tested) / n;
    state.counters["buds"] = static_cast<double>(work.bud_visits) / n;
    state.counters["shadows"] = static_cast<double>(work.shadow_updates) / n;
  }
};

void single_tree(benchmark::State& state) {
  const Parameters p = broad();
  GrowthInput input;
  input.parameters = &p;
  input.max_height_m = 14.0f;
  Totals totals;
  for (auto _ : state) {
    input.key = static_cast<std::uint64_t>(state.iterations()) % 8;
    GrowthWork work;
    const Skeleton s = grow(input, nullptr, &work);
    totals.add(s, work, input.max_height_m);
    benchmark::DoNotOptimize(s.distal.data());
  }
  totals.report(state);
}
BENCHMARK(single_tree)->Unit(benchmark::kMillisecond);

struct Stand {
  std::vector<crowns::CrownRegion> regions;

  explicit Stand(int trees) : regions(static_cast<std::size_t>(trees)) {
    constexpr float kSide = 30.0f, kVoxel = 0.25f, kReach = 4.0f;
    constexpr int kHeight = 80;  // 20 m
    RandomStream random(7, 0, Purpose::planting);
    std::vector<Vec2> bases;
    while (bases.size() < regions.size()) {
      const Vec2 p{random.uniform(0.0f, kSide), random.uniform(0.0f, kSide)};
      bool near = false;
      for (const Vec2& b : bases) near = near || glm::length(b - p) < 0.8f;
      if (!near) bases.push_back(p);
    }
    for (std::size_t t = 0; t < regions.size(); ++t) {
      crowns::CrownRegion& r = regions[t];
      r.voxel_m = r.layer_m = kVoxel;
      r.low = {-kReach, 0.0f, -kReach};
      const int across = static_cast<int>(2.0f * kReach / kVoxel);
      r.cells = {across, kHeight, across};
      r.bits.assign((r.index({0, kHeight, 0}) + 63) / 64, 0);
      for (int z = 0; z < across; ++z) {
        for (int x = 0; x < across; ++x) {
          const Vec2 at = bases[t] + Vec2(r.low.x, r.low.z) + kVoxel * (Vec2(x, z) + 0.5f);
          const float own = glm::length(at - bases[t]);
          bool mine = own < kReach;
          for (std::size_t o = 0; mine && o < bases.size(); ++o) mine = glm::length(at - bases[o]) >= own;
          for (int y = 0; mine && y < kHeight; ++y) r.claim({x, y, z});
        }
      }
    }
  }
};

void stand(benchmark::State& state) {
  static const Stand plot(300);
  const Parameters p = broad();
  Totals totals;
  for (auto _ : state) {
    for (std::size_t t = 0; t < plot.regions.size(); ++t) {
      GrowthInput input;
      input.parameters = &p;
      input.max_height_m = 18.0f;
      input.region = &plot.regions[t];
      input.key = t;
      GrowthWork work;
      const Skeleton s = grow(input, nullptr, &work);
      totals.add(s, work, input.max_height_m);
    }
  }
  totals.report(state);
  state.counters["tall"] = benchmark::Counter(static_cast<double>(totals.tall), benchmark::Counter::kAvgIterations);
}
BENCHMARK(stand)->Unit(benchmark::kMillisecond);

void stand_on_all_cores(benchmark::State& state) {
  static const Stand plot(300);
  const Parameters p = broad();
  for (auto _ : state) {
    parallel_for(plot.regions.size(), [&](std::size_t t) {
      GrowthInput input;
      input.parameters = &p;
      input.max_height_m = 18.0f;
      input.region = &plot.regions[t];
      input.key = t;
      benchmark::DoNotOptimize(grow(input).size());
    });
  }
}
BENCHMARK(stand_on_all_cores)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
