#include "ui/state_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "growth/digest.h"
#include "ui/app.h"

namespace bosquet::ui {

std::string state_text(App& app) {
  Session& s = app.session();
  const scene::Document& document = *s.document();
  const bool settled = app.settled();
  nlohmann::ordered_json json;
  json["trees"] = document.trees->size();
  json["grown"] = app.view().grown_trees();
  json["settled"] = settled;
  const scene::History& history = s.history();
  json["undo"] = history.can_undo() ? history.undo_name() : "";
  json["redo"] = history.can_redo() ? history.redo_name() : "";
  json["steps"] = history.steps();
  json["unsaved"] = s.unsaved();
  json["title"] = app.title();
  json["tool"] = tool_info(s.tool_kind()).name;
  json["radius_m"] = s.settings.radius_m;
  json["selection"] = s.selection();
  json["question"] = app.question();
  json["message"] = app.message();
  json["units"] = s.settings.units == Units::feet ? "feet" : "metres";
  json["dark"] = app.preferences().dark;
  json["overlay_step"] = app.overlay_step();
  if (document.terrain->water_level_m) json["water_level_m"] = *document.terrain->water_level_m;
  json["view"] = {app.view_low().x, app.view_low().y, app.view_size().x, app.view_size().y};
  nlohmann::ordered_json& widgets = json["widgets"] = nlohmann::ordered_json::object();
  for (const auto& [name, box] : app.marks()) widgets[name] = {box.x, box.y, box.z, box.w};
  nlohmann::ordered_json& places = json["places"] = nlohmann::ordered_json::array();
  for (const scene::Tree& tree : *document.trees) {
    if (places.size() >= kMostPlaces) break;
    const auto seen = s.rig.project(to_world(tree.at, document.terrain->ground(tree.at)), app.view_size());
    if (!seen || seen->x < 0 || seen->y < 0 || seen->x >= app.view_size().x || seen->y >= app.view_size().y) continue;
    const Vec2 at = *seen + app.view_low();
    places.push_back({{"id", tree.id},
                      {"species", document.species_of(tree).name},
                      {"east", tree.at.x},
                      {"north", tree.at.y},
                      {"x", at.x},
                      {"y", at.y}});
  }
  if (settled) {
    nlohmann::ordered_json& skeletons = json["skeletons"] = nlohmann::ordered_json::object();
    for (const scene::Tree& tree : *document.trees)
      if (const auto found = app.view().grown().find(tree.id);
          found != app.view().grown().end() && found->second.grown.skeleton)
        skeletons[std::to_string(tree.id)] = hex_digits(growth::digest(*found->second.grown.skeleton));
  }
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<void> StateFile::write(App& app) {
  std::string text = state_text(app);
  if (text == written_) return {};
  const std::filesystem::path beside = file_.string() + ".new";
  std::ofstream out(beside);
  out << text;
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(beside, file_, failed);
  if (!out || failed) return cannot_finish(file_.string() + ": cannot be written");
  written_ = std::move(text);
  return {};
}

}  // namespace bosquet::ui
