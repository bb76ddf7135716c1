// Tool settings: the numbers of all tools, shown for the tool in hand and kept between strokes.
#pragma once

#include <concepts>
#include <type_traits>

#include "core/parameter.h"
#include "distribution/rows.h"
#include "distribution/sowing.h"
#include "terrain/area.h"
#include "terrain/brush.h"

namespace bosquet::ui {

inline constexpr float kLeastRadius_m = 0.5f, kMostRadius_m = 500.0f;

inline terrain::Stroke default_stroke() {
  terrain::Stroke stroke;
  stroke.strength = 0.6f;
  return stroke;
}

struct ToolSettings {
  float radius_m = 6.0f;  ///< of every brush
  distribution::PlantBrush plant;
  terrain::Stroke ground = default_stroke();
  terrain::Area area = {.name = "path", .kind = terrain::AreaKind::path};
  distribution::RowRules row;
  distribution::RowRules hedge = distribution::hedge_rules();
  distribution::GridRules grid;
  float per_hectare = 400.0f;
  float scale = 0.9f;          ///< of single trees
  std::size_t species = 0;     ///< of single trees
  float water_level_m = 0.0f;  ///< last one set
};

}  // namespace bosquet::ui
