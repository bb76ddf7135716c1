// Pick: what a line of sight meets.
//
// Frame     world metres
// Cost      ground: a walk over the cells under the ray; trees: all of them, a few operations each
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/document.h"
#include "ui/camera_rig.h"

namespace bosquet::ui {

/// Where the ray meets the ground of the site, or the level around it at the height of the site's nearest edge.
std::optional<Vec3> ground_hit(const terrain::Terrain& ground, const SightRay& ray);

/// The tree whose trunk or crown, as its species is shaped, the ray meets first; a hero tree, below 0, as it has grown.
std::optional<std::int32_t> tree_hit(const scene::Document& document, const SightRay& ray);

/// Trees and hero trees whose foot is seen inside a closed outline in the view (pixels), in the document's order.
std::vector<std::int32_t> trees_inside(const scene::Document& document, const CameraRig& rig, Vec2 view_size,
                                       const std::vector<Vec2>& outline);

}  // namespace bosquet::ui
