// Theme: fonts, colours and sizes of the window, dark or light, at any scale of the screen.
#pragma once

#include <imgui.h>

namespace bosquet::ui {

/// Icons, as code points of the icon font; text stands in for them where the font is missing.
namespace icon {
inline constexpr const char* kSelect = "\xef\x89\x85";  // f245 mouse-pointer
inline constexpr const char* kTree = "\xef\x86\xbb";    // f1bb tree
inline constexpr const char* kBrush = "\xef\x87\xbc";   // f1fc paint-brush
inline constexpr const char* kEraser = "\xef\x84\xad";  // f12d eraser
inline constexpr const char* kUp = "\xef\x81\xa2";      // f062 arrow-up
inline constexpr const char* kDown = "\xef\x81\xa3";    // f063 arrow-down
inline constexpr const char* kUndo = "\xef\x83\xa2";    // f0e2 undo
inline constexpr const char* kRedo = "\xef\x80\x9e";    // f01e repeat
inline constexpr const char* kPlay = "\xef\x81\x8b";    // f04b play
inline constexpr const char* kPause = "\xef\x81\x8c";   // f04c pause
inline constexpr const char* kFolder = "\xef\x81\xbb";  // f07b folder
inline constexpr const char* kFile = "\xef\x80\x96";    // f016 file
inline constexpr const char* kLock = "\xef\x80\xa3";    // f023 lock
}  // namespace icon

struct Fonts {
  ImFont* text = nullptr;
  ImFont* heading = nullptr;
  bool icons = false;  ///< merged into both
};

/// Loads fonts at `scale` times 15 pixels; call again when the screen's scale changes, before a frame.
Fonts load_fonts(float scale);

/// Colours and spacing; sizes times `scale`.
void apply_theme(bool dark, float scale);

}  // namespace bosquet::ui
