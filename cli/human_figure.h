// Human figure: a walking person for scale.
//
// Model     torso, head and limbs as tubes of elliptical rings, after the proportions of an adult: eight heads high,
//           hip at half the height
// Frame     stands on y = 0 at the origin, walks to +x and half toward +z; metres
#pragma once

#include "core/triangle_mesh.h"

namespace bosquet::cli {

inline constexpr float kFigureHeight = 1.75f;

TriangleMesh human_figure();

}  // namespace bosquet::cli
