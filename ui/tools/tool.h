// Tools: what a hand does to the document, as small state machines.
//
// Model     a tool is fed with events that know where they point in the world, and answers with the document as it is
//           after them; it knows neither GLFW nor OpenGL. While a button is held its edits are one drag, made anew each
//           time from the document that the drag began with, so that a stroke depends on its path and times alone
// Frame     plan (east, north) metres; pixels of the view
// Errors    what cannot be done is a message in the answer; the document stays as it was
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.h"
#include "scene/edits.h"
#include "scene/planting_edits.h"
#include "ui/camera_rig.h"
#include "ui/events.h"
#include "ui/tools/tool_settings.h"

namespace bosquet::ui {

enum class ToolKind {
  select,
  plant_brush,
  single,
  row,
  grid,
  hedge,
  fill,
  hero,
  erase,
  raise,
  lower,
  smooth,
  flatten,
  noise,
  exclude,
  include,
  density,
  water,
  measure,
};
inline constexpr int kToolCount = 19;

/// An event with what it points at.
struct ToolEvent {
  Event event;
  std::optional<Vec3> ground;        ///< under the pointer
  std::optional<std::int32_t> tree;  ///< or hero tree, below 0
};

/// What tools work on.
struct ToolScene {
  std::shared_ptr<const scene::Document> document;
  std::vector<std::int32_t> selection;
  CameraRig rig;
  Vec2 view_size{1.0f};
  ToolSettings* settings = nullptr;
  scene::PlantingGround* planting = nullptr;
};

/// What came of an event.
struct ToolAnswer {
  std::optional<scene::Edited> edit;
  std::uint64_t drag = 0;  ///< of the edit: 0 is a step of its own
  std::optional<std::vector<std::int32_t>> selection;
  std::string message;             ///< for the person, when something could not be done
  std::size_t asks_for_trees = 0;  ///< above 0: so many trees would be planted; confirm() plants them
};

/// What is drawn over the scene for the tool in hand.
struct Preview {
  struct Ring {
    Vec2 centre;
    float radius_m;
  };
  std::optional<Ring> ring;
  std::vector<Vec2> line;     ///< plan
  bool closed = false;        ///< the line is an outline
  std::vector<Vec2> places;   ///< where trees would stand
  std::vector<Vec2> outline;  ///< pixels: box or lasso
  std::string label;          ///< beside the pointer
};

class Tool {
 public:
  virtual ~Tool() = default;
  virtual ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) = 0;
  /// Asked once a frame, so that a brush that is held still goes on.
  virtual ToolAnswer tick(double, const ToolScene&) { return {}; }
  /// After the person agreed to what asks_for_trees told.
  virtual ToolAnswer confirm(const ToolScene&) { return {}; }
  virtual Preview preview(const ToolScene&) const { return {}; }
  /// Whether a drag or an outline is going on, which Escape ends.
  virtual bool busy() const { return false; }
  virtual void cancel() {}
};

struct ToolInfo {
  ToolKind kind;
  std::string_view name;  ///< "Plant brush"
  std::string_view hint;  ///< one line for the status bar
  int key;                ///< shortcut, a letter in upper case
  bool has_radius;        ///< [ and ] change it
};

const ToolInfo& tool_info(ToolKind kind);
std::unique_ptr<Tool> make_tool(ToolKind kind);

/// A number for a new drag, above 0 and never the same.
std::uint64_t new_drag();

/// Strokes with more trees than this are asked about first.
inline constexpr std::size_t kManyTrees = 20'000;

}  // namespace bosquet::ui
