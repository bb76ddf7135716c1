// Run: the window from its opening to its end.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::ui {

struct RunOptions {
  std::filesystem::path file;
  std::filesystem::path script;      ///< replayed, then the window closes
  std::filesystem::path screenshot;  ///< of the last frame, when it is settled
  std::filesystem::path report;      ///< JSON: seconds a frame, and what they were spent on
  std::filesystem::path state;       ///< JSON: what the window shows, whenever that changes (ui/state_file.h)
  int threads = 0;
  IVec2 size{0};    ///< of the window at first; 0: WindowOptions::kUsual, or what the screen has room for
  float scale = 0;  ///< of text and buttons; 0: the screen's
};

/// Opens the window and stays until it is closed. Errors of kind `input` for files that cannot be opened and scripts that
/// do not hold, `cannot_finish` without a display.
Result<void> run_window(const RunOptions& options);

}  // namespace bosquet::ui
