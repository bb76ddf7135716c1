#include "geometry/foliage.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/branch_mesh.h"
#include "geometry/leaf_atlas.h"

namespace bosquet::geometry {
namespace {

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
  const float l2 = glm::dot(v, v);
  return l2 > 1e-10f ? v / std::sqrt(l2) : otherwise;
}

/// Random numbers of a twig (leaf kWholeTwig), a leaf of it, or an internode (place kOfInternode).
constexpr std::uint32_t kOfInternode = 0xffff;
RandomStream stream(const FoliageInput& in, std::uint32_t internode, std::uint32_t place,
                    int leaf = LeafSite::kWholeTwig) {
  const std::uint64_t which = static_cast<std::uint64_t>(internode) << 32 | static_cast<std::uint64_t>(place) << 16 |
                              static_cast<std::uint64_t>(leaf + 2);
  return {in.seed, mix_bits(in.key) + which, Purpose::foliage};
}

/// Exposure of leafy wood beside that of its crown. Even a free tree's leaves shade each other so much that few see half of
/// the sky; eyes and cameras take the brightest for white.
class CrownLight {
 public:
  CrownLight(const growth::Skeleton& s, const ThickestPaths& paths, const std::vector<std::uint8_t>& bears)
      : light_(s.light) {
    for (std::uint32_t i : paths.internodes)
      if (bears[i]) sorted_.push_back(s.light[i]);
    std::sort(sorted_.begin(), sorted_.end());
    if (!sorted_.empty()) scale_ = 1.0f / std::clamp(sorted_[sorted_.size() * 19 / 20], 0.02f, 1.0f);
  }
  /// 1 where nineteen of twenty are darker, in proportion below.
  float at(std::uint32_t internode) const { return std::clamp(light_[internode] * scale_, 0.0f, 1.0f); }

  /// Share of the leafy wood that is not brighter.
  float rank(std::uint32_t internode) const {
    const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), light_[internode]);
    return sorted_.empty() ? 1.0f : static_cast<float>(above - sorted_.begin()) / static_cast<float>(sorted_.size());
  }

 private:
  const std::vector<float>& light_;
  std::vector<float> sorted_;
  float scale_ = 1.0f;
};

/// r L^2 > 1 - share: r is a hash of the twig's place, L the rank of its exposure in the crown.
bool blooms(const FoliageInput& in, const Bloom* bloom, const LeafSite& site, const CrownLight& light) {
  if (!bloom) return false;
  constexpr std::uint64_t kBlooming = 990;
  const float r = static_cast<float>(stream(in, site.internode, site.place).at(kBlooming) >> 40) * 0x1p-24f;
  const float rank = light.rank(site.internode);
  return r * rank * rank > 1.0f - bloom->share;
}

/// Bunches that hang from their stalks; others stand out from their twig.
bool hangs(BloomForm form) {
  return form == BloomForm::catkin || form == BloomForm::balls || form == BloomForm::keys ||
         form == BloomForm::bracts || form == BloomForm::drupes || form == BloomForm::nuts || form == BloomForm::cones;
}

/// For each standing internode, whether it is young and thin enough to bear leaves.
std::vector<std::uint8_t> bearing(const FoliageInput& in) {
  const growth::Skeleton& s = *in.skeleton;
  std::vector<std::uint16_t> last_growth(s.size(), 0);
  for (std::uint32_t i : in.paths->internodes) last_growth[i] = s.born[i];
  for (std::size_t i = s.size(); i-- > 0;) {
    if (s.parent[i] < 0) continue;
    std::uint16_t& below = last_growth[static_cast<std::size_t>(s.parent[i])];
    below = std::max(below, last_growth[i]);
  }
  std::vector<std::uint8_t> bears(s.size(), 0);
  for (std::uint32_t i : in.paths->internodes)
    bears[i] = 2000.0f * in.radius[i] <= in.foliage->max_twig_mm &&
               last_growth[i] - s.born[i] <= in.foliage->leaf_life_seasons;
  return bears;
}

/// The open side of the crown: the gradient of an ellipsoid as wide and high as the foliage, and a little upward, where
/// the light is.
class Crown {
 public:
  Crown(const growth::Skeleton& s, std::span<const LeafSite> sites) {
    DVec3 sum{0.0}, squares{0.0};
    for (const LeafSite& site : sites) {
      const DVec3 p{s.distal[site.internode]};
      sum += p, squares += p * p;
    }
    const double n = std::max<double>(1.0, static_cast<double>(sites.size()));
    const DVec3 mean = sum / n, variance = squares / n - mean * mean;
    centre_ = Vec3(mean);
    const auto level = static_cast<float>(variance.x + variance.z), upright = static_cast<float>(variance.y);
    centre_.y -= 0.4f * std::sqrt(std::max(0.0f, upright));
    curvature_ = {1.0f / (0.5f * level + 0.05f), 1.0f / (upright + 0.05f), 1.0f / (0.5f * level + 0.05f)};
  }
  Vec3 outward(const Vec3& p) const { return unit(unit((p - centre_) * curvature_, kUp) + 0.35f * kUp, kUp); }

 private:
  Vec3 centre_, curvature_;
};

/// Frame of a stalk at its foot: at `angle` from the twig, its upper side toward the twig's tip.
LeafFrame stalk(const Vec3& twig, const Vec3& radial, const SinCos& angle) {
  const Vec3 heading = angle.cos * twig + angle.sin * radial;
  const Vec3 up = unit(twig - glm::dot(twig, heading) * heading, radial);
  return {heading, glm::cross(up, heading), up};
}

/// Unit vectors across a twig: `side` level, so that two-ranked leaves make flat sprays, `over` at a right angle.
struct Across {
  Vec3 side, over;
  explicit Across(const Vec3& twig) {
    const Vec3 level = unit(glm::cross(twig, kUp), Vec3{1, 0, 0});
    side = unit(level - glm::dot(level, twig) * twig, Vec3{0, 0, 1});
    over = glm::cross(side, twig);
  }
  Vec3 at(const SinCos& azimuth) const { return azimuth.cos * side + azimuth.sin * over; }
};

/// The sum of two angles.
SinCos sum(const SinCos& a, const SinCos& b) { return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin}; }

/// Where a blade or twig that hangs `droop` below level, away from its foot, points, and the normal of its upper side.
struct Hanging {
  Vec3 heading, normal;
};
Hanging hanging(const Vec3& heading, const SinCos& droop, const Vec3& out) {
  const Vec3 level{heading.x, 0, heading.z};
  const float l2 = glm::dot(level, level);
  const Vec3 away = l2 > 1e-10f ? level / std::sqrt(l2) : unit(Vec3{out.x, 0, out.z}, Vec3{1, 0, 0});
  return {droop.cos * away - droop.sin * kUp, droop.cos * kUp + droop.sin * away};
}

/// The stalk sinks under its load, the more the softer it is.
LeafFrame sunk(const LeafFrame& frame, const Vec3& heading, float softness) {
  LeafFrame f;
  f.heading = unit(glm::mix(frame.heading, heading, softness / (1.0f + softness)), frame.heading);
  f.up = unit(frame.up - glm::dot(frame.up, f.heading) * f.heading, frame.left);
  f.left = glm::cross(f.up, f.heading);
  return f;
}

std::uint8_t byte(float x) { return static_cast<std::uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// Linear colour factor: `warm` above 0 turns green toward yellow and red, below 0 away from it.
Vec3 hue_turned(float warm) {
  return warm > 0.0f ? Vec3{1.0f, 1.0f - 0.25f * warm, 1.0f - 0.5f * warm} : Vec3{1.0f + 0.3f * warm, 1.0f, 1.0f};
}

/// Leaves let light through to those behind them: shade is less deep than on wood.
float leaf_occlusion(float light) { return 0.3f + 0.7f * occlusion(light); }

/// Writes cards: strips of `columns` quads across, one row.
class Cards {
 public:
  /// `small`: cards over which the crown's outward direction hardly changes.
  Cards(const Crown& crown, float soft, bool small) : crown_(crown), soft_(soft), small_(small) {}

  /// A card with its foot at `foot`, `length` along `heading`; `sides` are the directions from its midline to the left
  /// and right edge (two halves, or one flat card when they are opposite), `normals` those of the halves.
  /// `out` is the crown's outward direction somewhere near.
  void add(const Vec3& foot, const Vec3& heading, float length, float half_width, const Vec3& left, const Vec3& right,
           const Vec3& up, const Vec3& out, const AtlasCell& uv, Rgba8 colour, bool folded) {
    const Vec3 to_top = length * heading;
    const Vec3 outward = small_ ? out : crown_.outward(foot + 0.5f * to_top);
    const float facing = glm::dot(up, outward);
    const bool front = facing >= 0.0f;
    // A card seen edge-on from outside shows both its sides there: its normals stay its own, or one side would be
    // black.
    const float x = std::min(1.0f, std::abs(facing) / 0.7f);
    const float soft = soft_ * x * x * (3.0f - 2.0f * x);
    const Vec3 l = half_width * left, r = half_width * right;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 across = folded ? unit(right - left, left) : right;
    const Vec3 flat = front ? up : -up, of_all = unit(glm::mix(flat, outward, soft), kUp);
    const auto normal = [&](const Vec3& p, float side) {
      if (small_ && !folded) return of_all;
      // Halves of a folded card look a little to their own side.
      const Vec3 face = folded ? unit(flat + 0.35f * side * across, up) : flat;
      return unit(glm::mix(face, crown_.outward(p), soft), kUp);
    };
    const auto corner = [&](const Vec3& p, float u, float v, float side) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(normal(p, side));
      mesh.uvs.push_back({u, v});
      mesh.colours.push_back(colour);
    };
    const float middle = 0.5f * (uv.u0 + uv.u1);
    corner(foot + l, uv.u0, uv.v1, -1);
    if (folded) corner(foot, middle, uv.v1, 0);
    corner(foot + r, uv.u1, uv.v1, 1);
    corner(foot + l + to_top, uv.u0, uv.v0, -1);
    if (folded) corner(foot + to_top, middle, uv.v0, 0);
    corner(foot + r + to_top, uv.u1, uv.v0, 1);
    const std::uint32_t row = folded ? 3 : 2;
    for (std::uint32_t k = 0; k + 1 < row; ++k) {
      const std::uint32_t a = base + k, b = a + 1, c = a + row, d = c + 1;
      const std::array<std::uint32_t, 6> two =
          front ? std::array<std::uint32_t, 6>{a, b, d, a, d, c} : std::array<std::uint32_t, 6>{a, d, b, a, c, d};
      mesh.indices.insert(mesh.indices.end(), two.begin(), two.end());
    }
  }

  TriangleMesh mesh;

 private:
  const Crown& crown_;
  float soft_;
  bool small_;
};

AtlasCell inset(AtlasCell cell, float share_of_width) {
  const float margin = 0.5f * kAtlasMargin, middle = 0.5f * (cell.u0 + cell.u1);
  const float half = (0.25f - margin) * share_of_width;
  return {middle - half, cell.v0 + margin, middle + half, cell.v1 - margin};
}

/// A strip of the wood at a twig's foot.
AtlasCell wood_cell() {
  const AtlasCell cell = cluster_cell(0);
  const float middle = 0.5f * (cell.u0 + cell.u1), foot = cell.v1 - 0.5f * kAtlasMargin;
  return {middle - 0.0005f, foot - 0.01f, middle + 0.0005f, foot - 0.002f};
}

/// How far up its twig a leaf stands, 0..1.
float place_on_twig(const LeafLook& leaf, int number, int leaves, float jitter) {
  const float x = (static_cast<float>(number) + jitter) / static_cast<float>(leaves);
  return leaf.cluster == ClusterForm::tuft ? 0.55f + 0.45f * x : 0.12f + 0.88f * x;
}

}  // namespace

std::vector<LeafSite> leaf_sites(const FoliageInput& in, FoliageLevel level) {
  const growth::Skeleton& s = *in.skeleton;
  const FoliageLook& look = *in.foliage;
  const bool leafed = has_leaves(in.look->leaf, in.season);
  std::vector<LeafSite> sites;
  if (level == FoliageLevel::leaves && !leafed) return sites;
  const bool single = level == FoliageLevel::leaves;
  const Bloom* bloom = bloom_of(in.look->leaf, in.season);
  const int leaves = single ? single_leaves(in.look->leaf) : 0;
  const float fallen = in.season == Season::autumn && !in.look->leaf.evergreen ? look.autumn_fall : 0.0f;
  const float divergence = radians(look.divergence_deg);
  const std::vector<std::uint8_t> bears = bearing(in);
  const CrownLight crown_light(s, *in.paths, bears);

  for (const ThickestPaths::Path& path : in.paths->paths) {
    const auto run = in.paths->of(path);
    // Around a twig leaves go on turning from internode to internode; 64 turns are enough to forget where it began.
    std::uint32_t around = static_cast<std::uint32_t>(stream(in, run[0], kOfInternode).at(1) >> 58);
    for (std::size_t k = 0; k < run.size(); ++k) {
      const std::uint32_t i = run[k];
      if (!bears[i]) continue;
      const Vec3 d = s.distal[i] - s.proximal(i);
      const float length = std::sqrt(glm::dot(d, d));
      RandomStream of_internode = stream(in, i, kOfInternode);
      const auto n =
          std::min(static_cast<std::uint32_t>(length / look.cluster_spacing_m + of_internode.uniform()), 1000u);
      // The foot of a side branch lies inside the wood that bears it.
      const float inside = k == 0 && path.parent >= 0 ? in.radius[in.paths->internodes[path.node]] : 0.0f;
      for (std::uint32_t place = 0; place <= n; ++place) {
        const bool tip = place == n;
        if (tip && k + 1 < run.size()) break;
        RandomStream random = stream(in, i, place);
        LeafSite site;
        site.internode = i;
        site.place = static_cast<std::uint16_t>(place);
        site.tip = tip;
        site.at = tip ? 1.0f : (static_cast<float>(place) + random.uniform(0.25f, 0.75f)) / static_cast<float>(n);
        site.azimuth = divergence * static_cast<float>(around++) + random.uniform(-0.25f, 0.25f);
        site.size = 1.0f + look.size_variation * random.uniform(-1.0f, 1.0f);
        const bool gone = random.uniform() < fallen;
        if ((gone && !single) || site.at * length < inside) continue;
        if (!single) {
          sites.push_back(site);
          continue;
        }
        // The twig's wood and its leaves one by one.
        const float twig_size = site.size;
        site.leaf = LeafSite::kTwigWood;
        sites.push_back(site);
        for (int number = 0; number < leaves; ++number) {
          RandomStream of_leaf = stream(in, i, place, number);
          site.leaf = static_cast<std::int16_t>(number);
          site.size = twig_size * (1.0f + look.size_variation * of_leaf.uniform(-1.0f, 1.0f));
          if (of_leaf.uniform() >= fallen) sites.push_back(site);
        }
        site.size = 1.0f;
        if (blooms(in, bloom, site, crown_light))
          for (int bunch = 0; bunch < bloom->bunches; ++bunch) {
            site.leaf = static_cast<std::int16_t>(LeafSite::kFirstBunch + bunch);
            sites.push_back(site);
          }
      }
    }
  }
  return sites;
}

int single_leaves(const LeafLook& leaf) {
  const float cell = cluster_cell_m(leaf), all = static_cast<float>(leaf.cluster_leaves);
  float blade = 1e-6f * leaf.length_mm * leaf.width_mm;
  switch (leaf.outline) {
    case LeafOutline::needle_spray:
    case LeafOutline::scale_cord:
      return leaf.cluster_leaves;  // side shoots, which do not hide each other
    case LeafOutline::pinnate_compound:
      blade *= 0.45f;
      break;
    case LeafOutline::palmate:
      blade *= 0.5f;
      break;
    default:
      blade *= 0.66f;
  }
  // Leaves of the picture are turned away by some degree and smaller toward the shoot's end; thrown at random on the part
  // of the cell that the twig fills they cover 1 - exp(-area) of it.
  constexpr float kSeen = 0.68f;
  const float filled = leaf.cluster == ClusterForm::strings ? 0.35f : 0.62f;
  const float region = filled * cell * cell, shown = region * (1.0f - exp2(-1.442695f * kSeen * all * blade / region));
  return std::clamp(static_cast<int>(shown / blade + 0.5f), std::min(3, leaf.cluster_leaves), leaf.cluster_leaves);
}

std::size_t triangles_per_site(const FoliageLook& foliage, FoliageLevel level) {
  switch (level) {
    case FoliageLevel::leaves:
      return 2;
    case FoliageLevel::clusters:
      return foliage.cluster_planes == 1 ? 4 : 2 * static_cast<std::size_t>(foliage.cluster_planes);
    case FoliageLevel::cards:
      return 2;
  }
  return 2;
}

LeafFrame turn_petiole(LeafFrame f, const Vec3& toward, float twist, float bend, float turn, float fineness) {
  // Steps small enough that the first-order turn is stable.
  const int steps = 2 + static_cast<int>(fineness * (2.0f + 2.0f * std::max({twist, bend, turn})));
  const float ds = 1.0f / static_cast<float>(steps);
  // Nearly a unit vector to one: a step of Newton's for the inverse root. Exactly at the end.
  const auto nearly_unit = [](const Vec3& v) { return v * (1.5f - 0.5f * glm::dot(v, v)); };
  for (int k = 0; k < steps; ++k) {
    const float ht = glm::dot(f.heading, toward), lt = glm::dot(f.left, toward);
    // L.(T x (H x T)) = L.H (T.T) - (L.T)(H.T), and L.H = 0.
    const float about_h = -twist * lt * ds, about_l = bend * ht * ds, about_u = -turn * lt * ht * ds;
    const Vec3 heading = f.heading - about_l * f.up + about_u * f.left;
    const Vec3 up = f.up - about_h * f.left + about_l * f.heading;
    f.heading = nearly_unit(heading);
    f.up = nearly_unit(up - glm::dot(up, f.heading) * f.heading);
    f.left = glm::cross(f.up, f.heading);
  }
  f.heading = glm::normalize(f.heading);
  f.up = glm::normalize(f.up - glm::dot(f.up, f.heading) * f.heading);
  f.left = glm::cross(f.up, f.heading);
  return f;
}

TriangleMesh mesh_foliage(const FoliageInput& in, FoliageLevel level, std::span<const LeafSite> sites,
                          std::size_t count) {
  const growth::Skeleton& s = *in.skeleton;
  const FoliageLook& look = *in.foliage;
  const LeafLook& leaf = in.look->leaf;
  const std::size_t n = sites.size();
  count = std::min(count, n);
  if (count == 0) return {};
  const auto kept = [&, whole = count == n](std::size_t k) { return whole || (k + 1) * count / n != k * count / n; };

  // What is left out adds its area to the others.
  double all = 0.0, of_kept = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!sites[k].is_leafy()) continue;
    const double area = static_cast<double>(sites[k].size) * static_cast<double>(sites[k].size);
    all += area;
    if (kept(k)) of_kept += area;
  }
  const float growth = of_kept > 0.0 ? static_cast<float>(std::sqrt(all / of_kept)) : 1.0f;
  const float crowding = 1.0f - 1.0f / growth;

  // Sizes and angles of this level.
  const bool single = level == FoliageLevel::leaves;
  const bool spring = in.season == Season::spring && !leaf.evergreen;
  const float season_size = spring ? look.spring_size : 1.0f;
  constexpr float kFilled = 1.0f - 2.0f * kAtlasMargin;
  const float twig_m = cluster_cell_m(leaf) * (0.5f + 0.5f * season_size) * kFilled;
  const float leaf_m = leaf_cell_m(leaf) * season_size * kFilled;
  const bool needles = is_needle(leaf.outline);
  const Bloom* bloom = bloom_of(leaf, in.season);
  const float bunch_m = bloom && single ? bunch_cell_m(*bloom) * kFilled : 0.0f;
  const int leaves = single ? single_leaves(leaf) : 0;
  const bool folded_leaves = bloom && bloom->before_leaves && in.season == Season::spring;
  const float narrow = needles ? 1.0f : std::clamp(1.35e-3f * leaf.width_mm / leaf_cell_m(leaf), 0.1f, 1.0f);
  const SinCos leaf_droop = sin_cos(radians(leaf.droop_deg)), twig_droop = sin_cos(radians(look.cluster_droop_deg));
  const SinCos insertion = sin_cos(radians(look.insertion_deg));
  const bool folded = level == FoliageLevel::clusters && look.cluster_planes == 1;
  const int planes = level == FoliageLevel::clusters ? look.cluster_planes : 1;
  // A card of far trees has the area of all planes of the clusters that it stands for.
  const float of_planes = level == FoliageLevel::cards ? std::sqrt(static_cast<float>(look.cluster_planes)) : 1.0f;
  const SinCos fold = sin_cos(radians(folded ? look.fold_deg : 0.0f));

  const Crown crown(s, sites);
  const CrownLight crown_light(s, *in.paths, bearing(in));
  RandomStream of_tree = stream(in, 0xffffffff, kOfInternode);
  const float tree_warmth = look.tree_hue * of_tree.uniform(-0.5f, 0.5f);
  const float tree_value = 1.0f - 0.16f * look.tree_hue * of_tree.uniform();
  const float mottle = in.season == Season::autumn && !leaf.evergreen ? 0.35f : 0.12f;

  Cards cards(crown, look.soft_normals, single);
  const std::size_t triangles = count * triangles_per_site(look, level);
  const std::size_t vertices = folded ? 6 * count : 2 * triangles;
  cards.mesh.positions.reserve(vertices), cards.mesh.normals.reserve(vertices), cards.mesh.uvs.reserve(vertices);
  cards.mesh.colours.reserve(vertices), cards.mesh.indices.reserve(3 * triangles);

  constexpr std::uint64_t kAny = 1000;  // numbers of a twig's stream far from those drawn in turn
  std::uint32_t last_internode = 0xffffffff, last_place = 0;
  Vec3 twig_at{0.0f}, out = kUp;
  LeafFrame twig_frame{};
  RandomStream of_twig = of_tree;
  float light = 1.0f, twig_warmth = 0.0f, twig_value = 1.0f;
  bool blooming = false;
  SinCos twig_azimuth{0.0f, 1.0f};
  Across twig_across(kUp);
  std::vector<SinCos> turned;  // of the leaves of a twig, one after the other
  if (single)
    for (int number = 0; number < std::max(leaves, bloom ? bloom->bunches : 0); ++number)
      turned.push_back(sin_cos(radians(look.divergence_deg) * static_cast<float>(number)));
  for (std::size_t k = 0; k < n; ++k) {
    if (!kept(k)) continue;
    const LeafSite& site = sites[k];
    const std::uint32_t i = site.internode;

    // Where the twig stands on its branch and how it turns; wood turns less than a leaf's stalk. Leaves of one twig
    // come one after the other.
    if (i != last_internode || site.place != last_place) {
      last_internode = i, last_place = site.place;
      of_twig = stream(in, i, site.place);
      light = crown_light.at(i);
      const float weak = 1.0f / (1.0f + 10.0f * std::max(0.0f, s.vigor[i]));
      twig_warmth = look.vigor_hue * weak * weak + tree_warmth;
      twig_value = leaf_occlusion(light) * tree_value;
      blooming = blooms(in, bloom, site, crown_light);
      const Vec3 from = s.proximal(i), to = s.distal[i];
      const Vec3 branch = unit(to - from, kUp);
      const Across across(branch);
      twig_azimuth = sin_cos(site.azimuth);
      const Vec3 radial = across.at(twig_azimuth);
      twig_at = glm::mix(from, to, site.at) + (site.tip ? 0.0f : 0.8f * in.radius[i]) * radial;
      out = crown.outward(twig_at);
      const LeafFrame foot = site.tip ? stalk(branch, across.over, {0.0f, 1.0f}) : stalk(branch, radial, insertion);
      // A card that stands for many looks out of the crown, a piece of its shell.
      const Hanging hang = hanging(foot.heading, twig_droop, out);
      const auto any = [&](std::uint64_t number) {
        return static_cast<float>(of_twig.at(kAny + number) >> 40) * 0x1p-23f - 1.0f;
      };
      const float shell = single ? 0.0f : crowding;
      const Vec3 toward = unit(glm::mix(hang.normal, out, std::max(look.sun_turn * light, shell)) +
                                   0.7f * shell * Vec3{any(0), any(1), any(2)},
                               kUp);
      const float ease = 0.6f * (0.9f + 0.3f * any(3)) * (1.0f + shell);
      twig_frame = turn_petiole(sunk(foot, hang.heading, ease * look.bend), toward, ease * look.twist, ease * look.bend,
                                ease * look.turn);
      if (single) twig_across = Across(twig_frame.heading);
    }

    // A single leaf stands on its twig as the twig on the branch.
    RandomStream random = site.leaf == LeafSite::kWholeTwig ? of_twig : stream(in, i, site.place, site.leaf);
    for (int skip = 0; skip < 4; ++skip) random.bits();  // what leaf_sites has used
    LeafFrame frame = twig_frame;
    Vec3 at = twig_at;
    const bool wood = site.leaf == LeafSite::kTwigWood;
    const bool bunch = site.is_bunch();
    if (bunch) {
      // Spread along the twig, hanging down or standing out.
      const Vec3 twig = frame.heading;
      const int number = site.leaf - LeafSite::kFirstBunch;
      const Vec3 radial = twig_across.at(sum(turned[static_cast<std::size_t>(number)], twig_azimuth));
      at += (0.25f + 0.7f * (static_cast<float>(number) + random.uniform()) / static_cast<float>(bloom->bunches)) *
            0.8f * twig_m * twig;
      frame = stalk(twig, radial, insertion);
      const Vec3 to = hangs(bloom->form) ? 0.25f * radial - kUp : 0.6f * radial + 0.8f * kUp;
      frame.heading = unit(to, radial);
      frame.up = unit(radial - glm::dot(radial, frame.heading) * frame.heading, kUp);
      frame.left = glm::cross(frame.up, frame.heading);
    } else if (single && !wood) {
      const Vec3 twig = frame.heading;
      const SinCos azimuth = sum(turned[static_cast<std::size_t>(site.leaf)], twig_azimuth);
      at += place_on_twig(leaf, site.leaf, leaves, random.uniform(0.2f, 0.8f)) * 0.8f * twig_m * twig;
      frame = stalk(twig, twig_across.at(azimuth), insertion);
      const Hanging hang = hanging(frame.heading, leaf_droop, out);
      const Vec3 toward = unit(glm::mix(hang.normal, out, look.sun_turn * light), kUp);
      const float ease = random.uniform(0.6f, 1.2f);
      constexpr float kCoarse = 0.4f;  // of so many leaves none is looked at closely enough for more steps
      frame = turn_petiole(sunk(frame, hang.heading, ease * look.bend), toward, ease * look.twist, ease * look.bend,
                           ease * look.turn, kCoarse);
    }

    // How it looks.
    const float warmth = twig_warmth + mottle * random.uniform(-1.0f, 1.0f);
    const float value = twig_value * random.uniform(0.88f, 1.0f);
    const Vec3 tint = value * (wood || bunch ? Vec3(1.0f) : hue_turned(std::clamp(warmth, -1.0f, 1.0f)));
    const Rgba8 colour{byte(tint.x), byte(tint.y), byte(tint.z), 255};
    // In a season with a bloom the atlas' first column shows it, the second is plain.
    const bool first = random.uniform() < 0.5f;
    const int variant = bunch ? 0 : bloom ? (blooming && !single ? 0 : 1) : first ? 0 : 1;
    AtlasCell uv = wood     ? wood_cell()
                   : bunch  ? inset(leaf_cell(0), 1.0f)
                   : single ? inset(leaf_cell(variant), narrow)
                            : inset(cluster_cell(variant), 1.0f);
    if (random.uniform() < 0.5f) std::swap(uv.u0, uv.u1);

    if (wood) {
      const float half = 0.5e-3f * leaf.twig_mm;
      cards.add(at, frame.heading, 0.8f * twig_m, half, frame.left, -frame.left, frame.up, out, uv, colour, false);
      continue;
    }
    if (bunch) {
      cards.add(at, frame.heading, bunch_m, 0.5f * bunch_m, frame.left, -frame.left, frame.up, out, uv, colour, false);
      continue;
    }
    // A card that stands for many grows around its place, not out of the crown.
    const float length = (single ? leaf_m : twig_m) * site.size * growth * of_planes *
                         (single && blooming && folded_leaves ? kFoldedLeaf : 1.0f);
    const float half_width = 0.5f * length * (single ? narrow : 1.0f);
    const Vec3 foot = at - 0.5f * crowding * length * frame.heading;
    for (int plane = 0; plane < planes; ++plane) {
      LeafFrame f = frame;
      if (planes > 1) {
        const SinCos turn = sin_cos(kPi * (static_cast<float>(plane) + 0.5f) / static_cast<float>(planes) - 0.5f * kPi);
        f.left = turn.cos * frame.left + turn.sin * frame.up;
        f.up = turn.cos * frame.up - turn.sin * frame.left;
      }
      const Vec3 left = fold.cos * f.left - fold.sin * f.up, right = -fold.cos * f.left - fold.sin * f.up;
      cards.add(foot, f.heading, length, half_width, left, right, f.up, out, uv, colour, folded);
    }
  }
  assert(cards.mesh.triangles() == triangles);
  return std::move(cards.mesh);
}

}  // namespace bosquet::geometry
