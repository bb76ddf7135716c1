#include "ui/export_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "exchange/texture_cache.h"

namespace bosquet::ui {
namespace {

// A triangle's share of vertices and indices as files store them, measured on the examples; images of a species.
constexpr double kBytesPerTriangle = 66, kPackedBytesPerTriangle = 14, kImageBytesPerSpecies = 1.6e6;

}  // namespace

exchange::GltfOptions gltf_options(const ExportSettings& settings) {
  exchange::GltfOptions options;
  if (settings.preset == ExportPreset::engines) options.lod = exchange::LodFiles::nodes;
  if (settings.preset == ExportPreset::web) {
    options.instancing = true;
    options.compression = exchange::Compression::meshopt;
    options.max_glb_bytes = 0x7fff'ffffu;
  }
  return options;
}

ExportSize estimate(const scene::GrownScene& scene, const ExportSettings& settings) {
  ExportSize size;
  std::vector<bool> used(scene.document.species.size(), false);
  std::size_t i = 0;
  for (const scene::Tree& tree : *scene.document.trees) {
    const scene::GrownTree& grown = scene.trees[i++];
    if (!grown.skeleton) continue;
    used[tree.species] = true;
    const scene::Species& species = scene.document.species_of(tree);
    size.triangles +=
        geometry::estimate_triangles(*grown.skeleton, grown.skeleton->radius, species.look, species.foliage, {});
  }
  if (settings.max_triangles > 0)
    size.triangles = std::min(size.triangles, static_cast<std::uint64_t>(settings.max_triangles));
  const double each = settings.preset == ExportPreset::web ? kPackedBytesPerTriangle : kBytesPerTriangle;
  const auto species = static_cast<double>(std::count(used.begin(), used.end(), true));
  size.bytes = static_cast<std::uint64_t>(each * static_cast<double>(size.triangles) + kImageBytesPerSpecies * species);
  return size;
}

ExportJob::~ExportJob() {
  cancel();
  if (done_.valid()) done_.wait();
}

void ExportJob::start(scene::GrownScene scene, const ExportSettings& settings, std::filesystem::path target) {
  if (running()) return;
  progress_ = std::make_unique<Progress>();
  progress_->begin("meshes", 0);
  done_ = std::async(
      std::launch::async,
      [scene = std::move(scene), settings, target = std::move(target), progress = progress_.get()]() -> std::string {
        scene::ModelOptions model;
        model.max_triangles = static_cast<std::size_t>(std::max(0, settings.max_triangles));
        const exchange::TextureCache cache = exchange::TextureCache::of_user();
        const scene::PaintingCache paintings(cache.folder());
        model.paintings = &paintings;
        auto built = scene::build_model(scene, model, progress);
        if (!built) return built.error().message;
        exchange::GltfOptions options = gltf_options(settings);
        options.version = "bosquet";
        options.textures = &cache;
        options.progress = progress;
        auto written = exchange::write_gltf(built->model, target, options);
        if (!written) return written.error().message;
        return fmt::format("Exported {}: {:.1f} MB, {} triangles", target.filename().string(),
                           static_cast<double>(written->bytes) / 1e6, built->triangles);
      });
}

float ExportJob::share() const {
  if (!progress_ || progress_->total() == 0) return 0.0f;
  return static_cast<float>(progress_->done()) / static_cast<float>(progress_->total());
}

void ExportJob::cancel() {
  if (progress_) progress_->cancel();
}

std::optional<std::string> ExportJob::finished() {
  if (!done_.valid() || done_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  return done_.get();
}

}  // namespace bosquet::ui
