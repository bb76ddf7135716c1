#include "ui/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

namespace bosquet::ui {
namespace {

constexpr const char* kWithout =
    "pictures and files need no window: bosquet render FILE -o OUT.png, bosquet make --help";

std::string last_glfw_error() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words ? words : "unknown reason";
}

Button button_of(int button) {
  return button == GLFW_MOUSE_BUTTON_RIGHT    ? Button::right
         : button == GLFW_MOUSE_BUTTON_MIDDLE ? Button::middle
         : button == GLFW_MOUSE_BUTTON_LEFT   ? Button::left
                                              : Button::none;
}

// Letters by what stands on the key, so that shortcuts are where they are printed.
int key_of(int key, int scancode) {
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return kKeyNumpad0 + (key - GLFW_KEY_KP_0);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F11) return kKeyF1 + (key - GLFW_KEY_F1);
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return kKeyEscape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return kKeyEnter;
    case GLFW_KEY_TAB:
      return kKeyTab;
    case GLFW_KEY_BACKSPACE:
      return kKeyBackspace;
    case GLFW_KEY_DELETE:
      return kKeyDelete;
    case GLFW_KEY_RIGHT:
      return kKeyRight;
    case GLFW_KEY_LEFT:
      return kKeyLeft;
    case GLFW_KEY_DOWN:
      return kKeyDown;
    case GLFW_KEY_UP:
      return kKeyUp;
    case GLFW_KEY_HOME:
      return kKeyHome;
    case GLFW_KEY_END:
      return kKeyEnd;
    case GLFW_KEY_SPACE:
      return kKeySpace;
    default:
      break;
  }
  if (const char* name = glfwGetKeyName(key, scancode); name && name[0] && !name[1]) {
    const char c = name[0];
    return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
  }
  return key >= 32 && key < 128 ? key : kKeyNone;
}

// The usual size, in the screen's own measure, as far as there is room for it and for the frame that the desktop puts
// round it.
IVec2 size_with_room() {
  constexpr int kFrame = 48;
  const IVec2 usual = WindowOptions::kUsual;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!monitor) return usual;
  int x = 0, y = 0, w = 0, h = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
  float sx = 1, sy = 1;
  glfwGetMonitorContentScale(monitor, &sx, &sy);
  // What is asked for is enlarged by the scale (GLFW_SCALE_TO_MONITOR) where sizes are in pixels.
  const auto room = [](int there, float scale) {
    return std::max(320, static_cast<int>(static_cast<float>(there - kFrame) / std::max(1.0f, scale)));
  };
  return {std::min(usual.x, room(w, sx)), std::min(usual.y, room(h, sy))};
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<Event> events;
  std::vector<std::filesystem::path> dropped;
  Modifiers modifiers;

  ~State() {
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }

  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

  // GLFW speaks in screen coordinates, which are not pixels everywhere.
  Vec2 pixels(double x, double y) const {
    int w = 1, h = 1, fw = 1, fh = 1;
    glfwGetWindowSize(window, &w, &h);
    glfwGetFramebufferSize(window, &fw, &fh);
    return {static_cast<float>(x * fw / std::max(1, w)), static_cast<float>(y * fh / std::max(1, h))};
  }
  Vec2 pointer() const {
    double x = 0, y = 0;
    glfwGetCursorPos(window, &x, &y);
    return pixels(x, y);
  }
  Event& add(Event::Kind kind, Vec2 at) {
    Event& event = events.emplace_back();
    event.kind = kind;
    event.at = at;
    event.modifiers = modifiers;
    event.time_s = glfwGetTime();
    return event;
  }
  void set_modifiers(int mods) {
    modifiers = {(mods & GLFW_MOD_SHIFT) != 0, (mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0,
                 (mods & GLFW_MOD_ALT) != 0};
  }
  // A modifier's own press and release are not in the mods that come with them.
  void note_modifier_key(int key, bool down) {
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) modifiers.shift = down;
    if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL) modifiers.control = down;
    if (key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT) modifiers.alt = down;
  }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::open(const WindowOptions& options) {
  if (!glfwInit()) return cannot_finish("no display to open a window on (" + last_glfw_error() + "); " + kWithout);
  auto state = std::make_unique<State>();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const IVec2 size = options.size.x > 0 ? options.size : size_with_room();
  state->window = glfwCreateWindow(size.x, size.y, options.title.c_str(), nullptr, nullptr);
  if (!state->window)
    return cannot_finish("no window with OpenGL 3.3 can be opened (" + last_glfw_error() + "); " + kWithout);
  GLFWwindow* window = state->window;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window, state.get());
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    State& s = State::of(w);
    s.add(Event::Kind::move, s.pixels(x, y));
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    State& s = State::of(w);
    s.set_modifiers(mods);
    s.add(action == GLFW_PRESS ? Event::Kind::press : Event::Kind::release, s.pointer()).button = button_of(button);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) {
    State& s = State::of(w);
    s.add(Event::Kind::scroll, s.pointer()).scroll = static_cast<float>(y);
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    State& s = State::of(w);
    s.set_modifiers(mods);
    s.note_modifier_key(key, action != GLFW_RELEASE);
    s.add(action == GLFW_RELEASE ? Event::Kind::key_release : Event::Kind::key_press, s.pointer()).key =
        key_of(key, scancode);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned letter) {
    State& s = State::of(w);
    s.add(Event::Kind::text, s.pointer()).key = static_cast<int>(letter);
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) State::of(w).dropped.emplace_back(paths[i]);
  });
  return Window(std::move(state));
}

std::vector<Event> Window::events(double wait_s) {
  if (wait_s > 0)
    glfwWaitEventsTimeout(wait_s);
  else
    glfwPollEvents();
  return std::exchange(state_->events, {});
}

std::vector<std::filesystem::path> Window::dropped() { return std::exchange(state_->dropped, {}); }

IVec2 Window::size() const {
  IVec2 size(0);
  glfwGetFramebufferSize(state_->window, &size.x, &size.y);
  return size;
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 4.0f);
}

double Window::time_s() const { return glfwGetTime(); }
bool Window::wants_to_close() const { return glfwWindowShouldClose(state_->window); }
void Window::keep_open() { glfwSetWindowShouldClose(state_->window, GLFW_FALSE); }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }
void Window::show_frame() { glfwSwapBuffers(state_->window); }

}  // namespace bosquet::ui
