#include "geometry/branch_curve.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/scalar.h"

namespace bosquet::geometry {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

// What a ring's absence may cost at coarseness 1: an error of centre or radius of 3 mm and a sixteenth of the radius.
constexpr float kTolerance_m = 0.003f;
constexpr float kToleranceOfRadius = 0.06f;

// Wood of this radius or, where there is thinner wood, the thinnest, has three sides.
constexpr float kTipRadius_m = 0.004f;

// Rings are wanted at least so often, so that tints by height and occlusion can change along a straight trunk.
constexpr float kLongestSpan_m = 2.0f;

struct Node {
  Vec3 at;
  float wood;
  float light;
};

float length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

Vec3 direction(const Vec3& v, const Vec3& otherwise) {
  const float l = length(v);
  return l > 1e-6f ? v / l : otherwise;
}

/// Moves inner nodes of thick wood toward their neighbours' middle: bends rounder than the wood is thick.
void smooth(std::vector<Node>& nodes, std::size_t fixed) {
  constexpr int kPasses = 3;
  std::vector<Vec3> moved(nodes.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    bool any = false;
    for (std::size_t j = fixed; j + 1 < nodes.size(); ++j) {
      const float step = length(nodes[j + 1].at - nodes[j].at);
      const float weight = std::min(0.5f, 0.5f * nodes[j].wood / std::max(step, kLeastStep_m));
      const bool thick = weight > 0.05f;
      moved[j] = thick ? glm::mix(nodes[j].at, 0.5f * (nodes[j - 1].at + nodes[j + 1].at), weight) : nodes[j].at;
      any = any || thick;
    }
    if (!any) return;
    for (std::size_t j = fixed; j + 1 < nodes.size(); ++j) nodes[j].at = moved[j];
  }
}

/// Velocity of a centripetal Catmull-Rom curve at `b` between neighbours `a` and `c`, for parameter steps of the square
/// root of the distances; times `step` it is a Hermite tangent of a segment that long in parameter.
Vec3 velocity(const Vec3& a, const Vec3& b, const Vec3& c) {
  const float before = std::sqrt(std::max(length(b - a), kLeastStep_m));
  const float after = std::sqrt(std::max(length(c - b), kLeastStep_m));
  return (b - a) / before - (c - a) / (before + after) + (c - b) / after;
}

struct Hermite {
  Vec3 p, q, m, n;  // ends and their tangents
  Vec3 at(float t) const {
    const float s = 1.0f - t;
    return (1.0f + 2.0f * t) * s * s * p + t * s * s * m + t * t * (3.0f - 2.0f * t) * q - t * t * s * n;
  }
  Vec3 slope(float t) const {
    const float s = 1.0f - t;
    return 6.0f * t * s * (q - p) + s * (1.0f - 3.0f * t) * m + t * (3.0f * t - 2.0f) * n;
  }
};

/// Hermite pieces through the nodes; the first begins with `start` as its direction.
Hermite piece(const std::vector<Node>& nodes, std::size_t j, const Vec3& start) {
  const Vec3 &p = nodes[j].at, &q = nodes[j + 1].at;
  const float step = std::sqrt(std::max(length(q - p), kLeastStep_m));
  const Vec3 m = j > 0 ? step * velocity(nodes[j - 1].at, p, q) : start * length(q - p);
  const Vec3 n = j + 2 < nodes.size() ? step * velocity(p, q, nodes[j + 2].at) : 1.5f * (q - p) - 0.5f * m;
  return {p, q, m, n};
}

/// Adds a sample unless it stands on the last one.
void add(std::vector<BranchSample>& samples, std::size_t first, const BranchSample& sample) {
  if (samples.size() > first && sample.along - samples.back().along < kLeastStep_m) return;
  samples.push_back(sample);
}

/// Sets `matters` of all samples of a path (Douglas-Peucker, with an explicit stack).
void rank(std::span<BranchSample> path) {
  path.front().matters = path.back().matters = kInfinite;
  struct Span {
    std::size_t a, b;
    float limit;
  };
  std::vector<Span> stack{{0, path.size() - 1, kInfinite}};
  while (!stack.empty()) {
    const auto [a, b, limit] = stack.back();
    stack.pop_back();
    if (b - a < 2) continue;
    const BranchSample &p = path[a], &q = path[b];
    float worst = 0.0f;
    std::size_t at = a + 1;
    for (std::size_t j = a + 1; j < b; ++j) {
      const float t = (path[j].along - p.along) / (q.along - p.along);
      const float off = length(path[j].centre - glm::mix(p.centre, q.centre, t));
      const float saddle = length(path[j].saddle - glm::mix(p.saddle, q.saddle, t));
      const float wide = 2.0f * (std::abs(path[j].radius - glm::mix(p.radius, q.radius, t)) + saddle);
      const float error = std::max(off, wide) / (kTolerance_m + kToleranceOfRadius * path[j].wood);
      if (error > worst) worst = error, at = j;
    }
    const float span = q.along - p.along;
    if (span > kLongestSpan_m && worst < span / kLongestSpan_m) {
      worst = span / kLongestSpan_m;
      at = (a + b) / 2;
    }
    if (worst < 1.0f) continue;  // no coarseness asks for it
    path[at].matters = std::min(worst, limit);
    stack.push_back({a, at, path[at].matters});
    stack.push_back({at, b, path[at].matters});
  }
}

/// Where a child leaves its parent.
struct Fork {
  Vec3 node{0.0f};
  Vec3 heading = kUp;
  float radius = 0;                        // of the parent there
  std::span<const BranchSample> parent{};  // the part of its curve near the node

  /// Metres outside the parent's surface, below 0 inside.
  float outside(const Vec3& p) const {
    float least = kInfinite;
    for (std::size_t k = 1; k < parent.size(); ++k) {
      const BranchSample &a = parent[k - 1], &b = parent[k];
      const Vec3 step = b.centre - a.centre;
      const float t = std::clamp(glm::dot(p - a.centre, step) / glm::dot(step, step), 0.0f, 1.0f);
      least = std::min(least, length(p - a.centre - t * step) - glm::mix(a.radius, b.radius, t));
    }
    return least;
  }
};

/// How far a ring would stick out of the parent, metres; 0 when it is inside.
float protrusion(const Fork& fork, const BranchSample& ring) {
  const Vec3 level = glm::cross(ring.tangent, std::abs(ring.tangent.y) < 0.9f ? kUp : Vec3{1, 0, 0});
  const Vec3 a = direction(level, Vec3{1, 0, 0}), b = glm::cross(ring.tangent, a);
  float most = 0.0f;
  for (const float x : {-1.0f, -0.70710678f, 0.0f, 0.70710678f, 1.0f}) {
    const float y = std::sqrt(1.0f - x * x);
    for (const float side : {y, -y})
      most = std::max(most, fork.outside(ring.centre + ring.radius * (x * a + side * b)));
  }
  return most;
}

/// The samples of a curve within `reach` metres of sample `at`, at least one on either side.
std::span<const BranchSample> around(std::span<const BranchSample> curve, std::size_t at, float reach) {
  std::size_t low = at, high = at;
  while (low > 0 && (low == at || curve[at].along - curve[low].along < reach)) --low;
  while (high + 1 < curve.size() && (high == at || curve[high].along - curve[at].along < reach)) ++high;
  return curve.subspan(low, high - low + 1);
}

}  // namespace

BranchCurves branch_curves(const growth::Skeleton& skeleton, std::span<const float> radius, const ThickestPaths& paths,
                           const BranchShape& shape) {
  assert(radius.size() == skeleton.size());
  BranchCurves result;
  result.curves.reserve(paths.paths.size());
  result.samples.reserve(3 * paths.internodes.size());
  result.tip_radius = kTipRadius_m;

  // Of each internode's upper end, for its children: where the curve passes, in which direction, at which sample.
  std::vector<Vec3> node_at(skeleton.size());
  std::vector<Vec3> node_heading(skeleton.size());
  std::vector<std::uint32_t>& node_sample = result.node_sample;
  node_sample.resize(skeleton.size());
  std::vector<Node> nodes;
  std::vector<BranchSample> parent_samples;

  for (const ThickestPaths::Path& path : paths.paths) {
    const auto run = paths.of(path);
    const bool stem = path.parent < 0;
    Fork fork;
    float base_light = skeleton.light[run[0]];
    if (!stem) {
      const std::uint32_t below = paths.internodes[path.node];
      fork = {node_at[below], node_heading[below], std::max(radius[below], 1e-4f), {}};
      const BranchCurve& parent = result.curves[static_cast<std::size_t>(path.parent)];
      if (parent.count > 0) {
        const auto near = around(result.of(parent), node_sample[below] - parent.first, 3.0f * fork.radius);
        parent_samples.assign(near.begin(), near.end());  // a copy: more samples are about to be added
        fork.parent = parent_samples;
      }
      base_light = skeleton.light[below];
    }

    // The path's nodes from its base, smoothed.
    nodes.clear();
    nodes.push_back({fork.node, radius[run[0]], base_light});
    for (std::uint32_t i : run) nodes.push_back({skeleton.distal[i], std::max(radius[i], 1e-4f), skeleton.light[i]});
    smooth(nodes, 1);
    for (std::size_t j = 0; j < run.size(); ++j) {
      const Vec3& after = nodes[std::min(j + 2, nodes.size() - 1)].at;
      node_at[run[j]] = nodes[j + 1].at;
      node_heading[run[j]] = direction(after - nodes[j].at, kUp);
    }
    result.tip_radius = std::min(result.tip_radius, nodes.back().wood);

    // Where the curve begins: under the ground, or inside the parent with the nodes that lie in the parent left out.
    BranchCurve curve;
    curve.first = static_cast<std::uint32_t>(result.samples.size());
    curve.parent = path.parent;
    curve.base_radius = nodes.front().wood = std::max(radius[run[0]], 1e-4f);
    Vec3 start = kUp;
    float along = 0.0f;
    std::size_t skipped = 0;
    if (stem) {
      const float depth = 0.04f + curve.base_radius;
      nodes.insert(nodes.begin(), {nodes.front().at - depth * kUp, curve.base_radius, base_light});
      along = -depth;
    } else {
      while (skipped + 2 < nodes.size() && fork.outside(nodes[skipped + 1].at) < 0.0f) ++skipped;
      nodes.erase(nodes.begin() + 1, nodes.begin() + 1 + static_cast<std::ptrdiff_t>(skipped));
      const Vec3 leaving = direction(nodes[1].at - fork.node, fork.heading);
      const float along_parent = std::max(0.0f, glm::dot(leaving, fork.heading));
      nodes.front().at -= along_parent * std::min(0.7f * fork.radius, 0.1f) * fork.heading;
      start = direction(leaving + along_parent * fork.heading, leaving);
    }

    // Sample the curve, closely where it leaves the parent or the ground.
    const float flare_top = std::min(shape.root_flare_height * curve.base_radius, kFlareTop_m);
    const float collar = shape.collar_length * curve.base_radius;
    bool in_collar = !fork.parent.empty();
    float room = std::max(curve.base_radius, 0.92f * fork.radius);  // widest that the parent can hide
    Vec3 last = nodes.front().at;
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) {
      const Hermite h = piece(nodes, j, start);
      const float wood = nodes[j].wood;
      int steps = wood > 0.02f ? 4 : wood > 0.006f ? 3 : 2;
      if (!stem && j == 0) steps = wood > 0.008f ? 16 : 4;
      if (stem && along < flare_top) steps = 8;
      for (int k = j == 0 ? 0 : 1; k <= steps; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(steps);
        BranchSample s;
        s.centre = h.at(t);
        s.tangent = direction(h.slope(t), direction(h.q - h.p, kUp));
        along += length(s.centre - last);
        last = s.centre;
        s.along = along;
        s.wood = glm::mix(nodes[j].wood, nodes[j + 1].wood, t);
        s.light = glm::mix(nodes[j].light, nodes[j + 1].light, t);
        s.radius = s.wood;
        if (stem) {
          const float x = 1.0f - std::clamp(s.along / flare_top, 0.0f, 1.0f);
          s.radius = s.wood + std::min(shape.root_flare * curve.base_radius, 0.3f * flare_top) * x * x * x;
        } else if (in_collar) {
          const float outside = fork.outside(s.centre);
          const float x = 1.0f - std::clamp(outside / collar, 0.0f, 1.0f);
          // A steep branch lies against its parent anyway: a wide collar would show as a chin below it.
          const float steep = std::max(0.0f, glm::dot(s.tangent, fork.heading));
          s.radius = std::min(s.wood * (1.0f + shape.collar * (1.0f - 0.8f * steep) * x * x), room);
          const float hidden = 1.0f + std::clamp(outside / fork.radius, -1.0f, 0.0f);
          s.saddle = std::min(shape.saddle * s.wood, 0.8f * fork.radius) * x * x * x * hidden * hidden * fork.heading;
          s.crotch = x * x * x;
          if (j == 0 && k == 0) {
            s.radius = std::max(0.6f * s.wood, s.radius - protrusion(fork, s));
            room = std::max(s.wood, s.radius);
          }
          in_collar = outside < collar;
        }
        add(result.samples, curve.first, s);
      }
      const std::size_t place = stem ? j : j + 1 + skipped;  // of the node just reached among the path's, from 1
      if (place > 0) node_sample[run[place - 1]] = static_cast<std::uint32_t>(result.samples.size()) - 1;
    }
    for (std::size_t k = 0; k < skipped; ++k) node_sample[run[k]] = curve.first;

    curve.count = static_cast<std::uint32_t>(result.samples.size()) - curve.first;
    if (curve.count < 2) {  // a path without length
      result.samples.resize(curve.first);
      curve.count = 0;
    } else {
      rank({result.samples.data() + curve.first, curve.count});
      const auto samples = result.of(curve);
      for (std::size_t k = 1; k < samples.size(); ++k)
        curve.weight += 2.0f * kPi * samples[k].wood * (samples[k].along - samples[k - 1].along);
    }
    result.curves.push_back(curve);
  }

  for (std::size_t c = result.curves.size(); c-- > 0;) {
    const BranchCurve& curve = result.curves[c];
    if (curve.parent >= 0) result.curves[static_cast<std::size_t>(curve.parent)].weight += curve.weight;
  }
  return result;
}

}  // namespace bosquet::geometry
