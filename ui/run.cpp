#include "ui/run.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/stopwatch.h"
#include "exchange/file_output.h"
#include "exchange/image_file.h"
#include "ui/app.h"
#include "ui/script_player.h"
#include "ui/state_file.h"
#include "ui/window.h"

namespace bosquet::ui {
namespace {

constexpr double kIdleWait_s = 0.05;
constexpr double kSettleAtMost_s = 60;
constexpr std::size_t kSlowest = 12;  ///< frames that the report names

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// What was asked of the person once is not asked again: a file in the state folder tells.
std::filesystem::path first_run_mark() { return state_path("seen-first-steps"); }

double share(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}

}  // namespace

Result<void> run_window(const RunOptions& options) {
  std::optional<Script> script;
  if (!options.script.empty()) {
    auto read = read_script(options.script);
    if (!read) return read.error();
    script = std::move(*read);
  }
  WindowOptions window_options;
  window_options.size = options.size;
  auto window = Window::open(window_options);
  if (!window) return window.error();

  AppOptions app_options;
  app_options.file = options.file;
  app_options.session.threads = options.threads;
  app_options.marks = !options.state.empty();
  std::error_code ec;
  const bool by_hand = !script && options.screenshot.empty();
  app_options.first_run = by_hand && options.file.empty() && !std::filesystem::exists(first_run_mark(), ec);
  const std::filesystem::path remembered = state_path("window.json");
  app_options.preferences = read_preferences(remembered);
  auto app = App::create(app_options);
  if (!app) return app.error();
  if (app_options.first_run) std::ofstream(first_run_mark()) << "\n";

  std::optional<ScriptPlayer> player;
  const auto screenshot = [&] { return render::read_framebuffer(0, window->size()); };
  if (script) player.emplace(std::move(*script), screenshot);
  std::vector<double> cpu, wall, cpu_growing, wall_growing;
  std::vector<int> lines;
  std::string title;
  Preferences kept = app_options.preferences;
  int calm = 0;
  std::optional<StateFile> state;
  if (!options.state.empty()) state.emplace(options.state);
  while (!(*app)->ended()) {
    const bool busy = player || !(*app)->settled();
    std::vector<Event> events = window->events(busy ? 0.0 : kIdleWait_s);
    const double now = window->time_s();
    const Stopwatch watch;
    const double cpu_before = thread_seconds();
    if (player) {
      if (player->done()) break;
      events = player->next(**app, now);
      if (!player->problem().empty()) break;
    }
    if (window->size().x < 1 || window->size().y < 1) continue;  // an icon
    const std::vector<std::filesystem::path> dropped = window->dropped();
    FrameInput input;
    input.size = window->size();
    input.scale = options.scale > 0 ? options.scale : window->scale();
    input.time_s = now;
    input.events = events;
    input.dropped = dropped;
    input.close = window->wants_to_close();
    if (input.close) window->keep_open();
    (*app)->frame(input);
    cpu.push_back(thread_seconds() - cpu_before);
    window->show_frame();
    if (state)
      if (auto written = state->write(**app); !written) return written;
    wall.push_back(watch.seconds());
    lines.push_back(player ? player->line() : 0);
    if (!(*app)->session().pipeline().idle()) {
      cpu_growing.push_back(cpu.back());
      wall_growing.push_back(wall.back());
    }
    // What a script chose is not what the person chose.
    if (Preferences now_chosen = (*app)->preferences(); by_hand && now_chosen != kept)
      write_preferences(kept = std::move(now_chosen), remembered);
    if (const std::string now_title = (*app)->title(); now_title != title) window->set_title(title = now_title);
    if (!player && !options.screenshot.empty()) {
      calm = (*app)->settled() && (*app)->has_thumbnails() ? calm + 1 : 0;
      if (calm > 3 || now > kSettleAtMost_s) break;
    }
  }
  if (player && !player->problem().empty()) return Error{player->problem()};
  if (!options.screenshot.empty())
    if (auto written = exchange::write_image(options.screenshot, screenshot()); !written) return written;
  if (!options.report.empty()) {
    nlohmann::ordered_json json;
    const auto of = [](const std::vector<double>& seconds) {
      return nlohmann::ordered_json{{"median", 1e3 * share(seconds, 0.5)},
                                    {"p99", 1e3 * share(seconds, 0.99)},
                                    {"most", 1e3 * share(seconds, 1.0)}};
    };
    json["frames"] = cpu.size();
    json["cpu_ms"] = of(cpu);
    json["frame_ms"] = of(wall);
    json["growing"] = {{"frames", cpu_growing.size()}, {"cpu_ms", of(cpu_growing)}, {"frame_ms", of(wall_growing)}};
    std::vector<std::size_t> order(cpu.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cpu[a] > cpu[b]; });
    for (std::size_t i = 0; i < std::min<std::size_t>(kSlowest, order.size()); ++i)
      json["slowest"].push_back(
          {{"frame", order[i]}, {"script_line", lines[order[i]]}, {"cpu_ms", 1e3 * cpu[order[i]]}});
    json["trees"] = (*app)->session().document()->trees->size();
    std::ofstream out(options.report);
    out << json.dump(2) << "\n";
    if (!out) return cannot_finish(options.report.string() + ": cannot be written");
  }
  return {};
}

}  // namespace bosquet::ui
