// Progress display: shows a Progress on stderr while work runs elsewhere.
//
// On a terminal one line is rewritten: stage, percent, items done, time left. Otherwise a plain line is printed
// every ten seconds. Interrupts (Ctrl-C, SIGTERM) cancel the work.
#pragma once

#include <thread>

#include "core/progress.h"

namespace bosquet::cli {

class ProgressDisplay {
 public:
  /// Shows `progress` until destroyed; `quiet` shows nothing but still lets Ctrl-C cancel.
  ProgressDisplay(Progress& progress, bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

 private:
  void show_until_stopped();

  Progress& progress_;
  bool terminal_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace bosquet::cli
