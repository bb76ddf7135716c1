// Competition for space: markers dropped around buds, refused where wood, ground or other trees are, and claimed.
//
// Source    Longay 2014, 4.2.1 and 4.3.1, fig. 4.4; 6.6 (crown region)
// Decision  in a region narrower than the cone hardly any marker may stand, so the tip of a trunk also drops one
//           straight ahead, or above where its region does not go on ahead: between neighbours a tree grows up, not
//           nowhere
// Decision  a bud drops 1 + floor(marker_rate * v / v_max) markers, v of the last season; before later metamers only
//           the buds still growing drop and claim
// Decision  a bud competes when one of its own markers may stand: who saw no room takes none from those who did
#include <algorithm>
#include <cmath>
#include <span>

#include "growth/directions.h"
#include "growth/lanes.h"
#include "growth/light.h"
#include "growth/region_test.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

// Where a trunk's tip looks on its own axis, in occupancy radii.
constexpr float kAhead = 1.25f;

constexpr std::size_t kAtOnce = 64;  ///< buds whose markers stay in the first-level cache until they are looked up

/// Makes the markers of one bud after another; what they are made of stands beside each other. Begins a round.
class Dropping {
 public:
  explicit Dropping(Tree& tree)
      : buds_(tree.buds.each.data()),
        samples_(tree.samples.reader()),
        cell_of_(tree.occupancy.cell_finder()),
        random_(tree.random),
        occupied_m_(tree.occupied_m),
        rate_(tree.parameters->marker_rate),
        greatest_(tree.greatest_vigor),
        planar_(tree.parameters->planar) {
    DroppedMarkers& d = tree.dropped;
    d.make_room(kAtOnce * (1 + static_cast<std::size_t>(rate_)) + PerceptionSamples::kMost);
    d.standing.keep(0), tree.competing.keep(0);
    x_ = d.x.data(), y_ = d.y.data(), z_ = d.z.data(), cell_ = d.cell.data(), bud_ = d.bud.data();
  }

  void drop(std::int32_t bud) {
    Bud& b = buds_[bud];
    b.claims = 0;
    const int markers = 1 + static_cast<int>(rate_ * share_of(b.flow, greatest_));
    const Vec3 at = b.at, along = b.direction;
    const Basis basis =
        planar_ ? Basis{normalised_or({along.y, -along.x, 0.0f}, {1.0f, 0.0f, 0.0f}), Vec3{0.0f, 0.0f, 1.0f}}
                : basis_around(along);
    const Vec3 to_x = occupied_m_ * basis.x, to_y = occupied_m_ * basis.y, to_z = occupied_m_ * along;
    const auto first = static_cast<std::uint32_t>(random_.bits()) % PerceptionSamples::kCount;
    for (int m = 0; m < markers; m += 4) {
      // Four at once; what is too many of them the next ones overwrite.
      const auto n = first + static_cast<std::uint32_t>(m);
      const Float4 sx = samples_.x(n), sy = samples_.y(n), sz = samples_.z(n);
      const Float4 x = all4(at.x) + (sx * all4(to_x.x) + sy * all4(to_y.x) + sz * all4(to_z.x));
      const Float4 y = all4(at.y) + (sx * all4(to_x.y) + sy * all4(to_y.y) + sz * all4(to_z.y));
      const Float4 z = all4(at.z) + (sx * all4(to_x.z) + sy * all4(to_y.z) + sz * all4(to_z.z));
      store4(x_ + count_, x), store4(y_ + count_, y), store4(z_ + count_, z);
      store4(cell_ + count_, cell_of_(x, y, z));
      store4(bud_ + count_, Int4{bud, bud, bud, bud});
      count_ += static_cast<std::size_t>(std::min(4, markers - m));
    }
  }
  void forget() { count_ = 0; }
  std::size_t count() const { return count_; }
  const RandomStream& random() const { return random_; }

 private:
  Bud* buds_;
  PerceptionSamples::Reader samples_;
  Occupancy::CellFinder cell_of_;
  RandomStream random_;
  float occupied_m_, rate_, greatest_;
  bool planar_;
  float *x_, *y_, *z_;
  std::int32_t *cell_, *bud_;
  std::size_t count_ = 0;
};

/// Where the tip of a trunk has room on its own axis, or above, when its region refuses most of its markers.
void look_ahead(Tree& tree, const RegionTest& in_its_region, std::int32_t bud, std::size_t first, std::size_t end) {
  std::size_t refused = 0;
  const DroppedMarkers& d = tree.dropped;
  for (std::size_t i = first; i < end; ++i) {
    refused += d.y[i] > 0.0f && !in_its_region(Float4{d.x[i], d.y[i], d.z[i], 0.0f});
  }
  if (2 * refused <= end - first) return;
  const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
  for (const Vec3& ahead : {b.direction, kUp}) {
    const Vec3 marker = b.at + kAhead * tree.occupied_m * ahead;
    ++tree.work.markers_tested;
    if (marker.y <= 0.0f || !in_its_region(lanes(marker)) || tree.occupancy.occupied(marker)) continue;
    claim(tree, bud, ahead);
    break;
  }
}

/// Drops the markers of some buds and lists those that may stand.
void drop(Tree& tree, const RegionTest& in_its_region, Dropping& dropping, std::span<const std::int32_t> buds) {
  dropping.forget();
  for (const std::int32_t bud : buds) {
    const std::size_t first = dropping.count();
    dropping.drop(bud);
    const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    if (b.order == 0 && b.state == BudState::terminal) look_ahead(tree, in_its_region, bud, first, dropping.count());
  }

  // No step waits for another: lists are written ahead and grow by 0 or 1, for which it is could not be guessed.
  DroppedMarkers& d = tree.dropped;
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
  std::size_t living = 0;
  for (std::size_t n = 0; n < tree.living.size(); n += kAtOnce) {
    const std::size_t end = weed_out(tree, n, std::min(n + kAtOnce, tree.living.size()), living);
    const std::span<const std::int32_t> buds{tree.living.data() + living, end - living};
    sense_light(tree, buds);
    if (!painted) drop(tree, in_its_region, dropping, buds);
    living = end;
  }
  tree.living.resize(living);
  tree.work.bud_visits += living;
  if (painted) return claim_painted(tree, tree.living);
  tree.random = dropping.random();
  claim_standing(tree);
}

void compete_again(Tree& tree) {
  tree.extending.clear();
  for (const GrowingBud& g : tree.growing) tree.extending.push_back(g.bud);
  if (!tree.input->markers.empty()) return claim_painted(tree, tree.extending);
  const RegionTest in_its_region(tree);
  Dropping dropping(tree);
  const std::span<const std::int32_t> buds(tree.extending);
  for (std::size_t n = 0; n < buds.size(); n += kAtOnce) {
    drop(tree, in_its_region, dropping, buds.subspan(n, std::min(kAtOnce, buds.size() - n)));
  }
  tree.random = dropping.random();
  claim_standing(tree);
}

}  // namespace bosquet::growth
