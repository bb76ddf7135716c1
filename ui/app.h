// App: the whole window but for the desktop's part of it: panels, scene, shortcuts, dialogs, one frame at a time.
//
// Model     frame() takes what happened since the last one, hands events to the panels or, over the scene, to camera and
//           tool, and draws everything into a framebuffer. So the same app runs in a window, by a script, and in tests
//           without a display
// Context   OpenGL and Dear ImGui contexts current on one thread
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/result.h"
#include "render/sun_position.h"
#include "ui/events.h"
#include "ui/export_job.h"
#include "ui/file_chooser.h"
#include "ui/input.h"
#include "ui/preferences.h"
#include "ui/scene_view.h"
#include "ui/session.h"
#include "ui/theme.h"
#include "ui/thumbnails.h"
#include "ui/widgets/schematic_tree.h"

namespace bosquet::ui {

struct AppOptions {
  Session::Options session;
  std::filesystem::path file;  ///< opened at the start; empty: the example park, and recovery is offered
  bool first_run = false;      ///< shows the overlay
  Preferences preferences;
  bool marks = false;  ///< notes where widgets lie
};

struct FrameInput {
  IVec2 size{1440, 900};
  float scale = 1.0f;
  double time_s = 0;
  std::span<const Event> events = {};
  std::span<const std::filesystem::path> dropped = {};
  unsigned framebuffer = 0;
  bool close = false;  ///< the person wants to close the window
};

class App {
 public:
  static Result<std::unique_ptr<App>> create(const AppOptions& options);
  ~App();

  void frame(const FrameInput& input);
  /// The person agreed to end, or nothing was unsaved.
  bool ended() const { return ended_; }
  /// Nothing grows, is drawn or waited for; the species' pictures may still come.
  bool settled() const;
  bool has_thumbnails() const { return thumbnails_->settled(); }

  /// Writes the scene, as the export dialog would.
  void export_to(const std::filesystem::path& file);

  Session& session() { return *session_; }
  SceneView& view() { return *view_; }
  /// Part of the window that shows the scene, in pixels.
  Vec2 view_low() const { return view_low_; }
  Vec2 view_size() const { return view_size_; }
  std::string title() const;
  /// As they are now.
  Preferences preferences() const;

  // For programs that drive the window (ui/state_file.h).
  const std::string& message() const { return toast_; }
  int overlay_step() const { return overlay_step_; }
  /// What is asked in the middle of the window, in a word; empty when nothing is.
  std::string question() const;
  /// Where widgets lie, by name: x, y, width, height; only when AppOptions::marks asks for it.
  const std::map<std::string, Vec4>& marks() const { return marks_; }

 private:
  App() = default;
  friend struct Panels;

  // What is asked in the middle of the window.
  enum class Ask { nothing, close, open, start, recover, many_trees };

  void pass(const FrameInput& in, std::span<const Event> fresh, double passed_s);
  void route(std::span<const Event> events, double time_s);
  void to_camera(const Event& event);
  bool shortcut(const Event& event);
  void run_guarded(std::function<void()> then, Ask why);
  void open_file(const std::filesystem::path& file);
  void say(std::string message);
  void say_notes();
  float finer() const;
  void draw_overlays();

  std::unique_ptr<Session> session_;
  std::optional<SceneView> view_;
  std::optional<Thumbnails> thumbnails_;
  Input input_;
  Fonts fonts_;
  float scale_ = 0;
  Preferences preferences_;  ///< but for the units, which are the session's
  bool ended_ = false;
  Vec2 view_low_{0.0f}, view_size_{1.0f};
  Vec2 pointer_{0.0f};
  bool over_scene_ = false;
  Button held_ = Button::none;  ///< pressed over the scene
  bool camera_drag_ = false;
  double moved_s_ = -10, time_s_ = 0;
  double memory_mb_ = 0, asked_memory_s_ = -10;  ///< of the program, and when that was
  std::size_t coarser_triangles_ = 0;            ///< before the last refinement of the scene as it is
  std::uint64_t refined_revision_ = 0;
  std::vector<int> keys_down_;

  std::string toast_;
  double toast_until_s_ = 0;
  Ask ask_ = Ask::nothing;
  std::function<void()> then_;
  std::vector<scene::Recovery> recoveries_;
  bool show_history_ = false, show_export_ = false, show_shortcuts_ = false;
  int overlay_step_ = -1;  ///< of the first-run overlay; below 0: not shown
  bool playing_ = false;
  float year_ = 30;                                                       ///< that the slider was set to last
  render::DateTime when_{2026, 6, 21, 15.0};                              ///< that the sun was set to last
  bool sun_is_down_ = false;                                              ///< at that time
  bool sun_has_a_time_ = true;                                            ///< it stands there at some day and hour
  std::tuple<scene::Sun, double, double> clock_follows_{{-1, -1}, 0, 0};  ///< sun, latitude, longitude of when_

  FileChooser chooser_;
  ExportJob export_;
  ExportSettings export_settings_;
  ExportProbe export_probe_;
  SchematicTree schematic_;
  std::uint64_t inspector_drag_ = 0;
  bool marking_ = false;
  std::map<std::string, Vec4> marks_;
};

}  // namespace bosquet::ui
