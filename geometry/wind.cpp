#include "geometry/wind.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/random.h"
#include "geometry/shares.h"

namespace bosquet::geometry {
namespace {

// Thinner wood bends no more: it gives way with its leaves.
constexpr float kThinnest_m = 1e-3f;

// What the way is made of, at the upper end of an internode.
struct Bend {
  float turn = 0, way = 0;

  Bend after(float length, float radius) const {
    const float more = kWindStrain * length / radius;
    return {turn + more, way + (turn + 0.5f * more) * length};
  }
};

std::uint8_t phase_of(std::uint64_t key, std::uint64_t which) {
  return static_cast<std::uint8_t>(mix_bits(mix_bits(key) + which) >> 56);
}

Rgba8 weights(float of_tree, float of_limb, std::uint8_t phase) { return {unorm8(of_tree), unorm8(of_limb), 0, phase}; }

/// `share` of the way from one place to the next above it, which has the phase of both.
Rgba8 between(const TreeWind::Way& low, const TreeWind::Way& high, float share) {
  return weights(low.of_tree + share * (high.of_tree - low.of_tree), low.of_limb + share * (high.of_limb - low.of_limb),
                 high.phase);
}

TreeWind::Way foot_of(const TreeWind& wind, const growth::Skeleton& skeleton, std::uint32_t internode) {
  const std::int32_t below = skeleton.parent[internode];
  return below < 0 ? TreeWind::Way{} : wind.ways[static_cast<std::size_t>(below)];
}

}  // namespace

Rgba8 TreeWind::on(const growth::Skeleton& skeleton, std::uint32_t internode, float at) const {
  return between(foot_of(*this, skeleton, internode), ways[internode], at);
}

TreeWind tree_wind(const growth::Skeleton& skeleton, std::span<const float> radius, const ThickestPaths& paths,
                   std::uint64_t key) {
  assert(radius.size() == skeleton.size());
  TreeWind wind;
  wind.ways.resize(skeleton.size());
  std::vector<Bend> of_tree(skeleton.size()), of_limb(skeleton.size());
  std::vector<std::int32_t> limb(paths.paths.size(), -1);  // the limb that a path belongs to; -1: a stem
  float highest = 0.0f;
  std::uint32_t top = 0;
  for (std::size_t p = 0; p < paths.paths.size(); ++p) {
    const ThickestPaths::Path& path = paths.paths[p];
    const auto run = paths.of(path);
    if (path.parent >= 0) {
      const std::int32_t below = limb[static_cast<std::size_t>(path.parent)];
      limb[p] = below >= 0 ? below : static_cast<std::int32_t>(run[0]);
    }
    // A limb is known by the internode it begins with, so that it keeps its phase when others go.
    const bool stem = limb[p] < 0;
    const std::uint8_t phase =
        phase_of(key, stem ? 0 : 1 + std::uint64_t{skeleton.number_of(static_cast<std::uint32_t>(limb[p]))});
    for (const std::uint32_t i : run) {
      const std::int32_t below = skeleton.parent[i];
      const Vec3 d = skeleton.distal[i] - skeleton.proximal(i);
      const float length = std::sqrt(glm::dot(d, d)), wood = std::max(radius[i], kThinnest_m);
      const auto from = [&](const std::vector<Bend>& bends) {
        return below < 0 ? Bend{} : bends[static_cast<std::size_t>(below)];
      };
      of_tree[i] = from(of_tree).after(length, wood);
      if (!stem) of_limb[i] = from(of_limb).after(length, wood);
      wind.ways[i].phase = phase;
      wind.longest_m = std::max(wind.longest_m, of_tree[i].way);
      if (skeleton.distal[i].y > highest) highest = skeleton.distal[i].y, top = i;
    }
  }
  if (!(wind.longest_m > 0.0f)) return wind;
  for (const std::uint32_t i : paths.internodes) {
    wind.ways[i].of_tree = of_tree[i].way / wind.longest_m;
    wind.ways[i].of_limb = of_limb[i].way / wind.longest_m;
  }
  wind.top = wind.ways[top].of_tree;
  return wind;
}

std::vector<Rgba8> curve_wind(const TreeWind& wind, const growth::Skeleton& skeleton, const ThickestPaths& paths,
                              const BranchCurves& curves) {
  assert(curves.curves.size() == paths.paths.size());
  std::vector<Rgba8> out(curves.samples.size());
  for (std::size_t p = 0; p < paths.paths.size(); ++p) {
    const BranchCurve& curve = curves.curves[p];
    const auto run = paths.of(paths.paths[p]);
    if (curve.count == 0) continue;
    // Evenly by length between the samples where two nodes lie; nodes inside the parent have no place of their own.
    std::uint32_t from = curve.first;
    TreeWind::Way low = foot_of(wind, skeleton, run[0]);
    for (std::size_t k = 0; k < run.size(); ++k) {
      const std::uint32_t last = curve.first + curve.count - 1;
      const std::uint32_t to = k + 1 == run.size() ? last : std::min(curves.node_sample[run[k]], last);
      if (to == from) continue;
      const TreeWind::Way& high = wind.ways[run[k]];
      const float begin_m = std::max(0.0f, curves.samples[from].along), end_m = curves.samples[to].along;
      for (std::uint32_t s = from; s <= to; ++s) {
        const float along_m = curves.samples[s].along;
        out[s] = between(low, high, along_m < end_m ? std::max(0.0f, along_m - begin_m) / (end_m - begin_m) : 1.0f);
      }
      from = to, low = high;
    }
  }
  return out;
}

void lean_with_height(TriangleMesh& cards, const TreeWind& wind) {
  const Box3 box = cards.bounds();
  cards.wind.clear();
  for (const Vec3& p : cards.positions)
    cards.wind.push_back(weights(wind.top * std::clamp(p.y / std::max(box.high.y, 1e-3f), 0.0f, 1.0f), 0.0f, 0));
}

}  // namespace bosquet::geometry
