// Plant brush: trees at a rate of strength x radius^2 x time along a stroke; with Shift it erases.
//
// Holds     the trees of a stroke hang on its path and times in 1/60 s, not on how many events reported it
#pragma once

#include "ui/tools/select_tool.h"
#include "ui/tools/tool.h"

namespace bosquet::ui {

class PlantBrushTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  ToolAnswer tick(double time_s, const ToolScene& scene) override;
  ToolAnswer confirm(const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  bool busy() const override { return before_ != nullptr || eraser_.busy(); }
  void cancel() override;

 private:
  void add_event(Vec2 at, double time_s);
  ToolAnswer plant(const ToolScene& scene, bool agreed);
  std::vector<Vec2> places() const;

  std::shared_ptr<const scene::Document> before_;
  std::vector<distribution::BrushEvent> events_;
  distribution::PlantBrush brush_;
  double began_s_ = 0;
  std::uint64_t drag_ = 0;
  int planted_tick_ = -1;
  bool waits_ = false;  ///< for the person to agree to very many trees
  std::optional<Vec2> pointer_;
  EraseTool eraser_;  ///< while Shift was down when the button was pressed
};

}  // namespace bosquet::ui
