// Export job: the grown scene written to a file in the background, told beforehand how large it will be.
//
// Model     the trees are those that the pipeline has grown. A scene: meshes are built within the triangle budget; presets
//           are what other programs open: everything (plain), Blender (plain), Unreal and Unity (plain with levels of
//           detail and wind weights), web (instanced and packed). A picture is drawn from the same meshes by a renderer of its own. All
//           else is what the command makes of it (exchange/scene_files.h)
// Size      a scene's follows from its triangles and images and a picture's from its pixels, by what the examples took;
//           the others are so quickly made that they are written to a temporary file, measured and removed
// Errors    what could not be written, as one message
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/result.h"
#include "exchange/gltf_writer.h"
#include "exchange/scene_files.h"
#include "render/view.h"
#include "scene/grown_scene.h"
#include "scene/model_builder.h"
#include "ui/scene_view.h"

namespace bosquet::ui {

enum class ExportPreset { everything, blender, engines, web };
inline constexpr std::array<std::string_view, 4> kExportPresetNames{"Everything", "Blender", "Unreal / Unity", "Web"};

enum class ExportKind {
  scene,
  picture,
  plan_picture,
  plan_drawing,
  plan_cad,
  schedule,
  species,
  map,
  old_map,
  web_map,
  regions,
  tree,
  recipe,
};
struct ExportKindInfo {
  std::string_view name, ending, meaning;
};
const ExportKindInfo& export_kind(ExportKind kind);
inline constexpr int kExportKinds = 13;

struct ExportSettings {
  ExportKind kind = ExportKind::scene;
  ExportPreset preset = ExportPreset::everything;
  int max_triangles = 2'000'000;
  int picture_width = 1920;  ///< pixels; its height is as the window's
};

/// What is written, and where.
struct ExportOrder {
  scene::GrownScene scene;
  exchange::SceneFileOptions options;
  ExportSettings settings;
  render::View view;             ///< of a picture
  Show show = Show::trees;       ///< likewise
  std::optional<float> slice_m;  ///< likewise, of regions
  std::filesystem::path target;
};

/// The writer's options of a preset.
exchange::GltfOptions gltf_options(const ExportSettings& settings);

struct ExportSize {
  std::uint64_t triangles = 0, bytes = 0;  ///< about
};
/// What an export would come to, from the trees as grown.
ExportSize estimate(const scene::GrownScene& scene, const ExportSettings& settings);

/// Whether a file of this name is a picture of the scene.
bool is_picture(const std::filesystem::path& target);

/// About what a picture of so many pixels comes to.
std::uint64_t picture_bytes(IVec2 size);

/// How large a plan, list or map will be, found out in the background.
class ExportProbe {
 public:
  /// Asks for what has the number `of`, unless that was asked for last.
  void ask(std::uint64_t of, ExportKind kind, const std::function<scene::GrownScene()>& scene,
           const exchange::SceneFileOptions& options);
  /// A sentence: how large it will be, or why it cannot be; empty while it is found out.
  const std::string& words();

 private:
  std::uint64_t asked_ = 0;
  std::future<std::string> coming_;
  std::string words_;
};

/// "12.3 MB", "45 kB".
std::string bytes_words(std::uint64_t bytes);

class ExportJob {
 public:
  ~ExportJob();
  /// Begins to write; one at a time.
  void start(ExportOrder order);
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
