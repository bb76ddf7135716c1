// Standing: what crowns/ is told of the obstacles and hero trees of a document, and what it finds wrong with them.
//
// Errors    an obstacle that cannot be voxelised, by name; everything else is a warning
// Cost      an outline: its columns; a mesh: its surface in voxels
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/result.h"
#include "crowns/crown_space.h"
#include "scene/document.h"

namespace bosquet::scene {

/// Obstacles as voxels, near the site; hero trees as their living wood.
Result<crowns::Standing> standing(const Document& document, std::vector<std::string>& warnings);

/// The same for one document after another: what stands as it stood is not made again, and is the same memory, so that
/// crowns::update_space sees what changed.
class StandingKeeper {
 public:
  Result<crowns::Standing> of(const Document& document, std::vector<std::string>& warnings);

 private:
  // Shape, heights and lattice of an obstacle; skeleton and foot of a hero tree.
  using ObstacleKey = std::tuple<const void*, const void*, float, float, float, float, float, float>;
  using HeroKey = std::tuple<const void*, float, float, float>;
  struct KeptObstacle {
    Obstacle obstacle;  ///< holds the memory that the key points to
    std::shared_ptr<const crowns::ObstacleVolume> volume;
  };
  struct KeptHero {
    std::shared_ptr<const growth::Skeleton> skeleton;
    std::shared_ptr<const std::vector<Segment>> wood;
  };
  std::map<ObstacleKey, KeptObstacle> obstacles_;
  std::map<HeroKey, KeptHero> heroes_;
};

/// Trees that stand in obstacles or trunks, and what stands off the site, in words.
std::vector<std::string> space_warnings(const crowns::CrownSpace& space, const Document& document);

}  // namespace bosquet::scene
