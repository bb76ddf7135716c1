// Growth benchmarks: internodes kept for each second of one core.
//
// stand/N        the trees of examples/plots/plot_N.toml in their own crown regions with their own asymmetry, planted and
//                divided as `bosquet make` does, but all with the numbers of `bench_parameters`: the default species keep
//                some 90,000 internodes on the plot of 300, the bar of 1,000,000 a second and core asks for 600,000 and
//                more, every tree at least 0.8 of its final height, light sensitivity >= 1 and shoots of at most 4
// species/N      the same plots with the species as they are
// best           stand/300 and species/300, each tree at the least of its processor times in five rounds, which other work
//                on the machine disturbs little
// free_standing  one oak without neighbours
// steps/N        stand/N stepped season by season with a clock around each step, in % of the whole; `equal` is 1 when
//                the skeletons are those of grow()
// two_cores/N    stand/N on two cores: the speed-up over one core, divided by the speed-up of a loop that only computes,
//                run just before and after; the median of nine
// Counters       internodes/s; kept: living at the end; tall: share of trees of at least 0.8 of their final height;
//                markers tested, living buds visited and shadow updates for each internode kept, so that a faster
//                program can be told from one that does less; bytes: of the finished skeleton for each internode kept
// Where          docs/performance.md has the figures and how to see more of where the time goes
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/heap.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "crowns/asymmetry.h"
#include "crowns/crown_space.h"
#include "exchange/recipe.h"
#include "growth/digest.h"
#include "growth/grow.h"
#include "growth/tree.h"
#include "scene/grown_scene.h"

namespace {

using namespace bosquet;
using namespace bosquet::growth;

/// A broad-leaved tree that needs every step: it sheds, deflects, is pressed by its neighbours and looks for light.
Parameters bench_parameters() {
  Parameters p;
  p.internode_length_m = 0.14f;
  p.occupancy_radius = 2.2f, p.perception_depth = 2.2f;
  p.shadow_strength = 0.02f, p.light_sensitivity = 1.0f, p.apical_dominance = 0.5f, p.max_shoot_length = 4;
  p.straightness = 0.4f, p.tropism = 0.2f, p.space = 0.4f, p.set_point_angle_deg = 45.0f;
  p.deflection_angle_deg = 8.0f, p.shedding_threshold = 0.01f;
  return p;
}

template <class T>
T value_or_exit(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
  }
  return std::move(*result);
}

/// The trees of a plot, ready to grow.
struct Plot {
  scene::Document document;
  std::vector<crowns::CrownRegion> regions;
  std::vector<Vec3> asymmetry;
  std::vector<float> costs;

  explicit Plot(int trees) {
    const std::string file =
        std::string(BOSQUET_SOURCE_DIR) + "/examples/plots/plot_" + std::to_string(trees) + ".toml";
    document = value_or_exit(exchange::build_document(value_or_exit(exchange::read_recipe(file)))).document;
    const crowns::CrownSpace space =
        value_or_exit(crowns::divide_space(scene::claimants(document), *document.terrain, document.space, nullptr));
    asymmetry = crowns::neighbourhood_asymmetry(space, document.asymmetry);
    for (std::size_t t = 0; t < document.trees->size(); ++t) {
      regions.push_back(crowns::region(space, t));
      const float height = document.mature_height_m((*document.trees)[t]);
      costs.push_back(height * height);
    }
  }
  static const Plot& of(int trees) {
    static std::map<int, Plot> plots;
    return plots.try_emplace(trees, trees).first->second;
  }
  std::size_t size() const { return regions.size(); }
  /// Null: the species' own parameters.
  GrowthInput input(std::size_t t, const Parameters* parameters) const {
    const scene::Tree& tree = (*document.trees)[t];
    GrowthInput input;
    input.parameters = parameters ? parameters : &document.species_of(tree).growth;
    input.max_height_m = document.mature_height_m(tree);
    input.region = &regions[t], input.asymmetry = asymmetry[t];
    input.seed = document.seed, input.key = tree.key;
    return input;
  }
};

std::size_t bytes(const Skeleton& s) {
  return s.parent.capacity() * sizeof(s.parent[0]) + s.axis.capacity() * sizeof(s.axis[0]) +
         s.order.capacity() * sizeof(s.order[0]) + s.distal.capacity() * sizeof(s.distal[0]) +
         s.radius.capacity() * sizeof(s.radius[0]) + s.born.capacity() * sizeof(s.born[0]) +
         s.shed.capacity() * sizeof(s.shed[0]) + s.light.capacity() * sizeof(s.light[0]) +
         s.vigor.capacity() * sizeof(s.vigor[0]);
}

struct Totals {
  double kept = 0, bytes_held = 0, trees = 0, tall = 0;
  GrowthWork work;
  void add(const Skeleton& s, const GrowthWork& w, float height_m) {
    float top = 0.0f;
    for (std::size_t i = 0; i < s.size(); ++i) kept += s.alive(i), top = std::max(top, s.distal[i].y);
    trees += 1.0, tall += top >= 0.8f * height_m;
    bytes_held += static_cast<double>(bytes(s));
    work.markers_tested += w.markers_tested, work.bud_visits += w.bud_visits, work.shadow_updates += w.shadow_updates;
  }
  void report(benchmark::State& state) const {
    state.counters["internodes/s"] = benchmark::Counter(kept, benchmark::Counter::kIsRate);
    state.counters["kept"] = benchmark::Counter(kept, benchmark::Counter::kAvgIterations);
    state.counters["tall"] = tall / trees;
    state.counters["markers"] = static_cast<double>(work.markers_tested) / kept;
    state.counters["buds"] = static_cast<double>(work.bud_visits) / kept;
    state.counters["shadows"] = static_cast<double>(work.shadow_updates) / kept;
    state.counters["bytes"] = bytes_held / kept;
  }
};

void grow_plot(benchmark::State& state, const Parameters* parameters) {
  const Plot& plot = Plot::of(static_cast<int>(state.range(0)));
  Totals totals;
  for (auto _ : state) {
    for (std::size_t t = 0; t < plot.size(); ++t) {
      const GrowthInput input = plot.input(t, parameters);
      GrowthWork work;
      const Skeleton s = grow(input, nullptr, &work);
      totals.add(s, work, input.max_height_m);
    }
  }
  totals.report(state);
}

void stand(benchmark::State& state) {
  const Parameters p = bench_parameters();
  grow_plot(state, &p);
}
BENCHMARK(stand)->Arg(10)->Arg(30)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond);

void species(benchmark::State& state) { grow_plot(state, nullptr); }
BENCHMARK(species)->Arg(10)->Arg(30)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond);

/// Processor seconds of this thread.
double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void best(benchmark::State& state) {
  const Plot& plot = Plot::of(static_cast<int>(state.range(0)));
  const Parameters p = bench_parameters();
  double seconds = 0.0, kept = 0.0;
  for (auto _ : state) {
    kept = 0.0;
    std::vector<double> least(plot.size(), 1e9);
    // Round by round: a tree grown twice in a row finds its branches guessed and its memory near.
    for (int n = 0; n < 5; ++n) {
      for (std::size_t t = 0; t < plot.size(); ++t) {
        const GrowthInput input = plot.input(t, state.range(1) ? nullptr : &p);
        const double before = thread_seconds();
        const Skeleton s = grow(input);
        least[t] = std::min(least[t], thread_seconds() - before);
        for (std::size_t i = 0; n == 0 && i < s.size(); ++i) kept += s.alive(i);
      }
    }
    seconds = std::accumulate(least.begin(), least.end(), 0.0);
  }
  state.counters["internodes/s"] = kept / seconds;
}
BENCHMARK(best)
    ->ArgNames({"trees", "species"})
    ->Args({300, 0})
    ->Args({300, 1})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void free_standing(benchmark::State& state) {
  const auto oak = value_or_exit(scene::builtin_species("english_oak"));
  GrowthInput input;
  input.parameters = &oak.growth;
  input.max_height_m = oak.shape.mature_height_m;
  Totals totals;
  for (auto _ : state) {
    input.key = (input.key + 1) % 8;
    GrowthWork work;
    const Skeleton s = grow(input, nullptr, &work);
    totals.add(s, work, input.max_height_m);
  }
  totals.report(state);
}
BENCHMARK(free_standing)->Unit(benchmark::kMillisecond);

void steps(benchmark::State& state) {
  const Plot& plot = Plot::of(static_cast<int>(state.range(0)));
  const Parameters p = bench_parameters();
  enum Step { start, sensing, vigor, fate, deflection, extension, shedding, steps };
  constexpr std::array<const char*, steps> names{"start",       "sensing%",   "vigor%",   "fate%",
                                                 "deflection%", "extension%", "shedding%"};
  std::array<double, steps> seconds{};
  bool equal = true;
  for (auto _ : state) {
    Tree tree;
    for (std::size_t t = 0; t < plot.size(); ++t) {
      const GrowthInput input = plot.input(t, &p);
      Stopwatch watch;
      const auto lap = [&](Step step) { seconds[step] += watch.restart(); };
      plant(tree, input);
      lap(start);
      while (!tree.finished) {
        // As grow_season does, which `equal` checks.
        const std::size_t before = tree.wood.size();
        update_habits(tree), sense(tree), lap(sensing);
        share_vigor(tree), lap(vigor);
        const bool any = choose_growing(tree);
        lap(fate);
        if (any) deflect(tree);
        lap(deflection);
        const bool tall = any && extend(tree);
        lap(extension);
        shed(tree), lap(shedding);
        tree.idle_seasons = tree.wood.size() > before ? 0 : tree.idle_seasons + 1;
        ++tree.season;
        tree.finished = tall || tree.idle_seasons >= 3 || tree.season >= p.max_seasons;
      }
      equal = equal && tree.wood.distal == grow(input).distal;
    }
  }
  double sum = 0.0;
  for (const double s : seconds) sum += s;
  for (std::size_t s = 0; s < steps; ++s) state.counters[names[s]] = 100.0 * seconds[s] / sum;
  state.counters["equal"] = equal;
}
BENCHMARK(steps)->Arg(300)->Unit(benchmark::kMillisecond);

/// A loop that only computes, on `threads` threads; returns its seconds.
double spin(int threads) {
  Stopwatch watch;
  run_with_threads(threads, [] {
    parallel_for(64, [](std::size_t i) {
      std::uint64_t x = i + 1;
      for (int n = 0; n < 1'000'000; ++n) x = mix_bits(x);
      benchmark::DoNotOptimize(x);
    });
  });
  return watch.seconds();
}

void two_cores(benchmark::State& state) {
  const Plot& plot = Plot::of(static_cast<int>(state.range(0)));
  const Parameters p = bench_parameters();
  const auto seconds_on = [&](int threads) {
    Stopwatch watch;
    run_with_threads(threads, [&] {
      parallel_dearest_first(plot.costs,
                             [&](std::size_t t) { benchmark::DoNotOptimize(grow(plot.input(t, &p)).size()); });
    });
    return watch.seconds();
  };
  std::vector<double> efficiency, speed_up;
  for (auto _ : state) {
    for (int n = 0; n < 9; ++n) {
      const double before = spin(1) / spin(2);
      speed_up.push_back(seconds_on(1) / seconds_on(2));
      const double after = spin(1) / spin(2);
      efficiency.push_back(speed_up.back() / (0.5 * (before + after)));
    }
  }
  std::sort(efficiency.begin(), efficiency.end()), std::sort(speed_up.begin(), speed_up.end());
  state.counters["efficiency"] = efficiency[efficiency.size() / 2];
  state.counters["speed_up"] = speed_up[speed_up.size() / 2];
}
BENCHMARK(two_cores)->Arg(300)->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  bosquet::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
