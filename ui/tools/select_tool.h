// Select tool: takes trees and hero trees by click, box (drag over ground) or lasso (drag with Alt), adds with Shift, moves what is
// selected by dragging it, scales it with Control and the wheel, deletes it.
#pragma once

#include "ui/tools/tool.h"

namespace bosquet::ui {

class SelectTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  bool busy() const override { return state_ != State::idle; }
  void cancel() override;

 private:
  enum class State { idle, pressed, box, lasso, moving };
  ToolAnswer move_to(const ToolEvent& event);
  ToolAnswer take(const std::vector<std::int32_t>& trees, const ToolScene& scene, bool add) const;

  State state_ = State::idle;
  Vec2 from_pixel_{0.0f}, pixel_{0.0f};
  std::vector<Vec2> lasso_;
  std::optional<std::int32_t> pressed_tree_;
  std::shared_ptr<const scene::Document> before_;
  std::vector<std::int32_t> moved_;
  Vec2 from_{0.0f};
  std::uint64_t drag_ = 0;
  bool add_ = false;
};

/// Takes trees away along a stroke.
class EraseTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  bool busy() const override { return before_ != nullptr; }
  void cancel() override { before_.reset(), points_.clear(); }

 private:
  ToolAnswer erase(const ToolScene& scene);

  std::shared_ptr<const scene::Document> before_;
  std::vector<Vec2> points_;
  std::uint64_t drag_ = 0;
  std::optional<Vec2> pointer_;
};

/// The site's water level, set by dragging it up or down from where the pointer meets the ground.
class WaterTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  bool busy() const override { return before_ != nullptr; }
  void cancel() override { before_.reset(); }

 private:
  std::shared_ptr<const scene::Document> before_;
  std::uint64_t drag_ = 0;
  float from_level_m_ = 0, metres_per_pixel_ = 0.01f;
  Vec2 from_pixel_{0.0f};
  std::optional<Vec3> pointer_;
};

}  // namespace bosquet::ui
