// glTF written to a file: bytes a second of the vertex data and triangles a second, for each kind of file. Bytes are those
// of the plain data, also where the file is smaller.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "exchange/gltf_check.h"
#include "exchange/gltf_writer.h"
#include "tests/exchange/sample_model.h"

namespace bosquet::exchange {
namespace {

// About 1.6 million triangles: 200 trees of 2,560 triangles of wood and 5,400 of leaves, none alike.
const scene::Model& forest() {
  static const scene::Model model = [] {
    scene::Model m = sample_model();
    m.nodes.resize(1);
    for (int i = 0; i < 200; ++i) {
      scene::Node tree;
      tree.name = "tree-" + std::to_string(i);
      tree.translation = {5.0f * static_cast<float>(i % 20), 0.0f, 5.0f * static_cast<float>(i / 20)};
      tree.parts = {{std::make_shared<TriangleMesh>(tube(16, 80, 0.2f, 4.0f + 0.01f * static_cast<float>(i), 3.0f)), 0},
                    {std::make_shared<TriangleMesh>(cards(2700 + i)), 1}};
      m.nodes.push_back(std::move(tree));
    }
    return m;
  }();
  return model;
}

void Write(benchmark::State& state) {
  GltfOptions options;
  options.compression = static_cast<Compression>(state.range(0));
  options.instancing = state.range(1) != 0;
  const auto folder = std::filesystem::temp_directory_path() / "bosquet-gltf-bench";
  std::filesystem::create_directories(folder);
  const auto plain = write_gltf(forest(), folder / "plain.glb");
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    const auto written = write_gltf(forest(), folder / "out.glb", options);
    if (!written) return state.SkipWithError(written.error().message.c_str());
    bytes = written->bytes;
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(plain->bytes) * state.iterations());
  state.counters["file_MB"] = static_cast<double>(bytes) / 1e6;
  state.counters["triangles/s"] =
      benchmark::Counter(static_cast<double>(count(forest()).triangles) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
  std::filesystem::remove_all(folder);
}
BENCHMARK(Write)
    ->ArgNames({"compression", "instancing"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void Check(benchmark::State& state) {
  const auto file = std::filesystem::temp_directory_path() / "bosquet-gltf-bench.glb";
  GltfOptions options;
  options.compression = static_cast<Compression>(state.range(0));
  const auto written = write_gltf(forest(), file, options);
  for (auto _ : state) benchmark::DoNotOptimize(check_gltf(file));
  state.SetBytesProcessed(static_cast<std::int64_t>(written->bytes) * state.iterations());
  std::filesystem::remove(file);
}
BENCHMARK(Check)->ArgName("compression")->Arg(0)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace bosquet::exchange
