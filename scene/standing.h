// Standing: what crowns/ is told of the obstacles and hero trees of a document, and what it finds wrong with them.
//
// Errors    an obstacle that cannot be voxelised, by name; everything else is a warning
// Cost      an outline: its columns; a mesh: its surface in voxels
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "crowns/crown_space.h"
#include "scene/document.h"

namespace bosquet::scene {

/// Obstacles as voxels, near the site; hero trees as their living wood.
Result<crowns::Standing> standing(const Document& document, std::vector<std::string>& warnings);

/// Trees that stand in obstacles or trunks, and what stands off the site, in words.
std::vector<std::string> space_warnings(const crowns::CrownSpace& space, const Document& document);

}  // namespace bosquet::scene
