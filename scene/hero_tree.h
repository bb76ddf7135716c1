// Hero tree: a tree that is already grown and stays as it is, set on the site beside those that grow.
//
// Model     its skeleton is fixed; it takes the voxels that its wood passes through and takes no part in the division
// Frame     the skeleton is in tree frame, already scaled and turned
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/vec.h"
#include "growth/skeleton.h"

namespace bosquet::scene {

struct HeroTree {
  std::int32_t id = -1;  ///< below 0, shared with obstacles and never reused
  std::string name;
  std::size_t species = 0;  ///< index into Document::species, for its look
  std::uint64_t key = 0;    ///< of its leaves' random streams
  Vec2 at{0.0f};            ///< plan
  std::shared_ptr<const growth::Skeleton> skeleton;

  bool operator==(const HeroTree&) const = default;  ///< with the very same skeleton
};

/// The skeleton enlarged and turned about its foot, counter-clockwise seen from above.
growth::Skeleton placed(growth::Skeleton skeleton, float scale, float rotation_deg);

}  // namespace bosquet::scene
