#include "ui/tools/plant_brush_tool.h"

#include <cmath>

#include "ui/tools/barred_ground.h"

namespace bosquet::ui {
namespace {

// The planting follows the hand at most so often: the stroke is planted anew each time.
constexpr int kTicksBetween = 3;

// Enough places of a stroke to see what it lies on.
constexpr std::size_t kPlacesSeen = 64;

}  // namespace

std::vector<Vec2> PlantBrushTool::places() const {
  std::vector<Vec2> places;
  const std::size_t step = 1 + events_.size() / kPlacesSeen;
  for (std::size_t i = 0; i < events_.size(); i += step)
    for (const Vec2 off : {Vec2{0.0f}, Vec2{0.6f, 0.0f}, Vec2{-0.6f, 0.0f}, Vec2{0.0f, 0.6f}, Vec2{0.0f, -0.6f}})
      places.push_back(events_[i].at + brush_.radius_m * off);
  return places;
}

void PlantBrushTool::add_event(Vec2 at, double time_s) {
  const int tick = std::max(events_.empty() ? 0 : events_.back().tick,
                            static_cast<int>(std::lround((time_s - began_s_) * distribution::kTicksPerSecond)));
  events_.push_back({at, tick});
}

ToolAnswer PlantBrushTool::plant(const ToolScene& scene, bool agreed) {
  ToolAnswer answer;
  const double seconds = static_cast<double>(events_.back().tick) / distribution::kTicksPerSecond;
  const double trees =
      1.0 + static_cast<double>(brush_.rate * brush_.strength * brush_.radius_m * brush_.radius_m) * seconds;
  if (!agreed && trees > static_cast<double>(kManyTrees)) {
    answer.asks_for_trees = static_cast<std::size_t>(trees);
    waits_ = true;
    return answer;
  }
  auto edit = scene::plant_stroke(*before_, *scene.planting, brush_, events_);
  if (!edit) {
    answer.message = edit.error().message;
    return answer;
  }
  planted_tick_ = events_.back().tick;
  if (!edit->notes.empty()) answer.message = with_what_bars(edit->notes.front(), *before_, places());
  if (!edit->trees.empty()) answer.edit = std::move(*edit), answer.drag = drag_;
  return answer;
}

ToolAnswer PlantBrushTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  if (event.ground) pointer_ = to_plan(*event.ground);
  if (waits_) return {};
  if (eraser_.busy() || (e.kind == Event::Kind::press && e.modifiers.shift)) return eraser_.handle(event, scene);
  switch (e.kind) {
    case Event::Kind::press:
      if (e.button != Button::left || !event.ground) return {};
      before_ = scene.document;
      brush_ = scene.settings->plant;
      brush_.radius_m = scene.settings->radius_m;
      events_.clear();
      began_s_ = e.time_s;
      drag_ = new_drag();
      planted_tick_ = -1;
      add_event(*pointer_, e.time_s);
      return plant(scene, false);
    case Event::Kind::move:
      if (before_ && event.ground) add_event(*pointer_, e.time_s);
      return {};
    case Event::Kind::release: {
      if (!before_ || e.button != Button::left) return {};
      add_event(event.ground ? to_plan(*event.ground) : events_.back().at, e.time_s);
      ToolAnswer answer = plant(scene, false);
      if (!waits_) cancel();
      return answer;
    }
    default:
      return {};
  }
}

ToolAnswer PlantBrushTool::tick(double time_s, const ToolScene& scene) {
  if (!before_ || waits_) return {};
  add_event(events_.back().at, time_s);
  if (events_.back().tick < planted_tick_ + kTicksBetween) {
    events_.pop_back();
    return {};
  }
  return plant(scene, false);
}

ToolAnswer PlantBrushTool::confirm(const ToolScene& scene) {
  if (!waits_) return {};
  ToolAnswer answer = plant(scene, true);
  cancel();
  return answer;
}

Preview PlantBrushTool::preview(const ToolScene& scene) const {
  Preview preview;
  if (pointer_) preview.ring = {*pointer_, scene.settings->radius_m};
  return preview;
}

void PlantBrushTool::cancel() {
  before_.reset();
  events_.clear();
  waits_ = false;
  eraser_.cancel();
}

}  // namespace bosquet::ui
