// Plan ground: areas, water, buildings and contour lines of a site as shapes of a plan.
//
// Decision  areas and water are drawn along the half-way line of their masks, so an edge is true to a fraction of a cell;
//           an obstacle from a mesh is drawn as the hull of its plan
// Frame     as plan_drawing.h
// Cost      the cells of the site once, and those around each area's edge
#pragma once

#include <string>
#include <vector>

#include "exchange/plan_drawing.h"
#include "scene/document.h"

namespace bosquet::exchange {

/// What of the ground stands on the plan, for its key.
struct GroundKinds {
  std::vector<terrain::AreaKind> areas;
  bool water = false, buildings = false;
  double contours_m = 0;  ///< height between contour lines; 0: there are none
};

/// Adds the ground's layers and shapes to a plan whose scale is chosen.
GroundKinds draw_ground(PlanDrawing& plan, const scene::Document& document);

/// How such an area looks.
PlanFill area_fill(terrain::AreaKind kind);
PlanFill water_fill();
PlanFill building_fill();
std::string_view area_words(terrain::AreaKind kind);

/// A layer at the end of the plan's.
std::size_t add_layer(PlanDrawing& plan, std::string name, int colour);

}  // namespace bosquet::exchange
