#include "cli/progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

namespace bosquet::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kRefresh = std::chrono::milliseconds(100);
constexpr double kPlainLineEvery_s = 10.0;
constexpr std::size_t kBarWidth = 24;

std::atomic<Progress*> interrupted_progress{nullptr};

void on_interrupt(int) {
  Progress* p = interrupted_progress.load();
  if (!p || p->cancelled()) _exit(2);  // asked twice: at once
  p->cancel();
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string time_left(double elapsed_s, double share) {
  if (share < 0.02 || elapsed_s < 0.5) return "";
  const int left = static_cast<int>(elapsed_s * (1.0 - share) / share + 0.5);
  return left >= 60 ? fmt::format("{} min {:02} s left", left / 60, left % 60) : fmt::format("{} s left", left);
}

}  // namespace

ProgressDisplay::ProgressDisplay(Progress& progress, bool quiet)
    : progress_(progress), terminal_(isatty(STDERR_FILENO) != 0) {
  interrupted_progress.store(&progress);
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (!quiet) thread_ = std::thread([this] { show_until_stopped(); });
}

ProgressDisplay::~ProgressDisplay() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  interrupted_progress.store(nullptr);
}

void ProgressDisplay::show_until_stopped() {
  std::string stage;
  const auto start = Clock::now();
  auto stage_start = start;
  double last_plain_s = 0.0;
  while (!stop_.load()) {
    const std::string now = progress_.stage();
    const std::size_t done = progress_.done(), total = progress_.total();
    // The counts are read one after the other while work goes on, so done may exceed total for a moment.
    const double share = total ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0.0;
    if (now != stage) stage = now, stage_start = Clock::now();
    const double elapsed = seconds_since(stage_start);
    if (!stage.empty() && terminal_) {
      const auto filled = static_cast<std::size_t>(share * kBarWidth);
      const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
      if (total == 0)
        fmt::print(stderr, "\r\033[K{}", stage);
      else
        fmt::print(stderr, "\r\033[K{} [{}] {:3.0f} %  {}/{}  {}", stage, bar, 100.0 * share, done, total,
                   time_left(elapsed, share));
      std::fflush(stderr);
    } else if (const double running = seconds_since(start);
               !stage.empty() && running - last_plain_s >= kPlainLineEvery_s) {
      last_plain_s = running;
      if (total < 2)
        fmt::print(stderr, "{}, {:.0f} s\n", stage, elapsed);
      else
        fmt::print(stderr, "{}: {} of {} {}\n", stage, done, total, time_left(elapsed, share));
    }
    std::this_thread::sleep_for(kRefresh);
  }
  if (terminal_) {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}

}  // namespace bosquet::cli
