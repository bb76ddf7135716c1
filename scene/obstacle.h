// Obstacle: a building, wall or other thing that stands on the site, as it is drawn and as crowns give way to it.
//
// Frame     world metres; the outline in plan
// Holds     an extruded one keeps its outline, from which its voxels are exact; its mesh is the prism
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/polygon.h"
#include "core/triangle_mesh.h"

namespace bosquet::scene {

struct Obstacle {
  std::int32_t id = -1;  ///< below 0, shared with hero trees and never reused
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const Polygon> outline;  ///< null for a mesh from a file
  float low_y = 0, high_y = 0;             ///< of the prism

  bool operator==(const Obstacle&) const = default;  ///< with the very same mesh and outline
};

}  // namespace bosquet::scene
