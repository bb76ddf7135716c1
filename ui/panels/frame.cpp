#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/panels/panels.h"
#include "ui/tools/standing_edits.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/slider.h"

// The window's frame: menu, tools, status, and what lies over them for a moment.
namespace bosquet::ui {

bool begin_panel(const char* name, Vec2 low, Vec2 size, bool scrolls) {
  ImGui::SetNextWindowPos({low.x, low.y});
  ImGui::SetNextWindowSize({size.x, size.y});
  return ImGui::Begin(name, nullptr,
                      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                          ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                          (scrolls ? 0 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse));
}

void end_panel() { ImGui::End(); }

void Panels::mark(App& app, std::string_view name) {
  if (!app.marking_ || ImGui::IsWindowAppearing()) return;  // it still looks for its place
  const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  app.marks_[std::string(name)] = Vec4(low.x, low.y, size.x, size.y);
}

void Panels::ask_open(App& app) {
  app.chooser_.ask(FileChooser::Mode::open, "Open", {".bosquet", ".toml"}, "",
                   [&app](const std::filesystem::path& file) { app.open_file(file); });
}

void Panels::ask_import(App& app, ImportKind kind) {
  app.chooser_.ask(FileChooser::Mode::open, "Import", import_endings(kind), "",
                   [&app, kind](const std::filesystem::path& file) {
                     auto edit = import_file(*app.session_->document(), kind, file);
                     if (!edit) {
                       app.say(edit.error().message);
                       return;
                     }
                     app.say(import_words(*edit, file));
                     app.session_->apply(std::move(*edit));
                   });
}

void Panels::ask_hero(App& app) {
  app.chooser_.ask(FileChooser::Mode::open, "Hero tree", {".tree.json"}, "", [&app](const std::filesystem::path& file) {
    auto hero = read_hero(*app.session_->document(), file);
    if (!hero) {
      app.say(hero.error().message);
      return;
    }
    app.say(hero->name + " is in hand: click where it shall stand");
    app.session_->settings.hero = std::move(*hero);
    app.session_->take(ToolKind::hero);
  });
}

void Panels::ask_save_as(App& app, std::function<void()> then) {
  app.chooser_.ask(FileChooser::Mode::save, "Save as", {".bosquet"}, app.session_->name() + ".bosquet",
                   [&app, then](const std::filesystem::path& file) {
                     if (auto saved = app.session_->save_as(file); !saved)
                       app.say(saved.error().message);
                     else {
                       note_recent(app.preferences_, app.session_->path());
                       app.say("Saved " + file.filename().string());
                       if (then) then();
                     }
                   });
}

void Panels::save(App& app, std::function<void()> then) {
  if (!app.session_->has_file() || !app.session_->read_only().empty()) {
    ask_save_as(app, std::move(then));
    return;
  }
  if (auto saved = app.session_->save(); !saved) {
    app.say(saved.error().message);
    return;
  }
  app.say("Saved " + app.session_->path().filename().string());
  if (then) then();
}

void Panels::menu(App& app, Layout& layout) {
  Session& s = *app.session_;
  if (!ImGui::BeginMainMenuBar()) return;
  layout.menu = ImGui::GetWindowHeight();
  const bool file_open = ImGui::BeginMenu("File");
  mark(app, "File");
  if (file_open) {
    if (ImGui::BeginMenu("New")) {
      for (const std::string& name : template_names())
        if (ImGui::MenuItem(name.c_str()))
          app.run_guarded(
              [&app, name] {
                if (auto made = make_template(name))
                  app.session_->start(std::move(*made), "Untitled");
                else
                  app.say(made.error().message);
              },
              App::Ask::start);
      ImGui::EndMenu();
    }
    if (ImGui::MenuItem("Open...", "Ctrl+O")) ask_open(app);
    if (ImGui::BeginMenu("Open recent", !app.preferences_.recent.empty())) {
      for (const std::filesystem::path& file : std::vector(app.preferences_.recent))
        if (ImGui::MenuItem(file.filename().string().c_str())) app.open_file(file);
      ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Save", "Ctrl+S")) save(app);
    if (ImGui::MenuItem("Save as...", "Ctrl+Shift+S")) ask_save_as(app);
    ImGui::Separator();
    const bool import_open = ImGui::BeginMenu("Import");
    mark(app, "Import");
    if (import_open) {
      if (ImGui::MenuItem("Ground (elevation raster)...")) ask_import(app, ImportKind::ground);
      if (ImGui::MenuItem("Trees (inventory)...")) ask_import(app, ImportKind::trees);
      if (ImGui::MenuItem("Buildings (outlines or mesh)...")) ask_import(app, ImportKind::buildings);
      if (ImGui::MenuItem("Hero tree (.tree.json)...")) ask_hero(app);
      mark(app, "Import hero");
      if (ImGui::MenuItem("Plan picture to draw on...")) ask_import(app, ImportKind::underlay);
      mark(app, "Import underlay");
      ImGui::EndMenu();
    }
    if (ImGui::MenuItem("Export...", "Ctrl+E")) app.show_export_ = true;
    mark(app, "Export...");
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) app.run_guarded([&app] { app.ended_ = true; }, App::Ask::close);
    ImGui::EndMenu();
  }
  const bool edit_open = ImGui::BeginMenu("Edit");
  mark(app, "Edit");
  if (edit_open) {
    const scene::History& h = s.history();
    const std::string undo = h.can_undo() ? "Undo " + h.undo_name() : "Undo";
    const std::string redo = h.can_redo() ? "Redo " + h.redo_name() : "Redo";
    if (ImGui::MenuItem(undo.c_str(), "Ctrl+Z", false, h.can_undo())) s.undo();
    if (ImGui::MenuItem(redo.c_str(), "Ctrl+Y", false, h.can_redo())) s.redo();
    ImGui::MenuItem("History", "Ctrl+H", &app.show_history_);
    ImGui::Separator();
    const bool any = !s.selection().empty();
    if (ImGui::MenuItem("Delete", "Delete", false, any)) {
      s.apply(remove_selected(*s.document(), s.selection()));
    }
    if (ImGui::MenuItem("Lock", "Ctrl+L", false, any)) s.apply(scene::lock_trees(*s.document(), s.selection(), true));
    if (ImGui::MenuItem("Unlock", nullptr, false, any)) s.apply(scene::lock_trees(*s.document(), s.selection(), false));
    if (ImGui::MenuItem("Keep as hero", nullptr, false, s.selected_tree() != nullptr)) keep_as_hero(app);
    ImGui::EndMenu();
  }
  const bool view_open = ImGui::BeginMenu("View");
  mark(app, "View");
  if (view_open) {
    for (std::size_t k = 0; k < kShowNames.size(); ++k)
      if (ImGui::MenuItem(kShowNames[k].data(), nullptr, app.view_->show == static_cast<Show>(k))) {
        app.view_->show = static_cast<Show>(k);
        const bool flat = k >= static_cast<std::size_t>(Show::regions);
        s.rig.show_plan(flat);
      }
    ImGui::Separator();
    const std::pair<const char*, std::pair<const char*, StandardView>> looks[] = {
        {"From the south", {"Num 1", StandardView::south}}, {"From the north", {"Num 9", StandardView::north}},
        {"From the east", {"Num 3", StandardView::east}},   {"From the west", {"Num 6", StandardView::west}},
        {"From above", {"Num 7", StandardView::top}},       {"Oblique", {"Num 5", StandardView::oblique}}};
    for (const auto& [name, look] : looks)
      if (ImGui::MenuItem(name, look.first)) s.rig.look(look.second);
    if (ImGui::MenuItem("Walk", "C", s.rig.walking())) s.rig.walk(!s.rig.walking(), *s.document()->terrain);
    if (!s.document()->cameras.empty() && ImGui::BeginMenu("Cameras")) {
      for (const scene::Camera& camera : s.document()->cameras)
        if (ImGui::MenuItem(camera.name.c_str())) s.rig.look(camera);
      ImGui::EndMenu();
    }
    ImGui::Separator();
    if (!s.document()->underlay.file.empty()) {
      ImGui::MenuItem("Plan picture beneath", nullptr, &app.view_->show_underlay);
      mark(app, "Plan picture beneath");
      ImGui::Separator();
    }
    const bool feet = s.settings.units == Units::feet;
    if (ImGui::MenuItem("Feet and inches", nullptr, feet)) s.settings.units = feet ? Units::metres : Units::feet;
    mark(app, "Feet and inches");
    if (bool& dark = app.preferences_.dark; ImGui::MenuItem("Dark", nullptr, &dark)) apply_theme(dark, app.scale_);
    mark(app, "Dark");
    ImGui::EndMenu();
  }
  const bool help_open = ImGui::BeginMenu("Help");
  mark(app, "Help");
  if (help_open) {
    ImGui::MenuItem("Shortcuts", "F1", &app.show_shortcuts_);
    if (ImGui::MenuItem("First steps")) app.overlay_step_ = 0;
    ImGui::EndMenu();
  }
  const std::string title = app.title();
  const float width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::SameLine(layout.screen.x - width - 16 * layout.scale);
  ImGui::TextDisabled("%s", title.c_str());
  ImGui::EndMainMenuBar();
}

namespace {

const char* symbol(ToolKind kind) {
  switch (kind) {
    case ToolKind::select:
      return "\xef\x89\x85";  // mouse-pointer
    case ToolKind::plant_brush:
      return "\xef\x87\xbc";  // paint-brush
    case ToolKind::single:
      return "\xef\x86\xbb";  // tree
    case ToolKind::row:
      return "\xef\x83\xb6";  // align: ellipsis-like
    case ToolKind::grid:
      return "\xef\x80\x8a";  // th
    case ToolKind::hedge:
      return "\xef\x83\x89";  // bars
    case ToolKind::fill:
      return "\xef\x95\x86";  // draw polygon, missing in old fonts
    case ToolKind::hero:
      return "\xef\x80\x85";  // star
    case ToolKind::erase:
      return "\xef\x84\xad";  // eraser
    case ToolKind::raise:
      return "\xef\x81\xa2";  // arrow-up
    case ToolKind::lower:
      return "\xef\x81\xa3";  // arrow-down
    case ToolKind::measure:
      return "\xef\x81\xae";  // expand
    default:
      return nullptr;
  }
}

const char* short_name(ToolKind kind) {
  static constexpr const char* kNames[] = {"Select",    "Paint",     "Tree",    "Row",   "Grid",   "Hedge",   "Fill",
                                           "Hero",      "Erase",     "Raise",   "Lower", "Smooth", "Flatten", "Rough",
                                           "Keep free", "Let plant", "Density", "Water", "Measure"};
  return kNames[static_cast<std::size_t>(kind)];
}

constexpr float kLeastSlider = 118.0f;

void width_for(const char* label, const char* longest_value) {
  ImGui::SetNextItemWidth(std::max(kLeastSlider * ImGui::GetFontSize() / 15.0f, slider_width(label, longest_value)));
}

void length(const char* label, float& metres, float low, float high, Units units, const char* meaning,
            ImGuiSliderFlags flags = 0) {
  width_for(label, "100.0 ft");
  length_slider(label, metres, low, high, units, flags);
  explain(meaning);
  ImGui::SameLine();
}

void number(const char* label, float& value, float low, float high, const char* format, const char* meaning,
            ImGuiSliderFlags flags = 0) {
  width_for(label, "0.00");
  slider(label, value, low, high, format, flags);
  explain(meaning);
  ImGui::SameLine();
}

void row_fields(distribution::RowRules& row, Units units) {
  length("Spacing", row.spacing_m, 0.3f, 30.0f, units, "Distance from tree to tree along the row");
  int sides = static_cast<int>(row.sides);
  ImGui::SetNextItemWidth(118 * ImGui::GetFontSize() / 15);
  if (ImGui::Combo("Sides", &sides, "On the line\0Left\0Right\0Both\0"))
    row.sides = static_cast<distribution::RowSides>(sides);
  ImGui::SameLine();
  if (row.sides != distribution::RowSides::on_line)
    length("Offset", row.offset_m, 0.0f, 30.0f, units, "Distance of the rows from the line");
  length("Jitter", row.jitter_m, 0.0f, 5.0f, units, "Largest distance of a tree from its place");
}

// Trees an area, by hectares or acres.
void density_slider(ToolSettings& t) {
  constexpr float kAcresPerHectare = 2.47105f;
  const bool metric = t.units == Units::metres;
  float each = metric ? t.per_hectare : t.per_hectare / kAcresPerHectare;
  if (slider("Density", each, metric ? 10.0f : 4.0f, metric ? 10'000.0f : 4'000.0f,
             metric ? "%.0f / ha" : "%.0f / acre", ImGuiSliderFlags_Logarithmic))
    t.per_hectare = metric ? each : each * kAcresPerHectare;
}

}  // namespace

void Panels::toolbar(App& app, const Layout& layout) {
  Session& s = *app.session_;
  ToolSettings& t = s.settings;
  if (begin_panel("tools", {0, layout.menu}, {layout.screen.x, layout.top}, false)) {
    const float button = 30 * layout.scale;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {3 * layout.scale, 0});
    for (int k = 0; k < kToolCount; ++k) {
      const auto kind = static_cast<ToolKind>(k);
      const ToolInfo& info = tool_info(kind);
      if (kind == ToolKind::plant_brush || kind == ToolKind::raise || kind == ToolKind::exclude ||
          kind == ToolKind::measure) {
        ImGui::Dummy({5 * layout.scale, button});
        ImGui::SameLine();
      }
      const bool held = s.tool_kind() == kind;
      if (held) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
      const char* sign = app.fonts_.icons ? symbol(kind) : nullptr;
      const bool drawn = sign && kind != ToolKind::fill && kind != ToolKind::row && kind != ToolKind::measure;
      const std::string label = std::string(drawn ? sign : short_name(kind)) + "##" + std::string(info.name);
      if (ImGui::Button(label.c_str(), {drawn ? button : 0, button})) s.take(kind);
      mark(app, info.name);
      if (held) ImGui::PopStyleColor();
      explain(fmt::format("{} ({})\n{}", info.name, static_cast<char>(info.key), info.hint));
      ImGui::SameLine();
    }
    ImGui::PopStyleVar();
    if (layout.two_rows) {
      ImGui::NewLine();
    } else {
      ImGui::Dummy({8 * layout.scale, button});
      ImGui::SameLine();
    }
    // What the tool in hand can be told, and nothing of the others; as high as the tools.
    const float within = std::max(0.0f, 0.5f * (button - ImGui::GetFontSize()));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, within});
    const ToolInfo& info = tool_info(s.tool_kind());
    if (info.has_radius)
      length("Radius", t.radius_m, kLeastRadius_m, 100.0f, t.units, "Radius of the brush; [ and ] change it",
             ImGuiSliderFlags_Logarithmic);
    switch (s.tool_kind()) {
      case ToolKind::plant_brush:
        number("Strength", t.plant.strength, 0.02f, 1.0f, "%.2f", "Trees that the brush plants in a second");
        break;
      case ToolKind::single:
        number("Size", t.scale, 0.1f, 1.2f, "%.2f", "Share of the mature size");
        break;
      case ToolKind::row:
        row_fields(t.row, t.units);
        break;
      case ToolKind::hedge:
        row_fields(t.hedge, t.units);
        break;
      case ToolKind::grid:
        length("Spacing", t.grid.spacing_m, 0.5f, 30.0f, t.units, "Distance from tree to tree along a row");
        length("Rows", t.grid.row_gap_m, 0.5f, 30.0f, t.units, "Distance from row to row");
        number("Turn", t.grid.rotation_deg, -90.0f, 90.0f, "%.0f\xc2\xb0", "Turn of the grid");
        break;
      case ToolKind::fill:
        width_for("Density", "10000 / acre");
        density_slider(t);
        explain(t.units == Units::metres ? "Trees on each hectare" : "Trees on each acre");
        ImGui::SameLine();
        break;
      case ToolKind::raise:
      case ToolKind::lower:
      case ToolKind::noise:
        length("Height", t.ground.amount_m, 0.1f, 10.0f, t.units,
               "Height that a stroke adds or takes at full strength");
        [[fallthrough]];
      case ToolKind::smooth:
      case ToolKind::flatten:
        number("Strength", t.ground.strength, 0.02f, 1.0f, "%.2f", "Share of the full effect");
        break;
      case ToolKind::hero:
        number("Turn", t.hero_turn_deg, -180.0f, 180.0f, "%.0f\xc2\xb0", "Turn of the hero tree, counter-clockwise");
        break;
      case ToolKind::density:
        number("Density", t.ground.density, 0.0f, 1.0f, "%.2f", "Share of the usual trees that will be planted there");
        number("Strength", t.ground.strength, 0.02f, 1.0f, "%.2f", "Share of the full effect");
        break;
      case ToolKind::exclude: {
        int kind = static_cast<int>(t.area.kind);
        ImGui::SetNextItemWidth(110 * layout.scale);
        if (ImGui::Combo("Area", &kind, "Other\0Path\0Lawn\0Bed\0Building\0Water\0")) {
          t.area.kind = static_cast<terrain::AreaKind>(kind);
          t.area.name = std::string(terrain::kAreaKindNames[static_cast<std::size_t>(kind)]);
          t.area.cover = terrain::usual_cover(t.area.kind);
        }
        ImGui::SameLine();
        break;
      }
      default:
        break;
    }
    ImGui::PopStyleVar();
  }
  end_panel();
}

void Panels::status(App& app, const Layout& layout) {
  Session& s = *app.session_;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * layout.scale, 4 * layout.scale});
  if (begin_panel("status", {0, layout.screen.y - layout.bottom}, {layout.screen.x, layout.bottom}, false)) {
    const scene::PipelineStatus status = s.pipeline().status();
    ImGui::Text("%zu trees", s.document()->trees->size());
    ImGui::SameLine(0, 18 * layout.scale);
    if (status.busy && status.total > 0) {
      const float share = static_cast<float>(status.done) / static_cast<float>(status.total);
      const std::string text = fmt::format("growing {} of {}", status.done, status.total);
      ImGui::ProgressBar(share, {170 * layout.scale, layout.bottom - 9 * layout.scale}, text.c_str());
    } else if (status.busy) {
      ImGui::TextDisabled("%s", status.stage);
    } else if (status.error) {
      ImGui::TextColored({0.9f, 0.45f, 0.3f, 1}, "%s", status.error->message.c_str());
    } else {
      ImGui::TextDisabled("grown");
    }
    ImGui::SameLine(0, 18 * layout.scale);
    ImGui::TextDisabled("%s triangles",
                        fmt::format("{:.2f} M", static_cast<double>(app.view_->triangles()) / 1e6).c_str());
    ImGui::SameLine(0, 18 * layout.scale);
    ImGui::TextDisabled("%.0f MB", app.memory_mb_);
    if (app.export_.running()) {
      ImGui::SameLine(0, 18 * layout.scale);
      ImGui::ProgressBar(app.export_.share(), {150 * layout.scale, layout.bottom - 9 * layout.scale},
                         (std::string("export: ") + app.export_.stage()).c_str());
      ImGui::SameLine();
      if (ImGui::SmallButton("Cancel")) app.export_.cancel();
    }
    const std::string hint(tool_info(s.tool_kind()).hint);
    const float width = ImGui::CalcTextSize(hint.c_str()).x;
    ImGui::SameLine(std::max(500 * layout.scale, layout.screen.x - width - 14 * layout.scale));
    ImGui::TextDisabled("%s", hint.c_str());
  }
  end_panel();
  ImGui::PopStyleVar();
}

void Panels::history(App& app, const Layout& layout) {
  Session& s = *app.session_;
  ImGui::SetNextWindowSize({250 * layout.scale, 340 * layout.scale}, ImGuiCond_Appearing);
  ImGui::SetNextWindowPos({layout.screen.x - layout.right - 270 * layout.scale, layout.menu + layout.top + 10},
                          ImGuiCond_Appearing);
  if (ImGui::Begin("History", &app.show_history_, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
    const scene::History& h = s.history();
    std::optional<std::size_t> to;
    for (std::size_t step = 0; step < h.steps(); ++step) {
      const bool undone = step > h.place();
      if (undone) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
      if (ImGui::Selectable((h.name(step) + "##" + std::to_string(step)).c_str(), step == h.place())) to = step;
      mark(app, fmt::format("history {}", step));
      if (undone) ImGui::PopStyleColor();
    }
    if (to) s.go_to(*to);
  }
  ImGui::End();
}

void Panels::toast(App& app, const Layout& layout) {
  if (app.toast_.empty() || app.time_s_ > app.toast_until_s_) return;
  ImGui::SetNextWindowPos({layout.left + 0.5f * app.view_size_.x, layout.screen.y - layout.bottom - 18 * layout.scale},
                          ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowBgAlpha(0.92f);
  ImGui::Begin("toast", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  ImGui::PushTextWrapPos(0.7f * app.view_size_.x);
  ImGui::TextUnformatted(app.toast_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void Panels::shortcuts(App& app, const Layout& layout) {
  const float high = std::min(760 * layout.scale, 0.92f * layout.screen.y);
  ImGui::SetNextWindowSize({530 * layout.scale, high}, ImGuiCond_Appearing);
  ImGui::SetNextWindowPos({0.5f * layout.screen.x, 0.5f * layout.screen.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
  if (ImGui::Begin("Shortcuts", &app.show_shortcuts_, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
    const auto row = [](const std::string& keys, std::string_view what) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keys.c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what.data(), what.data() + what.size());
    };
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
      ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 0.42f);
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.58f);
      for (int k = 0; k < kToolCount; ++k) {
        const ToolInfo& info = tool_info(static_cast<ToolKind>(k));
        row(std::string(1, static_cast<char>(info.key)), info.name);
      }
      row("[ ]", "Smaller or larger brush");
      row("Shift", "Smooths, erases, or adds to the selection");
      row("Drag", "Select: a box; on a tree: moves it");
      row("Alt + drag", "Select: a lasso");
      row("Ctrl + wheel", "Size of the selected trees");
      row("Right drag", "Turn the view");
      row("Middle drag, Shift + right drag", "Move the view");
      row("Wheel", "Nearer or farther");
      row("Arrows", "Walk");
      row("C", "Walk at eye height");
      row("F, Home", "Frame the selection, the site");
      row("Num 1 3 5 6 7 9", "Views from the sides and above");
      row("Ctrl+Z, Ctrl+Y", "Undo, redo");
      row("Ctrl+H", "History");
      row("Ctrl+S, Ctrl+O, Ctrl+E", "Save, open, export");
      row("Ctrl+A, Ctrl+L", "Select all, lock");
      row("Escape", "Ends what is going on");
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace bosquet::ui
