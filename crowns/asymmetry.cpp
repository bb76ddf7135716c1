#include "crowns/asymmetry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "core/hash.h"
#include "core/parallel.h"
#include "core/scalar.h"
#include "crowns/update_space.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

constexpr float kStep = 1.0f / 64.0f;  // V is rounded to it
constexpr std::size_t kGrain = 8;

// Square buckets as wide as the farthest that two trees can press each other.
class Neighbourhood {
 public:
  Neighbourhood(std::span<const Claimant> trees, double bucket_m) : bucket_m_(bucket_m) {
    for (std::size_t i = 0; i < trees.size(); ++i) buckets_[key(bucket(trees[i].base))].push_back(i);
  }

  template <class Visit>
  void near(Vec2 base, const Visit& visit) const {
    const IVec2 b = bucket(base);
    for (int n = b.y - 1; n <= b.y + 1; ++n)
      for (int e = b.x - 1; e <= b.x + 1; ++e)
        if (const auto at = buckets_.find(key({e, n})); at != buckets_.end())
          for (std::size_t i : at->second) visit(i);
  }

 private:
  IVec2 bucket(Vec2 base) const {
    return {static_cast<int>(std::floor(static_cast<double>(base.x) / bucket_m_)),
            static_cast<int>(std::floor(static_cast<double>(base.y) / bucket_m_))};
  }
  static std::uint64_t key(IVec2 b) {
    return (std::uint64_t{static_cast<std::uint32_t>(b.y)} << 32) | static_cast<std::uint32_t>(b.x);
  }

  double bucket_m_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> buckets_;
};

// The way from j's base to i's, unit length, (east, north).
DVec2 away(const Claimant& i, const Claimant& j, double distance) {
  if (distance > 0.0) return (DVec2(i.base) - DVec2(j.base)) / distance;
  const bool first = i.key < j.key || (i.key == j.key && i.id < j.id);
  const std::uint64_t low = std::min(i.key, j.key), high = std::max(i.key, j.key);
  RandomStream azimuth(low, high, Purpose::asymmetry);
  const SinCos a = sin_cos(2.0f * kPi * azimuth.uniform());
  return (first ? 1.0 : -1.0) * DVec2(a.cos, a.sin);
}

// Eq. 6.3 summed over the neighbours, which are visited by rising key.
DVec2 pressure(std::span<const Claimant> trees, std::size_t me, const Neighbourhood& neighbourhood,
               const AsymmetryOptions& o) {
  const Claimant& i = trees[me];
  struct Press {
    std::uint64_t key;
    std::int32_t id;
    DVec2 value;
  };
  std::vector<Press> presses;
  neighbourhood.near(i.base, [&](std::size_t n) {
    if (n == me || !trees[n].presses) return;
    const Claimant& j = trees[n];
    const DVec2 between = DVec2(i.base) - DVec2(j.base);
    const double distance = std::sqrt(between.x * between.x + between.y * between.y);
    const double radius = static_cast<double>(o.radius_factor) * 2.0 *
                          static_cast<double>(std::max(i.crown_radius_m(), j.crown_radius_m()));
    const double trunks = static_cast<double>(i.trunk_radius_m() + j.trunk_radius_m());
    const double counted = std::max(distance, trunks);
    if (counted > radius) return;
    const double areas = std::min(static_cast<double>(j.projected_area_m2() / i.projected_area_m2()),
                                  static_cast<double>(o.area_ratio_cap));
    const double weight =
        static_cast<double>(o.area_weight) * areas + static_cast<double>(o.distance_weight) * (1.0 - counted / radius);
    presses.push_back({j.key, j.id, weight * away(i, j, distance)});
  });
  std::sort(presses.begin(), presses.end(),
            [](const Press& a, const Press& b) { return a.key != b.key ? a.key < b.key : a.id < b.id; });
  DVec2 sum{0.0};
  for (const Press& p : presses) sum += p.value;
  return sum;
}

// The same for what stands there.
DVec2 pressure(const CrownSpace& space, const Claimant& i, const AsymmetryOptions& o) {
  const double radius = static_cast<double>(o.radius_factor) * 2.0 * static_cast<double>(i.crown_radius_m());
  const float crown_base = i.ground_y + i.scale_height * i.shape.trunk_height_m;
  DVec2 sum{0.0};
  for (const Obstacle& obstacle : space.standing().obstacles) {
    const auto foot = footprint_beside(*obstacle.volume, space.options().voxel(), i.base, crown_base, radius);
    if (!foot || foot->distance_m == 0.0) continue;  // nothing pushes a tree out of what it stands in
    const double counted = std::max(foot->distance_m, static_cast<double>(i.trunk_radius_m()));
    if (counted > radius) continue;
    const double areas =
        std::min(foot->area_m2 / static_cast<double>(i.projected_area_m2()), static_cast<double>(o.area_ratio_cap));
    const double weight =
        static_cast<double>(o.area_weight) * areas + static_cast<double>(o.distance_weight) * (1.0 - counted / radius);
    sum += weight * (DVec2(i.base) - foot->nearest) / foot->distance_m;
  }
  return sum;
}

DVec2 downhill(const terrain::Terrain& terrain, Vec2 base) {
  const DVec2 rise(terrain.height.gradient(base));
  return -rise / std::sqrt(1.0 + rise.x * rise.x + rise.y * rise.y);
}

// Largest distance from `centre` (columns) to a voxel centre of the share. The farthest of a row is one of its ends.
double farthest(const CrownSpace& space, std::int32_t me, const LayerShare& share, DVec2 centre) {
  double squared = 0;
  for (std::int32_t j = share.low.y; j <= share.high.y; ++j) {
    std::int32_t west = share.high.x + 1, east = share.low.x - 1;
    for (std::int32_t te = share.low.x >> 6; te <= share.high.x >> 6; ++te) {
      const SpaceTile* tile = space.find_tile({te, j >> 6});
      if (!tile || !tile->has(share.layer)) continue;
      const std::int32_t* row = tile->owner.data() + tile->offset(share.layer) + (j & (kTileEdge - 1)) * kTileEdge;
      const std::int32_t from = std::max(share.low.x, te * kTileEdge);
      const std::int32_t to = std::min(share.high.x, te * kTileEdge + kTileEdge - 1);
      for (std::int32_t i = from; i <= to; ++i)
        if (row[i - te * kTileEdge] == me) west = std::min(west, i), east = std::max(east, i);
    }
    if (west > east) continue;
    const double y = j + 0.5 - centre.y;
    const double x = std::max(std::fabs(west + 0.5 - centre.x), std::fabs(east + 0.5 - centre.x));
    squared = std::max(squared, x * x + y * y);
  }
  return std::sqrt(squared);
}

// |T - C| / B averaged over the layers by their voxels.
double displacement(const CrownSpace& space, std::size_t me) {
  const DVec2 base = DVec2(space.claimants()[me].base) / static_cast<double>(space.voxel_m());
  double sum = 0, voxels = 0;
  for (const LayerShare& share : space.shares(me)) {
    const double n = static_cast<double>(share.voxels);
    const DVec2 centre = DVec2(static_cast<double>(share.east_sum), static_cast<double>(share.north_sum)) / n + 0.5;
    const double radius = farthest(space, space.slot_of(me), share, centre);
    const DVec2 offset = base - centre;
    const double distance = std::sqrt(offset.x * offset.x + offset.y * offset.y);
    if (radius > 0.0) sum += n * std::min(1.0, distance / radius);
    voxels += n;
  }
  return voxels > 0.0 ? sum / voxels : 0.0;
}

float rounded(double v) { return static_cast<float>(std::floor(v / static_cast<double>(kStep) + 0.5)) * kStep; }

Vec3 asymmetry(const CrownSpace& space, std::size_t me, const Neighbourhood& neighbourhood,
               const AsymmetryOptions& options, const terrain::Terrain* terrain) {
  const Claimant& tree = space.claimants()[me];
  DVec2 v = pressure(space.claimants(), me, neighbourhood, options) + pressure(space, tree, options);
  if (v.x != 0.0 || v.y != 0.0) v *= displacement(space, me);
  if (terrain && options.slope_weight > 0.0f)
    v += static_cast<double>(options.slope_weight) * downhill(*terrain, tree.base);
  const double length = std::sqrt(v.x * v.x + v.y * v.y), most = static_cast<double>(options.asymmetry_max);
  if (length > most) v *= most / length;
  return {rounded(v.x), 0.0f, rounded(-v.y)};
}

}  // namespace

std::vector<Vec3> neighbourhood_asymmetry(const CrownSpace& space, const AsymmetryOptions& options,
                                          const terrain::Terrain* terrain) {
  const auto trees = space.claimants();
  std::vector<Vec3> out(trees.size(), Vec3{0.0f});
  if (trees.empty()) return out;
  float widest = 0.0f;
  for (const Claimant& t : trees) widest = std::max(widest, 2.0f * t.crown_radius_m());
  const Neighbourhood neighbourhood(trees, static_cast<double>(options.radius_factor) * static_cast<double>(widest));
  parallel_for(
      trees.size(), [&](std::size_t me) { out[me] = asymmetry(space, me, neighbourhood, options, terrain); }, kGrain);
  return out;
}

std::vector<Vec3> update_asymmetry(const CrownSpace& previous, std::span<const Vec3> before, const SpaceUpdate& update,
                                   const AsymmetryOptions& options, const terrain::Terrain* terrain,
                                   std::vector<std::size_t>* changed) {
  const CrownSpace& space = update.space;
  const auto trees = space.claimants();
  std::vector<Vec3> out(trees.size(), Vec3{0.0f});
  std::vector<std::uint8_t> stale(trees.size(), update.whole);

  // What is kept of before, by slot.
  std::vector<std::size_t> was(trees.size(), before.size());
  if (!update.whole)
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const std::int32_t slot = space.slot_of(i);
      if (slot >= previous.slots()) continue;
      const std::int32_t c = previous.claimant_of(slot);
      if (c >= 0 && previous.claimants()[static_cast<std::size_t>(c)].id == trees[i].id)
        was[i] = static_cast<std::size_t>(c), out[i] = before[was[i]];
    }

  // Trees whose region changed, and those that an edit can press or no longer presses.
  for (std::size_t i : update.changed) stale[i] = 1;
  float widest = 0.0f;
  for (const Claimant& t : trees) widest = std::max(widest, 2.0f * t.crown_radius_m());
  const auto radius = [&](const Claimant& a, float width) {
    return options.radius_factor * std::max(2.0f * a.crown_radius_m(), width) + 0.01f;
  };
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Claimant& t = trees[i];
    for (const Claimant& e : update.edits) {
      const float r = radius(t, 2.0f * e.crown_radius_m());
      const float d = glm::distance(t.base, e.base);
      if (d <= r || d <= t.trunk_radius_m() + e.trunk_radius_m()) stale[i] = 1;
    }
    for (const Box2& box : update.obstacle_edits)
      if (glm::distance(t.base, glm::clamp(t.base, box.low, box.high)) <= radius(t, 0.0f) + space.voxel_m())
        stale[i] = 1;
    if (options.slope_weight > 0.0f)
      for (const Box2& box : update.reshaped) stale[i] = stale[i] || box.contains(t.base);
  }

  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < trees.size(); ++i)
    if (stale[i]) todo.push_back(i);
  if (!todo.empty()) {
    const Neighbourhood neighbourhood(trees, static_cast<double>(options.radius_factor) * static_cast<double>(widest));
    parallel_for(
        todo.size(), [&](std::size_t n) { out[todo[n]] = asymmetry(space, todo[n], neighbourhood, options, terrain); },
        kGrain);
  }
  if (changed)
    for (std::size_t i : todo)
      if (was[i] == before.size() || out[i] != before[was[i]]) changed->push_back(i);
  return out;
}

}  // namespace bosquet::crowns
