// Slider: a number in a bar that fills with it, its name and its value inside, so that neither hides the other.
//
// Who       every panel; a click with Control lets the number be typed
// Units     a length slider holds metres and shows feet where the window does
// Context   a frame of Dear ImGui begun; as wide as the next item
#pragma once

#include <imgui.h>

#include "ui/widgets/units.h"

namespace bosquet::ui {

/// `label` as ImGui's: what stands behind ## is not shown. Values stay within their limits, typed ones too.
bool slider(const char* label, float& value, float low, float high, const char* format, ImGuiSliderFlags flags = 0);
bool slider(const char* label, int& value, int low, int high, const char* format = "%d", ImGuiSliderFlags flags = 0);
bool length_slider(const char* label, float& metres, float low, float high, Units units, ImGuiSliderFlags flags = 0);

/// As wide as name and value need.
float slider_width(const char* label, const char* longest_value);

}  // namespace bosquet::ui
