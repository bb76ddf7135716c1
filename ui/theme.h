// Theme: fonts, colours and sizes of the window, dark or light, at any scale of the screen.
#pragma once

#include <imgui.h>

namespace bosquet::ui {

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
