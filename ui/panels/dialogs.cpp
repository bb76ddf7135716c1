#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "ui/panels/panels.h"
#include "ui/widgets/fields.h"

// What is asked in the middle of the window, and the first steps.
namespace bosquet::ui {

bool begin_dialog(const char* title, const Layout& layout, float width, bool* open) {
  if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  ImGui::SetNextWindowPos({0.5f * layout.screen.x, 0.45f * layout.screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width * layout.scale, 0}, ImGuiCond_Always);
  return ImGui::BeginPopupModal(title, open,
                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings);
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
    if (!begin_dialog("So many trees?", layout, 380)) return;
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
    if (!begin_dialog("Recover", layout, 480)) return;
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
  if (!begin_dialog("Unsaved work", layout, 420)) return;
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
