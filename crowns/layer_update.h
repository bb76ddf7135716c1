// Layer update: one layer of the crown space divided anew after an edit, as far as the edit reaches. For update_space();
// nobody else includes it.
//
// Model     update_space.h tells why a set of trees that is widened until nothing outside touches what changed gives the
//           division of all
// Cost      follows the voxels of the edited trees and of their neighbours in this layer
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "crowns/crown_space.h"
#include "crowns/space_layout.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {

inline constexpr auto kSheetColumns = static_cast<std::size_t>(kTileColumns);
inline constexpr std::int32_t kGone = -1;  ///< a slot's claimant, when it has none
inline constexpr std::array<IVec2, 4> kBeside{IVec2{-1, 0}, IVec2{1, 0}, IVec2{0, -1}, IVec2{0, 1}};

/// A voxel that belonged to a tree before a hero tree took it.
struct HiddenVoxel {
  std::int32_t slot, layer;
  IVec2 column;
};

/// Layers of a column that came to lie above the ground, or under it.
struct GroundEdit {
  IVec2 column;
  std::int32_t low, high;
  bool opened;
};

/// What is the same for all layers.
struct SpaceEdit {
  const CrownSpace& before;
  const SpaceLayout& old_layout;
  const SpaceLayout& layout;
  const Standing& standing;
  const terrain::Terrain& terrain;
  const SpaceOptions& options;
  std::vector<std::int32_t> old_claimant;  ///< of each slot, or kGone
  std::vector<std::int32_t> claimant;      ///< the same after the edit
  std::vector<std::int32_t> edited;        ///< slots of trees that came, went or have another front
  std::vector<const Obstacle*> gone_obstacles, new_obstacles;
  std::vector<HiddenVoxel> hidden;  ///< sorted by slot, layer
  std::vector<GroundEdit> ground_edits;
  /// Of tiles that were not held, or whose ground is another.
  std::unordered_map<std::uint64_t, std::shared_ptr<const std::vector<std::int32_t>>> ground;
  std::mutex ground_lock;

  const Placed* old_place(std::int32_t slot) const { return place(old_layout, old_claimant, slot); }
  const Placed* new_place(std::int32_t slot) const { return place(layout, claimant, slot); }

  std::shared_ptr<const std::vector<std::int32_t>> ground_of(IVec2 tile) {
    const std::lock_guard lock(ground_lock);
    const auto known = ground.find(packed(tile));
    if (known != ground.end()) return known->second;
    if (const SpaceTile* held = before.find_tile(tile)) return held->ground;
    auto& layers = ground[packed(tile)];
    if (!layers) layers = ground_layers(tile, terrain, layout.domain, options);
    return layers;
  }

 private:
  static const Placed* place(const SpaceLayout& of, const std::vector<std::int32_t>& claimants, std::int32_t slot) {
    const std::int32_t c =
        static_cast<std::size_t>(slot) < claimants.size() ? claimants[static_cast<std::size_t>(slot)] : kGone;
    return c == kGone ? nullptr : &of.placed[static_cast<std::size_t>(c)];
  }
};

// One layer of one tile before and after, without hero trees and without what hangs below bases. Owners are slots or
/// kFree.
struct LayerSheet {
  IVec2 tile{0};
  std::vector<std::int32_t> before, now;
  std::vector<std::uint64_t> ticks;  ///< of voxels that were divided anew
  std::vector<std::uint8_t> open;    ///< above ground and in no obstacle, after the edit
  std::vector<std::uint8_t> divided;
};

/// The sheets of a layer that hold anything to do with the edit, divided anew. Safe for several layers at a time.
std::vector<LayerSheet> update_layer(SpaceEdit& edit, std::int32_t layer);

}  // namespace bosquet::crowns
