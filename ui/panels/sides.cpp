#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "scene/settings_edits.h"
#include "scene/tree_parameters.h"
#include "ui/panels/panels.h"
#include "ui/tools/standing_edits.h"
#include "ui/widgets/dials.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/slider.h"

// The bars at the sides: what is planted, and what is selected.
namespace bosquet::ui {
namespace {

constexpr float kOldest = 100;  ///< years that the slider goes to

std::string readable(std::string name) {
  for (char& c : name)
    if (c == '_') c = ' ';
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

float probability(const scene::Document& document, std::size_t species) {
  if (document.species_bar.empty()) return 1.0f;
  for (const distribution::MixEntry& entry : document.species_bar)
    if (entry.species == species) return entry.probability;
  return 0.0f;
}

scene::SharedList<distribution::MixEntry> with_probability(const scene::Document& document, std::size_t species,
                                                           float to) {
  std::vector<distribution::MixEntry> mix;
  bool found = false;
  for (std::size_t s = 0; s < document.species.size(); ++s) {
    distribution::MixEntry entry;
    entry.species = static_cast<std::uint32_t>(s);
    entry.probability = probability(document, s);
    for (const distribution::MixEntry& old : document.species_bar)
      if (old.species == s) entry.scale_min = old.scale_min, entry.scale_max = old.scale_max;
    if (s == species) entry.probability = to;
    found |= entry.probability > 0.0f;
    mix.push_back(entry);
  }
  // Something must be left to plant.
  if (!found) mix[species].probability = 0.05f;
  return mix;
}

// A small picture of a species' habit: its crown's outline over its trunk, to one scale for all.
void draw_habit(const scene::Species& species, ImVec2 low, ImVec2 size, float tallest_m) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const crowns::RepresentativeShape& shape = species.shape;
  const float unit = 0.95f * size.y / tallest_m;
  const float foot = low.y + size.y, middle = low.x + 0.5f * size.x;
  const float half = 0.5f * unit * shape.crown_height_m(), wide = 0.5f * unit * shape.crown_width_m;
  const float trunk = std::max(1.0f, 0.5f * unit * shape.trunk_width_m);
  const float centre = foot - unit * shape.trunk_height_m - half;
  draw->AddRectFilled({middle - trunk, centre}, {middle + trunk, foot}, IM_COL32(128, 98, 68, 255));
  constexpr int kPoints = 28;
  for (int i = 0; i < kPoints; ++i) {
    const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(i) / kPoints);
    draw->PathLineTo({middle + wide * a.cos, centre + half * a.sin});
  }
  draw->PathFillConvex(IM_COL32(112, 156, 84, 255));
}

// What a parameter does: a small tree with a low value of it beside one with a high value, all else as it is.
void draw_low_and_high(const growth::Parameters& p, std::string_view name, double few, double many, float scale) {
  constexpr float kWidth = 120, kHeight = 110;
  static SchematicTree low, high;
  const auto draw = [&](SchematicTree& tree, double value, const char* words) {
    const scene::SharedList<scene::ParameterOverride> one{{"growth." + std::string(name), value}};
    if (const auto changed = scene::with_overrides(p, one)) tree.set(*changed);
    ImGui::BeginGroup();
    tree.draw(kWidth * scale, kHeight * scale);
    ImGui::TextDisabled("%s", words);
    ImGui::EndGroup();
  };
  draw(low, few, "low");
  ImGui::SameLine();
  draw(high, many, "high");
}

}  // namespace

void Panels::species_bar(App& app, const Layout& layout) {
  Session& s = *app.session_;
  const float top = layout.menu + layout.top;
  if (begin_panel("species", {0, top}, {layout.left, layout.screen.y - top - layout.bottom})) {
    if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
    ImGui::TextUnformatted("Species");
    if (app.fonts_.heading) ImGui::PopFont();
    const std::shared_ptr<const scene::Document> document = s.document();
    float tallest = 1.0f, sum = 0.0f;
    for (std::size_t k = 0; k < document->species.size(); ++k) {
      tallest = std::max(tallest, document->species[k]->shape.mature_height_m);
      sum += probability(*document, k);
    }
    static std::uint64_t drag = 0;
    const float row = 54 * layout.scale;
    for (std::size_t k = 0; k < document->species.size(); ++k) {
      const scene::Species& species = *document->species[k];
      ImGui::PushID(static_cast<int>(k));
      const ImVec2 low = ImGui::GetCursorScreenPos();
      const float width = ImGui::GetContentRegionAvail().x;
      ImGui::InvisibleButton("species", {width, row});
      mark(app, species.name);
      const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
      float share = probability(*document, k);
      if (ImGui::IsItemActivated()) drag = new_drag(), s.settings.species = k;
      if (held && std::abs(ImGui::GetMouseDragDelta(0, 3.0f).x) > 0.0f) {
        const float to = std::clamp((ImGui::GetIO().MousePos.x - low.x) / width, 0.0f, 1.0f);
        if (auto edit = scene::set_species_bar(*document, with_probability(*document, k, to)))
          s.apply(std::move(*edit), drag);
        share = to;
      }
      ImDrawList* draw = ImGui::GetWindowDrawList();
      const ImVec2 high{low.x + width, low.y + row - 4 * layout.scale};
      draw->AddRectFilled(low, high, ImGui::GetColorU32(hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), 5);
      const float bar = 5 * layout.scale;
      draw->AddRectFilled({low.x, high.y - bar}, {low.x + width * std::min(1.0f, share), high.y},
                          ImGui::GetColorU32(ImGuiCol_CheckMark), 2);
      if (s.settings.species == k) draw->AddRect(low, high, ImGui::GetColorU32(ImGuiCol_CheckMark), 5, 0, 1.5f);
      const float picture = 48 * layout.scale;
      if (const unsigned texture = app.thumbnails_->of(document->species[k]))
        draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), {low.x + 3, low.y + 1},
                       {low.x + 3 + picture, low.y + 1 + picture});
      else
        draw_habit(species, {low.x + 4, low.y + 3}, {42 * layout.scale, row - 10 * layout.scale}, tallest);
      draw->AddText({low.x + 56 * layout.scale, low.y + 8 * layout.scale}, ImGui::GetColorU32(ImGuiCol_Text),
                    readable(species.name).c_str());
      draw->AddText({low.x + 56 * layout.scale, low.y + 27 * layout.scale}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                    fmt::format("{:.0f} %   {}", sum > 0 ? 100.0f * share / sum : 0.0f,
                                length_words(species.shape.mature_height_m, s.settings.units, 0))
                        .c_str());
      if (!held)
        explain(fmt::format("{} ({})\nDrag sideways: how much of it the brush plants", readable(species.name),
                            species.botanical_name));
      ImGui::PopID();
    }
    ImGui::Spacing();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##add", "Add a species...")) {
      for (const std::string& name : scene::builtin_species_names()) {
        const bool there = std::any_of(document->species.begin(), document->species.end(),
                                       [&](const auto& have) { return have->name == name; });
        if (!there && ImGui::Selectable(readable(name).c_str())) {
          auto species = scene::builtin_species(name);
          auto edit = species ? scene::add_species(*document, std::move(*species)) : species.error();
          if (edit)
            s.apply(std::move(*edit));
          else
            app.say(edit.error().message);
        }
      }
      ImGui::EndCombo();
    }
    if (!document->heroes.empty()) {
      ImGui::Spacing();
      ImGui::TextDisabled("Hero trees");
      for (const scene::HeroTree& hero : document->heroes) {
        ImGui::PushID(hero.id);
        const bool chosen = s.selected_hero() == &hero;
        const float copy = ImGui::CalcTextSize("Again").x + 2 * ImGui::GetStyle().FramePadding.x;
        const float name = ImGui::GetContentRegionAvail().x - copy - ImGui::GetStyle().ItemSpacing.x;
        if (ImGui::Selectable(hero.name.c_str(), chosen, 0, {name, 0})) s.select({hero.id});
        mark(app, hero.name);
        explain(hero.name);
        ImGui::SameLine();
        if (ImGui::SmallButton("Again")) {
          s.settings.hero = hero_in_hand(*document, hero);
          s.take(ToolKind::hero);
        }
        explain("Sets this tree once more where you click");
        ImGui::PopID();
      }
    }
  }
  end_panel();
}

void Panels::keep_as_hero(App& app) {
  Session& s = *app.session_;
  const scene::Tree* tree = s.selected_tree();
  if (!tree) return;
  const auto grown = app.view_->grown().find(tree->id);
  if (grown == app.view_->grown().end()) {
    app.say("This tree is still growing");
    return;
  }
  auto edit = scene::keep_as_hero(*s.document(), tree->id, grown->second.grown.skeleton,
                                  fmt::format("{} {}", readable(s.document()->species_of(*tree).name), tree->id));
  if (!edit) {
    app.say(edit.error().message);
    return;
  }
  const std::int32_t hero = s.document()->next_standing_id;
  s.apply(std::move(*edit));
  s.select({hero});
}

void Panels::growth_widgets(App& app, const scene::Tree& tree) {
  Session& s = *app.session_;
  const growth::Parameters& kind = s.document()->species_of(tree).growth;
  auto own = scene::with_overrides(kind, tree.overrides);
  growth::Parameters p = own ? *own : kind;
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  bool changed = false;
  ImGui::BeginGroup();
  changed |= tropism_arrow("set point", p.set_point_angle_deg, half);
  mark(app, "Tropism");
  explain("Where branches turn to: up, level or down. Drag the arrow.");
  ImGui::Text("Tropism %.0f\xc2\xb0", p.set_point_angle_deg);
  ImGui::EndGroup();
  ImGui::SameLine();
  ImGui::BeginGroup();
  changed |= branching_angles("angles", p.branching_angle_deg, p.deflection_angle_deg, half);
  mark(app, "Branching");
  explain("The angle at which side shoots leave, and how far they push their parent away. Drag either.");
  ImGui::Text("Branching %.0f\xc2\xb0, %.0f\xc2\xb0", p.branching_angle_deg, p.deflection_angle_deg);
  ImGui::EndGroup();
  ImGui::BeginGroup();
  changed |= weights_triangle("weights", p.straightness, p.tropism, p.space, half);
  mark(app, "Weights");
  explain("What a new shoot follows: its own direction, the tropism, or free space. Drag the point.");
  ImGui::EndGroup();
  ImGui::SameLine();
  ImGui::BeginGroup();
  changed |= bud_ellipse("buds", p.gravimorphism_vertical, p.gravimorphism_level, p.gravimorphism_offset, half);
  mark(app, "Buds");
  explain("Which buds round a level branch are favoured: those above, below or beside it. Drag its handles.");
  ImGui::EndGroup();
  app.schematic_.set(p);
  app.schematic_.draw(ImGui::GetContentRegionAvail().x, 150 * app.scale_);
  explain("How a young tree with these numbers grows in one plane");
  FieldVisitor visitor(
      [](std::string_view name) {
        return name == "apical_dominance" || name == "light_sensitivity" || name == "shedding_threshold" ||
               name == "max_shoot_length" || name == "occupancy_radius";
      },
      [&](std::string_view name, double few, double many) { draw_low_and_high(p, name, few, many, app.scale_); });
  ImGui::PushItemWidth(-1);
  describe(p, visitor);
  ImGui::PopItemWidth();
  changed |= visitor.changed();
  if (changed) {
    if (app.inspector_drag_ == 0) app.inspector_drag_ = new_drag();
    const std::vector<std::int32_t> one{tree.id};
    auto edit = scene::set_overrides(*s.document(), one, scene::overrides_between(kind, p));
    if (edit)
      s.apply(std::move(*edit), app.inspector_drag_);
    else
      app.say(edit.error().message);
  }
  if (!ImGui::IsAnyItemActive()) app.inspector_drag_ = 0;
  if (!tree.overrides.empty() && ImGui::Button("As its species again")) {
    const std::vector<std::int32_t> one{tree.id};
    if (auto edit = scene::set_overrides(*s.document(), one, {})) s.apply(std::move(*edit));
  }
}

void Panels::tree_page(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  const scene::Tree tree = *s.selected_tree();
  const scene::Species& species = document->species_of(tree);
  if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
  ImGui::Text("%s %d", readable(species.name).c_str(), tree.id);
  if (app.fonts_.heading) ImGui::PopFont();
  ImGui::TextDisabled("%s", species.botanical_name.c_str());
  const auto grown = app.view_->grown().find(tree.id);
  if (grown != app.view_->grown().end()) {
    const scene::GrownTree& g = grown->second.grown;
    const bool metric = s.settings.units == Units::metres;
    const std::string trunk = metric ? fmt::format("{:.0f} cm", 100.0f * g.measures.trunk_diameter_m)
                                     : fmt::format("{:.1f}\"", 12.0f * kFeetPerMetre * g.measures.trunk_diameter_m);
    ImGui::Text("%s high, crown %s, trunk %s", length_words(g.measures.height_m, s.settings.units).c_str(),
                length_words(g.measures.crown_diameter_m, s.settings.units).c_str(), trunk.c_str());
    ImGui::Text("%d internodes, about %.0f years", g.measures.internodes, g.age_years);
  } else {
    ImGui::TextDisabled("growing...");
  }
  ImGui::Text("at %s east, %s north", length_words(tree.at.x, s.settings.units, 2).c_str(),
              length_words(tree.at.y, s.settings.units, 2).c_str());
  const std::vector<std::int32_t> one{tree.id};
  ImGui::PushItemWidth(-1);
  float scale = tree.scale_height;
  ImGui::BeginDisabled(tree.locked);
  if (slider("Size", scale, 0.1f, 1.5f, "%.2f") && scale > 0) {
    if (app.inspector_drag_ == 0) app.inspector_drag_ = new_drag();
    const float by = scale / tree.scale_height;
    if (auto edit = scene::scale_trees(*document, one, by, by)) s.apply(std::move(*edit), app.inspector_drag_);
  }
  explain("Share of the size of a mature tree of its species");
  ImGui::EndDisabled();
  ImGui::PopItemWidth();
  bool locked = tree.locked;
  if (ImGui::Checkbox("Locked", &locked)) s.apply(scene::lock_trees(*document, one, locked));
  explain("A locked tree is neither moved, erased nor changed");
  ImGui::SameLine();
  if (ImGui::Button("Keep as hero")) keep_as_hero(app);
  explain("Keeps the tree exactly as it is grown now");
  ImGui::Separator();
  ImGui::BeginDisabled(tree.locked);
  growth_widgets(app, tree);
  ImGui::EndDisabled();
}

void Panels::trees_page(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
  ImGui::Text("%zu trees", s.selection().size());
  if (app.fonts_.heading) ImGui::PopFont();
  if (ImGui::Button("Lock")) s.apply(scene::lock_trees(*document, s.selection(), true));
  ImGui::SameLine();
  if (ImGui::Button("Unlock")) s.apply(scene::lock_trees(*document, s.selection(), false));
  ImGui::SameLine();
  if (ImGui::Button("Delete")) s.apply(remove_selected(*document, s.selection()));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##species", "Replace by species...")) {
    for (std::size_t k = 0; k < document->species.size(); ++k)
      if (ImGui::Selectable(readable(document->species[k]->name).c_str()))
        if (auto edit = scene::replace_species(*document, s.selection(), k)) s.apply(std::move(*edit));
    ImGui::EndCombo();
  }
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##status", "Set status...")) {
    for (std::size_t k = 0; k < scene::kTreeStatusNames.size(); ++k)
      if (ImGui::Selectable(readable(std::string(scene::kTreeStatusNames[k])).c_str()))
        s.apply(scene::set_status(*document, s.selection(), static_cast<scene::TreeStatus>(k)));
    ImGui::EndCombo();
  }
  ImGui::TextWrapped("Drag one of them to move all; Ctrl and the wheel change their size.");
}

void Panels::site_page(App& app) {
  Session& s = *app.session_;
  const std::shared_ptr<const scene::Document> document = s.document();
  const Vec2 size = document->terrain->size_m();
  if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
  ImGui::TextUnformatted("Site");
  if (app.fonts_.heading) ImGui::PopFont();
  const Units units = s.settings.units;
  ImGui::Text("%s x %s, %zu trees", length_words(size.x, units, 0).c_str(), length_words(size.y, units, 0).c_str(),
              document->trees->size());

  ImGui::Separator();
  ImGui::TextUnformatted("Years");
  if (s.growth().year) app.year_ = *s.growth().year;
  bool all_grown = !s.growth().year;
  if (ImGui::Checkbox("All grown", &all_grown)) {
    app.playing_ = false;
    if (!all_grown && app.year_ >= kOldest) app.year_ = 30;
    s.set_year(all_grown ? std::optional<float>() : std::optional<float>(app.year_));
  }
  explain("Every tree at its final height");
  ImGui::SameLine();
  if (ImGui::Button(app.playing_ ? "Stop" : "Play", {60 * app.scale_, 0})) {
    app.playing_ = !app.playing_;
    if (app.playing_ && (app.year_ >= kOldest || all_grown)) app.year_ = 1;
  }
  explain("Lets the scene grow from planting to maturity");
  ImGui::SetNextItemWidth(-1);
  float year = all_grown ? kOldest : app.year_;
  if (slider("##year", year, 1, kOldest, all_grown ? "fully grown" : "%.0f years")) s.set_year(app.year_ = year);

  ImGui::Separator();
  ImGui::TextUnformatted("Sun");
  sun_fields(app);

  ImGui::Separator();
  ImGui::TextUnformatted("View");
  int show = static_cast<int>(app.view_->show);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::Combo("##show", &show, "Trees\0Shapes\0Crown regions\0Asymmetry\0Plan\0")) {
    app.view_->show = static_cast<Show>(show);
    s.rig.show_plan(show >= static_cast<int>(Show::regions));
  }
  if (app.view_->show == Show::regions) {
    float slice = app.view_->slice_m.value_or(6.0f);
    ImGui::SetNextItemWidth(-1);
    if (length_slider("Layer", slice, 0, 30, s.settings.units)) app.view_->slice_m = slice;
  }
  ImGui::SetNextItemWidth(-1);
  slider("Exposure", app.view_->look.exposure_ev, -2, 2, "%+.1f EV");
  explain("Makes the picture brighter or darker");
  scene::GroundCover cover = document->ground_cover;
  ImGui::SetNextItemWidth(-1);
  const bool grown = slider("Grass", cover.density, 0, 3, "%.1f");
  mark(app, "Grass");
  explain("Tufts on lawns and meadows near the eye; 1 is usual, 0 draws none");
  if (auto edit = scene::set_ground_cover(*document, cover); grown && edit) {
    if (app.inspector_drag_ == 0) app.inspector_drag_ = new_drag();
    s.apply(std::move(*edit), app.inspector_drag_);
  }
  if (!document->underlay.file.empty()) underlay_fields(app);
  if (!ImGui::IsAnyItemActive()) app.inspector_drag_ = 0;

  ImGui::Separator();
  const auto list = [](const char* heading, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    ImGui::TextDisabled("%s", heading);
    for (const std::string& line : lines) ImGui::TextWrapped("%s", line.c_str());
  };
  list("Warnings", s.pipeline().status().warnings);
  list("Noted when it was opened", s.notes);
}

void Panels::inspector(App& app, const Layout& layout) {
  const float top = layout.menu + layout.top;
  if (begin_panel("inspector", {layout.screen.x - layout.right, top},
                  {layout.right, layout.screen.y - top - layout.bottom})) {
    if (app.session_->selected_tree())
      tree_page(app);
    else if (app.session_->selected_hero())
      hero_page(app);
    else if (!app.session_->selection().empty())
      trees_page(app);
    else
      site_page(app);
  }
  end_panel();
}

}  // namespace bosquet::ui
