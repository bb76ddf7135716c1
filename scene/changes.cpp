#include "scene/changes.h"

#include <algorithm>

namespace bosquet::scene {
namespace {

// Trees of two documents side by side, by id, without the blocks that both hold.
void compare_trees(const Trees& before, const Trees& after, Changes& out) {
  const auto a = before.blocks(), b = after.blocks();
  std::size_t i = 0, j = 0;        // blocks
  std::size_t in_a = 0, in_b = 0;  // trees in them
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && in_a == 0 && in_b == 0 && a[i] == b[j]) {
      ++i, ++j;
      continue;
    }
    const Tree* old = i < a.size() ? &(*a[i])[in_a] : nullptr;
    const Tree* now = j < b.size() ? &(*b[j])[in_b] : nullptr;
    const bool take_old = old && (!now || old->id <= now->id), take_now = now && (!old || now->id <= old->id);
    if (!take_now)
      out.removed.push_back(old->id);
    else if (!take_old)
      out.added.push_back(now->id);
    else if (old != now && *old != *now)
      out.changed.push_back(now->id);
    if (take_old && ++in_a == a[i]->size()) ++i, in_a = 0;
    if (take_now && ++in_b == b[j]->size()) ++j, in_b = 0;
  }
}

}  // namespace

Changes changes(const Document& before, const Document& after) {
  Changes out;
  out.site = before.seed != after.seed || before.place != after.place;
  if (before.terrain != after.terrain) out.ground = terrain::difference(*before.terrain, *after.terrain);
  if (before.trees != after.trees) compare_trees(*before.trees, *after.trees, out);
  if (!before.species.shares(after.species))
    for (std::size_t s = 0; s < after.species.size(); ++s)
      if (s >= before.species.size() || before.species[s] != after.species[s]) out.species.push_back(s);
  out.fewer_species = after.species.size() < before.species.size();
  out.interactions = before.interactions != after.interactions;
  out.species_bar = before.species_bar != after.species_bar;
  out.obstacles = before.obstacles != after.obstacles;
  out.heroes = before.heroes != after.heroes;
  out.space = before.space != after.space;
  out.asymmetry = before.asymmetry != after.asymmetry;
  out.light = before.light != after.light;
  out.cameras = before.cameras != after.cameras;
  out.figures = before.figures != after.figures;
  out.sun = before.sun != after.sun;
  out.max_triangles = before.max_triangles != after.max_triangles;
  out.clearance = before.clearance != after.clearance;
  out.ground_cover = before.ground_cover != after.ground_cover;
  out.plan = before.plan != after.plan || before.underlay != after.underlay;
  out.counters = before.next_tree_id != after.next_tree_id || before.next_standing_id != after.next_standing_id ||
                 before.next_block != after.next_block;
  return out;
}

}  // namespace bosquet::scene
