// Plan sheet: paper and scale for a site, and the furniture beside its plan: frame, key, scale bar, north arrow, title.
//
// Decision  on fitting paper the smallest sheet from A3 on that takes the site at 1:500 or larger, else at 1:1000, else A1
//           at the largest usual scale that holds it; on a chosen one the largest usual scale that fits
// Frame     as plan_drawing.h
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "exchange/plan_drawing.h"
#include "scene/plan_settings.h"

namespace bosquet::exchange {

/// Chooses paper, scale and place for what lies between `low` and `high`.
Result<PlanDrawing> lay_out(const scene::PlanSettings& settings, DVec2 low, DVec2 high);

/// A row of the key: a sample drawn about (0, 0) within some 2.5 mm, and words.
struct KeyRow {
  std::vector<PlanItem> sample;  ///< in millimetres on paper
  std::string code, name, second;
  std::string count;
  bool italic = true;  ///< the name, where a second stands under it: as botanical ones are written
};
struct KeyPart {
  std::string heading;
  std::vector<KeyRow> rows;
};

/// Draws the furniture onto `layer`.
void furnish(PlanDrawing& plan, std::size_t layer, const scene::PlanSettings& settings, const std::vector<KeyPart>& key,
             const std::vector<std::string>& notes);

}  // namespace bosquet::exchange
