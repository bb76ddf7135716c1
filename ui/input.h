// Input: events handed to Dear ImGui, one frame at a time.
//
// Decision  ImGui 1.86 sees the state at a frame's begin alone: it misses what is pressed and let go between two frames,
//           and takes a press to be where the pointer ended. So a frame gets events up to a press or release and the rest
//           waits for the next one; whoever draws slowly runs more frames without drawing until nothing waits, and gives
//           tools the events that ImGui has seen, so that both agree on where a click went
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

  /// Brings events to ImGui's state, before its NewFrame(): those that waited, then these, as far as one frame can see
  /// them; returns them.
  std::vector<Event> feed(std::span<const Event> events);
  /// Events wait for the next frame.
  bool waiting() const { return !held_back_.empty(); }

 private:
  void set(const Event& event);
  std::vector<Event> held_back_;
};

}  // namespace bosquet::ui
