#include "ui/tools/place_tools.h"

#include <fmt/format.h>

#include <algorithm>

#include "distribution/region.h"
#include "ui/tools/barred_ground.h"
#include "ui/tools/standing_edits.h"

namespace bosquet::ui {
namespace {

constexpr double kDoubleClick_s = 0.4;
constexpr float kSamePlace_px = 6.0f;
constexpr std::size_t kShownPlaces = 4000;

ToolAnswer answered(Result<scene::Edited> edit) {
  ToolAnswer answer;
  if (!edit) {
    answer.message = edit.error().message;
  } else {
    if (!edit->notes.empty()) answer.message = edit->notes.front();
    answer.edit = std::move(*edit);
  }
  return answer;
}

// The answer of a planting at these places, or of trees sown among them.
ToolAnswer told(ToolAnswer answer, const ToolScene& scene, std::span<const Vec2> places) {
  if (!answer.message.empty()) answer.message = with_what_bars(std::move(answer.message), *scene.document, places);
  return answer;
}

// Places all over a region.
std::vector<Vec2> spread(const distribution::Region& region) {
  constexpr int kAcross = 24;
  const Box2 box = distribution::bounds(region);
  std::vector<Vec2> places;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const Vec2 at = box.low + box.size() * (Vec2{i, j} + 0.5f) / static_cast<float>(kAcross);
      if (distribution::contains(region, at)) places.push_back(at);
    }
  return places;
}

}  // namespace

ToolAnswer SingleTool::handle(const ToolEvent& event, const ToolScene& scene) {
  if (event.ground) pointer_ = to_plan(*event.ground);
  if (event.event.kind != Event::Kind::press || event.event.button != Button::left || !event.ground) return {};
  const std::size_t species = std::min(scene.settings->species, scene.document->species.size() - 1);
  return told(answered(scene::plant_tree(*scene.document, *scene.planting, species, *pointer_, scene.settings->scale)),
              scene, {&*pointer_, 1});
}

Preview SingleTool::preview(const ToolScene& scene) const {
  Preview preview;
  if (!pointer_ || scene.document->species.empty()) return preview;
  const std::size_t species = std::min(scene.settings->species, scene.document->species.size() - 1);
  preview.ring = {*pointer_, 0.5f * scene.settings->scale * scene.document->species[species]->shape.crown_width_m};
  preview.places.push_back(*pointer_);
  return preview;
}

ToolAnswer HeroTool::handle(const ToolEvent& event, const ToolScene& scene) {
  if (event.ground) pointer_ = to_plan(*event.ground);
  if (event.event.kind != Event::Kind::press || event.event.button != Button::left || !event.ground) return {};
  const std::optional<HeroInHand>& hero = scene.settings->hero;
  if (!hero) {
    ToolAnswer answer;
    answer.message = "No hero tree is in hand: File > Import > Hero tree, or keep a grown tree as one";
    return answer;
  }
  return answered(place_hero(*scene.document, *hero, *pointer_, scene.settings->hero_turn_deg));
}

Preview HeroTool::preview(const ToolScene& scene) const {
  Preview preview;
  const std::optional<HeroInHand>& hero = scene.settings->hero;
  if (!pointer_ || !hero) return preview;
  preview.ring = {*pointer_, extent_of(*hero->skeleton).radius_m};
  preview.places.push_back(*pointer_);
  preview.label = hero->name;
  return preview;
}

ToolAnswer PathTool::end(const ToolScene& scene) {
  if (points_.size() < least_) {
    const std::size_t least = least_;
    cancel();
    ToolAnswer answer;
    answer.message = fmt::format("{} needs at least {} points", closed_ ? "An area" : "A line", least);
    return answer;
  }
  std::size_t count = 0;
  places(points_, scene, count);
  if (count > kManyTrees) {
    waiting_ = std::move(points_);
    points_.clear();
    ToolAnswer answer;
    answer.asks_for_trees = count;
    return answer;
  }
  ToolAnswer answer = finish(points_, scene);
  points_.clear();
  return answer;
}

ToolAnswer PathTool::confirm(const ToolScene& scene) {
  if (waiting_.empty()) return {};
  const std::vector<Vec2> line = std::move(waiting_);
  waiting_.clear();
  return finish(line, scene);
}

ToolAnswer PathTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  if (event.ground) pointer_ = to_plan(*event.ground);
  if (e.kind == Event::Kind::key_press) {
    if (e.key == kKeyEnter && busy()) return end(scene);
    if (e.key == kKeyBackspace && busy()) points_.pop_back();
    return {};
  }
  if (e.kind != Event::Kind::press || e.button != Button::left || !event.ground) return {};
  const bool again = e.time_s - last_press_s_ < kDoubleClick_s && glm::length(e.at - last_pixel_) < kSamePlace_px;
  last_press_s_ = e.time_s, last_pixel_ = e.at;
  if (again && busy()) return end(scene);
  // A click on the first point closes an outline.
  if (closed_ && points_.size() >= least_) {
    const Vec2 first = points_.front();
    const auto seen = scene.rig.project(to_world(first, scene.document->terrain->ground(first)), scene.view_size);
    if (seen && glm::length(*seen - e.at) < 1.5f * kSamePlace_px) return end(scene);
  }
  points_.push_back(*pointer_);
  return {};
}

Preview PathTool::preview(const ToolScene& scene) const {
  Preview preview;
  preview.line = points_;
  if (pointer_ && busy()) preview.line.push_back(*pointer_);
  preview.closed = closed_ && preview.line.size() > 2;
  if (preview.line.size() >= least_) {
    std::size_t count = 0;
    preview.places = places(preview.line, scene, count);
    if (count > 0) preview.label = count == 1 ? "1 tree" : fmt::format("{} trees", count);
    if (preview.places.size() > kShownPlaces) preview.places.clear();
  }
  return preview;
}

std::vector<Vec2> RowTool::places(const std::vector<Vec2>& line, const ToolScene& scene, std::size_t& count) const {
  auto made = distribution::row_places(line, hedge_ ? scene.settings->hedge : scene.settings->row);
  count = made ? made->size() : 0;
  return made ? std::move(*made) : std::vector<Vec2>();
}

ToolAnswer RowTool::finish(const std::vector<Vec2>& line, const ToolScene& scene) {
  const distribution::RowRules& rules = hedge_ ? scene.settings->hedge : scene.settings->row;
  auto made = distribution::row_places(line, rules);
  if (!made) return answered(made.error());
  return told(
      answered(scene::plant_places(*scene.document, *scene.planting, *made, rules.jitter_m, hedge_ ? "hedge" : "row")),
      scene, *made);
}

std::vector<Vec2> AreaTool::places(const std::vector<Vec2>& line, const ToolScene& scene, std::size_t& count) const {
  count = 0;
  const distribution::Region region = Polygon{line, {}};
  if (grid_) {
    auto made = distribution::grid_places(region, scene.settings->grid);
    if (!made) return {};
    count = made->size();
    return std::move(*made);
  }
  count = static_cast<std::size_t>(distribution::area_m2(region) * scene.settings->per_hectare * 1e-4f + 0.5f);
  return {};
}

ToolAnswer AreaTool::finish(const std::vector<Vec2>& line, const ToolScene& scene) {
  const distribution::Region region = Polygon{line, {}};
  if (grid_) {
    auto made = distribution::grid_places(region, scene.settings->grid);
    if (!made) return answered(made.error());
    return told(
        answered(scene::plant_places(*scene.document, *scene.planting, *made, scene.settings->grid.jitter_m, "grid")),
        scene, *made);
  }
  std::size_t count = 0;
  places(line, scene, count);
  if (count == 0) {
    ToolAnswer answer;
    answer.message = "The area is too small for one tree at this density";
    return answer;
  }
  return told(answered(scene::plant_area(*scene.document, *scene.planting, region, count)), scene, spread(region));
}

Preview MeasureTool::preview(const ToolScene& scene) const {
  Preview preview = PathTool::preview(scene);
  float length = 0.0f, area = 0.0f;
  for (std::size_t i = 0; i < preview.line.size(); ++i) {
    const Vec2 a = preview.line[i], b = preview.line[(i + 1) % preview.line.size()];
    if (i + 1 < preview.line.size()) length += glm::length(b - a);
    area += 0.5f * (a.x * b.y - b.x * a.y);
  }
  if (preview.line.size() > 1) preview.label = length_words(length, scene.settings->units, 2);
  if (preview.line.size() > 2)
    preview.label += fmt::format(", encloses {}", area_words(std::abs(area), scene.settings->units));
  return preview;
}

ToolAnswer MeasureTool::finish(const std::vector<Vec2>& line, const ToolScene& scene) {
  scene.settings->measured = {line.front(), line.back()};
  return {};
}

}  // namespace bosquet::ui
