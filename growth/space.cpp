// Competition for space: markers dropped around buds, refused where wood, ground or other trees are, and claimed.
//
// Source    Longay 2014, 4.2.1 and 4.3.1, fig. 4.4; 6.6 (crown region)
// Decision  in a region narrower than the cone hardly any marker may stand, so the tip of a trunk also drops one
//           straight ahead, or above where its region does not go on ahead: between neighbours a tree grows up, not
//           nowhere
// Decision  a bud drops 1 + floor(marker_rate * v / v_max) markers, v of the last season; before later metamers only
//           the buds still growing drop and claim
#include <algorithm>
#include <cmath>
#include <limits>

#include "growth/lanes.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

// Where a trunk's tip looks on its own axis, in occupancy radii.
constexpr float kAhead = 1.25f;

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
    if (!all((q >= all4(0.0f)) & (q < end_))) return false;
    const Int4 c = whole(q);
    return region_->voxel({c[0], c[1], c[2]});
  }

 private:
  const crowns::CrownRegion* region_;
  Float4 low_{}, edge_{}, end_{}, lid_{};
};

void drop_and_claim(Tree& tree) {
  if (!tree.input->markers.empty()) return claim_painted(tree);
  Buds& buds = tree.buds;
  tree.competitors.build(tree.competing, tree.reach_m, tree.cos_perception);
  const float rate = tree.parameters->marker_rate;
  for (const Competitor& c : tree.competing) {
    const auto b = static_cast<std::size_t>(c.bud);
    buds.claimed[b] = Vec3{0.0f}, buds.claims[b] = 0;
  }
  const RegionTest in_its_region(tree);
  const Float4 radius = all4(tree.occupied_m);
  // First all markers that may stand as far as ground and region know, then wood and buds: many places are looked up at
  // once that way, and none has to wait for what became of the one before.
  std::uint64_t tested = 0;
  tree.dropped.clear();
  for (const Competitor& c : tree.competing) {
    const auto b = static_cast<std::size_t>(c.bud);
    const int markers = 1 + static_cast<int>(rate * buds.vigor[b]);
    const Basis basis =
        tree.parameters->planar
            ? Basis{normalised_or({c.direction.y, -c.direction.x, 0.0f}, {1.0f, 0.0f, 0.0f}), Vec3{0.0f, 0.0f, 1.0f}}
            : basis_around(c.direction);
    const Float4 x = lanes(basis.x), y = lanes(basis.y), direction = lanes(c.direction), at = lanes(c.at);
    const float ground = buds.order[b] == 0 ? 0.0f : tree.input->clear_stem_m;  // the trunk must get there
    std::uint64_t bits = 0;
    int refused = 0;  // by the region
    tested += static_cast<std::uint64_t>(markers);
    for (int m = 0; m < markers; ++m, bits >>= 12) {
      if (m % 5 == 0) bits = tree.random.bits();
      const Float4 offset = radius * tree.samples.at(static_cast<std::uint32_t>(bits), x, y, direction);
      const Float4 marker = at + offset;
      if (marker[1] <= ground) continue;
      if (!in_its_region(marker)) {
        ++refused;
        continue;
      }
      tree.occupancy.expect(marker);
      tree.dropped.push_back({marker, square(offset), c.bud, false});
    }
    if (2 * refused > markers && buds.order[b] == 0 && buds.state[b] == BudState::terminal) {
      for (const Vec3& ahead : {c.direction, kUp}) {
        const Float4 marker = lanes(c.at + kAhead * tree.occupied_m * ahead);
        ++tested;
        if (marker[1] <= ground || !in_its_region(marker) || tree.occupancy.occupied(marker)) continue;
        tree.dropped.push_back({lanes(ahead), 0.0f, c.bud, true});
        break;
      }
    }
  }
  for (const DroppedMarker& d : tree.dropped) {
    if (d.ahead) {
      const auto b = static_cast<std::size_t>(d.bud);
      buds.claimed[b] += vec3(d.at);
      ++buds.claims[b];
      continue;
    }
    if (tree.occupancy.occupied(d.at)) continue;
    const std::int32_t winner = tree.competitors.nearest(vec3(d.at), std::sqrt(d.distance2), d.bud);
    const auto w = static_cast<std::size_t>(winner);
    buds.claimed[w] += normalised_or(vec3(d.at) - buds.at[w], Vec3{0.0f});
    ++buds.claims[w];
  }
  tree.work.markers_tested += tested;
}

}  // namespace

void compete_for_space(Tree& tree) {
  tree.competing.clear();
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    tree.competing.push_back({tree.buds.at[b], bud, tree.buds.direction[b]});
  }
  drop_and_claim(tree);
}

void compete_for_space_again(Tree& tree) {
  tree.competing.clear();
  for (const GrowingBud& g : tree.growing) {
    const auto b = static_cast<std::size_t>(g.bud);
    tree.competing.push_back({tree.buds.at[b], g.bud, tree.buds.direction[b]});
  }
  drop_and_claim(tree);
}

}  // namespace bosquet::growth
