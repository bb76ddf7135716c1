// Events: what a hand does, as plain values that tools and cameras are fed with.
//
// Units     pixels of the scene view, (0, 0) at its upper left, y down; seconds since the window opened
// Who       the window makes them from GLFW's callbacks, a script from a text file, tests by hand
#pragma once

#include "core/vec.h"

namespace bosquet::ui {

enum class Button { none, left, middle, right };

struct Modifiers {
  bool shift = false, control = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

/// Keys that mean something beyond a letter; letters and digits are themselves, in upper case.
enum Key : int {
  kKeyNone = 0,
  kKeyEscape = 256,
  kKeyEnter,
  kKeyTab,
  kKeyBackspace,
  kKeyDelete,
  kKeyRight,
  kKeyLeft,
  kKeyDown,
  kKeyUp,
  kKeyHome,
  kKeyEnd,
  kKeySpace,
  kKeyNumpad0,  ///< and the nine after it
  kKeyNumpad9 = kKeyNumpad0 + 9,
  kKeyF1,
  kKeyF11 = kKeyF1 + 10
};

struct Event {
  enum class Kind { move, press, release, scroll, key_press, key_release, text };
  Kind kind = Kind::move;
  Vec2 at{0.0f};  ///< pointer
  Button button = Button::none;
  int key = kKeyNone;  ///< of text: its code point
  float scroll = 0;    ///< notches, up and away above 0
  Modifiers modifiers = {};
  double time_s = 0;
};

}  // namespace bosquet::ui
