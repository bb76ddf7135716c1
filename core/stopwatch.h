// Stopwatch: wall-clock seconds for reports. Never an input of a computation.
#pragma once

#include <chrono>

namespace bosquet {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Seconds since the last restart, and starts again.
  double restart() {
    const double s = seconds();
    start_ = Clock::now();
    return s;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace bosquet
