#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "scene/settings_edits.h"
#include "scene/site_edits.h"
#include "ui/panels/panels.h"
#include "ui/tools/standing_edits.h"
#include "ui/underlay.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/slider.h"

// What stands as it is: the hero tree that is selected, and the picture beneath the site.
namespace bosquet::ui {
namespace {

// A length that is typed or dragged, and taken over once the hand lets go.
bool length_field(const char* label, double& metres, Units units, const char* meaning) {
  const double unit = units == Units::feet ? static_cast<double>(kFeetPerMetre) : 1.0;
  static ImGuiID held = 0;
  static float held_value = 0;
  const ImGuiID id = ImGui::GetID(label);
  float shown = held == id ? held_value : static_cast<float>(metres * unit);
  ImGui::DragFloat(label, &shown, 0.1f, 0.0f, 0.0f, units == Units::feet ? "%.2f ft" : "%.2f m");
  if (ImGui::IsItemActive()) held = id, held_value = shown;
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  if (!ImGui::IsItemActive() && held == id) held = 0;
  explain(meaning);
  if (done) metres = static_cast<double>(shown) / unit;
  return done;
}

}  // namespace

void Panels::hero_page(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  const scene::HeroTree hero = *s.selected_hero();
  if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
  ImGui::TextWrapped("%s", hero.name.c_str());
  if (app.fonts_.heading) ImGui::PopFont();
  ImGui::TextDisabled("Hero tree, %s", document->species[hero.species]->botanical_name.c_str());
  const HeroExtent extent = extent_of(*hero.skeleton);
  ImGui::Text("%s high, reaching %s out", length_words(extent.height_m, s.settings.units).c_str(),
              length_words(extent.radius_m, s.settings.units).c_str());
  ImGui::Text("at %s east, %s north", length_words(hero.at.x, s.settings.units, 2).c_str(),
              length_words(hero.at.y, s.settings.units, 2).c_str());
  ImGui::TextWrapped("It stays exactly as it is; others grow round it. Drag it to move it.");
  ImGui::Separator();
  // Turned and scaled from what it was when the hand took the slider.
  static std::shared_ptr<const scene::Document> before;
  static float turn = 0, size = 1;
  const auto edit = [&](const char* name, float& value, float low, float high, const char* format) {
    ImGui::SetNextItemWidth(-1);
    const bool changed = slider(name, value, low, high, format);
    mark(app, name);
    if (ImGui::IsItemActivated()) before = document, app.inspector_drag_ = new_drag();
    if (changed && before)
      if (auto turned = scene::turn_hero(*before, hero.id, size, turn))
        s.apply(std::move(*turned), app.inspector_drag_);
    if (ImGui::IsItemDeactivated()) before.reset(), turn = 0, size = 1;
  };
  edit("Turn", turn, -180, 180, "%.0f\xc2\xb0");
  explain("Counter-clockwise seen from above");
  edit("Size", size, 0.5f, 2.0f, "x %.2f");
  explain("Times the size it has");
  if (ImGui::Button("Set again")) {
    s.settings.hero = hero_in_hand(*document, hero);
    s.take(ToolKind::hero);
  }
  explain("Sets this tree once more where you click");
  ImGui::SameLine();
  if (ImGui::Button("Delete"))
    if (auto removed = scene::remove_hero(*document, hero.id)) s.apply(std::move(*removed));
  if (!ImGui::IsAnyItemActive()) app.inspector_drag_ = 0;
}

void Panels::underlay_fields(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  scene::Underlay underlay = document->underlay;
  ImGui::Separator();
  ImGui::Checkbox("Plan picture", &app.view_->show_underlay);
  mark(app, "Plan picture");
  explain(underlay.file);
  ImGui::SameLine();
  const bool remove = ImGui::SmallButton("Remove");
  auto width = static_cast<double>(underlay.width_m);
  ImGui::PushItemWidth(0.6f * ImGui::GetContentRegionAvail().x);
  bool changed = length_field("Width", width, s.settings.units, "Of the picture on the ground; its height follows");
  changed |= length_field("East", underlay.south_west.x, s.settings.units, "Of its south-west corner from the site's");
  changed |= length_field("North", underlay.south_west.y, s.settings.units, "Of its south-west corner from the site's");
  if (const auto& line = s.settings.measured) {
    double length = static_cast<double>(glm::length(line->second - line->first));
    if (length_field("Measured", length, s.settings.units,
                     "Type how long the line measured last really is: the picture is scaled to it")) {
      underlay = scaled_to(underlay, line->first, line->second, length);
      width = static_cast<double>(underlay.width_m);
      s.settings.measured.reset();
      changed = true;
    }
    mark(app, "Measured");
  } else {
    ImGui::TextDisabled("To scale it, measure on it (M)");
    explain("Measure a length that you know, end with Enter, and type here how long it really is");
  }
  ImGui::PopItemWidth();
  static float opacity = -1;
  float shown = opacity >= 0 ? opacity : underlay.opacity;
  ImGui::SetNextItemWidth(-1);
  slider("Opacity", shown, 0, 1, "%.2f");
  explain("How strongly it shows over the meadow");
  if (ImGui::IsItemActive()) opacity = shown;
  if (ImGui::IsItemDeactivatedAfterEdit()) underlay.opacity = shown, changed = true;
  if (!ImGui::IsItemActive()) opacity = -1;
  underlay.width_m = static_cast<float>(std::max(0.1, width));
  if (remove) underlay = {};
  if (changed || remove) s.apply(scene::set_underlay(*document, underlay));
}

}  // namespace bosquet::ui
