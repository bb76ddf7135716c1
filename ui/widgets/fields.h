// Fields: described parameters as sliders, switches and choices, each with its sentence and unit as a tooltip.
//
// Who       panels; a field edits its number in place and says so
// Context   a frame of Dear ImGui begun
#pragma once

#include <imgui.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.h"

namespace bosquet::ui {

/// "set_point_angle_deg" as people read it: "Set point angle".
std::string label_of(std::string_view name, std::string_view unit = {});

bool real_field(const Real& info, float& value);
bool whole_field(const Whole& info, int& value);
bool switch_field(const Switch& info, bool& value);
bool choice_field(const Choice& info, int& value);

/// A tooltip for the item drawn last.
void explain(std::string_view meaning);

/// Visits a described struct and draws a field for each entry that `shown` lets through; tables are left out.
/// `picture`, where there is one, adds to the tooltip of a number: it is told its name, a low and a high value.
using TooltipPicture = std::function<void(std::string_view name, double few, double many)>;
template <class Shown>
class FieldVisitor {
 public:
  explicit FieldVisitor(Shown shown, TooltipPicture picture = {})
      : shown_(std::move(shown)), picture_(std::move(picture)) {}
  bool changed() const { return changed_; }

  void operator()(const Real& info, float& value) {
    if (!shown_(info.name)) return;
    changed_ |= real_field(info, value);
    const double part = kFromEnd * (info.high - info.low);
    illustrate(info.name, info.low + part, info.high - part);
  }
  void operator()(const Real& info, double& value) {
    auto number = static_cast<float>(value);
    if (shown_(info.name) && real_field(info, number)) value = number, changed_ = true;
  }
  void operator()(const Whole& info, int& value) {
    if (!shown_(info.name)) return;
    changed_ |= whole_field(info, value);
    illustrate(info.name, info.low, info.high);
  }
  void operator()(const Switch& info, bool& value) {
    if (shown_(info.name)) changed_ |= switch_field(info, value);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& info, Enum& value) {
    auto number = static_cast<int>(value);
    if (shown_(info.name) && choice_field(info, number)) value = static_cast<Enum>(number), changed_ = true;
  }
  void operator()(const Colour&, Vec3&) {}
  void operator()(const Text&, std::string&) {}
  template <class T>
  void operator()(const Tables&, std::vector<T>&) {}

 private:
  static constexpr double kFromEnd = 0.1;  ///< the very ends are rarely trees

  void illustrate(std::string_view name, double few, double many) const {
    if (!picture_ || ImGui::IsMouseDown(0) || !ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    picture_(name, few, many);
    ImGui::EndTooltip();
  }

  Shown shown_;
  TooltipPicture picture_;
  bool changed_ = false;
};

/// Fields for all of a described struct; whether one changed.
template <class Described>
bool fields(Described& described) {
  FieldVisitor visitor([](std::string_view) { return true; });
  describe(described, visitor);
  return visitor.changed();
}

}  // namespace bosquet::ui
