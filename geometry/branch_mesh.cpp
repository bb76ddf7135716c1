#include "geometry/branch_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <span>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/shares.h"

namespace bosquet::geometry {
namespace {

// Side counts in use: few different ones, so that neighbouring rings mostly agree and need no stitching.
constexpr std::array<int, 11> kSides{3, 4, 5, 6, 8, 10, 12, 16, 20, 24, kMostSides};

// Up to this coarseness all branches are kept; beyond, whole branches go before the limbs become crude.
constexpr float kCoarsestWhole = 8.0f;

// Coarser than this, or thinner, a tip is the point of a cone; else a ring with a cap.
constexpr float kCapsUpTo = 2.0f;
constexpr float kThinTip_m = 0.006f;

// The bark turns around a branch by so much of a tile for each tile along it.
constexpr float kBarkTurn = 0.04f;

// So much light is lost where a branch leaves its parent.
constexpr float kCrotchShade = 0.2f;

// Bark is drawn at most so many times smaller than life.
constexpr float kSmallestBark = 1.0f / 12.0f;

struct Ring {
  std::uint32_t sample;
  int sides;
};

struct Rings {
  std::vector<Ring> rings;
  bool capped = false;  ///< a ring at the tip and an apex beyond; else the tip itself is the apex
  std::size_t triangles() const {
    std::size_t sum = static_cast<std::size_t>(rings.back().sides);
    for (std::size_t k = 1; k < rings.size(); ++k) sum += static_cast<std::size_t>(rings[k - 1].sides + rings[k].sides);
    return sum;
  }
  std::size_t vertices() const {  // a ring begins and ends at one place; then the apex
    std::size_t sum = 1;
    for (const Ring& ring : rings) sum += static_cast<std::size_t>(ring.sides) + 1;
    return sum;
  }
};

/// Eq. C.2 with n = 2, divided by sqrt(coarseness).
int sides_of(float wood, float tip_radius, float coarseness) {
  const float wanted = 3.0f * std::sqrt(wood / (tip_radius * coarseness));
  int sides = kSides[0];
  for (int s : kSides)
    if (static_cast<float>(s) <= wanted + 0.5f) sides = s;
  return sides;
}

/// Which rings a curve has at this coarseness.
void select_rings(std::span<const BranchSample> path, float tip_radius, float coarseness, Rings& out) {
  out.rings.clear();
  const BranchSample& tip = path.back();
  out.capped = coarseness <= kCapsUpTo && tip.radius > kThinTip_m;
  const std::size_t end = out.capped ? path.size() : path.size() - 1;

  for (std::size_t k = 0; k < end; ++k) {
    const BranchSample& s = path[k];
    const bool last = k + 1 == path.size();
    if (!(s.matters > coarseness)) continue;
    // Rings tilted against each other closer than their width would cut each other. Rather one less.
    const auto crossing = [&](const Ring& below) {
      const BranchSample& b = path[below.sample];
      const Vec3 step = s.centre - b.centre, tilt = s.tangent - b.tangent;
      const float saddle = std::max(std::abs(glm::dot(s.saddle, tilt)), std::abs(glm::dot(b.saddle, tilt)));
      const float reach = 1.1f * (std::max(s.radius, b.radius) * std::sqrt(glm::dot(tilt, tilt)) + saddle);
      return glm::dot(step, step) < reach * reach;
    };
    if (!last && !out.rings.empty() && crossing(out.rings.back())) continue;
    while (last && out.rings.size() > 1 && crossing(out.rings.back())) out.rings.pop_back();
    out.rings.push_back({static_cast<std::uint32_t>(k), sides_of(s.wood, tip_radius, coarseness)});
  }
}

const SinCos* circle(int sides) {
  static const auto table = [] {
    std::array<std::array<SinCos, kMostSides + 1>, kMostSides + 1> t{};
    for (int n = 3; n <= kMostSides; ++n)
      for (int k = 0; k <= n; ++k)
        t[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)] =
            sin_cos(2.0f * kPi * static_cast<float>(k % n) / static_cast<float>(n));
    return t;
  }();
  return table[static_cast<std::size_t>(sides)].data();
}

struct Frame {
  Vec3 normal, binormal;
};

Frame first_frame(const Vec3& tangent, const Vec3& toward) {
  Vec3 n = toward - glm::dot(toward, tangent) * tangent;
  if (glm::dot(n, n) < 1e-4f) n = Vec3{1, 0, 0} - tangent.x * tangent;
  if (glm::dot(n, n) < 1e-4f) n = Vec3{0, 0, 1} - tangent.z * tangent;
  n = glm::normalize(n);
  return {n, glm::cross(tangent, n)};
}

/// Carries the frame from one ring to the next without twist (Wang et al. 2008).
Frame carried(const Frame& frame, const BranchSample& from, const BranchSample& to) {
  const Vec3 v = to.centre - from.centre;
  const float c = glm::dot(v, v);
  if (c < 1e-12f) return first_frame(to.tangent, frame.normal);
  const Vec3 n = frame.normal - (2.0f / c) * glm::dot(v, frame.normal) * v;
  const Vec3 t = from.tangent - (2.0f / c) * glm::dot(v, from.tangent) * v;
  const Vec3 w = to.tangent - t;
  const float d = glm::dot(w, w);
  return first_frame(to.tangent, d < 1e-12f ? n : n - (2.0f / d) * glm::dot(w, n) * w);
}

/// bark_tint() looked up: an eighth of an octave of diameter and an eighth of the foot's height share a value.
class Tints {
 public:
  explicit Tints(const Look& look) : look_(look), table_(kDiameters * kHeights, Vec3(-1.0f)) {}

  Vec3 at(float diameter_m, float height_m) {
    const float foot = look_.bark.base_height_m;
    const auto h = height_m < foot ? static_cast<std::uint32_t>(8.0f * std::max(0.0f, height_m) / foot) : 8u;
    const std::uint32_t eighths = std::bit_cast<std::uint32_t>(std::clamp(diameter_m, 1.0f / 8192.0f, 7.9f)) >> 20;
    Vec3& tint = table_[(eighths - kLeast) * kHeights + std::min(h, 8u)];
    if (tint.x < 0.0f)
      tint = bark_tint(look_, std::bit_cast<float>(eighths << 20 | 1u << 19),
                       h < 8u ? (static_cast<float>(h) + 0.5f) * foot / 8.0f : height_m);
    return tint;
  }

 private:
  static constexpr std::uint32_t kHeights = 9, kLeast = std::bit_cast<std::uint32_t>(1.0f / 8192.0f) >> 20;
  static constexpr std::uint32_t kDiameters = (std::bit_cast<std::uint32_t>(8.0f) >> 20) - kLeast;
  const Look& look_;
  std::vector<Vec3> table_;
};

class Mesher {
 public:
  Mesher(const Look& look, std::size_t triangles, std::size_t vertices, bool windy) : look_(look), tints_(look) {
    mesh.positions.reserve(vertices), mesh.normals.reserve(vertices), mesh.uvs.reserve(vertices);
    mesh.colours.reserve(vertices), mesh.indices.reserve(3 * triangles);
    if (windy) mesh.wind.reserve(vertices);
  }

  /// Weights of a path's vertices, in the order of add_path().
  void add_wind(std::span<const Rgba8> wind, const Rings& rings) {
    for (const Ring& ring : rings.rings)
      mesh.wind.insert(mesh.wind.end(), static_cast<std::size_t>(ring.sides) + 1, wind[ring.sample]);
    mesh.wind.push_back(wind.back());
  }

  void add_path(std::span<const BranchSample> path, const Rings& rings, bool stem, RandomStream random) {
    const float u0 = random.uniform(), v0 = random.uniform();
    lobes_ = stem ? static_cast<float>(4 + random.below(3)) : 0.0f;
    lobe_phase_ = random.uniform(0.0f, 2.0f * kPi);
    const float tile = look_.bark.tile_m;

    // Whole tiles around, as many as fit the base at true scale.
    const float tiles = 2.0f * kPi * path[rings.rings[0].sample].wood / tile;
    const float repeats = std::max(1.0f, static_cast<float>(static_cast<int>(tiles + 0.5f)));
    const auto scale = [&](float wood) { return std::max(2.0f * kPi * wood / (tile * repeats), kSmallestBark); };

    Frame frame{};
    std::uint32_t below = 0;
    float v = 0.0f;
    for (std::size_t k = 0; k < rings.rings.size(); ++k) {
      const Ring& ring = rings.rings[k];
      const BranchSample& s = path[ring.sample];
      const BranchSample& before = path[rings.rings[k > 0 ? k - 1 : k].sample];
      const BranchSample& after = k + 1 < rings.rings.size() ? path[rings.rings[k + 1].sample] : path.back();
      frame = k == 0 ? first_frame(s.tangent, stem ? Vec3{0, 0, -1} : kUp) : carried(frame, before, s);

      // Taper on both sides, for the normals.
      const float run = after.along - before.along;
      const float taper = run > kLeastStep_m ? std::clamp((after.radius - before.radius) / run, -1.0f, 1.0f) : 0.0f;

      // In the crotch, where the branch leaves its parent, it is dark.
      const float shade = occlusion(s.light) * (1.0f - kCrotchShade * s.crotch);
      const Vec3 tint = tints_.at(2.0f * s.wood, s.centre.y) * shade;
      const Rgba8 colour{unorm8(tint.x), unorm8(tint.y), unorm8(tint.z), 255};

      v += 2.0f * (s.along - before.along) / (tile * (scale(s.wood) + scale(before.wood)));
      const Vec3 widening = run > kLeastStep_m ? (after.saddle - before.saddle) / run : Vec3(0.0f);
      const std::uint32_t top =
          add_ring(s, ring, frame, taper, widening, {u0 + kBarkTurn * v, v0 - v}, repeats, colour);
      if (k > 0) join(below, rings.rings[k - 1].sides, top, ring.sides);
      below = top;
    }

    // The tip: a cone to the last sample, or a cap beyond it.
    const BranchSample& tip = path.back();
    const Ring& last = rings.rings.back();
    const float beyond = rings.capped ? 0.7f * tip.radius : 0.0f;
    const Vec3 tint = tints_.at(2.0f * tip.wood, tip.centre.y) * occlusion(tip.light);
    mesh.positions.push_back(tip.centre + beyond * tip.tangent);
    mesh.normals.push_back(tip.tangent);
    v += (tip.along + beyond - path[last.sample].along) / (tile * scale(path[last.sample].wood));
    mesh.uvs.push_back({u0 + kBarkTurn * v + 0.5f * repeats, v0 - v});
    mesh.colours.push_back({unorm8(tint.x), unorm8(tint.y), unorm8(tint.z), 255});
    const auto apex = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(last.sides); ++i)
      mesh.indices.insert(mesh.indices.end(), {below + i, below + i + 1, apex});
  }

  TriangleMesh mesh;

 private:
  /// Adds sides + 1 vertices, the first and the last at one place; their first index comes back.
  std::uint32_t add_ring(const BranchSample& s, const Ring& ring, const Frame& frame, float taper, const Vec3& widening,
                         Vec2 uv, float repeats, Rgba8 colour) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const SinCos* angle = circle(ring.sides);
    const float lobe = ring.sides >= 12 && lobes_ > 0.0f ? 0.3f * (s.radius - s.wood) : 0.0f;
    // An oval: longer along the parent, most in the crotch, least where a steep branch has its outer side.
    const Vec3 oval = s.saddle - glm::dot(s.saddle, s.tangent) * s.tangent;
    const float most = std::sqrt(glm::dot(s.saddle, s.saddle)), level = std::sqrt(glm::dot(oval, oval));
    const bool saddled = level > 1e-3f * s.radius;
    const float lean = saddled ? glm::dot(s.saddle, s.tangent) / most : 0.0f;
    for (int i = 0; i <= ring.sides; ++i) {
      const Vec3 out = angle[i].cos * frame.normal + angle[i].sin * frame.binormal;
      float radius = s.radius;
      Vec3 normal = out - taper * s.tangent;
      if (lobe > 0.0f) {
        // Buttresses of the root flare.
        const float share = static_cast<float>(i % ring.sides) / static_cast<float>(ring.sides);
        const SinCos wave = sin_cos(lobes_ * 2.0f * kPi * share + lobe_phase_);
        radius += lobe * wave.cos;
        const Vec3 around = angle[i].cos * frame.binormal - angle[i].sin * frame.normal;
        normal += lobes_ * lobe * wave.sin / radius * around;
      }
      Vec3 at = s.centre + radius * out;
      if (saddled) {
        const float share = glm::dot(out, oval) / level;
        const float gain = share > 0.0f ? 1.0f + std::min(lean, 0.0f) : 1.0f - std::max(lean, 0.0f);
        at += gain * share * level / most * s.saddle;
        const float wider = gain * level;
        normal -= share * wider / (radius + wider) * oval / level +
                  gain * std::abs(share) * glm::dot(widening, oval) / level * s.tangent;
      }
      mesh.positions.push_back(at);
      mesh.normals.push_back(glm::normalize(normal));
      mesh.uvs.push_back({uv.x + repeats * static_cast<float>(i) / static_cast<float>(ring.sides), uv.y});
      mesh.colours.push_back(colour);
    }
    return first;
  }

  /// The strip between two rings of the same or different side counts.
  void join(std::uint32_t low, int low_sides, std::uint32_t high, int high_sides) {
    int i = 0, j = 0;
    while (i < low_sides || j < high_sides) {
      const auto a = low + static_cast<std::uint32_t>(i), b = high + static_cast<std::uint32_t>(j);
      // Advance on the ring whose next vertex comes first around.
      if (j == high_sides || (i < low_sides && (i + 1) * high_sides <= (j + 1) * low_sides)) {
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, b});
        ++i;
      } else {
        mesh.indices.insert(mesh.indices.end(), {a, b + 1, b});
        ++j;
      }
    }
  }

  const Look& look_;
  Tints tints_;
  float lobes_ = 0.0f, lobe_phase_ = 0.0f;
};

struct MeshSize {
  std::size_t triangles = 0, vertices = 0;
};

MeshSize size_of(const BranchCurves& curves, const BranchCurve& curve, float coarseness, Rings& scratch) {
  if (curve.count == 0) return {};
  select_rings(curves.of(curve), curves.tip_radius, coarseness, scratch);
  return {scratch.triangles(), scratch.vertices()};
}

void add(BranchPlan& plan, const MeshSize& size) { plan.triangles += size.triangles, plan.vertices += size.vertices; }

/// The branches that matter most, at the coarsest that limbs may become; stems in any case.
BranchPlan most_important(const BranchCurves& curves, std::size_t max_triangles) {
  Rings scratch;
  BranchPlan plan;
  plan.keep.assign(curves.curves.size(), 0);

  // Stems first, as coarse as it takes.
  constexpr float kCoarsest = 1e6f;
  for (plan.coarseness = kCoarsestWhole;; plan.coarseness *= 2.0f) {
    plan.triangles = plan.vertices = 0;
    for (const BranchCurve& c : curves.curves)
      if (c.parent < 0) add(plan, size_of(curves, c, plan.coarseness, scratch));
    if (plan.triangles <= max_triangles || plan.coarseness > kCoarsest) break;
  }
  for (std::size_t c = 0; c < curves.curves.size(); ++c) plan.keep[c] = curves.curves[c].parent < 0;

  std::vector<std::uint32_t> order(curves.curves.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float wa = curves.curves[a].weight, wb = curves.curves[b].weight;
    return wa != wb ? wa > wb : a < b;
  });
  for (std::uint32_t c : order) {
    const BranchCurve& curve = curves.curves[c];
    if (plan.keep[c] || !plan.keep[static_cast<std::size_t>(curve.parent)]) continue;
    const MeshSize more = size_of(curves, curve, plan.coarseness, scratch);
    if (plan.triangles + more.triangles > max_triangles) continue;
    plan.keep[c] = 1;
    add(plan, more);
  }
  return plan;
}

}  // namespace

float occlusion(float exposure) {
  return kDeepShade + (1.0f - kDeepShade) * std::sqrt(std::clamp(exposure, 0.0f, 1.0f));
}

BranchPlan plan_branches(const BranchCurves& curves, float coarseness) {
  BranchPlan plan{coarseness, std::vector<std::uint8_t>(curves.curves.size(), 1), 0, 0};
  Rings scratch;
  for (const BranchCurve& curve : curves.curves) add(plan, size_of(curves, curve, coarseness, scratch));
  return plan;
}

BranchPlan plan_branches_within(const BranchCurves& curves, std::size_t max_triangles) {
  BranchPlan plan = plan_branches(curves, 1.0f);
  if (plan.triangles <= max_triangles) return plan;

  // Everything, as fine as it fits.
  BranchPlan best = plan_branches(curves, kCoarsestWhole);
  if (best.triangles > max_triangles) return most_important(curves, max_triangles);
  float fine = 1.0f, coarse = kCoarsestWhole;
  for (int step = 0; step < 8; ++step) {
    const float middle = std::sqrt(fine * coarse);
    plan = plan_branches(curves, middle);
    if (plan.triangles <= max_triangles) {
      coarse = middle;
      best = std::move(plan);
    } else {
      fine = middle;
    }
  }
  return best;
}

TriangleMesh mesh_branches(const BranchCurves& curves, const BranchPlan& plan, const Look& look, std::uint64_t seed,
                           std::uint64_t key, std::span<const Rgba8> wind) {
  assert(plan.keep.size() == curves.curves.size() && (wind.empty() || wind.size() == curves.samples.size()));
  Mesher mesher(look, plan.triangles, plan.vertices, !wind.empty());
  Rings rings;
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    const BranchCurve& curve = curves.curves[c];
    if (!plan.keep[c] || curve.count == 0) continue;
    const auto path = curves.of(curve);
    select_rings(path, curves.tip_radius, plan.coarseness, rings);
    mesher.add_path(path, rings, curve.parent < 0, RandomStream(seed, mix_bits(key) + c, Purpose::branch_mesh));
    if (!wind.empty()) mesher.add_wind(wind.subspan(curve.first, curve.count), rings);
  }
  assert(mesher.mesh.triangles() == plan.triangles && mesher.mesh.positions.size() == plan.vertices);
  return std::move(mesher.mesh);
}

}  // namespace bosquet::geometry
