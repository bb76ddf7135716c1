// Terrain tool: brushes that shape the ground, bar it from planting or free it again.
#pragma once

#include "terrain/brush.h"
#include "ui/tools/tool.h"

namespace bosquet::ui {

class TerrainTool : public Tool {
 public:
  explicit TerrainTool(terrain::BrushKind kind) : kind_(kind) {}
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  bool busy() const override { return live_.has_value(); }
  void cancel() override;

 private:
  ToolAnswer stroke_to(Vec2 at);

  terrain::BrushKind kind_;
  std::optional<terrain::LiveStroke> live_;
  std::shared_ptr<const scene::Document> before_;  ///< that the stroke began with
  std::uint64_t drag_ = 0;
  Vec2 last_{0.0f};
  std::optional<Vec2> pointer_;
};

}  // namespace bosquet::ui
