#include "ui/widgets/schematic_tree.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "growth/grow.h"

namespace bosquet::ui {
namespace {

// Enough internodes to show a habit, few enough to keep up with a hand.
constexpr float kHeight_internodes = 34.0f;
constexpr int kMostSeasons = 60;

}  // namespace

void SchematicTree::set(const growth::Parameters& parameters) {
  growth::Parameters flat = parameters;
  flat.planar = true;
  flat.max_seasons = std::min(flat.max_seasons, kMostSeasons);
  if (!growth::check(flat)) return;
  growth::GrowthInput input;
  input.parameters = &flat;
  input.max_height_m = kHeight_internodes * flat.internode_length_m;
  input.seed = 1, input.key = 1;
  const std::uint64_t wanted = growth::hash(input);
  if (wanted == grown_for_) return;
  grown_for_ = wanted;
  skeleton_ = growth::grow(input);
}

void SchematicTree::draw(float width, float height) const {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  if (skeleton_.size() == 0) return;
  // A planar tree stands in one vertical plane through its base: the farthest point from the axis tells which.
  Vec2 plane(1.0f, 0.0f);
  float farthest = 0.0f, top = 0.0f;
  for (std::size_t i = 0; i < skeleton_.size(); ++i) {
    if (!skeleton_.alive(i)) continue;
    const Vec3& p = skeleton_.distal[i];
    const float out = std::sqrt(p.x * p.x + p.z * p.z);
    top = std::max(top, p.y);
    if (out > farthest) farthest = out, plane = Vec2(p.x, p.z) / out;
  }
  const float scale = std::min(0.94f * height / std::max(top, 1e-3f), 0.47f * width / std::max(farthest, 1e-3f));
  const auto place = [&](const Vec3& p) {
    return ImVec2(low.x + 0.5f * width + scale * (p.x * plane.x + p.z * plane.y), low.y + 0.98f * height - scale * p.y);
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 wood = ImGui::GetColorU32(ImGuiCol_TextDisabled), leaf = ImGui::GetColorU32(ImGuiCol_CheckMark);
  for (std::size_t i = 0; i < skeleton_.size(); ++i) {
    if (!skeleton_.alive(i)) continue;
    const float thick = std::clamp(2.0f * scale * skeleton_.radius[i], 1.0f, 9.0f);
    draw->AddLine(place(skeleton_.proximal(i)), place(skeleton_.distal[i]), thick > 1.2f ? wood : leaf, thick);
  }
}

}  // namespace bosquet::ui
