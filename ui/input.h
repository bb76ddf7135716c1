// Input: events handed to Dear ImGui, one frame at a time.
//
// Decision  ImGui 1.86 sees the state at a frame's begin alone and misses what is pressed and let go between two frames,
//           so a key or button changes once a frame and what follows waits; tools get every event at once
// Who       the window, scripts and tests feed it alike
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"
#include "ui/events.h"

namespace bosquet::ui {

class Input {
 public:
  /// Tells ImGui's keys from our keys; once, after the ImGui context was made.
  static void bind_keys();

  /// Brings the events of a frame to ImGui's state, before its NewFrame().
  void feed(std::span<const Event> events);

 private:
  void set(const Event& event);
  std::vector<Event> held_back_;
};

}  // namespace bosquet::ui
