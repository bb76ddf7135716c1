// Ground finish: the last step of every ground texture, for meadow, lawn, gravel, paving and soil alike.
//
// Units     linear colours 0..1; the square's edge is that of the relief, and both repeat
#pragma once

#include <vector>

#include "core/vec.h"
#include "geometry/ground_texture.h"
#include "geometry/texture_relief.h"

namespace bosquet::geometry {

/// Colours, row by row of the relief's square, scaled to the mean kGroundMean, and the relief's normals.
GroundTextures finish_ground(const std::vector<Vec3>& colours, const Relief& relief);

}  // namespace bosquet::geometry
