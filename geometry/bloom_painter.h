// Bloom painter: one bunch of flowers or fruit on an atlas canvas.
//
// Frame     the bunch springs from `node` and stands or hangs in a direction of the cell, 0 degrees up, positive to the
//           right; metres
// Holds     nothing is farther from `node` than bunch_extent_m(bloom)
#pragma once

#include "core/random.h"
#include "geometry/atlas_canvas.h"
#include "geometry/bloom.h"

namespace bosquet::geometry {

/// Length of a bunch from its node to its farthest end.
float bunch_extent_m(const Bloom& bloom);

/// Half its width to either side of the direction in which it stands or hangs.
float bunch_half_width_m(const Bloom& bloom);

/// `stalk` is the colour of stems, linear.
void paint_bunch(AtlasCanvas& canvas, RandomStream& stream, const Bloom& bloom, const Vec3& stalk, Vec2 node,
                 float angle_deg);

}  // namespace bosquet::geometry
