#include "ui/tools/select_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/site_edits.h"
#include "ui/pick.h"
#include "ui/tools/standing_edits.h"

namespace bosquet::ui {
namespace {

constexpr float kDragBegins_px = 4.0f;
constexpr float kScaleOfNotch = 1.05f;

bool holds(const std::vector<std::int32_t>& ids, std::int32_t id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

ToolAnswer SelectTool::take(const std::vector<std::int32_t>& trees, const ToolScene& scene, bool add) const {
  ToolAnswer answer;
  std::vector<std::int32_t> all;
  if (add) all = scene.selection;
  for (const std::int32_t id : trees) {
    const auto there = std::find(all.begin(), all.end(), id);
    if (there == all.end())
      all.push_back(id);
    else if (trees.size() == 1)
      all.erase(there);  // one that is clicked again is let go
  }
  std::sort(all.begin(), all.end());
  answer.selection = std::move(all);
  return answer;
}

ToolAnswer SelectTool::move_to(const ToolEvent& event) {
  ToolAnswer answer;
  if (!event.ground) return answer;
  auto edit = move_selected(*before_, moved_, to_plan(*event.ground) - from_);
  if (!edit) {
    answer.message = edit.error().message;
    return answer;
  }
  if (!edit->skipped.empty())
    answer.message =
        fmt::format("{} stay: locked, or they would leave the site", scene::trees_in_words(edit->skipped.size()));
  answer.edit = std::move(*edit);
  answer.drag = drag_;
  return answer;
}

ToolAnswer SelectTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  pixel_ = e.at;
  switch (e.kind) {
    case Event::Kind::press:
      if (e.button != Button::left) return {};
      state_ = State::pressed;
      from_pixel_ = e.at;
      pressed_tree_ = event.tree;
      add_ = e.modifiers.shift;
      before_ = scene.document;
      if (event.ground) from_ = to_plan(*event.ground);
      lasso_.assign(1, e.at);
      if (e.modifiers.alt) pressed_tree_.reset();
      return {};
    case Event::Kind::move: {
      if (state_ == State::idle) return {};
      if (state_ == State::pressed) {
        if (glm::length(e.at - from_pixel_) < kDragBegins_px) return {};
        if (pressed_tree_ && event.ground) {
          // What is dragged is selected first, unless it is.
          state_ = State::moving;
          drag_ = new_drag();
          moved_ = holds(scene.selection, *pressed_tree_) ? scene.selection : std::vector<std::int32_t>{*pressed_tree_};
          // From the tree's foot, so that it stands where the pointer is and does not jump when its crown was taken.
          if (const auto hit = scene.rig.ray(from_pixel_, scene.view_size);
              const auto ground = ground_hit(*scene.document->terrain, hit))
            from_ = to_plan(*ground);
          ToolAnswer answer = move_to(event);
          answer.selection = moved_;
          return answer;
        }
        state_ = e.modifiers.alt ? State::lasso : State::box;
      }
      if (state_ == State::moving) return move_to(event);
      if (state_ == State::lasso) lasso_.push_back(e.at);
      return {};
    }
    case Event::Kind::release: {
      if (e.button != Button::left) return {};
      const State ended = state_;
      const std::optional<std::int32_t> tree = pressed_tree_;
      const std::vector<Vec2> lasso = lasso_;
      ToolAnswer answer;
      if (ended == State::moving) answer = move_to(event);
      cancel();
      if (ended == State::pressed)
        return take(tree ? std::vector<std::int32_t>{*tree} : std::vector<std::int32_t>{}, scene, add_);
      if (ended == State::lasso)
        return take(trees_inside(*scene.document, scene.rig, scene.view_size, lasso), scene, add_);
      if (ended == State::box)
        return take(trees_inside(*scene.document, scene.rig, scene.view_size,
                                 {from_pixel_, {e.at.x, from_pixel_.y}, e.at, {from_pixel_.x, e.at.y}}),
                    scene, add_);
      return answer;
    }
    case Event::Kind::scroll: {
      if (!e.modifiers.control || scene.selection.empty()) return {};
      const float by = std::pow(kScaleOfNotch, e.scroll);
      ToolAnswer answer;
      auto edit = scale_selected(*scene.document, scene.selection, by);
      if (!edit)
        answer.message = edit.error().message;
      else
        answer.edit = std::move(*edit);
      return answer;
    }
    case Event::Kind::key_press:
      if ((e.key == kKeyDelete || e.key == kKeyBackspace) && !scene.selection.empty()) {
        ToolAnswer answer;
        answer.edit = remove_selected(*scene.document, scene.selection);
        if (!answer.edit->skipped.empty())
          answer.message = fmt::format("{} stay: they are locked", scene::trees_in_words(answer.edit->skipped.size()));
        answer.selection.emplace();
        return answer;
      }
      return {};
    default:
      return {};
  }
}

Preview SelectTool::preview(const ToolScene&) const {
  Preview preview;
  if (state_ == State::box)
    preview.outline = {from_pixel_, {pixel_.x, from_pixel_.y}, pixel_, {from_pixel_.x, pixel_.y}};
  if (state_ == State::lasso) preview.outline = lasso_;
  return preview;
}

void SelectTool::cancel() {
  state_ = State::idle;
  before_.reset();
  lasso_.clear();
  moved_.clear();
}

ToolAnswer EraseTool::erase(const ToolScene& scene) {
  ToolAnswer answer;
  scene::Edited edit = scene::erase_stroke(*before_, points_, scene.settings->radius_m);
  if (!edit.skipped.empty())
    answer.message = fmt::format("{} stay: they are locked", scene::trees_in_words(edit.skipped.size()));
  if (!edit.trees.empty()) answer.edit = std::move(edit), answer.drag = drag_;
  return answer;
}

ToolAnswer EraseTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  if (event.ground) pointer_ = to_plan(*event.ground);
  if (e.kind == Event::Kind::press && e.button == Button::left && event.ground) {
    before_ = scene.document;
    drag_ = new_drag();
    points_.assign(1, *pointer_);
    return erase(scene);
  }
  if (e.kind == Event::Kind::move && before_ && event.ground) {
    points_.push_back(*pointer_);
    return erase(scene);
  }
  if (e.kind == Event::Kind::release && e.button == Button::left) cancel();
  return {};
}

Preview EraseTool::preview(const ToolScene& scene) const {
  Preview preview;
  if (pointer_) preview.ring = {*pointer_, scene.settings->radius_m};
  return preview;
}

ToolAnswer WaterTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  if (event.ground && !before_) pointer_ = event.ground;
  const auto set = [&](std::optional<float> level) {
    ToolAnswer answer;
    answer.edit = scene::set_water_level(*before_, level);
    answer.drag = drag_;
    if (level) scene.settings->water_level_m = *level;
    return answer;
  };
  if (e.kind == Event::Kind::press && e.button == Button::left && event.ground) {
    before_ = scene.document;
    drag_ = new_drag();
    from_pixel_ = e.at;
    // Water rises from the ground that was pressed, a hand's breadth above it.
    from_level_m_ = event.ground->y + 0.05f;
    metres_per_pixel_ = std::max(0.002f, 0.35f * scene.rig.distance_m() / scene.view_size.y);
    return set(from_level_m_);
  }
  if (e.kind == Event::Kind::move && before_) return set(from_level_m_ + (from_pixel_.y - e.at.y) * metres_per_pixel_);
  if (e.kind == Event::Kind::release && e.button == Button::left) cancel();
  if (e.kind == Event::Kind::key_press && e.key == kKeyDelete && scene.document->terrain->water_level_m) {
    before_ = scene.document;
    drag_ = 0;
    ToolAnswer answer = set({});
    cancel();
    return answer;
  }
  return {};
}

Preview WaterTool::preview(const ToolScene& scene) const {
  Preview preview;
  if (before_ && scene.document->terrain->water_level_m)
    preview.label =
        fmt::format("water at {}", length_words(*scene.document->terrain->water_level_m, scene.settings->units, 2));
  else if (pointer_)
    preview.label = fmt::format("ground {}", length_words(pointer_->y, scene.settings->units, 2));
  return preview;
}

}  // namespace bosquet::ui
