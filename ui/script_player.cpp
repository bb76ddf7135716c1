#include "ui/script_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exchange/image_file.h"

namespace bosquet::ui {
namespace {

constexpr double kSettle_s = 60;
constexpr int kDragFrames = 24;
constexpr int kCalmFrames = 3;

float number(const std::string& word) { return std::strtof(word.c_str(), nullptr); }

Button button_of(const ScriptLine& line, std::size_t word) {
  if (line.words.size() <= word) return Button::left;
  return line.words[word] == "right" ? Button::right : line.words[word] == "middle" ? Button::middle : Button::left;
}

// "Ctrl+Shift+S" as modifiers and key.
int key_of(std::string name, Modifiers& modifiers) {
  for (std::size_t plus; (plus = name.find('+')) != std::string::npos && plus + 1 < name.size();) {
    const std::string held = name.substr(0, plus);
    modifiers.control |= held == "Ctrl";
    modifiers.shift |= held == "Shift";
    modifiers.alt |= held == "Alt";
    name = name.substr(plus + 1);
  }
  const std::pair<const char*, int> named[] = {
      {"Enter", kKeyEnter}, {"Escape", kKeyEscape}, {"Delete", kKeyDelete}, {"Backspace", kKeyBackspace},
      {"Tab", kKeyTab},     {"Home", kKeyHome},     {"Up", kKeyUp},         {"Down", kKeyDown},
      {"Left", kKeyLeft},   {"Right", kKeyRight},   {"F1", kKeyF1},         {"Space", kKeySpace}};
  for (const auto& [word, key] : named)
    if (name == word) return key;
  if (name.starts_with("Num") && name.size() == 4) return kKeyNumpad0 + (name[3] - '0');
  return name.empty() ? 0 : std::toupper(static_cast<unsigned char>(name[0]));
}

}  // namespace

ScriptPlayer::ScriptPlayer(Script script, std::function<Image()> screenshot)
    : script_(std::move(script)), screenshot_(std::move(screenshot)) {}

void ScriptPlayer::fail(const ScriptLine& line, const std::string& what) {
  problem_ = fmt::format("{}:{}: {}", script_.file.string(), line.number, what);
  line_ = script_.lines.size();
  queue_.clear();
  settle_until_s_ = -1, wait_until_s_ = 0;
  shot_.reset();
}

// One frame with one event, after those that are waiting.
void ScriptPlayer::add(Event::Kind kind, Button button, int key) {
  Event event;
  event.kind = kind;
  event.at = pointer_;
  event.button = button;
  event.key = key;
  event.modifiers = modifiers_;
  queue_.insert(queue_.begin(), {event});
}

void ScriptPlayer::run(App& app, const ScriptLine& line, double time_s) {
  const std::string& what = line.words[0];
  const auto n = [&](std::size_t i) { return number(line.words[i]); };
  Session& s = app.session();
  const auto rest = [&](std::size_t from) {
    std::string text;
    for (std::size_t i = from; i < line.words.size(); ++i) text += (text.empty() ? "" : " ") + line.words[i];
    return text;
  };
  if (what == "wait") {
    wait_until_s_ = time_s + static_cast<double>(n(1));
  } else if (what == "settle") {
    settle_until_s_ = time_s + (line.words.size() > 1 ? static_cast<double>(n(1)) : kSettle_s);
    calm_frames_ = 0;
  } else if (what == "move") {
    pointer_ = {n(1), n(2)};
    add(Event::Kind::move);
  } else if (what == "ground") {
    const Vec2 plan(n(1), n(2));
    const auto seen = s.rig.project(to_world(plan, s.document()->terrain->ground(plan)), app.view_size());
    if (!seen) return fail(line, "this ground point is behind the camera");
    pointer_ = app.view_low() + *seen;
    add(Event::Kind::move);
  } else if (what == "press") {
    add(Event::Kind::press, button_of(line, 1));
  } else if (what == "release") {
    add(Event::Kind::release, button_of(line, 1));
  } else if (what == "click") {
    pointer_ = {n(1), n(2)};
    add(Event::Kind::move);
    add(Event::Kind::press, button_of(line, 3));
    add(Event::Kind::release, button_of(line, 3));
  } else if (what == "drag") {
    const Vec2 from(n(1), n(2)), to(n(3), n(4));
    pointer_ = from;
    add(Event::Kind::move);
    add(Event::Kind::press, button_of(line, 5));
    for (int i = 1; i <= kDragFrames; ++i) {
      pointer_ = glm::mix(from, to, static_cast<float>(i) / kDragFrames);
      add(Event::Kind::move);
    }
    add(Event::Kind::release, button_of(line, 5));
  } else if (what == "scroll") {
    add(Event::Kind::scroll);
    queue_.front().front().scroll = n(1);
  } else if (what == "key") {
    Modifiers held;
    const int key = key_of(line.words[1], held);
    modifiers_ = held;
    add(Event::Kind::key_press, Button::none, key);
    add(Event::Kind::key_release, Button::none, key);
    modifiers_ = {};
  } else if (what == "type") {
    for (const char letter : rest(1)) add(Event::Kind::text, Button::none, letter);
  } else if (what == "tool") {
    for (int k = 0; k < kToolCount; ++k)
      if (tool_info(static_cast<ToolKind>(k)).name == rest(1)) return s.take(static_cast<ToolKind>(k));
    fail(line, fmt::format("no tool is called '{}'", rest(1)));
  } else if (what == "radius") {
    s.settings.radius_m = std::clamp(n(1), kLeastRadius_m, kMostRadius_m);
  } else if (what == "camera") {
    scene::Camera camera;
    camera.eye = to_world({n(1), n(2)}, n(3));
    camera.target = to_world({n(4), n(5)}, n(6));
    s.rig.look(camera);
  } else if (what == "open") {
    if (auto opened = s.open(line.words[1]); !opened) fail(line, opened.error().message);
  } else if (what == "save") {
    if (auto saved = s.save_as(line.words[1]); !saved) fail(line, saved.error().message);
  } else if (what == "year") {
    s.set_year(n(1) > 0 ? std::optional<float>(n(1)) : std::nullopt);
  } else if (what == "plan" || what == "trees") {
    s.rig.show_plan(what == "plan");
  } else if (what == "undo") {
    s.undo();
  } else if (what == "redo") {
    s.redo();
  } else if (what == "select") {
    std::vector<std::int32_t> ids;
    for (std::size_t i = 1; i < line.words.size(); ++i) ids.push_back(static_cast<std::int32_t>(n(i)));
    s.select(std::move(ids));
  } else if (what == "export") {
    app.export_to(line.words[1]);
  } else if (what == "screenshot") {
    shot_ = line.words[1];
  } else if (what == "expect") {
    const std::string& about = line.words[1];
    std::string found;
    if (about == "trees") found = std::to_string(s.document()->trees->size());
    if (about == "undo") found = s.history().can_undo() ? s.history().undo_name() : "nothing";
    if (about == "unsaved") found = s.unsaved() ? "yes" : "no";
    if (about == "selected") found = std::to_string(s.selection().size());
    if (found != rest(2)) fail(line, fmt::format("{} is '{}', expected is '{}'", about, found, rest(2)));
  }
}

std::vector<Event> ScriptPlayer::next(App& app, double time_s) {
  if (shot_) {
    if (auto written = exchange::write_image(*shot_, screenshot_()); !written) problem_ = written.error().message;
    shot_.reset();
  }
  if (settle_until_s_ >= 0) {
    calm_frames_ = app.settled() ? calm_frames_ + 1 : 0;
    if (calm_frames_ < kCalmFrames && time_s < settle_until_s_) return {};
    settle_until_s_ = -1;
  }
  if (time_s < wait_until_s_) return {};
  wait_until_s_ = 0;
  while (queue_.empty() && line_ < script_.lines.size() && !shot_ && settle_until_s_ < 0 && time_s >= wait_until_s_)
    run(app, script_.lines[line_++], time_s);
  if (queue_.empty()) return {};
  std::vector<Event> events = std::move(queue_.back());
  queue_.pop_back();
  for (Event& event : events) event.time_s = time_s;
  return events;
}

}  // namespace bosquet::ui
