#include "ui/input.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

namespace bosquet::ui {
namespace {

int index_of(Button button) { return button == Button::right ? 1 : button == Button::middle ? 2 : 0; }

}  // namespace

void Input::bind_keys() {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyMap[ImGuiKey_Tab] = kKeyTab;
  io.KeyMap[ImGuiKey_LeftArrow] = kKeyLeft;
  io.KeyMap[ImGuiKey_RightArrow] = kKeyRight;
  io.KeyMap[ImGuiKey_UpArrow] = kKeyUp;
  io.KeyMap[ImGuiKey_DownArrow] = kKeyDown;
  io.KeyMap[ImGuiKey_Home] = kKeyHome;
  io.KeyMap[ImGuiKey_End] = kKeyEnd;
  io.KeyMap[ImGuiKey_Delete] = kKeyDelete;
  io.KeyMap[ImGuiKey_Backspace] = kKeyBackspace;
  io.KeyMap[ImGuiKey_Space] = kKeySpace;
  io.KeyMap[ImGuiKey_Enter] = kKeyEnter;
  io.KeyMap[ImGuiKey_Escape] = kKeyEscape;
  io.KeyMap[ImGuiKey_A] = 'A';
  io.KeyMap[ImGuiKey_C] = 'C';
  io.KeyMap[ImGuiKey_V] = 'V';
  io.KeyMap[ImGuiKey_X] = 'X';
  io.KeyMap[ImGuiKey_Y] = 'Y';
  io.KeyMap[ImGuiKey_Z] = 'Z';
}

void Input::set(const Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyShift = event.modifiers.shift;
  io.KeyCtrl = event.modifiers.control;
  io.KeyAlt = event.modifiers.alt;
  const bool down = event.kind == Event::Kind::press || event.kind == Event::Kind::key_press;
  switch (event.kind) {
    case Event::Kind::press:
    case Event::Kind::release:
      io.MousePos = {event.at.x, event.at.y};
      if (event.button != Button::none) io.MouseDown[index_of(event.button)] = down;
      break;
    case Event::Kind::move:
      io.MousePos = {event.at.x, event.at.y};
      break;
    case Event::Kind::scroll:
      io.MouseWheel += event.scroll;
      break;
    case Event::Kind::key_press:
    case Event::Kind::key_release:
      if (event.key > 0 && event.key < static_cast<int>(std::size(io.KeysDown))) io.KeysDown[event.key] = down;
      break;
    case Event::Kind::text:
      io.AddInputCharacter(static_cast<unsigned>(event.key));
      break;
  }
}

std::vector<Event> Input::feed(std::span<const Event> events) {
  std::vector<Event> now = std::exchange(held_back_, {});
  now.insert(now.end(), events.begin(), events.end());
  std::vector<Event> turned;
  bool button_turned = false;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Event& e = now[i];
    const bool button = e.kind == Event::Kind::press || e.kind == Event::Kind::release;
    const bool key = e.kind == Event::Kind::key_press || e.kind == Event::Kind::key_release;
    const bool pointer = button || e.kind == Event::Kind::move || e.kind == Event::Kind::scroll;
    const bool again = key && std::any_of(turned.begin(), turned.end(), [&](const Event& t) { return t.key == e.key; });
    if (again || (button_turned && pointer)) {
      held_back_.assign(now.begin() + static_cast<std::ptrdiff_t>(i), now.end());
      now.resize(i);
      return now;
    }
    button_turned |= button;
    if (key) turned.push_back(e);
    set(e);
  }
  return now;
}

}  // namespace bosquet::ui
