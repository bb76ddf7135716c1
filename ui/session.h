// Session: a document that is being worked on: its history, file, journal, selection, the tool in hand, and its growth
// in the background.
//
// Model     every change goes through apply(), undo() or redo(), and so reaches the history, the pipeline and the journal
//           alike; whoever draws compares revision() with the one drawn last
// Who       the window and scripts; it knows neither ImGui nor OpenGL
// Errors    a file that cannot be opened or saved: the message, and the document stays open as it was
// Threads   one; pipeline and journal have their own
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/history.h"
#include "scene/journal.h"
#include "scene/pipeline.h"
#include "scene/project_file.h"
#include "ui/camera_rig.h"
#include "ui/tools/tool.h"

namespace bosquet::ui {

class Session {
 public:
  struct Options {
    bool journal = true;
    std::filesystem::path recovery_folder;  ///< empty: the user's
    int threads = 0;
  };

  explicit Session(Options options);
  ~Session();

  // The document.
  const std::shared_ptr<const scene::Document>& document() const { return history_->current(); }
  const scene::History& history() const { return *history_; }
  void apply(scene::Edited edit, std::uint64_t drag = 0);
  void undo();
  void redo();
  void go_to(std::size_t step);
  std::uint64_t revision() const { return revision_; }

  // Files. A recipe opens as a document without a file of its own.
  Result<void> open(const std::filesystem::path& file);
  /// A document that was never saved.
  void start(scene::Document document, std::string name);
  Result<void> save();
  Result<void> save_as(const std::filesystem::path& file);
  bool has_file() const { return project_.has_value(); }
  /// Why it cannot be saved under its name, if so.
  std::string read_only() const;
  bool unsaved() const { return history_->revision() != saved_revision_; }
  std::string name() const;
  const std::filesystem::path& path() const { return path_; }

  // Recovery.
  Result<void> recover(const scene::Recovery& recovery);
  const scene::Journal* journal() const { return journal_.get(); }

  // Selection.
  const std::vector<std::int32_t>& selection() const { return selection_; }
  void select(std::vector<std::int32_t> trees);
  /// The one tree that is selected, or null.
  const scene::Tree* selected_tree() const;
  /// The one hero tree that is selected, or null.
  const scene::HeroTree* selected_hero() const;

  // The tool in hand.
  ToolKind tool_kind() const { return tool_kind_; }
  void take(ToolKind kind);
  Tool& tool() { return *tool_; }
  ToolScene tool_scene(Vec2 view_size);
  /// Hands an event to the tool and does what it answers.
  void send(const ToolEvent& event, Vec2 view_size);
  void tick(double time_s, Vec2 view_size);
  /// The camera rests: what is nearest to it grows first, and finest.
  void look_from_here();
  void confirm_trees(Vec2 view_size);
  std::size_t asked_trees() const { return asked_trees_; }
  void decline_trees();

  // What the window shows.
  CameraRig rig;
  ToolSettings settings;
  std::string message;             ///< of the last thing that could not be done; cleared by who shows it
  std::vector<std::string> notes;  ///< of opening, a line each

  scene::Pipeline& pipeline() { return *pipeline_; }
  const scene::PipelineOptions& growth() const { return growth_; }
  void set_growth(const scene::PipelineOptions& options);
  void set_year(std::optional<float> year);
  void set_fineness(float fineness);  ///< of the trees' meshes (scene/pipeline.h)

 private:
  void changed();
  void begin(scene::Document document, std::string name, const std::filesystem::path& recipe = {});
  void use(ToolAnswer answer);

  Options options_;
  std::unique_ptr<scene::History> history_;
  std::unique_ptr<scene::Pipeline> pipeline_;
  std::unique_ptr<scene::Journal> journal_;
  std::optional<scene::ProjectFile> project_;
  scene::PlantingGround planting_;
  scene::PipelineOptions growth_;
  std::filesystem::path path_;
  std::string name_;
  std::vector<std::int32_t> selection_;
  ToolKind tool_kind_ = ToolKind::select;
  std::unique_ptr<Tool> tool_;
  std::size_t asked_trees_ = 0;
  Vec3 looked_from_{0.0f};
  std::uint64_t revision_ = 0, saved_revision_ = 0, edit_ = 0;
};

/// The documents that "New" offers: meadow, river bank, city square, avenue, forest edge.
std::vector<std::string> template_names();
Result<scene::Document> make_template(const std::string& name);

/// The park that is shown when no file is opened.
Result<scene::Document> make_example();
/// Its recipe.
const char* example_park_recipe();

/// A document from a project or a recipe.
struct OpenedDocument {
  scene::Document document;
  std::vector<std::string> notes;
};
Result<OpenedDocument> read_document(const std::filesystem::path& file);

}  // namespace bosquet::ui
