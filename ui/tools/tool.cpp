#include "ui/tools/tool.h"

#include <array>
#include <atomic>

#include "ui/tools/place_tools.h"
#include "ui/tools/plant_brush_tool.h"
#include "ui/tools/select_tool.h"
#include "ui/tools/terrain_tool.h"

namespace bosquet::ui {
namespace {

constexpr std::array<ToolInfo, kToolCount> kTools{{
    {ToolKind::select, "Select",
     "Click a tree; drag it to move it; drag over ground for a box, with Alt a lasso; Shift adds; Delete removes", 'V',
     false},
    {ToolKind::plant_brush, "Plant brush", "Hold and drag: trees of the species bar grow under the brush", 'B', true},
    {ToolKind::single, "Single tree", "Click where one tree shall stand", 'T', false},
    {ToolKind::row, "Row or avenue", "Click along the line; Enter or a double click plants", 'R', false},
    {ToolKind::grid, "Grid", "Click round the area; Enter, or its first point, plants", 'G', false},
    {ToolKind::hedge, "Hedge", "Click along the line; Enter or a double click plants", 'H', false},
    {ToolKind::fill, "Fill area", "Click round the area; Enter, or its first point, plants", 'P', false},
    {ToolKind::hero, "Hero tree",
     "Click where the hero tree in hand shall stand; it comes from a file or from the left", 'N', false},
    {ToolKind::erase, "Erase", "Hold and drag: trees under the brush go, locked ones stay", 'E', true},
    {ToolKind::raise, "Raise ground", "Hold and drag; Shift smooths", '1', true},
    {ToolKind::lower, "Lower ground", "Hold and drag; Shift smooths", '2', true},
    {ToolKind::smooth, "Smooth ground", "Hold and drag", '3', true},
    {ToolKind::flatten, "Flatten ground", "Hold and drag: everything comes to the height first touched; Shift smooths",
     '4', true},
    {ToolKind::noise, "Roughen ground", "Hold and drag; Shift smooths", '5', true},
    {ToolKind::exclude, "Keep free", "Hold and drag: nothing is planted there; Shift lets plant again", '6', true},
    {ToolKind::include, "Let plant", "Hold and drag: planting is allowed there again; Shift keeps free", '7', true},
    {ToolKind::density, "Planting density",
     "Hold and drag: brushes and areas plant so much of the usual there; Shift plants all again", '8', true},
    {ToolKind::water, "Water level", "Press on the ground and drag up or down; Delete takes the water away", 'W',
     false},
    {ToolKind::measure, "Measure", "Click points; Enter ends", 'M', false},
}};

}  // namespace

const ToolInfo& tool_info(ToolKind kind) { return kTools[static_cast<std::size_t>(kind)]; }

std::unique_ptr<Tool> make_tool(ToolKind kind) {
  switch (kind) {
    case ToolKind::select:
      return std::make_unique<SelectTool>();
    case ToolKind::plant_brush:
      return std::make_unique<PlantBrushTool>();
    case ToolKind::single:
      return std::make_unique<SingleTool>();
    case ToolKind::row:
      return std::make_unique<RowTool>(false);
    case ToolKind::hedge:
      return std::make_unique<RowTool>(true);
    case ToolKind::grid:
      return std::make_unique<AreaTool>(true);
    case ToolKind::fill:
      return std::make_unique<AreaTool>(false);
    case ToolKind::hero:
      return std::make_unique<HeroTool>();
    case ToolKind::erase:
      return std::make_unique<EraseTool>();
    case ToolKind::raise:
      return std::make_unique<TerrainTool>(terrain::BrushKind::raise);
    case ToolKind::lower:
      return std::make_unique<TerrainTool>(terrain::BrushKind::lower);
    case ToolKind::smooth:
      return std::make_unique<TerrainTool>(terrain::BrushKind::smooth);
    case ToolKind::flatten:
      return std::make_unique<TerrainTool>(terrain::BrushKind::flatten);
    case ToolKind::noise:
      return std::make_unique<TerrainTool>(terrain::BrushKind::noise);
    case ToolKind::exclude:
      return std::make_unique<TerrainTool>(terrain::BrushKind::exclude);
    case ToolKind::include:
      return std::make_unique<TerrainTool>(terrain::BrushKind::include);
    case ToolKind::density:
      return std::make_unique<TerrainTool>(terrain::BrushKind::density);
    case ToolKind::water:
      return std::make_unique<WaterTool>();
    case ToolKind::measure:
      return std::make_unique<MeasureTool>();
  }
  return nullptr;
}

std::uint64_t new_drag() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace bosquet::ui
