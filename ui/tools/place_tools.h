// Place tools: single trees, and trees along a line or over an area that is clicked point by point.
//
// Who       single; row and hedge (a line); grid, fill (an outline). A line or outline ends with Enter, a double click,
//           or for an outline a click on its first point; Backspace takes the last point back
#pragma once

#include "ui/tools/tool.h"

namespace bosquet::ui {

class SingleTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;

 private:
  std::optional<Vec2> pointer_;
};

/// Sets the hero tree in hand, as it is, where it is clicked.
class HeroTool : public Tool {
 public:
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;

 private:
  std::optional<Vec2> pointer_;
};

/// A polyline clicked point by point.
class PathTool : public Tool {
 public:
  explicit PathTool(bool closed, std::size_t least) : closed_(closed), least_(least) {}
  ToolAnswer handle(const ToolEvent& event, const ToolScene& scene) override;
  Preview preview(const ToolScene& scene) const override;
  ToolAnswer confirm(const ToolScene& scene) override;
  bool busy() const override { return !points_.empty(); }
  void cancel() override { points_.clear(), waiting_.clear(); }

 protected:
  /// How many trees finishing would plant, to ask before very many; places to show.
  virtual std::vector<Vec2> places(const std::vector<Vec2>& line, const ToolScene& scene, std::size_t& count) const = 0;
  virtual ToolAnswer finish(const std::vector<Vec2>& line, const ToolScene& scene) = 0;

 private:
  ToolAnswer end(const ToolScene& scene);

  bool closed_;
  std::size_t least_;
  std::vector<Vec2> points_;
  std::vector<Vec2> waiting_;  ///< for the person to agree
  std::optional<Vec2> pointer_;
  double last_press_s_ = -1;
  Vec2 last_pixel_{-1e9f};
};

class RowTool : public PathTool {
 public:
  explicit RowTool(bool hedge) : PathTool(false, 2), hedge_(hedge) {}

 private:
  std::vector<Vec2> places(const std::vector<Vec2>& line, const ToolScene& scene, std::size_t& count) const override;
  ToolAnswer finish(const std::vector<Vec2>& line, const ToolScene& scene) override;
  bool hedge_;
};

class AreaTool : public PathTool {
 public:
  explicit AreaTool(bool grid) : PathTool(true, 3), grid_(grid) {}

 private:
  std::vector<Vec2> places(const std::vector<Vec2>& line, const ToolScene& scene, std::size_t& count) const override;
  ToolAnswer finish(const std::vector<Vec2>& line, const ToolScene& scene) override;
  bool grid_;
};

/// Distances, along a line clicked point by point, and the area that it encloses; its ends are kept in the settings.
class MeasureTool : public PathTool {
 public:
  MeasureTool() : PathTool(false, 2) {}
  Preview preview(const ToolScene& scene) const override;

 private:
  std::vector<Vec2> places(const std::vector<Vec2>&, const ToolScene&, std::size_t& count) const override {
    count = 0;
    return {};
  }
  ToolAnswer finish(const std::vector<Vec2>& line, const ToolScene& scene) override;
};

}  // namespace bosquet::ui
