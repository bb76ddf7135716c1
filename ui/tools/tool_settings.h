// Tool settings: the numbers of all tools, shown for the tool in hand and kept between strokes.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/parameter.h"
#include "distribution/rows.h"
#include "distribution/sowing.h"
#include "growth/skeleton.h"
#include "scene/species.h"
#include "terrain/area.h"
#include "terrain/brush.h"
#include "ui/widgets/units.h"

namespace bosquet::ui {

inline constexpr float kLeastRadius_m = 0.5f, kMostRadius_m = 500.0f;

inline terrain::Stroke default_stroke() {
  terrain::Stroke stroke;
  stroke.strength = 0.6f;
  stroke.density = 0.3f;
  return stroke;
}

/// A saved tree that can be set on the site again and again.
struct HeroInHand {
  std::string name;
  std::shared_ptr<const scene::Species> species;
  std::uint64_t key = 0;
  std::shared_ptr<const growth::Skeleton> skeleton;
};

struct ToolSettings {
  Units units = Units::metres;  ///< that lengths are told in
  float radius_m = 6.0f;        ///< of every brush
  distribution::PlantBrush plant;
  terrain::Stroke ground = default_stroke();
  terrain::Area area = {.name = "path", .kind = terrain::AreaKind::path};
  distribution::RowRules row;
  distribution::RowRules hedge = distribution::hedge_rules();
  distribution::GridRules grid;
  float per_hectare = 400.0f;
  float scale = 0.9f;       ///< of single trees
  std::size_t species = 0;  ///< of single trees
  std::optional<HeroInHand> hero;
  float hero_turn_deg = 0.0f;
  float water_level_m = 0.0f;                     ///< last one set
  std::optional<std::pair<Vec2, Vec2>> measured;  ///< ends of the line measured last, plan
};

}  // namespace bosquet::ui
