// Human figure: a walking person for scale.
//
// Model     torso, head and limbs as tubes of elliptical rings, after the proportions of an adult: eight heads high,
//           hip at half the height
// Frame     stands on y = 0 at the origin, world axes; metres
#pragma once

#include "core/triangle_mesh.h"

namespace bosquet::geometry {

inline constexpr float kFigureHeight = 1.75f;

/// Toward the viewer of a picture from the south, so that shoulders show.
inline constexpr float kFigureHeading_deg = 122.0f;

/// Walks to `heading_deg`, from north clockwise.
TriangleMesh human_figure(float heading_deg = kFigureHeading_deg);

}  // namespace bosquet::geometry
