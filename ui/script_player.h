// Script player: gives a script's events to the app, frame by frame.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/result.h"
#include "ui/app.h"
#include "ui/script.h"

namespace bosquet::ui {

class ScriptPlayer {
 public:
  /// `screenshot` takes the window's pixels.
  ScriptPlayer(Script script, std::function<Image()> screenshot);

  /// The events of the coming frame. Acts on the app where a line says so.
  std::vector<Event> next(App& app, double time_s);
  bool done() const {
    return line_ >= script_.lines.size() && queue_.empty() && settle_until_s_ < 0 && wait_until_s_ == 0 && !shot_;
  }
  /// Of the file: the line that runs now.
  int line() const { return line_ > 0 && line_ <= script_.lines.size() ? script_.lines[line_ - 1].number : 0; }
  /// Why it ended before its end; empty when it did not.
  const std::string& problem() const { return problem_; }

 private:
  void run(App& app, const ScriptLine& line, double time_s);
  void fail(const ScriptLine& line, const std::string& what);
  void add(Event::Kind kind, Button button = Button::none, int key = 0);

  Script script_;
  std::function<Image()> screenshot_;
  std::size_t line_ = 0;
  std::vector<std::vector<Event>> queue_;  ///< events of coming frames, the next one last
  Vec2 pointer_{0.0f};
  Modifiers modifiers_;
  double wait_until_s_ = 0, settle_until_s_ = -1;
  std::optional<std::string> shot_;  ///< taken after the frame that follows
  int calm_frames_ = 0;
  std::string problem_;
};

}  // namespace bosquet::ui
