// Tree growth: one tree of a document from what surrounds it to its skeleton.
//
// Model     growth/grow.h of the tree's own parameters (its species' with what was changed for it alone), its crown
//           region, the light and the press of its neighbours; then its trunk brought to a given diameter
// Decision  a clipped tree grows only inside its form, all its buds breaking, until the form is full
// Holds     a pure function of the inputs: equal hashes, equal skeletons
// Threads   any number at once
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/progress.h"
#include "crowns/canopy_light.h"
#include "crowns/crown_region.h"
#include "growth/grow.h"
#include "growth/measure.h"
#include "growth/transmittance.h"
#include "scene/document.h"
#include "scene/skeleton_cache.h"

namespace bosquet::scene {

struct GrownTree {
  std::shared_ptr<const growth::Skeleton> skeleton;
  int season = -1;            ///< the last season shown; -1 all of them
  growth::Measures measures;  ///< at that season
  float age_years = 0;        ///< by the species' height curve
  bool from_cache = false;    ///< it was not grown now
  Vec3 asymmetry{0.0f};
};

/// What surrounds a tree, as crowns/ found it; null where it does not count.
struct TreeSurroundings {
  const crowns::CrownSpace* space = nullptr;
  const crowns::CanopyLight* light = nullptr;
  std::size_t claimant = 0;
  Vec3 asymmetry{0.0f};
};

/// Everything that one tree's skeleton hangs on. It refers to the document, which must outlive it.
class TreeInputs {
 public:
  TreeInputs(const Document& document, const Tree& tree, const TreeSurroundings& around, float detail);
  TreeInputs(const TreeInputs&) = delete;
  TreeInputs& operator=(const TreeInputs&) = delete;

  const growth::GrowthInput& growth() const { return input_; }
  /// Of all inputs, the trunk diameter included.
  std::uint64_t hash() const;

 private:
  friend GrownTree grow_tree(const Document&, const Tree&, const TreeInputs&, std::uint64_t, std::optional<float>,
                             SkeletonCache*, const Progress*, std::string&);
  std::optional<growth::Parameters> own_parameters_;
  crowns::CrownRegion region_;
  growth::Transmittance light_;
  growth::GrowthInput input_;
  std::optional<float> trunk_diameter_m_;
};

/// About how much work a tree is: to grow the dearest first.
float growth_cost(const Document& document, const Tree& tree);

/// Grows a tree, or finds it in the cache (may be null) under `hash`, that of its inputs; shows it at the age `year`. When
/// cancelled the skeleton is null. What could not be met is told in `warning`.
GrownTree grow_tree(const Document& document, const Tree& tree, const TreeInputs& inputs, std::uint64_t hash,
                    std::optional<float> year, SkeletonCache* cache, const Progress* progress, std::string& warning);

}  // namespace bosquet::scene
