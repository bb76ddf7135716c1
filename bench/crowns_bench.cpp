// Benchmarks of dividing the space: the plot of the source's table of speeds, and how the cost grows with the site.
//
// plot_300     300 clustered trees on 30 x 30 m, 128 x 128 x 20 voxels, as in Longay 2014 (1.05 s on 4 threads there);
//              bar: 110 ns a claimed voxel on one core
// Counters     ns_per_voxel: time over claimed voxels
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "core/parallel.h"
#include "core/random.h"
#include "crowns/asymmetry.h"
#include "crowns/crown_space.h"
#include "crowns/update_space.h"
#include "crowns/vdb.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

// Trees around cluster centres (ten to a cluster), heights and widths 0.5 to 1 of 20 m by 7 m.
std::vector<Claimant> clustered_trees(std::size_t count, float side_m) {
  std::vector<Claimant> trees(count);
  const auto clusters = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(count / 10));
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream draw(7, i, Purpose::planting);
    RandomStream centre(7, draw.below(clusters), Purpose::statistics);
    Claimant& t = trees[i];
    t.key = mix_bits(i + 1);
    t.id = static_cast<std::int32_t>(i) + 1;
    const Vec2 middle{centre.uniform(0.0f, side_m), centre.uniform(0.0f, side_m)};
    const float east = draw.uniform(-3.0f, 3.0f), north = draw.uniform(-3.0f, 3.0f);
    t.base = glm::clamp(middle + Vec2{east, north}, Vec2{0.0f}, Vec2{side_m});
    t.shape.crown_width_m = 7.0f;
    t.shape.mature_height_m = 20.0f;
    t.shape.trunk_width_m = 0.4f;
    t.scale_height = t.scale_width = draw.uniform(0.5f, 1.0f);
  }
  return trees;
}

terrain::Terrain flat(float side_m) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({side_m, side_m})));
}

SpaceOptions plot_options() {
  SpaceOptions o;
  o.voxel_m = 30.0f / 128.0f;
  o.layer_m = 1.0f;
  o.reach_factor = std::numeric_limits<float>::infinity();
  return o;
}

void count(benchmark::State& state, const CrownSpace& space) {
  const double voxels = static_cast<double>(space.claimed_voxels());
  state.counters["voxels"] = voxels;
  state.counters["ns_per_voxel"] =
      benchmark::Counter(voxels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void plot_300(benchmark::State& state) {
  const auto trees = clustered_trees(300, 30.0f);
  const auto ground = flat(30.0f);
  CrownSpace space;
  run_with_threads(static_cast<int>(state.range(0)), [&] {
    for (auto _ : state) space = *divide_space(trees, ground, plot_options());
  });
  count(state, space);
}
BENCHMARK(plot_300)->Arg(1)->ArgName("threads")->Unit(benchmark::kMillisecond);
BENCHMARK(plot_300)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

// Everything that the report's `crowns` holds: division, asymmetry and the OpenVDB grid.
void plot_300_whole_stage(benchmark::State& state) {
  const auto trees = clustered_trees(300, 30.0f);
  const auto ground = flat(30.0f);
  CrownSpace space;
  run_with_threads(static_cast<int>(state.range(0)), [&] {
    for (auto _ : state) {
      space = *divide_space(trees, ground, plot_options());
      benchmark::DoNotOptimize(neighbourhood_asymmetry(space, {}));
      benchmark::DoNotOptimize(build_grid(space).active_voxels());
    }
  });
  count(state, space);
}
BENCHMARK(plot_300_whole_stage)->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

// A thousand trees a hectare at 0.25 m with limited reach: cost goes with the voxels.
void hectares(benchmark::State& state) {
  const float side_m = static_cast<float>(state.range(0));
  const auto trees = clustered_trees(static_cast<std::size_t>(0.1f * side_m * side_m), side_m);
  const auto ground = flat(side_m);
  CrownSpace space;
  run_with_threads(1, [&] {
    for (auto _ : state) space = *divide_space(trees, ground, {});
  });
  count(state, space);
}
BENCHMARK(hectares)->Arg(16)->Arg(50)->Arg(158)->ArgName("side_m")->Unit(benchmark::kMillisecond);

// 10^8 voxels take half a minute: only when BOSQUET_BENCH_LARGE is set.
const bool large = [] {
  if (std::getenv("BOSQUET_BENCH_LARGE"))
    benchmark::RegisterBenchmark("hectares_large", hectares)
        ->Arg(500)
        ->Arg(660)
        ->ArgName("side_m")
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  return true;
}();

// Ten thousand trees on ten hectares, the whole, and one tree moved a metre; `voxels` are those that it claimed.
struct TenHectares {
  std::vector<Claimant> trees = clustered_trees(10'000, 316.0f);
  terrain::Terrain ground = flat(316.0f);
};

void ten_hectares(benchmark::State& state) {
  const TenHectares site;
  CrownSpace space;
  run_with_threads(static_cast<int>(state.range(0)), [&] {
    for (auto _ : state) space = *divide_space(site.trees, site.ground, {});
  });
  count(state, space);
  state.counters["MB"] = static_cast<double>(space.bytes()) * 1e-6;
}
BENCHMARK(ten_hectares)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

void one_of_ten_thousand_moved(benchmark::State& state) {
  TenHectares site;
  const CrownSpace space = *divide_space(site.trees, site.ground, {});
  const std::vector<Vec3> v = neighbourhood_asymmetry(space, {});
  const bool far = state.range(1) != 0;
  std::size_t n = 0, changed = 0, claimed = 0;
  run_with_threads(static_cast<int>(state.range(0)), [&] {
    for (auto _ : state) {
      auto trees = site.trees;
      Claimant& moved = trees[(n++ * 3571) % trees.size()];
      moved.base = glm::clamp(moved.base + (far ? Vec2{40.0f, -35.0f} : Vec2{0.8f, -0.6f}), Vec2{0.0f}, Vec2{316.0f});
      const auto update = *update_space(space, trees, {}, site.ground, {});
      benchmark::DoNotOptimize(update_asymmetry(space, v, update, {}, nullptr));
      changed += update.changed.size();
      claimed += update.space.claimed_voxels(static_cast<std::size_t>(&moved - trees.data()));
    }
  });
  state.counters["trees_changed"] = static_cast<double>(changed) / static_cast<double>(n);
  state.counters["voxels"] = static_cast<double>(claimed) / static_cast<double>(n);
}
BENCHMARK(one_of_ten_thousand_moved)
    ->ArgsProduct({{1, 2}, {0, 1}})
    ->ArgNames({"threads", "far"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void regions_of_plot_300(benchmark::State& state) {
  const auto trees = clustered_trees(300, 30.0f);
  const CrownSpace space = *divide_space(trees, flat(30.0f), plot_options());
  for (auto _ : state)
    for (std::size_t i = 0; i < trees.size(); ++i) benchmark::DoNotOptimize(region(space, i).bits.data());
}
BENCHMARK(regions_of_plot_300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bosquet::crowns
