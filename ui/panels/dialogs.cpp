#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <utility>

#include "core/hash.h"
#include "core/letters.h"
#include "ui/panels/panels.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/slider.h"

// What is asked in the middle of the window, the export dialog, and the first steps.
namespace bosquet::ui {
namespace {

void centre_next(const Layout& layout, float width) {
  ImGui::SetNextWindowPos({0.5f * layout.screen.x, 0.45f * layout.screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width * layout.scale, 0}, ImGuiCond_Always);
}

constexpr ImGuiWindowFlags kDialog = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings;

// The grown scene of the session as it stands, for files.
scene::GrownScene grown_scene(App& app) {
  scene::GrownScene grown;
  grown.given = *app.session().document();
  grown.document = scene::without_removed(grown.given);
  // What could not be grown is in no file.
  std::vector<scene::Tree> there;
  for (const scene::Tree& tree : *grown.document.trees) {
    const auto found = app.view().grown().find(tree.id);
    if (found == app.view().grown().end() || !found->second.grown.skeleton) continue;
    there.push_back(tree);
    grown.trees.push_back(found->second.grown);
  }
  if (there.size() < grown.document.trees->size())
    grown.document.trees = std::make_shared<const scene::Trees>(std::move(there));
  return grown;
}

}  // namespace

void App::export_to(const std::filesystem::path& file) {
  export_.start(grown_scene(*this), session_->name(), export_settings_, file);
}

void Panels::export_dialog(App& app, const Layout& layout) {
  Session& s = *app.session_;
  const char* title = "Export";
  if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  centre_next(layout, 430);
  if (!ImGui::BeginPopupModal(title, &app.show_export_, kDialog)) return;
  ExportSettings& e = app.export_settings_;
  const ExportKindInfo& kind = export_kind(e.kind);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##kind", kind.name.data())) {
    for (int k = 0; k < kExportKinds; ++k)
      if (const auto one = static_cast<ExportKind>(k); ImGui::Selectable(export_kind(one).name.data(), one == e.kind))
        e.kind = one;
    ImGui::EndCombo();
  }
  mark(app, "Export kind");
  const bool scene = e.kind == ExportKind::scene;
  if (scene) {
    int preset = static_cast<int>(e.preset);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::Combo("##preset", &preset, "For everything\0For Blender\0For Unreal / Unity\0For the web\0"))
      e.preset = static_cast<ExportPreset>(preset);
    static constexpr std::array<const char*, 4> kPresets{
        "Opens everywhere: plain meshes and textures.", "Plain meshes, as Blender reads them.",
        "Plain, each tree with its levels of detail as nodes.",
        "Small: leaves instanced, everything packed. Needs a viewer that knows meshopt, such as three.js."};
    ImGui::TextWrapped("%s", kPresets[static_cast<std::size_t>(preset)]);
    ImGui::SetNextItemWidth(-1);
    slider("Triangles at most", e.max_triangles, 50'000, 20'000'000, "%d", ImGuiSliderFlags_Logarithmic);
  } else {
    ImGui::TextWrapped("%s", kind.meaning.data());
  }
  const bool ready = s.pipeline().idle();
  const std::uint64_t asked = Hasher()
                                  .add(s.revision())
                                  .add(s.growth().year.value_or(0.0f))
                                  .add(static_cast<std::uint64_t>(e.kind))
                                  .add(static_cast<std::uint64_t>(e.preset))
                                  .add(static_cast<std::uint64_t>(e.max_triangles))
                                  .digest();
  if (!ready) {
    ImGui::TextDisabled("The trees are still growing...");
  } else if (scene) {
    // Asked once for each answer: it looks at every tree.
    static std::uint64_t told = 0;
    static ExportSize size;
    if (std::exchange(told, asked) != asked) size = estimate(grown_scene(app), e);
    ImGui::Text("About %s triangles and %s",
                fmt::format("{:.2f} million", static_cast<double>(size.triangles) / 1e6).c_str(),
                bytes_words(size.bytes).c_str());
  } else {
    app.export_probe_.ask(
        asked, e.kind, [&app] { return grown_scene(app); }, s.name());
    const std::string& words = app.export_probe_.words();
    if (words.empty())
      ImGui::TextDisabled("About ...");
    else
      ImGui::TextWrapped("%s", words.c_str());
  }
  ImGui::BeginDisabled(!ready || app.export_.running());
  const bool chosen = ImGui::Button("Choose file...", {140 * layout.scale, 0});
  mark(app, "Choose file...");
  if (chosen) {
    app.show_export_ = false;
    ImGui::CloseCurrentPopup();
    const std::string ending(kind.ending);
    app.chooser_.ask(FileChooser::Mode::save, "Export",
                     scene ? std::vector<std::string>{".glb", ".gltf"} : std::vector<std::string>{ending},
                     s.name() + ending, [&app, scene, ending](std::filesystem::path file) {
                       if (!scene && !folded_letters(file.filename().string()).ends_with(ending)) file += ending;
                       app.export_to(file);
                     });
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool cancel = ImGui::Button("Cancel", {90 * layout.scale, 0});
  // Escape in the list of kinds closes that list alone.
  if (cancel || (ImGui::IsKeyPressed(kKeyEscape, false) && ImGui::IsWindowFocused()))
    app.show_export_ = false, ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void Panels::questions(App& app, const Layout& layout) {
  Session& s = *app.session_;
  using Ask = App::Ask;
  if (app.ask_ == Ask::nothing || app.chooser_.open()) return;
  const auto done = [&] {
    app.ask_ = Ask::nothing;
    app.then_ = {};
    ImGui::CloseCurrentPopup();
  };

  if (app.ask_ == Ask::many_trees) {
    if (!ImGui::IsPopupOpen("So many trees?")) ImGui::OpenPopup("So many trees?");
    centre_next(layout, 380);
    if (!ImGui::BeginPopupModal("So many trees?", nullptr, kDialog)) return;
    ImGui::TextWrapped("This would plant about %zu trees. Growing them takes long and much memory.", s.asked_trees());
    const bool plant = ImGui::Button("Plant them", {130 * layout.scale, 0});
    mark(app, "Plant them");
    ImGui::SameLine();
    const bool decline = ImGui::Button("Do not", {130 * layout.scale, 0});
    mark(app, "Do not");
    if (plant || decline) {
      done();
      plant ? s.confirm_trees(app.view_size_) : s.decline_trees();
    }
    ImGui::EndPopup();
    return;
  }

  if (app.ask_ == Ask::recover) {
    if (!ImGui::IsPopupOpen("Recover")) ImGui::OpenPopup("Recover");
    centre_next(layout, 480);
    if (!ImGui::BeginPopupModal("Recover", nullptr, kDialog)) return;
    ImGui::TextWrapped("Bosquet ended before this was saved:");
    std::optional<std::size_t> chosen;
    const float button = 100 * layout.scale;
    if (ImGui::BeginTable("recoveries", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) {
      ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
      ImGui::TableSetupColumn("act", ImGuiTableColumnFlags_WidthFixed, button);
      for (std::size_t i = 0; i < app.recoveries_.size(); ++i) {
        const scene::Recovery& r = app.recoveries_[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name = r.project.empty() ? "A new document" : r.project.filename().string();
        ImGui::TextWrapped("%s", name.c_str());
        ImGui::TextDisabled(
            "%s", fmt::format("{}, {} edit{}", scene::time_words(r.time), r.edits, r.edits == 1 ? "" : "s").c_str());
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button("Recover", {button, 0})) chosen = i;
        mark(app, fmt::format("Recover {}", i));
        ImGui::PopID();
      }
      ImGui::EndTable();
    }
    ImGui::Spacing();
    if (chosen) {
      if (auto recovered = s.recover(app.recoveries_[*chosen]); !recovered)
        app.say(recovered.error().message);
      else
        app.say("Recovered. Save it under a name to keep it.");
      done();
    }
    if (ImGui::Button("Not now")) done();
    explain("The file is kept and offered again, also by: bosquet recover list");
    ImGui::EndPopup();
    return;
  }

  // Something that would lose unsaved work.
  if (!ImGui::IsPopupOpen("Unsaved work")) ImGui::OpenPopup("Unsaved work");
  centre_next(layout, 420);
  if (!ImGui::BeginPopupModal("Unsaved work", nullptr, kDialog)) return;
  ImGui::TextWrapped("%s was changed and is not saved.", s.name().c_str());
  const auto then = app.then_;
  const bool keep = ImGui::Button("Save", {120 * layout.scale, 0});
  mark(app, "Save");
  ImGui::SameLine();
  const bool lose = ImGui::Button("Do not save", {120 * layout.scale, 0});
  mark(app, "Do not save");
  ImGui::SameLine();
  const bool stay = ImGui::Button("Cancel", {120 * layout.scale, 0}) || ImGui::IsKeyPressed(kKeyEscape, false);
  mark(app, "Cancel");
  if (keep || lose || stay) done();
  if (keep) save(app, then);
  if (lose && then) then();
  ImGui::EndPopup();
}

void Panels::first_run(App& app, const Layout& layout) {
  if (app.overlay_step_ < 0 || app.ask_ != App::Ask::nothing) return;
  struct Step {
    const char* title;
    const char* text;
    Vec2 at;  ///< of the card's upper left, in the window
  };
  const float left = layout.left + 24 * layout.scale, top = layout.menu + layout.top + 24 * layout.scale;
  const float right = layout.screen.x - layout.right - 344 * layout.scale;
  const std::array<Step, 5> steps{{
      {"Look around",
       "Drag with the right button to turn, with the middle one to move, and use the wheel to come nearer. "
       "Press C to walk at eye height.",
       {left, top}},
      {"Shape the ground",
       "Raise and lower it with the arrow tools above; [ and ] change the brush. The water tool sets "
       "the level of water.",
       {left + 200 * layout.scale, top}},
      {"Paint a forest",
       "Choose on the left what is planted, drag sideways for more or less of a species, take the brush "
       "above and paint. Shapes stand at once, trees grow behind them.",
       {left, top + 120 * layout.scale}},
      {"Change one tree",
       "Click a tree to see it on the right. Its dials change how it grows; only that tree grows again. "
       "Drag it to move it.",
       {right, top}},
      {"Keep it",
       "Every edit can be undone with Ctrl+Z, and nothing is lost if the program ends. Save with Ctrl+S, export "
       "with Ctrl+E.",
       {right, top + 160 * layout.scale}},
  }};
  const Step& step = steps[static_cast<std::size_t>(app.overlay_step_)];
  ImGui::SetNextWindowPos({step.at.x, step.at.y});
  ImGui::SetNextWindowSize({320 * layout.scale, 0});
  ImGui::SetNextWindowBgAlpha(0.96f);
  ImGui::Begin("first steps", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  if (app.fonts_.heading) ImGui::PushFont(app.fonts_.heading);
  ImGui::Text("%d of 5   %s", app.overlay_step_ + 1, step.title);
  if (app.fonts_.heading) ImGui::PopFont();
  ImGui::TextWrapped("%s", step.text);
  const bool next = ImGui::Button(app.overlay_step_ == 4 ? "Begin" : "Next", {110 * layout.scale, 0});
  mark(app, "Next");
  if (next) app.overlay_step_ = app.overlay_step_ == 4 ? -1 : app.overlay_step_ + 1;
  ImGui::SameLine();
  if (app.overlay_step_ >= 0 && app.overlay_step_ < 4 && ImGui::Button("Skip", {110 * layout.scale, 0}))
    app.overlay_step_ = -1;
  ImGui::End();
}

}  // namespace bosquet::ui
