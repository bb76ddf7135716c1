// Grown scene: a document with everything its trees have become.
//
// Model     divide_space, asymmetry, canopy light, then every tree grown alone and in parallel (Longay 2014, 6.1); the
//           stages of the source's comparisons can be switched off one by one
// Holds     the same document and options give the same skeletons for any number of threads
// Errors    a crown space too large for memory; cancelled work (kind cannot_finish)
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "crowns/canopy_light.h"
#include "crowns/crown_space.h"
#include "growth/measure.h"
#include "growth/skeleton.h"
#include "scene/document.h"
#include "scene/skeleton_cache.h"
#include "scene/surroundings.h"
#include "scene/tree_growth.h"

namespace bosquet::scene {

struct GrowOptions {
  bool regions = true;                 ///< trees keep to their crown regions
  bool asymmetry = true;               ///< trees lean away from their neighbours
  bool light = true;                   ///< neighbours' crowns shade (where regions are on and the document has it on)
  float detail = 1.0f;                 ///< internodes are this many times shorter
  std::optional<float> year;           ///< show every tree at this age; missing: at its final height
  SkeletonCache* skeletons = nullptr;  ///< trees grown before; null: every tree is grown
  /// The scene is for build_model alone: crown space, light and fallen wood are let go as soon as they can be.
  bool only_meshes = false;
};

struct GrownScene {
  Document given;     ///< as it came
  Document document;  ///< the same without the trees to be removed: they take no room in the scene and are not grown
  crowns::CrownSpace space;           ///< empty when only meshes are wanted
  crowns::CanopyLight light;          ///< the same, and when canopy light is off
  std::vector<GrownTree> trees;       ///< in the document's order
  std::size_t claimed_voxels = 0;     ///< of the crown space
  std::uint64_t skeleton_digest = 0;  ///< over all skeletons as they grew, in the document's order
  Seconds seconds;                    ///< "crowns", "light", "growth"
  std::vector<std::string> warnings;

  std::size_t internodes() const;  ///< living
};

/// The document without its trees to be removed.
Document without_removed(const Document& document);

Result<GrownScene> grow_scene(const Document& document, const GrowOptions& options, Progress* progress);

}  // namespace bosquet::scene
