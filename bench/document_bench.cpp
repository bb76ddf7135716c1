// What editing costs: edits and undo among ten thousand trees, the memory of a thousand steps, and how soon a moved tree
// of a stand and its neighbours have grown again with their meshes.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/random.h"
#include "exchange/recipe.h"
#include "scene/document_digest.h"
#include "scene/edits.h"
#include "scene/history.h"
#include "scene/pipeline.h"
#include "scene/planting_edits.h"
#include "scene/site_edits.h"
#include "scene/surroundings.h"

namespace bosquet::scene {
namespace {

template <class T>
T value(Result<T> result) {
  if (!result) std::fprintf(stderr, "%s\n", result.error().message.c_str()), std::exit(1);
  return std::move(*result);
}

const Document& plot_300() {
  static const Document document = [] {
    const auto recipe = value(exchange::read_recipe(BOSQUET_SOURCE_DIR "/examples/plots/plot_300.toml"));
    return value(exchange::build_document(recipe)).document;
  }();
  return document;
}

/// Three species on 300 m, in the order of planting, which is no order in space.
const Document& ten_thousand() {
  static const Document document = [] {
    Document d;
    d.terrain = std::make_shared<const terrain::Terrain>(
        terrain::make_terrain(terrain::Heightfield(value(terrain::make_lattice({300, 300})))));
    for (const char* name : {"english_oak", "silver_birch", "norway_maple"})
      d.species.push_back(std::make_shared<const Species>(value(builtin_species(name))));
    RandomStream random(1, 1, Purpose::statistics);
    std::vector<Tree> trees(10'000);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      trees[i].id = static_cast<std::int32_t>(i + 1);
      trees[i].key = random.bits();
      trees[i].species = random.below(3);
      trees[i].at = {random.uniform(1, 299), random.uniform(1, 299)};
      trees[i].scale_height = trees[i].scale_width = random.uniform(0.3f, 1);
    }
    d.trees = std::make_shared<const Trees>(std::move(trees));
    settle_counters(d);
    return d;
  }();
  return document;
}

// A stroke of any kind: 5 s of planting, erasing, raising ground, moving a group.
Edited stroke(const Document& document, PlantingGround& ground, RandomStream& random) {
  const Vec2 from{random.uniform(20, 280), random.uniform(20, 280)};
  const std::vector<Vec2> line{from, from + Vec2(random.uniform(-15, 15), random.uniform(-15, 15))};
  switch (random.below(4)) {
    case 0: {
      distribution::PlantBrush brush;
      return value(plant_stroke(document, ground, brush, distribution::steady_stroke(line, 5.0f)));
    }
    case 1:
      return erase_stroke(document, line, 4.0f);
    case 2: {
      terrain::Stroke raise;
      raise.points = line;
      return shape_ground(document, raise);
    }
    default: {
      const Box2 box{from - 8.0f, from + 8.0f};
      return value(move_trees(document, trees_within(document, box), {0.7f, 0.4f}));
    }
  }
}

void plant_a_stroke(benchmark::State& state) {
  const Document& document = ten_thousand();
  PlantingGround ground;
  RandomStream random(2, 1, Purpose::statistics);
  value(ground.of(document));
  std::size_t planted = 0;
  for (auto _ : state) {
    const Vec2 from{random.uniform(20, 280), random.uniform(20, 280)};
    const std::vector<Vec2> line{from, from + Vec2(10, 5)};
    const Edited edited = value(plant_stroke(document, ground, {}, distribution::steady_stroke(line, 2.0f)));
    planted += edited.trees.size();
  }
  state.counters["trees"] = static_cast<double>(planted) / static_cast<double>(state.iterations());
}
BENCHMARK(plant_a_stroke)->Unit(benchmark::kMillisecond);

void move_a_group(benchmark::State& state) {
  const Document& document = ten_thousand();
  const auto group = trees_within(document, Box2{{100, 100}, {130, 130}});
  for (auto _ : state) benchmark::DoNotOptimize(value(move_trees(document, group, {0.5f, 0.5f})));
  state.counters["trees"] = static_cast<double>(group.size());
}
BENCHMARK(move_a_group)->Unit(benchmark::kMillisecond);

void a_thousand_steps(benchmark::State& state) {
  for (auto _ : state) {
    const Document& start = ten_thousand();
    RandomStream random(3, 1, Purpose::statistics);
    auto ground = std::make_unique<PlantingGround>();
    value(ground->of(start));
    malloc_trim(0);
    const auto in_use = [] { return mallinfo2().uordblks + mallinfo2().hblkhd; };
    History history(start);
    // The planting fields belong to the tool, not to the history: they are made anew before memory is read again.
    ground = std::make_unique<PlantingGround>();
    const std::size_t before = in_use();
    for (int n = 0; n < 1000; ++n) history.add(stroke(*history.current(), *ground, random));
    ground.reset();
    state.counters["MB"] = static_cast<double>(in_use() - before) * 1e-6;
    state.counters["told_MB"] = static_cast<double>(history.bytes()) * 1e-6;
    state.counters["steps"] = static_cast<double>(history.steps() - 1);
  }
}
BENCHMARK(a_thousand_steps)->Unit(benchmark::kSecond)->Iterations(1);

void undo_and_redo(benchmark::State& state) {
  PlantingGround ground;
  RandomStream random(4, 1, Purpose::statistics);
  History history(ten_thousand());
  for (int n = 0; n < 50; ++n) history.add(stroke(*history.current(), ground, random));
  for (auto _ : state) {
    history.undo();
    benchmark::DoNotOptimize(history.current());
    history.redo();
  }
}
BENCHMARK(undo_and_redo)->Unit(benchmark::kMicrosecond);

void digest_all(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(digest(ten_thousand()));
}
BENCHMARK(digest_all)->Unit(benchmark::kMillisecond);

void digest_after_an_edit(benchmark::State& state) {
  DigestKeeper keeper;
  Document document = ten_thousand();
  keeper.of(document);
  std::int32_t n = 0;
  for (auto _ : state) {
    document = value(move_trees(document, std::vector<std::int32_t>{1 + n++ % 10'000}, {0.01f, 0})).document;
    benchmark::DoNotOptimize(keeper.of(document));
  }
}
BENCHMARK(digest_after_an_edit)->Unit(benchmark::kMillisecond);

// A stroke of the raising brush among ten thousand trees: regions, asymmetry and light around it.
void regions_after_a_stroke(benchmark::State& state) {
  const Document& document = ten_thousand();
  StandingKeeper standing;
  std::vector<std::string> warnings;
  const Surroundings around = value(surround(document, {}, standing, warnings, nullptr, nullptr));
  RandomStream random(7, 1, Purpose::statistics);
  std::size_t touched = 0;
  for (auto _ : state) {
    state.PauseTiming();
    terrain::Stroke raise;
    const Vec2 from{random.uniform(20, 280), random.uniform(20, 280)};
    raise.points = {from, from + Vec2(10, 5)};
    const Document after = shape_ground(document, raise).document;
    warnings.clear();
    state.ResumeTiming();
    touched += value(update_surroundings(around, document, after, standing, warnings, nullptr)).touched.size();
  }
  state.counters["trees"] = static_cast<double>(touched) / static_cast<double>(state.iterations());
}
BENCHMARK(regions_after_a_stroke)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(20);

// A tree of the stand moves by half a metre and back; until all it touches stands there again, with its meshes.
void a_moved_tree(benchmark::State& state) {
  const Document& document = plot_300();
  PipelineOptions options;
  options.threads = static_cast<int>(state.range(0));
  options.skeleton_bytes = 1;  // nothing is found again: every touched tree grows
  options.mesh_bytes = 1;
  Pipeline pipeline(options);
  const View view{to_world({15, -20}, 10)};
  pipeline.set_document(std::make_shared<const Document>(document), view);
  pipeline.wait();
  pipeline.take_finished();
  RandomStream random(6, 1, Purpose::statistics);
  std::size_t touched = 0, internodes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::vector<std::int32_t> one{(*document.trees)[random.below(300)].id};
    Edited moved = value(move_trees(document, one, {random.below(2) ? 0.5f : -0.5f, 0}));
    auto snapshot = std::make_shared<const Document>(std::move(moved.document));
    state.ResumeTiming();
    pipeline.set_document(snapshot, view);
    pipeline.wait();
    state.PauseTiming();
    for (const FinishedTree& tree : pipeline.take_finished()) {
      ++touched;
      internodes += static_cast<std::size_t>(tree.grown.measures.internodes);
    }
    pipeline.set_document(std::make_shared<const Document>(document), view);
    pipeline.wait();
    pipeline.take_finished();
    state.ResumeTiming();
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["trees"] = static_cast<double>(touched) / runs;
  state.counters["internodes"] = static_cast<double>(internodes) / runs;
}
BENCHMARK(a_moved_tree)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(20)
    ->Repetitions(3);

}  // namespace
}  // namespace bosquet::scene
