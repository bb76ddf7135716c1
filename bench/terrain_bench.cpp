// Editing the ground of a site of 4096 x 4096 cells (2 km): a stroke of 20 m with a brush of 5 m and its undo, and the
// same stroke event by event as a window draws it. Bars on one core: 4 ms a stroke, 1 ms an undo.

#include <benchmark/benchmark.h>

#include <utility>
#include <vector>

#include "core/parallel.h"
#include "terrain/brush.h"
#include "terrain/difference.h"
#include "terrain/perlin.h"

namespace bosquet::terrain {
namespace {

const Terrain& site() {
  static const Terrain made = [] {
    Terrain ground = make_terrain(with_noise(Heightfield(*make_lattice({2048, 2048})), {3.0f, 40.0f, 2}, 1));
    return exclude(ground, {{{900, 900}, {1200, 900}, {1200, 1200}, {900, 1200}}, {}},
                   {"lawn", AreaKind::lawn, Cover::grass});
  }();
  return made;
}

Stroke twenty_metres(BrushKind kind) {
  return {.kind = kind, .points = {{1018, 1016}, {1030, 1032}}, .radius_m = 5, .area = {"walk", AreaKind::path}};
}

void stroke(benchmark::State& state) {
  const Stroke brush = twenty_metres(static_cast<BrushKind>(state.range(0)));
  state.SetLabel(std::string(kBrushKindNames[static_cast<std::size_t>(state.range(0))]));
  const Terrain& before = site();
  std::size_t tiles = 0;
  run_with_threads(1, [&] {
    for (auto _ : state) {
      const Edit done = edit(before, brush);
      benchmark::DoNotOptimize(&done);
      state.PauseTiming();
      tiles = difference(before, done.terrain).tiles();
      state.ResumeTiming();
    }
  });
  state.counters["tiles"] = static_cast<double>(tiles);
}
BENCHMARK(stroke)->DenseRange(0, 7)->Unit(benchmark::kMillisecond);

// Going back to the earlier value: the later one is let go of, and what differs is listed for redrawing.
void undo(benchmark::State& state) {
  const Terrain& before = site();
  const Stroke brush = twenty_metres(BrushKind::raise);
  run_with_threads(1, [&] {
    for (auto _ : state) {
      state.PauseTiming();
      Terrain now = apply(before, brush);
      state.ResumeTiming();
      const Difference d = difference(now, before);
      now = before;
      benchmark::DoNotOptimize(d.tiles());
    }
  });
}
BENCHMARK(undo)->Unit(benchmark::kMillisecond);

// One event of a stroke that is being drawn, a metre a time.
void live_event(benchmark::State& state) {
  const auto kind = static_cast<BrushKind>(state.range(0));
  state.SetLabel(std::string(kBrushKindNames[static_cast<std::size_t>(state.range(0))]));
  Stroke brush = twenty_metres(kind);
  brush.points = {{1000, 1000}};
  run_with_threads(1, [&] {
    LiveStroke live(site(), brush);
    float east = 1000;
    for (auto _ : state) {
      if (east > 1200) state.PauseTiming(), live = LiveStroke(site(), brush), east = 1000, state.ResumeTiming();
      const Vec2 next[] = {{east += 1.0f, 1000}};
      benchmark::DoNotOptimize(live.extend(next));
      const Terrain shown = live.terrain();
      benchmark::DoNotOptimize(&shown);
    }
  });
}
BENCHMARK(live_event)->Arg(0)->Arg(2)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bosquet::terrain
