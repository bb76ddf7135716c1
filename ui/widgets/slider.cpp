#include "ui/widgets/slider.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace bosquet::ui {
namespace {

constexpr float kPadding = 8.0f, kMark = 2.0f;  ///< at a scale of 1

float scale_now() { return ImGui::GetFontSize() / 15.0f; }

// How far along its bar a number stands.
float share_of(float value, float low, float high, bool logarithmic) {
  if (!(high > low)) return 0.0f;
  const float share =
      logarithmic && low > 0 ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(share, 0.0f, 1.0f);
}

bool draw(const char* label, ImGuiDataType type, void* value, const void* low, const void* high, const char* format,
          ImGuiSliderFlags flags, float share, float from) {
  const std::string hidden = std::string("##") + label;
  const ImGuiID id = ImGui::GetID(hidden.c_str());
  flags |= ImGuiSliderFlags_AlwaysClamp;
  if (ImGui::TempInputIsActive(id)) return ImGui::SliderScalar(hidden.c_str(), type, value, low, high, format, flags);

  const ImVec4 nothing(0, 0, 0, 0);
  for (const int colour : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_SliderGrab,
                           ImGuiCol_SliderGrabActive, ImGuiCol_Text})
    ImGui::PushStyleColor(colour, nothing);
  const bool changed = ImGui::SliderScalar(hidden.c_str(), type, value, low, high, format, flags);
  ImGui::PopStyleColor(6);
  const bool typing = ImGui::TempInputIsActive(id);  // since this click
  if (typing || !ImGui::IsItemVisible()) return changed;

  const float s = scale_now(), round = ImGui::GetStyle().FrameRounding;
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  ImDrawList* picture = ImGui::GetWindowDrawList();
  const bool held = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
  picture->AddRectFilled(a, b, ImGui::GetColorU32(hovered || held ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), round);
  // The hand holds the middle of ImGui's own grab, which is not drawn.
  const float inset = 2.0f + 0.5f * ImGui::GetStyle().GrabMinSize, width = b.x - a.x - 2.0f * inset;
  const float x = a.x + inset + width * share, x0 = from > 0.0f ? a.x + inset + width * from : a.x;
  const float left = std::min(x, x0), right = std::max(x, x0);
  picture->AddRectFilled({left, a.y}, {right, b.y}, ImGui::GetColorU32(ImGuiCol_Header), round,
                         from > 0.0f ? ImDrawFlags_RoundCornersNone : ImDrawFlags_RoundCornersLeft);
  if (ImGui::GetCurrentContext()->NavId == id && !ImGui::GetCurrentContext()->NavDisableHighlight)
    picture->AddRect(a, b, ImGui::GetColorU32(ImGuiCol_NavHighlight), round, 0, 1.5f * s);

  char words[64];
  ImGui::DataTypeFormatString(words, sizeof words, type, value, format);
  const float pad = kPadding * s, y = a.y + 0.5f * (b.y - a.y - ImGui::GetFontSize());
  const float words_width = ImGui::CalcTextSize(words).x;
  const char* end = ImGui::FindRenderedTextEnd(label);
  const bool named = end != label;
  const float words_x = named ? b.x - pad - words_width : 0.5f * (a.x + b.x - words_width);
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const ImVec4 clip(a.x, a.y, words_x - 0.5f * pad, b.y);
  // The mark leaves out what stands in its way.
  const auto on = [&](float from_x, float to_x) { return x > from_x - 0.5f * pad && x < to_x + 0.5f * pad; };
  const float label_width = named ? ImGui::CalcTextSize(label, end).x : 0.0f;
  const bool crosses =
      on(words_x, words_x + words_width) || (named && on(a.x + pad, std::min(a.x + pad + label_width, clip.z)));
  const auto stroke = [&](float top, float bottom) {
    picture->AddRectFilled({x - 0.5f * kMark * s, top}, {x + 0.5f * kMark * s, bottom},
                           ImGui::GetColorU32(ImGuiCol_SliderGrab));
  };
  if (crosses) {
    stroke(a.y, y);
    stroke(b.y - (y - a.y), b.y);
  } else {
    stroke(a.y, b.y);
  }
  if (named) picture->AddText(nullptr, 0.0f, {a.x + pad, y}, ink, label, end, 0.0f, &clip);
  picture->AddText({words_x, y}, ink, words);
  return changed;
}

}  // namespace

bool slider(const char* label, float& value, float low, float high, const char* format, ImGuiSliderFlags flags) {
  const bool logarithmic = (flags & ImGuiSliderFlags_Logarithmic) != 0;
  const float from = low < 0 && high > 0 ? share_of(0, low, high, false) : 0.0f;
  return draw(label, ImGuiDataType_Float, &value, &low, &high, format, flags, share_of(value, low, high, logarithmic),
              from);
}

bool slider(const char* label, int& value, int low, int high, const char* format, ImGuiSliderFlags flags) {
  const float share = share_of(static_cast<float>(value), static_cast<float>(low), static_cast<float>(high),
                               (flags & ImGuiSliderFlags_Logarithmic) != 0);
  return draw(label, ImGuiDataType_S32, &value, &low, &high, format, flags, share, 0.0f);
}

bool length_slider(const char* label, float& metres, float low, float high, Units units, ImGuiSliderFlags flags) {
  if (units == Units::metres) return slider(label, metres, low, high, "%.1f m", flags);
  float feet = metres * kFeetPerMetre;
  if (!slider(label, feet, low * kFeetPerMetre, high * kFeetPerMetre, "%.1f ft", flags)) return false;
  // Feet come rounded to a tenth; the ends are the ends.
  constexpr float kRounded_ft = 0.06f;
  metres = feet > high * kFeetPerMetre - kRounded_ft  ? high
           : feet < low * kFeetPerMetre + kRounded_ft ? low
                                                      : feet / kFeetPerMetre;
  return true;
}

float slider_width(const char* label, const char* longest_value) {
  const float gap = label[0] == '#' ? 0.0f : 1.5f * kPadding * scale_now();
  return ImGui::CalcTextSize(label, nullptr, true).x + ImGui::CalcTextSize(longest_value).x + gap +
         2.0f * kPadding * scale_now();
}

}  // namespace bosquet::ui
