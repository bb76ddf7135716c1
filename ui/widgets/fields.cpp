#include "ui/widgets/fields.h"

#include <cctype>
#include <cmath>

#include "ui/widgets/slider.h"

namespace bosquet::ui {
namespace {

constexpr float kTooltipWidth = 22.0f;  ///< in letters' heights

void limits(std::string& text, const std::string& low, const std::string& high, std::string_view unit) {
  text.append("\n").append(low).append(" to ").append(high);
  if (!unit.empty()) text.append(" ").append(unit);
}

std::string number(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", v);
  return buffer;
}

}  // namespace

std::string label_of(std::string_view name, std::string_view unit) {
  std::string label(name);
  // The unit is said beside the number.
  for (const std::string_view ending : {"_deg", "_m", "_cm", "_years"})
    if (label.size() > ending.size() && label.ends_with(ending)) label.resize(label.size() - ending.size());
  for (char& c : label)
    if (c == '_') c = ' ';
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  if (!unit.empty() && unit != "deg") label += " (" + std::string(unit) + ")";
  return label;
}

void explain(std::string_view meaning) {
  // Not over what is being dragged.
  if (ImGui::IsMouseDown(0) || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth * ImGui::GetFontSize());
  ImGui::TextUnformatted(meaning.data(), meaning.data() + meaning.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool real_field(const Real& info, float& value) {
  const auto low = static_cast<float>(info.low), high = static_cast<float>(info.high);
  const float span = high - low;
  const char* format = info.unit == "deg" ? "%.0f\xc2\xb0" : span <= 0.2f ? "%.4f" : span <= 20.0f ? "%.2f" : "%.1f";
  const ImGuiSliderFlags flags = low > 0.0f && high / low > 500.0f ? ImGuiSliderFlags_Logarithmic : 0;
  const std::string label = label_of(info.name, info.unit) + "##" + std::string(info.name);
  const bool changed = slider(label.c_str(), value, low, high, format, flags);
  std::string text(info.meaning);
  limits(text, number(info.low), number(info.high), info.unit);
  explain(text);
  return changed;
}

bool whole_field(const Whole& info, int& value) {
  const std::string label = label_of(info.name) + "##" + std::string(info.name);
  const bool changed = slider(label.c_str(), value, info.low, info.high);
  std::string text(info.meaning);
  limits(text, std::to_string(info.low), std::to_string(info.high), {});
  explain(text);
  return changed;
}

bool switch_field(const Switch& info, bool& value) {
  const std::string label = label_of(info.name) + "##" + std::string(info.name);
  const bool changed = ImGui::Checkbox(label.c_str(), &value);
  explain(info.meaning);
  return changed;
}

bool choice_field(const Choice& info, int& value) {
  const std::string label = label_of(info.name) + "##" + std::string(info.name);
  bool changed = false;
  const auto shown = label_of(info.names[static_cast<std::size_t>(value)]);
  if (ImGui::BeginCombo(label.c_str(), shown.c_str())) {
    for (int i = 0; i < static_cast<int>(info.names.size()); ++i)
      if (ImGui::Selectable(label_of(info.names[static_cast<std::size_t>(i)]).c_str(), i == value) && i != value)
        value = i, changed = true;
    ImGui::EndCombo();
  }
  explain(info.meaning);
  return changed;
}

}  // namespace bosquet::ui
