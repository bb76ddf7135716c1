// Painted growth: markers set by hand, and the buds that claim them.
//
// Source    Longay 2014, 4.3.1 (directed growth) and 5.2.1 (the brush); Runions et al. 2007
// Model     a marker stays until wood comes nearer than r; until then it goes, before every metamer, to the nearest bud
//           that perceives it. Buds drop none of their own, and none dies of waiting
// Decision  markers below ground or outside the region are never claimed. Laterals claim none below the clear stem
// Decision  until a marker is perceived for the first time, stems grow on straight as far as the highest one: the trunk
//           of a tree whose crown was painted in the air
#include "growth/directions.h"
#include "growth/tree.h"

namespace bosquet::growth {

void claim_painted(Tree& tree, std::span<const std::int32_t> living) {
  Buds& buds = tree.buds;
  Competitor* const competing = tree.competing.make_room(living.size());
  std::size_t count = 0;
  for (const std::int32_t bud : living) {
    Bud& b = buds[static_cast<std::size_t>(bud)];
    b.claims = 0;
    competing[count++] = {b.at, bud, b.direction};
  }
  tree.competing.keep(count);
  tree.competitors.build(tree.competing, tree.reach_m, tree.cos_perception);
  std::size_t kept = 0;
  for (const Vec3& marker : tree.markers) {
    if (tree.occupancy.occupied(marker)) continue;  // consumed
    tree.markers[kept++] = marker;
    const std::int32_t winner = tree.competitors.nearest(marker, tree.reach_m, kNone);
    if (winner < 0) continue;
    const Bud& w = buds[static_cast<std::size_t>(winner)];
    if (w.order > 0 && marker.y <= tree.input->clear_stem_m) continue;
    claim(tree, winner, normalised_or(marker - w.at, Vec3{0.0f}));
    tree.found_marker = true;
  }
  tree.work.markers_tested += tree.markers.size();
  tree.markers.resize(kept);

  if (tree.found_marker) return;
  for (const std::int32_t bud : living) {
    const Bud& b = buds[static_cast<std::size_t>(bud)];
    if (b.order > 0 || b.state != BudState::terminal || b.at.y >= tree.highest_marker_m) continue;
    claim(tree, bud, b.direction);
  }
}

}  // namespace bosquet::growth
