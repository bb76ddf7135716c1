// Export job: the grown scene written to a file in the background, told beforehand how large it will be.
//
// Model     the trees are those that the pipeline has grown; meshes are built within the triangle budget and written by
//           exchange/. Presets are what other programs open: everything (plain), Blender (plain), Unreal and Unity (plain
//           with levels of detail), web (instanced and packed)
// Errors    what could not be written, as one message
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/result.h"
#include "exchange/gltf_writer.h"
#include "scene/grown_scene.h"
#include "scene/model_builder.h"

namespace bosquet::ui {

enum class ExportPreset { everything, blender, engines, web };
inline constexpr std::array<std::string_view, 4> kExportPresetNames{"Everything", "Blender", "Unreal / Unity", "Web"};

struct ExportSettings {
  ExportPreset preset = ExportPreset::everything;
  int max_triangles = 2'000'000;
};

/// The writer's options of a preset.
exchange::GltfOptions gltf_options(const ExportSettings& settings);

struct ExportSize {
  std::uint64_t triangles = 0, bytes = 0;  ///< about
};
/// What an export would come to, from the trees as grown.
ExportSize estimate(const scene::GrownScene& scene, const ExportSettings& settings);

class ExportJob {
 public:
  ~ExportJob();
  /// Begins to write; one at a time.
  void start(scene::GrownScene scene, const ExportSettings& settings, std::filesystem::path target);
  bool running() const { return done_.valid(); }
  float share() const;
  const char* stage() const { return progress_ ? progress_->stage() : ""; }
  void cancel();
  /// What came of it, once: a sentence for the person.
  std::optional<std::string> finished();

 private:
  std::unique_ptr<Progress> progress_;
  std::future<std::string> done_;
};

}  // namespace bosquet::ui
