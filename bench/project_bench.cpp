// Project files: what saving and opening cost with 10,000 trees on a site of 10 ha.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "core/hash.h"
#include "scene/journal.h"
#include "scene/project_file.h"
#include "terrain/brush.h"

namespace {

using namespace bosquet;
using namespace bosquet::scene;

constexpr int kTrees = 10'000;
constexpr float kSide_m = 316.0f;

std::filesystem::path scratch() {
  static const std::filesystem::path folder = [] {
    const auto made = std::filesystem::temp_directory_path() / ("bosquet-project-bench-" + std::to_string(::getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  return folder;
}

Document large_document() {
  Document d;
  auto lattice = terrain::make_lattice({kSide_m, kSide_m});
  d.terrain = std::make_shared<const terrain::Terrain>(terrain::make_terrain(
      terrain::Heightfield(*lattice, [](Vec2 p) { return 0.05f * p.x + 0.002f * p.y * p.x / kSide_m; })));
  std::vector<std::shared_ptr<const Species>> species;
  for (const std::string& name : builtin_species_names())
    species.push_back(std::make_shared<const Species>(*builtin_species(name)));
  const std::size_t kinds = species.size();
  d.species = std::move(species);
  std::vector<Tree> trees(kTrees);
  for (int i = 0; i < kTrees; ++i) {
    Tree& t = trees[static_cast<std::size_t>(i)];
    t.id = i + 1, t.key = mix_bits(static_cast<std::uint64_t>(i));
    t.species = static_cast<std::size_t>(i) % kinds;
    RandomStream random(1, t.key, Purpose::planting);
    t.at = Vec2(random.uniform(0, kSide_m), random.uniform(0, kSide_m));
    t.scale_height = t.scale_width = random.uniform(0.7f, 1.1f);
    t.inventory_name = "Quercus robur";
  }
  d.trees = std::make_shared<const Trees>(std::move(trees));
  settle_counters(d);
  return d;
}

// A brush stroke: a hundred trees more.
Document planted(const Document& d, int n) {
  std::vector<Tree> fresh;
  Document out = d;
  for (int i = 0; i < 100; ++i) {
    Tree t = d.trees->front();
    t.id = out.next_tree_id++;
    t.key = mix_bits(static_cast<std::uint64_t>(t.id));
    t.at = Vec2(static_cast<float>(n % 300), static_cast<float>(i));
    fresh.push_back(std::move(t));
  }
  out.trees = std::make_shared<const Trees>(d.trees->edited(std::move(fresh)));
  return out;
}

// A brush stroke on the ground.
Document raised(const Document& d, int n) {
  terrain::Stroke stroke;
  stroke.points = {{20.0f + static_cast<float>(n % 250), 100}, {40.0f + static_cast<float>(n % 250), 120}};
  stroke.radius_m = 10;
  Document out = d;
  out.terrain = std::make_shared<const terrain::Terrain>(terrain::apply(*d.terrain, stroke));
  return out;
}

template <class Edit>
void save_after(benchmark::State& state, const Edit& edit) {
  Document d = large_document();
  auto file = ProjectFile::create(scratch() / "a.bosquet", d);
  int n = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const Document next = edit(d, n++);
    state.ResumeTiming();
    if (!file->save(next)) state.SkipWithError("not saved");
  }
}

void save_after_planting(benchmark::State& state) { save_after(state, planted); }
void save_after_stroke(benchmark::State& state) { save_after(state, raised); }

void open(benchmark::State& state) {
  if (!write_project(large_document(), scratch() / "b.bosquet")) state.SkipWithError("not written");
  for (auto _ : state) benchmark::DoNotOptimize(read_project(scratch() / "b.bosquet"));
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(scratch() / "b.bosquet"));
}

void save_as(benchmark::State& state) {
  const Document d = large_document();
  for (auto _ : state)
    if (!write_project(d, scratch() / "c.bosquet")) state.SkipWithError("not written");
}

// From an edit handed over until it is on the disk.
void journal_an_edit(benchmark::State& state) {
  Document d = large_document();
  auto journal = Journal::start(d, {}, scratch());
  (*journal)->wait();
  std::uint64_t n = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const Document next = planted(d, static_cast<int>(n));
    state.ResumeTiming();
    (*journal)->record(next, ++n);
    (*journal)->wait();
  }
  (*journal)->saved(scratch() / "a.bosquet", n);
}

BENCHMARK(save_after_planting)->Unit(benchmark::kMillisecond);
BENCHMARK(save_after_stroke)->Unit(benchmark::kMillisecond);
BENCHMARK(open)->Unit(benchmark::kMillisecond);
BENCHMARK(save_as)->Unit(benchmark::kMillisecond);
BENCHMARK(journal_an_edit)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
