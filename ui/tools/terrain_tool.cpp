#include "ui/tools/terrain_tool.h"

#include <algorithm>

#include "scene/site_edits.h"

namespace bosquet::ui {
namespace {

std::string_view name_of(terrain::BrushKind kind) {
  switch (kind) {
    case terrain::BrushKind::raise:
      return "Raise ground";
    case terrain::BrushKind::lower:
      return "Lower ground";
    case terrain::BrushKind::smooth:
      return "Smooth ground";
    case terrain::BrushKind::flatten:
      return "Flatten ground";
    case terrain::BrushKind::noise:
      return "Roughen ground";
    case terrain::BrushKind::exclude:
      return "Keep free";
    case terrain::BrushKind::include:
      return "Let plant";
    case terrain::BrushKind::density:
      return "Paint density";
  }
  return "Brush ground";
}

}  // namespace

ToolAnswer TerrainTool::stroke_to(Vec2 at) {
  ToolAnswer answer;
  last_ = at;
  const std::vector<Vec2> points{at};
  live_->extend(points);
  answer.edit = scene::set_ground(*before_, live_->terrain(), std::string(name_of(live_->stroke().kind)));
  answer.drag = drag_;
  return answer;
}

ToolAnswer TerrainTool::handle(const ToolEvent& event, const ToolScene& scene) {
  const Event& e = event.event;
  if (event.ground) pointer_ = to_plan(*event.ground);
  switch (e.kind) {
    case Event::Kind::press: {
      if (e.button != Button::left || !event.ground) return {};
      terrain::Stroke stroke = scene.settings->ground;
      stroke.kind = kind_;
      // Shift turns a brush into its helper: smoothing for those that shape, the other way for the rest.
      if (e.modifiers.shift) {
        if (kind_ == terrain::BrushKind::density)
          stroke.density = 1.0f;
        else
          stroke.kind = kind_ == terrain::BrushKind::exclude   ? terrain::BrushKind::include
                        : kind_ == terrain::BrushKind::include ? terrain::BrushKind::exclude
                                                               : terrain::BrushKind::smooth;
      }
      stroke.radius_m = scene.settings->radius_m;
      stroke.area = scene.settings->area;
      stroke.points.clear();
      before_ = scene.document;
      stroke.seed = before_->seed + before_->next_block;
      live_.emplace(*before_->terrain, stroke);
      drag_ = new_drag();
      return stroke_to(to_plan(*event.ground));
    }
    case Event::Kind::move: {
      if (!live_ || !event.ground) return {};
      const Vec2 at = to_plan(*event.ground);
      // Finer than a twentieth of the brush shows nothing.
      if (glm::length(at - last_) < 0.05f * live_->stroke().radius_m) return {};
      return stroke_to(at);
    }
    case Event::Kind::release:
      if (e.button == Button::left) live_.reset(), before_.reset();
      return {};
    default:
      return {};
  }
}

Preview TerrainTool::preview(const ToolScene& scene) const {
  Preview preview;
  if (pointer_) preview.ring = {*pointer_, scene.settings->radius_m};
  return preview;
}

void TerrainTool::cancel() { live_.reset(), before_.reset(); }

}  // namespace bosquet::ui
