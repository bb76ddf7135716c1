#include "growth/grow.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "growth/detail.h"
#include "growth/light.h"
#include "growth/radii.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

/// What every living internode got in the last season; fallen wood has its own already.
void record_light_and_vigor(Tree& tree) {
  Skeleton& wood = tree.wood;
  tree.work.shadow_cells += tree.shadow.settle();
  fill_in_vigor(tree);
  for (std::size_t i = 0; i < wood.size(); ++i) {
    if (!wood.alive(i)) continue;
    wood.light[i] = light_at(tree, wood.distal[i]);
    if (wood.born[i] + 1 < tree.season) tree.scale_vigor(i);
  }
}

/// Feeds every number of the parameters to a hash. In phases and orders the names of the keys that are given count too.
struct NamedNumbers {
  Hasher& hasher;
  void operator()(const Real& info, float v) { hasher.add(info.name).add(v); }
  void operator()(const Whole& info, int v) { hasher.add(info.name).add(v); }
};
struct ParameterHash {
  Hasher& hasher;
  void operator()(const Real&, float v) { hasher.add(v); }
  void operator()(const Whole&, int v) { hasher.add(v); }
  void operator()(const Switch&, bool v) { hasher.add(v); }
  void operator()(const Choice&, Phyllotaxis v) { hasher.add(static_cast<int>(v)); }
  void operator()(const Choice&, BudsAt v) { hasher.add(static_cast<int>(v)); }
  template <class Item>
  void operator()(const Tables&, const std::vector<Item>& items) {
    hasher.add(static_cast<std::uint64_t>(items.size()));
    for (const Item& item : items) {
      NamedNumbers named{hasher};
      describe(item, named);
    }
  }
};

/// Work arrays of finished trees, for the next ones.
class KeptTrees {
 public:
  std::unique_ptr<Tree> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return std::make_unique<Tree>();
    std::unique_ptr<Tree> tree = std::move(idle_.back());
    idle_.pop_back();
    return tree;
  }
  void give(std::unique_ptr<Tree> tree) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(tree));
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Tree>> idle_;  ///< at most as many as ever grew at once
};

KeptTrees& kept_trees() {
  static KeptTrees kept;
  return kept;
}

}  // namespace

void release_work_memory() { kept_trees().clear(); }

Skeleton grow(const GrowthInput& input, const Progress* progress, GrowthWork* work) {
  assert(input.parameters && check(*input.parameters));
  std::unique_ptr<Tree> kept = kept_trees().take();
  Tree& tree = *kept;
  plant(tree, input);

  while (!tree.finished && !(progress && progress->cancelled())) grow_season(tree);
  record_light_and_vigor(tree);
  tree.wood.seasons = tree.season;
  if (work) *work = tree.work;

  Skeleton grown = tree.wood;
  kept_trees().give(std::move(kept));
  grown.radius = radii(grown);
  if (input.detail != 1.0f) return at_detail(grown, input.detail);
  return grown;
}

std::uint64_t hash(const GrowthInput& input) {
  Hasher hasher;
  ParameterHash visit{hasher};
  describe(*input.parameters, visit);
  hasher.add(input.max_height_m).add(input.asymmetry).add(input.clear_stem_m).add(input.detail);
  hasher.add(input.seed).add(input.key);
  hasher.add(static_cast<std::uint64_t>(input.markers.size()));
  for (const Vec3& marker : input.markers) hasher.add(marker);
  hasher.add(input.region ? 1 : 0).add(input.light ? 1 : 0);
  if (const crowns::CrownRegion* r = input.region) {
    hasher.add(r->low).add(r->voxel_m).add(r->layer_m).add(r->cells.x).add(r->cells.y).add(r->cells.z);
    hasher.add_all(std::span<const std::uint64_t>(r->bits));
  }
  if (const Transmittance* t = input.light) {
    hasher.add(t->low).add(t->cell_m).add(t->cells.x).add(t->cells.y).add(t->cells.z);
    for (std::size_t i = 0; i < t->level.size(); i += 8) {
      std::uint64_t word = 0;
      for (std::size_t k = i; k < std::min(i + 8, t->level.size()); ++k) word = word << 8 | t->level[k];
      hasher.add(word);
    }
  }
  return hasher.digest();
}

}  // namespace bosquet::growth
