// Framing: cameras that show a whole model, and cameras a user names or types.
//
// Frame     world; plan terms are (east, north, height above datum) as in files and on the command line
// Errors    camera_from_text lists the model's camera names and the six numbers it would take
#pragma once

#include <span>
#include <string_view>

#include "core/result.h"
#include "core/vec.h"
#include "scene/model.h"

namespace bosquet::render {

/// Box around all nodes' meshes, world; empty for a model without triangles.
Box3 bounds(const scene::Model& model);

/// Camera south of `box` (at +z), looking north and down at `elevation_deg`, as near as shows the whole box in a
/// picture of `aspect` = width/height with a margin of 4 % on the tightest side. `azimuth_deg` turns it: from where it
/// looks, from north clockwise.
scene::Camera frame(const Box3& box, float aspect, float elevation_deg = 30.0f, float azimuth_deg = 180.0f,
                    float vertical_fov_deg = 40.0f);
/// The same about several boxes, as near as shows them all.
scene::Camera frame(std::span<const Box3> boxes, float aspect, float elevation_deg, float azimuth_deg = 180.0f,
                    float vertical_fov_deg = 40.0f);

/// Cameras that look from eye to target, given in world or in plan terms.
scene::Camera look_at_world(const Vec3& eye, const Vec3& target, float vertical_fov_deg = 40.0f);
scene::Camera look_at_plan(const Vec3& eye, const Vec3& target, float vertical_fov_deg = 40.0f);

/// The model's camera of this name, or "x,y,z,tx,ty,tz" in plan terms: eye and target as east, north, height.
Result<scene::Camera> camera_from_text(std::string_view text, const scene::Model& model);

}  // namespace bosquet::render
