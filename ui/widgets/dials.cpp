#include "ui/widgets/dials.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::ui {
namespace {

constexpr float kHandle = 5.0f;  ///< radius at a scale of 1
constexpr ImU32 kWood = IM_COL32(139, 107, 74, 255);
constexpr int kBuds = 12;

ImVec2 operator+(ImVec2 a, ImVec2 b) { return {a.x + b.x, a.y + b.y}; }
ImVec2 operator-(ImVec2 a, ImVec2 b) { return {a.x - b.x, a.y - b.y}; }
ImVec2 operator*(float s, ImVec2 a) { return {s * a.x, s * a.y}; }
float length(ImVec2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }

ImU32 colour(ImGuiCol index, float alpha = 1.0f) { return ImGui::GetColorU32(index, alpha); }

// A square that can be dragged in, with its background drawn.
struct Canvas {
  ImVec2 low, centre;
  float size, scale;  ///< scale: pixels to half the square
  float unit;         ///< pixels to one at a scale of 1
  bool held, began;
  ImVec2 mouse;
  ImDrawList* draw;

  Canvas(const char* id, float side) {
    size = side;
    low = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {side, side});
    held = ImGui::IsItemActive();
    began = ImGui::IsItemActivated();
    mouse = ImGui::GetIO().MousePos;
    centre = low + ImVec2{side / 2, side / 2};
    scale = side / 2;
    unit = ImGui::GetFontSize() / 15.0f;
    draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(low, low + ImVec2{side, side}, colour(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
    if (ImGui::IsItemHovered() || held)
      draw->AddRect(low, low + ImVec2{side, side}, colour(ImGuiCol_CheckMark, 0.6f), ImGui::GetStyle().FrameRounding);
  }

  void handle(ImVec2 at) const { draw->AddCircleFilled(at, kHandle * unit, colour(ImGuiCol_SliderGrabActive)); }
  void text(ImVec2 at, const char* words) const { draw->AddText(at, colour(ImGuiCol_TextDisabled), words); }
};

// Direction on the screen at an angle from upright, to the right.
ImVec2 from_upright(float degrees_) {
  const float a = radians(degrees_);
  return {std::sin(a), -std::cos(a)};
}

float angle_from_upright(ImVec2 d) { return degrees(std::atan2(std::abs(d.x), -d.y)); }

bool set(float& value, float to) {
  const bool changed = value != to;
  value = to;
  return changed;
}

}  // namespace

bool tropism_arrow(const char* id, float& set_point_angle_deg, float size) {
  const Canvas c(id, size);
  const ImVec2 fork = c.centre + ImVec2{-0.35f * c.scale, 0.1f * c.scale};
  bool changed = false;
  if (c.held && length(c.mouse - fork) > 2.0f)
    changed = set(set_point_angle_deg, std::clamp(std::round(angle_from_upright(c.mouse - fork)), 0.0f, 180.0f));
  c.draw->AddLine({fork.x, c.low.y + 0.94f * size}, {fork.x, c.low.y + 0.06f * size}, kWood, 6.0f * c.unit);
  for (const float mark : {0.0f, 45.0f, 90.0f, 135.0f, 180.0f})
    c.draw->AddLine(fork + 0.78f * c.scale * from_upright(mark), fork + 0.86f * c.scale * from_upright(mark),
                    colour(ImGuiCol_TextDisabled), c.unit);
  // A branch that leaves level and comes round to the set point.
  const ImVec2 toward = from_upright(set_point_angle_deg), tip = fork + 0.85f * c.scale * toward;
  const ImVec2 out = fork + ImVec2{0.35f * c.scale, 0.0f};
  c.draw->AddBezierQuadratic(fork, out, tip, kWood, 4.0f * c.unit);
  c.draw->AddLine(fork, tip, colour(ImGuiCol_CheckMark), 1.5f * c.unit);
  const ImVec2 across{-toward.y, toward.x};
  c.draw->AddTriangleFilled(tip, tip - 9.0f * c.unit * toward + 5.0f * c.unit * across,
                            tip - 9.0f * c.unit * toward - 5.0f * c.unit * across, colour(ImGuiCol_CheckMark));
  c.handle(tip);
  return changed;
}

bool branching_angles(const char* id, float& branching_angle_deg, float& deflection_angle_deg, float size) {
  const Canvas c(id, size);
  const ImVec2 fork = c.centre + ImVec2{0.0f, 0.35f * c.scale};
  const float reach = 1.05f * c.scale;
  const auto main_tip = [&] { return fork + reach * from_upright(-deflection_angle_deg); };
  const auto lateral_tip = [&] { return fork + 0.85f * reach * from_upright(branching_angle_deg); };
  static ImGuiID held_lateral = 0;
  const ImGuiID me = ImGui::GetID(id);
  if (c.began) held_lateral = length(c.mouse - lateral_tip()) <= length(c.mouse - main_tip()) ? me : 0;
  bool changed = false;
  if (c.held && length(c.mouse - fork) > 2.0f) {
    const float angle = std::round(angle_from_upright(c.mouse - fork));
    if (held_lateral == me)
      changed = set(branching_angle_deg, std::clamp(angle, 10.0f, 120.0f));
    else
      changed = set(deflection_angle_deg, std::clamp(c.mouse.x > fork.x ? 0.0f : angle, 0.0f, 45.0f));
  }
  c.draw->AddLine({fork.x, c.low.y + 0.96f * size}, fork, kWood, 6.0f * c.unit);
  c.draw->AddLine(fork, main_tip(), kWood, 5.0f * c.unit);
  c.draw->AddLine(fork, lateral_tip(), kWood, 3.5f * c.unit);
  // The straight way on, and both angles to it.
  c.draw->AddLine(fork, fork + 0.9f * reach * from_upright(0), colour(ImGuiCol_TextDisabled, 0.5f), c.unit);
  const float upright = -kPi / 2;
  c.draw->PathArcTo(fork, 0.45f * reach, upright, upright + radians(branching_angle_deg));
  c.draw->PathStroke(colour(ImGuiCol_CheckMark), 0, 1.5f * c.unit);
  c.draw->PathArcTo(fork, 0.6f * reach, upright - radians(deflection_angle_deg), upright);
  c.draw->PathStroke(colour(ImGuiCol_PlotHistogram), 0, 1.5f * c.unit);
  c.handle(main_tip());
  c.handle(lateral_tip());
  return changed;
}

bool weights_triangle(const char* id, float& straightness, float& tropism, float& space, float size) {
  const Canvas c(id, size);
  const float r = 0.82f * c.scale;
  const ImVec2 middle = c.centre + ImVec2{0.0f, 0.16f * c.scale};
  const std::array<ImVec2, 3> corner{middle + r * from_upright(0), middle + r * from_upright(-120),
                                     middle + r * from_upright(120)};
  std::array<float*, 3> weight{&straightness, &tropism, &space};
  bool changed = false;
  if (c.held) {
    // Barycentric coordinates of the pointer, cut to the triangle, in steps of a hundredth.
    const ImVec2 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], p = c.mouse - corner[0];
    const float det = e1.x * e2.y - e1.y * e2.x;
    float b = (p.x * e2.y - p.y * e2.x) / det, g = (e1.x * p.y - e1.y * p.x) / det, a = 1.0f - b - g;
    a = std::max(a, 0.0f), b = std::max(b, 0.0f), g = std::max(g, 0.0f);
    const float sum = a + b + g;
    const float tens = std::round(100.0f * a / sum), bs = std::min(std::round(100.0f * b / sum), 100.0f - tens);
    changed |= set(straightness, tens / 100.0f);
    changed |= set(tropism, bs / 100.0f);
    changed |= set(space, (100.0f - tens - bs) / 100.0f);
  }
  c.draw->AddTriangleFilled(corner[0], corner[1], corner[2], colour(ImGuiCol_WindowBg));
  c.draw->AddTriangle(corner[0], corner[1], corner[2], colour(ImGuiCol_TextDisabled), c.unit);
  const ImVec2 at{*weight[0] * corner[0].x + *weight[1] * corner[1].x + *weight[2] * corner[2].x,
                  *weight[0] * corner[0].y + *weight[1] * corner[1].y + *weight[2] * corner[2].y};
  // The star: a ray toward each corner, as long as its share.
  for (std::size_t k = 0; k < 3; ++k)
    c.draw->AddLine(at, at + *weight[k] * (corner[k] - at), colour(ImGuiCol_CheckMark), 2.0f * c.unit);
  c.handle(at);
  const float line = ImGui::GetTextLineHeight();
  c.text({corner[0].x - ImGui::CalcTextSize("straight").x / 2, corner[0].y - line}, "straight");
  c.text({c.low.x + 3, corner[1].y + 1}, "tropism");
  c.text({c.low.x + size - ImGui::CalcTextSize("space").x - 3, corner[2].y + 1}, "space");
  return changed;
}

bool bud_ellipse(const char* id, float& vertical, float& level, float& offset, float size) {
  const Canvas c(id, size);
  constexpr float kShown = 2.2f;  ///< half axes that fit; larger ones shrink the picture
  const float unit = c.scale / std::max({kShown, vertical + std::abs(offset), level});
  const auto place = [&](float x, float y) { return c.centre + ImVec2{unit * x, -unit * y}; };
  enum Part { top, side, whole };
  static ImGuiID owner = 0;
  static Part part = top;
  const ImGuiID me = ImGui::GetID(id);
  if (c.began) {
    owner = me;
    const float to_top = length(c.mouse - place(0, offset + vertical)),
                to_side = length(c.mouse - place(level, offset));
    const float to_middle = length(c.mouse - place(0, offset));
    part = to_middle < std::min(to_top, to_side) ? whole : to_top < to_side ? top : side;
  }
  bool changed = false;
  if (c.held && owner == me) {
    const float x = (c.mouse.x - c.centre.x) / unit, y = (c.centre.y - c.mouse.y) / unit;
    const auto rounded = [](float v) { return std::round(20.0f * v) / 20.0f; };
    // The axis stays inside the ellipse.
    constexpr float kInside = 0.05f;
    if (part == top)
      changed = set(vertical, std::clamp(rounded(y - offset), std::max(0.05f, std::abs(offset) + kInside), 4.0f));
    if (part == side) changed = set(level, std::clamp(rounded(std::abs(x)), 0.05f, 4.0f));
    if (part == whole) changed = set(offset, std::clamp(rounded(y), kInside - vertical, vertical - kInside));
  }
  for (int k = 0; k < kBuds; ++k) {
    // A bud in a direction lies where its ray meets the ellipse; that distance is what favours it.
    const float a = 2.0f * kPi * static_cast<float>(k) / kBuds, dx = std::sin(a), dy = std::cos(a);
    const float A = dx * dx / (level * level) + dy * dy / (vertical * vertical),
                B = -dy * offset / (vertical * vertical);
    const float C = offset * offset / (vertical * vertical) - 1.0f;
    const float t = (-B + std::sqrt(std::max(0.0f, B * B - A * C))) / A;
    const float good = std::clamp(0.5f * t, 0.0f, 1.0f);
    const ImU32 tint = ImGui::ColorConvertFloat4ToU32({0.85f - 0.6f * good, 0.25f + 0.5f * good, 0.22f, 1.0f});
    c.draw->AddLine(c.centre, place(t * dx, t * dy), tint, 2.0f * c.unit);
    c.draw->AddCircleFilled(place(t * dx, t * dy), 3.0f * c.unit, tint);
  }
  c.draw->PathClear();
  for (int k = 0; k < 48; ++k) {
    const float a = 2.0f * kPi * static_cast<float>(k) / 48;
    c.draw->PathLineTo(place(level * std::sin(a), offset + vertical * std::cos(a)));
  }
  c.draw->PathStroke(colour(ImGuiCol_CheckMark), ImDrawFlags_Closed, 1.5f * c.unit);
  c.draw->AddCircleFilled(c.centre, 0.07f * size, kWood);
  c.handle(place(0, offset + vertical));
  c.handle(place(level, offset));
  c.handle(place(0, offset));
  return changed;
}

}  // namespace bosquet::ui
