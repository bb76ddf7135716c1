#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "crowns/crown_space.h"
#include "crowns/space_layout.h"

namespace bosquet::crowns {
namespace {

// Trees by square cells as wide as the widest trunk reaches.
class TrunkGrid {
 public:
  explicit TrunkGrid(std::span<const Claimant> trees) : trees_(trees) {
    for (const Claimant& t : trees) edge_ = std::max(edge_, static_cast<double>(t.trunk_radius_m()));
    for (std::size_t i = 0; i < trees.size(); ++i) cells_[packed(cell(trees[i].base))].push_back(i);
  }
  template <class Visit>
  void near(Vec2 p, const Visit& visit) const {
    const IVec2 c = cell(p);
    for (int n = -1; n <= 1; ++n)
      for (int e = -1; e <= 1; ++e)
        if (const auto at = cells_.find(packed(c + IVec2{e, n})); at != cells_.end())
          for (std::size_t i : at->second) visit(i);
  }

 private:
  IVec2 cell(Vec2 p) const { return IVec2(glm::floor(DVec2(p) / edge_)); }
  std::span<const Claimant> trees_;
  double edge_ = 0.05;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

void in_trunks(std::span<const Claimant> trees, std::vector<SpaceProblem>& out) {
  const TrunkGrid grid(trees);
  for (const Claimant& t : trees) {
    const Claimant* in = nullptr;
    grid.near(t.base, [&](std::size_t n) {
      const Claimant& other = trees[n];
      const float radius = other.trunk_radius_m(), own = t.trunk_radius_m();
      if (&other == &t || glm::distance(t.base, other.base) >= radius) return;
      const bool other_first = radius > own || (radius == own && std::tie(other.key, other.id) < std::tie(t.key, t.id));
      if (other_first && (!in || other.id < in->id)) in = &other;
    });
    if (in) out.push_back({SpaceProblem::Kind::base_in_trunk, t.id, in->id});
  }
}

}  // namespace

std::vector<SpaceProblem> problems(const CrownSpace& space, Vec2 site_m) {
  using Kind = SpaceProblem::Kind;
  std::vector<SpaceProblem> out;
  const Standing& standing = space.standing();
  const double layer = static_cast<double>(space.layer_m()), voxel = static_cast<double>(space.voxel_m());
  const IVec2 last(glm::ceil(DVec2(site_m) / voxel) - 1.0);
  const auto off_site = [&](IVec2 low, IVec2 high) {
    return high.x < 0 || high.y < 0 || low.x > last.x || low.y > last.y;
  };

  for (const Claimant& t : space.claimants()) {
    const IVec3 base{static_cast<int>(std::floor(static_cast<double>(t.base.x) / voxel)),
                     static_cast<int>(std::floor(static_cast<double>(t.ground_y) / layer)),
                     static_cast<int>(std::floor(static_cast<double>(t.base.y) / voxel))};
    for (const Obstacle& o : standing.obstacles)
      if (holds(*o.volume, base)) {
        out.push_back({Kind::base_in_obstacle, t.id, o.id});
        break;
      }
  }
  in_trunks(space.claimants(), out);
  for (const Obstacle& o : standing.obstacles)
    if (o.volume->spans.empty() || off_site(o.volume->low, o.volume->high))
      out.push_back({Kind::obstacle_off_site, o.id, 0});
  for (const HeroClaim& h : standing.heroes) {
    Box2 box;
    for (const Segment& s : *h.segments) box.add(to_plan(s.from)), box.add(to_plan(s.to));
    if (box.empty() || box.high.x < 0 || box.high.y < 0 || box.low.x > site_m.x || box.low.y > site_m.y)
      out.push_back({Kind::hero_off_site, h.id, 0});
  }
  std::sort(out.begin(), out.end(), [](const SpaceProblem& a, const SpaceProblem& b) {
    return std::tuple(a.kind, std::abs(a.id)) < std::tuple(b.kind, std::abs(b.id));
  });
  return out;
}

}  // namespace bosquet::crowns
