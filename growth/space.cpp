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
#include <limits>
#include <span>

#include "growth/directions.h"
#include "growth/lanes.h"
#include "growth/light.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

// Where a trunk's tip looks on its own axis, in occupancy radii.
constexpr float kAhead = 1.25f;

constexpr std::size_t kFetchAhead = 6;  ///< buds

/// in_region() for many places, ready for use.
class RegionTest {
 public:
  explicit RegionTest(const Tree& tree) : region_(tree.input->region) {
    if (!region_) return;
    low_ = lanes(region_->low);
    edge_ = Float4{region_->voxel_m, region_->layer_m, region_->voxel_m, 1.0f};
    end_ = Float4{static_cast<float>(region_->cells.x), static_cast<float>(region_->cells.y),
                  static_cast<float>(region_->cells.z), 1.0f};
    lid_ = all4(std::numeric_limits<float>::max());
    lid_[1] = tree.input->max_height_m - region_->layer_m;
  }
  bool operator()(Float4 p) const {
    if (!region_) return true;
    p = lid_ < p ? lid_ : p;
    const Float4 q = (p - low_) / edge_;
    const bool inside = all((q >= all4(0.0f)) & (q < end_));
    const Int4 c = whole(inside ? q : all4(0.0f));
    return inside & region_->voxel({c[0], c[1], c[2]});
  }

 private:
  const crowns::CrownRegion* region_;
  Float4 low_{}, edge_{}, end_{}, lid_{};
};

/// Drops the markers of a bud, after `count` others; returns how many there are then.
std::size_t drop(Tree& tree, std::int32_t bud, std::size_t count) {
  Bud& b = tree.buds[static_cast<std::size_t>(bud)];
  b.claims = 0;
  const int markers = 1 + static_cast<int>(tree.parameters->marker_rate * tree.vigor_of(b));
  const Basis basis =
      tree.parameters->planar
          ? Basis{normalised_or({b.direction.y, -b.direction.x, 0.0f}, {1.0f, 0.0f, 0.0f}), Vec3{0.0f, 0.0f, 1.0f}}
          : basis_around(b.direction);
  const Vec3 to_x = tree.occupied_m * basis.x, to_y = tree.occupied_m * basis.y, to_z = tree.occupied_m * b.direction;
  const auto first = static_cast<std::uint32_t>(tree.random.bits()) % PerceptionSamples::kCount;
  DroppedMarkers& d = tree.dropped;
  for (int m = 0; m < markers; m += 4) {
    // Four at once; what is too many of them the next ones overwrite.
    const auto n = first + static_cast<std::uint32_t>(m);
    const Float4 sx = tree.samples.x(n), sy = tree.samples.y(n), sz = tree.samples.z(n);
    const Float4 x = all4(b.at.x) + (sx * all4(to_x.x) + sy * all4(to_y.x) + sz * all4(to_z.x));
    const Float4 y = all4(b.at.y) + (sx * all4(to_x.y) + sy * all4(to_y.y) + sz * all4(to_z.y));
    const Float4 z = all4(b.at.z) + (sx * all4(to_x.z) + sy * all4(to_y.z) + sz * all4(to_z.z));
    store4(&d.x[count], x), store4(&d.y[count], y), store4(&d.z[count], z);
    store4(&d.cell[count], tree.occupancy.cells_of(x, y, z));
    store4(&d.bud[count], Int4{bud, bud, bud, bud});
    count += static_cast<std::size_t>(std::min(4, markers - m));
  }
  return count;
}

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

/// Drops the markers of some buds, from `count` on; returns their end. The others' are not there any more.
std::size_t drop_all(Tree& tree, const RegionTest& in_its_region, std::int32_t bud, std::size_t count) {
  const std::size_t end = drop(tree, bud, count);
  const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
  if (b.order == 0 && b.state == BudState::terminal) look_ahead(tree, in_its_region, bud, count, end);
  return end;
}

void make_room(Tree& tree, std::size_t buds) {
  tree.dropped.make_room(buds * (1 + static_cast<std::size_t>(tree.parameters->marker_rate)) +
                         PerceptionSamples::kMost);
}

/// Looks the markers up, then claims the few that stand: no step waits for another.
void claim_dropped(Tree& tree, const RegionTest& in_its_region, std::size_t count) {
  DroppedMarkers& d = tree.dropped;
  tree.work.markers_tested += count;
  std::size_t free = 0;
  for (std::size_t i = 0; i < count; ++i) {
    d.free[free] = static_cast<std::int32_t>(i);
    free += tree.occupancy.state(d.cell[i]) == 0;
  }

  // Lists are written ahead and grow by 0 or 1: which it is could not be guessed.
  tree.competing.resize(free);
  std::size_t standing = 0, competing = 0;
  std::int32_t last = kNone;
  for (std::size_t k = 0; k < free; ++k) {
    const auto i = static_cast<std::size_t>(d.free[k]);
    const std::int32_t bud = d.bud[i];
    const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    const float ground = b.order == 0 ? 0.0f : tree.input->clear_stem_m;  // the trunk must get there
    const bool stands = (d.y[i] > ground) & in_its_region(Float4{d.x[i], d.y[i], d.z[i], 0.0f});
    d.free[standing] = d.free[k], standing += stands;
    tree.competing[competing] = {b.at, bud, b.direction}, competing += stands & (bud != last);
    last = stands ? bud : last;
  }
  tree.competing.resize(competing);
  tree.competitors.build(tree.competing, tree.reach_m, tree.cos_perception);
  for (std::size_t k = 0; k < standing; ++k) {
    const auto i = static_cast<std::size_t>(d.free[k]);
    const Vec3 marker{d.x[i], d.y[i], d.z[i]};
    const Vec3 to = marker - tree.buds[static_cast<std::size_t>(d.bud[i])].at;
    const std::int32_t winner = tree.competitors.nearest(marker, std::sqrt(glm::dot(to, to)), d.bud[i]);
    claim(tree, winner, normalised_or(marker - tree.buds[static_cast<std::size_t>(winner)].at, Vec3{0.0f}));
  }
}

}  // namespace

void sense(Tree& tree) {
  tree.work.shadow_cells += tree.shadow.settle();
  const bool painted = !tree.input->markers.empty();
  const RegionTest in_its_region(tree);
  make_room(tree, tree.living.size());
  std::size_t living = 0, markers = 0;
  for (std::size_t n = 0; n < tree.living.size(); ++n) {
    const std::int32_t bud = tree.living[n];
    if (n + kFetchAhead < tree.living.size())
      __builtin_prefetch(&tree.buds[static_cast<std::size_t>(tree.living[n + kFetchAhead])]);
    Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    if (b.state == BudState::dead || (b.node >= 0 && !tree.wood.alive(static_cast<std::size_t>(b.node)))) {
      b.state = BudState::dead;
      continue;
    }
    tree.living[living++] = bud;
    sense_light(tree, b);
    if (!painted) markers = drop_all(tree, in_its_region, bud, markers);
  }
  tree.living.resize(living);
  tree.work.bud_visits += living;
  painted ? claim_painted(tree, tree.living) : claim_dropped(tree, in_its_region, markers);
}

void compete_again(Tree& tree) {
  tree.extending.clear();
  for (const GrowingBud& g : tree.growing) tree.extending.push_back(g.bud);
  if (!tree.input->markers.empty()) return claim_painted(tree, tree.extending);
  const RegionTest in_its_region(tree);
  make_room(tree, tree.extending.size());
  std::size_t markers = 0;
  for (const std::int32_t bud : tree.extending) markers = drop_all(tree, in_its_region, bud, markers);
  claim_dropped(tree, in_its_region, markers);
}

}  // namespace bosquet::growth
