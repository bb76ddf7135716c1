// Lens: a view's camera as axes, projection and rays.
//
// Frame     positions are relative to the eye (world minus eye); clip space as OpenGL (-1..1, y up)
// Decision  a tile of a picture is the same lens with a window of its clip space blown up to the whole
#pragma once

#include "core/vec.h"
#include "render/shadow_cascades.h"
#include "render/view.h"

namespace bosquet::render {

/// Part of a picture in its clip space, -1..1 in both directions, y up.
struct ClipWindow {
  Vec2 low{-1.0f}, high{1.0f};
};

/// Axes and depths of a view onto `scene` (world), the depths as tight as the scene allows.
ViewVolume make_view_volume(const View& view, const Box3& scene);

/// Clip matrix for positions relative to the eye.
Mat4 relative_to_clip(const ViewVolume& volume, const ClipWindow& window);

/// The pixel at (x, y) in the window's own -1..1 is seen along forward + x right + y up; in a parallel projection along
/// `forward` from origin + x right + y up.
struct Rays {
  Vec3 right, up, forward, origin{0.0f};
};
Rays rays(const ViewVolume& volume, const ClipWindow& window);

}  // namespace bosquet::render
