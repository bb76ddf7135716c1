// Dials: pictures of growth parameters that are changed by dragging in them.
//
// Source    Longay 2014, 5.4 (the studio's widgets: each shows several parameters that belong together)
// Who       the inspector; each returns whether it changed its numbers this frame
// Units     degrees as in species files; sizes in pixels
// Context   a frame of Dear ImGui begun
#pragma once

#include "growth/parameters.h"

namespace bosquet::ui {

/// The set-point angle as an arrow from a trunk: straight up is 0, level 90, straight down 180 degrees.
bool tropism_arrow(const char* id, float& set_point_angle_deg, float size);

/// Branching angle (psi) and deflection (delta) as a lateral shoot and the bent main axis.
bool branching_angles(const char* id, float& branching_angle_deg, float& deflection_angle_deg, float size);

/// Straightness, tropism and space as a point in a triangle, which keeps their sum at 1; a star shows their shares.
bool weights_triangle(const char* id, float& straightness, float& tropism, float& space, float size);

/// The bud ellipse of gravimorphism across a level axis: drag its top, its side, or its middle. Rays to the buds run from
/// red (held back) to green (favoured).
bool bud_ellipse(const char* id, float& vertical, float& level, float& offset, float size);

}  // namespace bosquet::ui
