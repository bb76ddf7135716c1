// State file: what the window shows, as JSON for programs that drive it from outside: tests, and aids for those who do
// not see the screen.
//
// Format    trees, grown (drawn as they grew), settled (nothing grows, is drawn or waited for), undo, redo, steps,
//           unsaved, title, tool, radius_m, selection, question (what is asked in the middle), message, units, dark,
//           overlay_step, water_level_m, view [x, y, width, height] of the scene; widgets {name: [x, y, width, height]};
//           places [{id, species, east, north, x, y}]: trees whose foot is seen, at most kMostPlaces; skeletons
//           {id: 16 hex digits}, when settled. x and y in pixels of the window
// Errors    of kind `cannot_finish` for a file that cannot be written; bytes that are no UTF-8 stand as U+FFFD
// Cost      a millisecond or so a frame; only for those who ask for it
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace bosquet::ui {

class App;

inline constexpr std::size_t kMostPlaces = 2000;

/// The state as it is after a frame.
std::string state_text(App& app);

/// Writes it when it is not what was written last; a reader sees the whole text, old or new.
class StateFile {
 public:
  explicit StateFile(std::filesystem::path file) : file_(std::move(file)) {}
  Result<void> write(App& app);

 private:
  std::filesystem::path file_;
  std::string written_;
};

}  // namespace bosquet::ui
