// Benchmarks of canopy light: whole stands, and what one moved tree costs.
//
// hectares     a thousand trees a hectare, 12 to 24 m high, 0.25 m voxels, reach 15 m: cost goes with the regions' volume
// one_moved    the same on 10 ha, one tree moved by a metre: the trees around it are computed again
// Counters     ns_per_m3: time over the volume of all regions; trees: computed anew by the update; mb: memory of the light
#include <benchmark/benchmark.h>

#include <map>

#include "core/parallel.h"
#include "core/random.h"
#include "crowns/canopy_light.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

std::vector<Claimant> stand(float side_m) {
  const auto rows = static_cast<std::size_t>(side_m / 3.16f);
  std::vector<Claimant> trees(rows * rows);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    RandomStream draw(7, i, Purpose::planting);
    Claimant& t = trees[i];
    t.key = mix_bits(i + 1);
    t.id = static_cast<std::int32_t>(i) + 1;
    const Vec2 place(static_cast<float>(i % rows), static_cast<float>(i / rows));
    const float east = draw.uniform(0.2f, 0.8f), north = draw.uniform(0.2f, 0.8f);
    t.base = (place + Vec2(east, north)) * (side_m / static_cast<float>(rows));
    t.shape.crown_width_m = 8.0f;
    t.shape.mature_height_m = 24.0f;
    t.shape.leaf_area_density = 0.4f;
    t.scale_height = t.scale_width = draw.uniform(0.5f, 1.0f);
  }
  return trees;
}

terrain::Terrain flat(float side_m) {
  return terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({side_m, side_m})));
}

// Dividing takes longer than what is measured here, so a space is divided once.
const CrownSpace& divided(float side_m) {
  static std::map<float, CrownSpace> spaces;
  auto& space = spaces[side_m];
  if (space.claimants().empty()) space = *divide_space(stand(side_m), flat(side_m), {});
  return space;
}

void hectares(benchmark::State& state) {
  const auto side_m = static_cast<float>(state.range(0));
  run_with_threads(static_cast<int>(state.range(1)), [&] {
    const CrownSpace& space = divided(side_m);
    CanopyLight light;
    for (auto _ : state) light = canopy_light(space, {});
    const double m3 = static_cast<double>(space.claimed_voxels()) * 0.25 * 0.25;
    state.counters["mb"] = static_cast<double>(light.bytes()) / 1e6;
    state.counters["ns_per_m3"] =
        benchmark::Counter(m3 * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  });
}
BENCHMARK(hectares)
    ->Args({50, 1})
    ->Args({100, 1})
    ->Args({316, 1})
    ->Args({316, 2})
    ->ArgNames({"side_m", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void one_moved(benchmark::State& state) {
  constexpr float kSide = 316.0f;
  run_with_threads(static_cast<int>(state.range(0)), [&] {
    auto trees = stand(kSide);
    const terrain::Terrain terrain = flat(kSide);
    const CrownSpace& before = divided(kSide);
    const std::size_t moved = trees.size() / 2 + 50;
    const Vec2 from = trees[moved].base;
    trees[moved].base.x += 1.0f;
    static const CrownSpace after = *divide_space(trees, terrain, {});
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < trees.size(); ++i)
      if (glm::distance(trees[i].base, from) < 15.0f && region(before, i).bits != region(after, i).bits)
        changed.push_back(i);
    const CanopyLight light = canopy_light(before, {});
    LightUpdate update;
    for (auto _ : state) update = update_canopy_light(light, after, changed);
    state.counters["trees"] = static_cast<double>(update.changed.size());
  });
}
BENCHMARK(one_moved)->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace bosquet::crowns
