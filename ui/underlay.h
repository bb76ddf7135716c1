// Underlay: the picture of a plan or from the air, laid over the ground to draw on.
//
// Model     the ground's own triangles inside the picture's rectangle, lifted a little, with the picture on them; a
//           picture that shows weakly is mixed with the colour of a meadow
// Frame     world; the picture's rectangle in plan metres
// Errors    a file that cannot be read: the reader's message
// Threads   pure functions
#pragma once

#include <memory>
#include <span>

#include "core/image.h"
#include "core/result.h"
#include "core/triangle_mesh.h"
#include "render/texture_levels.h"
#include "scene/plan_settings.h"

namespace bosquet::ui {

/// A rectangle in plan metres.
struct PlanRectangle {
  Vec2 low{0.0f}, high{0.0f};
};

/// What of the ground lies under the rectangle, cut at its edges; uv (0, 0) is the picture's upper left.
TriangleMesh drape(std::span<const std::shared_ptr<const TriangleMesh>> ground, const PlanRectangle& rectangle,
                   float lift_m);

struct UnderlayPicture {
  render::MaterialLevels material;
  float height_per_width = 1.0f;
};

/// Reads the file, at most 2048 pixels wide or high.
Result<UnderlayPicture> read_underlay(const scene::Underlay& underlay);

/// Smaller or larger, so that the way from `a` to `b` on it becomes `true_m` long; `a` stays where it is.
scene::Underlay scaled_to(const scene::Underlay& underlay, Vec2 a, Vec2 b, double true_m);

PlanRectangle rectangle_of(const scene::Underlay& underlay, float height_per_width);

}  // namespace bosquet::ui
