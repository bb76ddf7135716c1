// Competition for space: markers dropped around buds, refused where wood, ground or other trees are, and claimed.
//
// Source    Longay 2014, 4.2.1 and 4.3.1, fig. 4.4; 6.6 (crown region)
// Decision  in a region narrower than the cone hardly any marker may stand, so the tip of a trunk also drops one
//           straight ahead, or above where its region does not go on ahead: between neighbours a tree grows up, not
//           nowhere
// Decision  before later metamers only the buds still growing drop and claim
// Decision  a bud competes when one of its own markers may stand: who saw no room takes none from those who did
#include <algorithm>
#include <cmath>
#include <span>

#include "growth/directions.h"
#include "growth/dropping.h"
#include "growth/lanes.h"
#include "growth/light.h"
#include "growth/region_test.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

// Where a trunk's tip looks on its own axis, in occupancy radii.
constexpr float kAhead = 1.25f;

/// Where the tip of a trunk has room on its own axis, or above, when its region refuses most of its markers.
void look_ahead(Tree& tree, const RegionTest& in_its_region, const DroppedMarkers::OfBud& dropped) {
  std::size_t refused = 0;
  const DroppedMarkers& d = tree.dropped;
  for (std::size_t i = dropped.first; i < dropped.end; ++i) {
    refused += d.y[i] > 0.0f && !in_its_region(Float4{d.x[i], d.y[i], d.z[i], 0.0f});
  }
  if (2 * refused <= dropped.end - dropped.first) return;
  const Bud& b = tree.buds[static_cast<std::size_t>(dropped.bud)];
  for (const Vec3& ahead : {b.direction, kUp}) {
    const Vec3 marker = b.at + kAhead * tree.occupied_m * ahead;
    ++tree.work.markers_tested;
    if (marker.y <= 0.0f || !in_its_region(lanes(marker)) || tree.occupancy.occupied(marker)) continue;
    claim(tree, dropped.bud, ahead);
    break;
  }
}

/// Forgets the markers and competitors of the last round.
void begin_round(Tree& tree) { tree.dropped.standing.keep(0), tree.competing.keep(0); }

/// Lists the markers of some buds that may stand, and the buds that compete for them.
void drop(Tree& tree, const RegionTest& in_its_region, Dropping& dropping, std::span<const std::int32_t> buds) {
  dropping.drop(buds);
  DroppedMarkers& d = tree.dropped;
  for (const DroppedMarkers::OfBud& dropped : d.of_trunks) look_ahead(tree, in_its_region, dropped);

  // No step waits for another: lists are written ahead and grow by 0 or 1, for which it is could not be guessed.
  const std::size_t count = dropping.count();
  tree.work.markers_tested += count;
  std::size_t free = 0;
  for (std::size_t i = 0; i < count; ++i) {
    d.free[free] = static_cast<std::int32_t>(i);
    free += tree.occupancy.state(d.cell[i]) == 0;
  }
  std::size_t standing = d.standing.size(), competing = tree.competing.size();
  Marker* const markers = d.standing.make_room(standing + free);
  Competitor* const competitors = tree.competing.make_room(competing + free);
  std::int32_t last = kNone;
  for (std::size_t k = 0; k < free; ++k) {
    const auto i = static_cast<std::size_t>(d.free[k]);
    const std::int32_t bud = d.bud[i];
    const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    const float ground = b.order == 0 ? 0.0f : tree.input->clear_stem_m;  // the trunk must get there
    const bool stands = (d.y[i] > ground) & in_its_region(Float4{d.x[i], d.y[i], d.z[i], 0.0f});
    const Vec3 at{d.x[i], d.y[i], d.z[i]}, to = at - b.at;
    markers[standing] = {at, bud, std::sqrt(glm::dot(to, to))}, standing += stands;
    competitors[competing] = {b.at, bud, b.direction}, competing += stands & (bud != last);
    last = stands ? bud : last;
  }
  d.standing.keep(standing), tree.competing.keep(competing);
}

/// Who gets the markers that may stand.
void claim_standing(Tree& tree) {
  tree.competitors.build(tree.competing, tree.reach_m, tree.cos_perception);
  for (Marker& m : tree.dropped.standing) m.bud = tree.competitors.nearest(m.at, m.from_m, m.bud);
  for (const Marker& m : tree.dropped.standing) {
    claim(tree, m.bud, normalised_or(m.at - tree.buds[static_cast<std::size_t>(m.bud)].at, Vec3{0.0f}));
  }
}

/// Of some living buds, those that died, or whose wood fell, leave the list, which is written again from `to` on.
std::size_t weed_out(Tree& tree, std::size_t from, std::size_t end, std::size_t to) {
  const std::uint16_t* const shed = tree.wood.shed.data();
  for (std::size_t n = from; n < end; ++n) {
    const std::int32_t bud = tree.living[n];
    Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    const std::uint16_t* const of_node = b.node < 0 ? &kNever : shed + b.node;
    const bool lives = (b.state != BudState::dead) & (*of_node == kNever);
    if (!lives) b.state = BudState::dead;
    tree.living[to] = bud, to += lives;
  }
  return to;
}

}  // namespace

void sense(Tree& tree) {
  tree.work.shadow_cells += tree.shadow.settle();
  place_buds(tree);
  const bool painted = !tree.input->markers.empty();
  const RegionTest in_its_region(tree);
  Dropping dropping(tree);
  begin_round(tree);
  std::size_t living = 0;
  for (std::size_t n = 0; n < tree.living.size(); n += Dropping::kAtOnce) {
    const std::size_t end = weed_out(tree, n, std::min(n + Dropping::kAtOnce, tree.living.size()), living);
    const std::span<const std::int32_t> buds{tree.living.data() + living, end - living};
    sense_light(tree, buds);
    if (!painted) drop(tree, in_its_region, dropping, buds);
    living = end;
  }
  tree.living.resize(living);
  tree.work.bud_visits += living;
  if (painted) return claim_painted(tree, tree.living);
  claim_standing(tree);
}

void compete_again(Tree& tree) {
  tree.extending.clear();
  for (const GrowingBud& g : tree.growing) tree.extending.push_back(g.bud);
  if (!tree.input->markers.empty()) return claim_painted(tree, tree.extending);
  const RegionTest in_its_region(tree);
  Dropping dropping(tree);
  begin_round(tree);
  const std::span<const std::int32_t> buds(tree.extending);
  for (std::size_t n = 0; n < buds.size(); n += Dropping::kAtOnce) {
    drop(tree, in_its_region, dropping, buds.subspan(n, std::min(Dropping::kAtOnce, buds.size() - n)));
  }
  claim_standing(tree);
}

}  // namespace bosquet::growth
