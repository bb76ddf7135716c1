// Triangles a second of the meshes, one core: bytes of a figure are its triangles.
#include <benchmark/benchmark.h>

#include "geometry/branch_mesh.h"
#include "geometry/ground_mesh.h"
#include "geometry/tree_mesh.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

const growth::Skeleton& tree() {
  static const growth::Skeleton s = test_skeleton({.seasons = 16}, 1);
  return s;
}

void count_triangles(benchmark::State& state, std::size_t each) {
  state.counters["triangles/s"] = benchmark::Counter(
      static_cast<double>(each) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["triangles"] = static_cast<double>(each);
}

void BranchCurvesOfATree(benchmark::State& state) {
  const growth::Skeleton& s = tree();
  const ThickestPaths paths = thickest_paths(s, s.radius, standing(s, -1));
  for (auto _ : state) benchmark::DoNotOptimize(branch_curves(s, s.radius, paths));
  state.counters["internodes/s"] = benchmark::Counter(
      static_cast<double>(s.size()) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(BranchCurvesOfATree);

void Branches(benchmark::State& state) {
  const growth::Skeleton& s = tree();
  const BranchCurves curves = branch_curves(s, s.radius, thickest_paths(s, s.radius, standing(s, -1)));
  const BranchPlan plan = plan_branches(curves, 1.0f);
  for (auto _ : state) benchmark::DoNotOptimize(mesh_branches(curves, plan, {}, 1, 2));
  count_triangles(state, plan.triangles);
}
BENCHMARK(Branches);

void WholeTree(benchmark::State& state) {
  const MeshOptions options{.foliage = static_cast<FoliageLevel>(state.range(0)),
                            .max_triangles = static_cast<std::size_t>(state.range(1))};
  std::size_t triangles = 0;
  for (auto _ : state) triangles = build_tree_mesh(tree(), tree().radius, {}, {}, options).triangles();
  count_triangles(state, triangles);
}
BENCHMARK(WholeTree)
    ->ArgNames({"level", "budget"})
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({1, 12000})
    ->Args({1, 1000});

void Ground(benchmark::State& state) {
  terrain::Terrain t;
  const auto lattice = terrain::make_lattice({300, 300}, 1.0f);
  t.height = terrain::Heightfield(*lattice, [](Vec2 p) { return 0.01f * p.x; });
  t.exclusion = terrain::Mask(*lattice);
  std::size_t triangles = 0;
  for (auto _ : state) {
    triangles = 0;
    for (const GroundPiece& piece : mesh_ground(t, {})) triangles += piece.mesh.triangles();
  }
  count_triangles(state, triangles);
}
BENCHMARK(Ground);

}  // namespace
}  // namespace bosquet::geometry
