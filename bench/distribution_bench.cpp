// Planting by deformation kernels: 300 trees on 256 x 256 cells (30 m) and 10,000 on 1024 x 1024 (316 m), three
// species whose nine pairs all act within 3 m. Bars on one core: 5 ms and 80 ms, fields' making included.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "core/parallel.h"
#include "distribution/sowing.h"

namespace bosquet::distribution {
namespace {

void plant(benchmark::State& state) {
  const auto side = static_cast<float>(state.range(0));
  const auto cells = static_cast<float>(state.range(1));
  const auto count = static_cast<std::size_t>(state.range(2));
  std::vector<Species> species;
  std::vector<Interaction> interactions;
  for (const char* name : {"a", "b", "c"}) species.push_back({name, 0.3f, {}});
  for (const Species& of : species)
    for (const Species& on : species)
      interactions.push_back(
          {of.name, on.name, of.name == on.name ? KernelKind::clustering : KernelKind::inhibition, 3.0f, 4.0f});
  const auto terrain = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({side, side})));
  run_with_threads(1, [&] {
    for (auto _ : state) {
      auto planting = Planting::make(terrain, species, interactions, side / cells);
      const Sowing what{.seed = 1, .block = 2, .mix = {{0, 1}, {1, 1}, {2, 1}}};
      const Sown sown = sow(*planting, what, Box2{Vec2{0}, Vec2{side}}, count);
      if (sown.trees.size() != count) state.SkipWithError("not all trees found room");
      benchmark::DoNotOptimize(sown.trees.data());
    }
  });
  state.counters["us/tree"] = benchmark::Counter(
      static_cast<double>(count) * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(plant)
    ->ArgNames({"side_m", "cells", "trees"})
    ->Args({30, 256, 300})
    ->Args({316, 1024, 10'000})
    ->Unit(benchmark::kMillisecond)
    ->Repetitions(9)
    ->ReportAggregatesOnly();

// A brush of 10 m moving over a large site: the rim of the mask at every draw.
void brush(benchmark::State& state) {
  const auto terrain = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({500, 500})));
  const std::vector<Species> species{{"a", 0.3f, {}}};
  auto planting = Planting::make(terrain, species, {});
  const std::vector<Vec2> points{{20, 20}, {480, 480}};
  Sowing what{.seed = 1, .block = 2, .mix = {{0, 1}}};
  std::size_t trees = 0;
  for (auto _ : state) {
    const Sown sown = sow_stroke(*planting, what, {10.0f, 1.0f, 0.2f}, steady_stroke(points, 10));
    what.first_index += sown.asked;
    trees += sown.trees.size();
  }
  state.counters["us/tree"] =
      benchmark::Counter(static_cast<double>(trees) * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(brush)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace
}  // namespace bosquet::distribution
