// Window: the desktop's window, its input as events, its OpenGL context.
//
// Context   OpenGL 3.3 core, current on the thread that opened it
// Errors    no display, or no OpenGL 3.3: what was found, and what can be done without a window
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "ui/events.h"

namespace bosquet::ui {

struct WindowOptions {
  std::string title = "Bosquet";
  static constexpr IVec2 kUsual{1440, 900};
  IVec2 size{0};  ///< 0: the usual one, or as much of it as the screen has beside its bars
};

class Window {
 public:
  static Result<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Waits at most so long for input; the events since the last call, in pixels of the framebuffer.
  std::vector<Event> events(double wait_s);
  std::vector<std::filesystem::path> dropped();

  IVec2 size() const;   ///< of the framebuffer
  float scale() const;  ///< of the screen: 2 on one with small pixels
  double time_s() const;
  bool wants_to_close() const;
  void keep_open();
  void set_title(const std::string& title);
  void show_frame();

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace bosquet::ui
