#include "geometry/twig_painter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/atlas_blade.h"
#include "geometry/bloom_painter.h"
#include "geometry/leaf_atlas.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

constexpr int kBlades = 4;  // outlines that a tree's leaves take turns with

Vec2 heading(float angle_deg) {  // 0 up, positive to the right
  const SinCos a = sin_cos(radians(angle_deg));
  return {a.sin, a.cos};
}

// A leaf reflects less pure a green than a photograph's contrast gives it.
constexpr float kPaler = 0.14f;

Vec3 albedo(const Vec3& colour) {
  const Vec3 seen = kLeafAlbedo * linear_from_srgb(colour);
  return glm::mix(seen, Vec3(luminance(seen)), kPaler);
}

// The colours of one season, linear albedo.
struct Dress {
  Vec3 upper, edge, under, twig, bud, tip;
  bool leaves = true;

  Dress(const LeafLook& leaf, Season season) : twig(albedo(leaf.twig_colour)), bud(albedo(leaf.bud_colour)) {
    const Vec3 summer = albedo(leaf.summer);
    upper = edge = tip = summer, under = albedo(leaf.underside);
    leaves = has_leaves(leaf, season);
    if (leaf.evergreen) {
      if (season == Season::spring) tip = albedo(leaf.spring);
    } else if (season == Season::spring) {
      upper = edge = albedo(leaf.spring), under = glm::mix(under, upper, 0.6f);
    } else if (season == Season::autumn) {
      upper = albedo(leaf.autumn), edge = albedo(leaf.autumn_late), under = glm::mix(under, upper, 0.75f);
    }
  }
};

class Painter {
 public:
  Painter(const LeafLook& leaf, Season season, const Bloom* bloom, std::uint64_t seed, int cell, int pixels, float side)
      : leaf_(leaf),
        dress_(leaf, season),
        season_(season),
        bloom_(bloom),
        folded_(bloom && bloom->before_leaves && season == Season::spring),
        stream_(seed, mix_bits(200 + static_cast<std::uint64_t>(cell)), Purpose::texture),
        canvas_(pixels, side, seed + static_cast<std::uint64_t>(cell)) {
    if (is_needle(leaf.outline)) return;
    for (int i = 0; i < kBlades; ++i) blades_.emplace_back(leaf, seed, static_cast<std::uint64_t>(cell * kBlades + i));
  }

  AtlasCanvas twig() {
    switch (leaf_.cluster) {
      case ClusterForm::tuft:
        tuft();
        break;
      case ClusterForm::alternate:
        feather(false);
        break;
      case ClusterForm::opposite:
        feather(true);
        break;
      case ClusterForm::strings:
        strings();
        break;
      case ClusterForm::spray:
        leaf_.outline == LeafOutline::scale_cord ? cords() : spray();
        break;
      case ClusterForm::brush:
        leaf_.outline == LeafOutline::scale_cord ? cords() : brush();
        break;
    }
    if (bloom_) hang_bunches();
    return std::move(canvas_);
  }

  AtlasCanvas single() {
    if (leaf_.outline == LeafOutline::needle_spray) {
      needle_shoot({0.0f, 0.0f}, 0.0f, 0.82f * canvas_.side(), 0.4f * twig_m(), 0.0f, 1.0f);
    } else if (leaf_.outline == LeafOutline::scale_cord) {
      cord({0.0f, 0.0f}, 0.0f, 0.9f * canvas_.side(), 2, 1.0f);
    } else if (dress_.leaves) {
      leaf({{0.0f, 0.0f}, stream_.uniform(-3.0f, 3.0f), metres(leaf_.length_mm), false, true});
    }
    return std::move(canvas_);
  }

  AtlasCanvas bunch() {
    // On a short piece of its twig or stalk.
    const Vec2 node{0.0f, kBunchStem * canvas_.side()};
    const float thin = std::clamp(0.06f * metres(bloom_->size_mm), 0.01f * canvas_.side(), 0.03f * canvas_.side());
    canvas_.rod({0.0f, 0.0f}, node, thin, thin, stalk_colour(), stalk_colour());
    paint_bunch(canvas_, stream_, *bloom_, stalk_colour(), node, 0.0f);
    return std::move(canvas_);
  }

 private:
  struct Leaf {
    Vec2 node;
    float angle_deg;  ///< 0 up, positive to the right
    float length;     ///< of the blade, metres
    bool under = false;
    bool flat = false;  ///< seen full face, as single leaves are
  };

  /// Where bunches may hang: at axils and ends.
  struct Node {
    Vec2 at;
    float angle_deg;
  };

  static float metres(float mm) { return 0.001f * mm; }
  float twig_m() const { return metres(leaf_.twig_mm); }
  float spread(float x) { return stream_.uniform(-x, x); }
  float rim() const { return 0.5f * canvas_.side() * (1.0f - 2.5f * kAtlasMargin); }
  Vec3 stalk_colour() const {
    const bool woody = bloom_ && (bloom_->form == BloomForm::cones || bloom_->form == BloomForm::balls);
    return woody ? dress_.twig : glm::mix(albedo(leaf_.summer), dress_.twig, 0.4f);
  }

  // Metres from a point to the cell's clear rim in this direction.
  float room(Vec2 from, float angle_deg) const {
    const Vec2 d = heading(angle_deg);
    const float side = d.x > 0.0f ? rim() - from.x : from.x + rim();
    const float middle = 0.5f * canvas_.side();
    const float up = d.y > 0.0f ? middle + rim() - from.y : from.y - middle + rim();
    float reach = 4.0f * canvas_.side();
    if (std::fabs(d.x) > 1e-3f) reach = std::min(reach, side / std::fabs(d.x));
    if (std::fabs(d.y) > 1e-3f) reach = std::min(reach, up / std::fabs(d.y));
    return std::max(0.0f, reach);
  }

  // Draws the blade in toward the twig until it lies inside the cell.
  float fitted(Vec2 base, Vec2 direction, float length, float half) const {
    const Vec2 middle{0.0f, 0.5f * canvas_.side()}, across{direction.y, -direction.x};
    for (int i = 0; i < 24; ++i, length *= 0.93f) {
      bool inside = true;
      for (const float at : {0.45f, 0.75f, 1.0f}) {
        const float width = at < 1.0f ? half * length : 0.0f;
        for (const float s : {-1.0f, 1.0f}) {
          const Vec2 p = base + direction * (at * length) + across * (s * width) - middle;
          inside = inside && std::fabs(p.x) <= rim() && std::fabs(p.y) <= rim();
        }
      }
      if (inside) break;
    }
    return length;
  }

  void leaf(Leaf at) {
    if (folded_ && !at.flat) at.length *= kFoldedLeaf;
    const LeafBlade& blade = blades_[stream_.below(kBlades)];
    // On a twig long stalks point toward the viewer and away, and are seen short.
    const float seen = leaf_.petiole_mm > 40.0f ? 0.55f : 1.0f;
    const float petiole = metres(leaf_.petiole_mm) * (at.flat ? 1.0f : seen * at.length / metres(leaf_.length_mm));
    const Vec2 direction = heading(at.angle_deg);
    // The stalk sets off more steeply than the blade hangs.
    const Vec2 stalk = glm::normalize(direction + Vec2(0.0f, 0.25f));
    const Vec2 end = at.node + stalk * petiole;
    BladePose pose;
    pose.direction = direction;
    pose.bend = at.flat ? spread(0.05f) : spread(0.14f);
    pose.narrow = at.flat ? 1.0f : 1.0f - 0.45f * stream_.uniform() * stream_.uniform();
    pose.tilt = at.flat ? Vec2(spread(0.1f), 0.0f) : Vec2(spread(0.45f), spread(0.4f));
    pose.length = fitted(end, direction, at.length * (at.flat ? 1.0f : stream_.uniform(0.85f, 1.0f)),
                         blade.half_width() + std::fabs(pose.bend));
    // The stalk ends in the notch of a heart, where a palmate leaf's veins meet, else at the blade's base.
    pose.base = end - direction * (blade.foot() * pose.length);
    pose.shadow = at.flat ? 0.0f : 0.42f;
    const float bright = 1.0f + 2.0f * spread(leaf_.colour_variation);
    const float warm = 0.6f * spread(leaf_.colour_variation);
    const Vec3 hue{1.0f + 1.5f * warm, 1.0f, 1.0f - 2.0f * warm};
    Vec3 upper = dress_.upper, edge = dress_.edge * (season_ == Season::autumn ? 1.0f : 0.86f);
    if (season_ == Season::autumn && !leaf_.evergreen) {
      // Some have turned farther than others, some are still green about the veins.
      const float turned = stream_.uniform();
      upper = glm::mix(upper, dress_.edge, 0.75f * turned * turned);
      if (turned < 0.25f) upper = glm::mix(upper, albedo(leaf_.summer), 0.45f);
    } else if (season_ == Season::summer) {
      edge = glm::mix(edge, albedo(leaf_.spring), 0.10f);
    }
    // A leaf alone stands for those that show either side.
    if (at.flat) upper = glm::mix(upper, dress_.under, leaf_.underside_share);
    pose.colour = (at.under ? dress_.under * glm::mix(Vec3(1.0f), hue, 0.3f) : upper * hue) * bright;
    pose.edge = (at.under ? 0.95f * dress_.under : edge * hue) * bright;
    pose.vein = at.under ? pose.colour * 1.25f : glm::mix(pose.colour * 1.6f, dress_.under, 0.35f);
    pose.mottle = 0.6f * leaf_.colour_variation + (season_ == Season::autumn ? 0.06f : 0.02f);
    canvas_.rod(at.node, end + direction * (0.04f * pose.length), std::max(0.00045f, 0.009f * pose.length),
                std::max(0.0003f, 0.007f * pose.length), glm::mix(pose.vein, dress_.twig, 0.35f), pose.vein);
    canvas_.blade(blade, pose);
  }

  void bud(Vec2 node, float angle_deg, float length) {
    const Vec2 direction = heading(angle_deg);
    canvas_.rod(node, node + direction * (0.6f * length), 0.30f * length, 0.26f * length, dress_.bud, dress_.bud);
    canvas_.rod(node + direction * (0.6f * length), node + direction * length, 0.26f * length, 0.04f * length,
                dress_.bud, 1.2f * dress_.bud);
  }

  // A leaf where the tree has leaves, else the bud that was in its axil.
  void leaf_or_bud(const Leaf& at) {
    nodes_.push_back({at.node, at.angle_deg});
    if (dress_.leaves) {
      leaf(at);
    } else {
      // Half of the axils have grown a spur or a fine side twig.
      const float size = std::max(0.003f, 1.4f * twig_m()), angle = 0.7f * at.angle_deg;
      Vec2 end = at.node;
      if (stream_.below(2) == 0) {
        const Vec2 direction = heading(angle);
        const float length = fitted(at.node, direction, at.length * stream_.uniform(0.3f, 0.9f) + size, 0.05f) - size;
        if (length > 0.0f) {
          end = at.node + direction * length;
          canvas_.rod(at.node, end, 0.25f * twig_m(), 0.15f * twig_m(), dress_.twig, dress_.twig);
        }
      }
      bud(end, angle, size);
    }
  }

  // A bent twig; returns its points, evenly spaced, base first.
  std::vector<Vec2> shoot(Vec2 base, float angle_deg, float bend_deg, float length, float zigzag_deg, float radius,
                          float tip_radius, int pieces) {
    std::vector<Vec2> points{base};
    const float step = length / static_cast<float>(pieces);
    for (int i = 0; i < pieces; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(pieces);
      const float angle = angle_deg + bend_deg * t + (i % 2 == 0 ? zigzag_deg : -zigzag_deg);
      points.push_back(points.back() + heading(angle) * step);
      const auto thin = [&](float x) { return radius + (tip_radius - radius) * x; };
      canvas_.rod(points[points.size() - 2], points.back(), thin(t - 0.5f / static_cast<float>(pieces)),
                  thin(t + 0.5f / static_cast<float>(pieces)), dress_.twig, dress_.twig);
    }
    return points;
  }

  // Oak, cherry: leaves crowd round the ends of a stout shoot and of its spurs.
  void tuft() {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const float lean = spread(7.0f);
    const auto main =
        shoot({0.0f, 0.0f}, lean, -2.0f * lean, 0.56f * side, 3.0f, 0.55f * twig_m(), 0.35f * twig_m(), 8);
    // About half of the leaves at the end, the rest on spurs to either side.
    const int total = leaf_.cluster_leaves, end = std::max(3, (total * 5 + 5) / 11);
    const int spurs = std::clamp((total - end) / 4, 2, 5), each = std::max(1, (total - end) / spurs);
    for (int k = 0; k < spurs; ++k) {
      const float h = k % 2 == 0 ? -1.0f : 1.0f;
      const Vec2 foot = main[static_cast<std::size_t>(2 + k * 5 / spurs)];
      const float angle = h * stream_.uniform(42.0f, 62.0f);
      const float reach = std::min(stream_.uniform(0.13f, 0.24f) * side, 0.6f * room(foot, angle));
      const auto side_shoot = shoot(foot, angle, -h * 20.0f, reach, 2.0f, 0.35f * twig_m(), 0.28f * twig_m(), 3);
      rosette(side_shoot.back(), angle - h * 12.0f, each, 84.0f, 0.92f * length);
    }
    rosette(main.back(), -lean, end, 112.0f, length);
  }

  // `count` leaves about a shoot's end, the outermost below, the last ones on top in the middle.
  void rosette(Vec2 end, float angle_deg, int count, float fan_deg, float length) {
    for (int i = 0; i < count; ++i) {
      const float rank = count > 1 ? static_cast<float>(i / 2) / static_cast<float>((count + 1) / 2) : 1.0f;
      const float hand = i % 2 == 0 ? -1.0f : 1.0f;
      const float off = i + 1 == count && count % 2 == 1
                            ? spread(6.0f)
                            : hand * (fan_deg * (1.0f - rank) * 0.97f + 9.0f) + spread(7.0f);
      const Vec2 node = end - heading(angle_deg) * ((1.0f - rank) * 0.10f * length);
      leaf_or_bud(
          {node, angle_deg + off, length * stream_.uniform(0.8f, 1.04f), stream_.uniform() < leaf_.underside_share});
    }
    if (!dress_.leaves) bud(end, angle_deg, std::max(0.004f, 2.0f * twig_m()));
  }

  // Birch, beech, elm: a slender zigzag shoot with a leaf at every bend, and side shoots to left and right in turn,
  // shorter toward its tip. Maple, olive: the same in pairs, straight.
  void feather(bool pairs) {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const int total = leaf_.cluster_leaves;
    const int side_shoots = total < 8 ? 2 : std::min(8, 2 * ((total + 4) / 9));
    const int on_main = std::max(3, total * 2 / 5);
    const int on_sides = std::max(side_shoots, total - on_main);
    const float lean = spread(5.0f), zigzag = pairs ? 0.0f : 7.0f;
    const int nodes = pairs ? std::max(2, (on_main + 1) / 2) : on_main;
    const auto main = shoot({0.0f, 0.0f}, lean, -2.0f * lean, 0.82f * side - (pairs ? 0.3f * length : 0.0f), zigzag,
                            0.5f * twig_m(), 0.22f * twig_m(), std::max(nodes + 2, side_shoots + 3));
    // Longest in the lower half, where the card is widest around them.
    float weight = 0.0f;
    const auto share = [&](int k) { return 1.0f - 0.09f * static_cast<float>(k); };
    for (int k = 0; k < side_shoots; ++k) weight += share(k);
    for (int k = 0; k < side_shoots; ++k) {
      const int rank = pairs ? k / 2 : k, ranks = pairs ? (side_shoots + 1) / 2 : side_shoots;
      const float h = k % 2 == 0 ? -1.0f : 1.0f;
      const float t = 0.12f + 0.55f * static_cast<float>(rank) / static_cast<float>(ranks);
      const Vec2 foot = main[static_cast<std::size_t>(t * static_cast<float>(main.size() - 1) + 0.5f)];
      const float angle = h * stream_.uniform(42.0f, 54.0f);
      const float reach = std::min(0.46f * side * (1.0f - 0.45f * t), 0.80f * room(foot, angle));
      const int leaves = std::max(1, static_cast<int>(static_cast<float>(on_sides) * share(k) / weight + 0.5f));
      const int steps = (pairs ? (leaves + 1) / 2 : leaves) + 1;
      const auto points =
          shoot(foot, angle, -h * 20.0f, reach, 0.8f * zigzag, 0.3f * twig_m(), 0.18f * twig_m(), steps);
      along(points, 1, 0.92f * length, 48.0f, k % 2 == 0 ? -1 : 1, pairs);
    }
    along(main, 2, length, 52.0f, 1, pairs);
  }

  // Leaves alternately left and right at a shoot's points from `first` on, or in pairs; the last one ahead.
  void along(const std::vector<Vec2>& points, std::size_t first, float length, float angle_deg, int hand,
             bool pairs = false) {
    for (std::size_t i = first; i < points.size(); ++i) {
      const Vec2 ahead = glm::normalize(points[i] - points[i - 1]);
      const float shoot_deg = degrees(atan2(ahead.x, ahead.y));
      const bool last = i + 1 == points.size();
      // Smaller toward the end of the shoot.
      const float t = static_cast<float>(i) / static_cast<float>(points.size());
      const auto one = [&](float off) {
        leaf_or_bud({points[i], shoot_deg + off, length * (1.08f - 0.28f * t) * stream_.uniform(0.85f, 1.05f),
                     stream_.uniform() < leaf_.underside_share});
      };
      if (pairs) {
        // Pairs cross: every other one is seen from its edge, which its stalks show as shorter.
        const float angle = angle_deg * (i % 2 == 0 ? 1.0f : 0.72f);
        one(-angle * (1.0f + spread(0.2f)));
        one(angle * (1.0f + spread(0.2f)));
        if (last) one(spread(10.0f));
        continue;
      }
      one(last ? spread(12.0f) : static_cast<float>(hand) * angle_deg * (1.0f + spread(0.25f)));
      hand = -hand;
    }
  }

  // Weeping willow: whips side by side, leaves along them, tips ahead.
  void strings() {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const int count = std::clamp(leaf_.cluster_leaves / 18, 2, 5);
    const int leaves = std::max(3, leaf_.cluster_leaves / count);
    const Vec2 root{0.0f, 1.5f * kAtlasMargin * side};
    canvas_.rod({0.0f, 0.0f}, root, 0.6f * twig_m(), 0.6f * twig_m(), dress_.twig, dress_.twig);
    for (int s = 0; s < count; ++s) {
      // Out from the common foot, then straight on, so that whips stay apart and daylight falls between them even when
      // the card is seen small. They end at unlike heights.
      const float place = (static_cast<float>(s) - 0.5f * static_cast<float>(count - 1)) / static_cast<float>(count);
      const float x = 0.95f * place * side, y = 0.22f * side, rise = std::sqrt(x * x + y * y);
      const float out = degrees(atan2(x, y)) / 0.75f;
      const int low = std::max(2, leaves / 5);
      const auto foot = shoot(root, 1.15f * out, -0.8f * out, rise, 0.0f, 0.5f * twig_m(), 0.45f * twig_m(), low);
      const float lean = spread(5.0f), reach = stream_.uniform(0.60f, 0.84f) * side - 0.5f * y;
      const auto whip =
          shoot(foot.back(), lean, -1.6f * lean, reach, 1.5f, 0.45f * twig_m(), 0.2f * twig_m(), leaves - low);
      along(foot, 2, length, 18.0f, s % 2 == 0 ? 1 : -1);
      along(whip, 1, length, 15.0f, s % 2 == 0 ? 1 : -1);
    }
  }

  // Spruce: a shoot with side shoots to both sides, all clothed in needles, shorter toward the tip.
  void spray() {
    const float side = canvas_.side();
    const float lean = spread(4.0f), reach = 0.88f * side;
    const int pairs = std::max(1, leaf_.cluster_leaves / 2);
    const auto point = [&](float t) { return Vec2(lean * 0.01f * side * t * (1.0f - t), t * reach); };
    for (int i = 0; i < pairs; ++i) {
      for (const int hand : {-1, 1}) {
        const float t = 0.10f + 0.72f * (static_cast<float>(i) + 0.5f * stream_.uniform() + (hand > 0 ? 0.25f : 0.0f)) /
                                    static_cast<float>(pairs);
        const float angle = static_cast<float>(hand) * stream_.uniform(44.0f, 58.0f);
        const float length =
            std::min(0.40f * side, (0.13f + 0.42f * (1.0f - t)) * side) * stream_.uniform(0.82f, 1.05f);
        const float most = (0.5f * side * (1.0f - 3.0f * kAtlasMargin) - 0.75f * metres(leaf_.length_mm)) /
                           std::fabs(heading(angle).x);
        needle_shoot(point(t), angle, std::min(length, most), 0.3f * twig_m(), -0.22f * angle, 0.55f + 0.45f * t);
      }
    }
    needle_shoot(point(0.0f), lean, reach, 0.5f * twig_m(), -2.0f * lean, 1.0f);
  }

  // Pine: bare wood forks, the ends of its few shoots stand in long needles on all sides.
  void brush() {
    const float side = canvas_.side(), needle = metres(leaf_.length_mm);
    const int shoots = std::max(2, leaf_.cluster_leaves);
    const auto wood =
        shoot({0.0f, 0.0f}, spread(4.0f), spread(8.0f), 0.30f * side, 2.0f, 0.5f * twig_m(), 0.4f * twig_m(), 4);
    for (int k = shoots; k-- > 0;) {
      const float place =
          shoots > 1 ? 2.0f * static_cast<float>((k * 2 + 1) % shoots) / static_cast<float>(shoots - 1) - 1.0f : 0.0f;
      const bool leader = k == 0;
      const float angle = leader ? spread(4.0f) : std::clamp(62.0f * place + spread(8.0f), -66.0f, 66.0f);
      const Vec2 foot = wood[static_cast<std::size_t>(leader ? 4 : 2 + k % 3)];
      const float length =
          std::min((leader ? 0.55f : stream_.uniform(0.30f, 0.42f)) * side, room(foot, angle) - needle);
      if (length > 0.02f) needle_shoot(foot, angle, length, 0.34f * twig_m(), -0.35f * angle, 8.0f);
    }
  }

  // A shoot clothed in needles: those behind, the wood, those to the sides and on top. The outer part is this year's.
  void needle_shoot(Vec2 base, float angle_deg, float length, float radius, float bend_deg, float bare_share) {
    const float needle = metres(leaf_.length_mm), width = metres(leaf_.width_mm);
    const int count = static_cast<int>(length * static_cast<float>(leaf_.needles_per_m));
    const bool long_needles = leaf_.fascicle > 1;
    constexpr int kPieces = 8;
    std::vector<Vec2> points{base};
    for (int i = 0; i < kPieces; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / kPieces;
      points.push_back(points.back() + heading(angle_deg + bend_deg * t) * (length / kPieces));
    }
    const auto at = [&](float t) {
      const float x = std::clamp(t, 0.0f, 0.9999f) * kPieces;
      const auto i = static_cast<std::size_t>(x);
      return glm::mix(points[i], points[i + 1], x - static_cast<float>(i));
    };
    const float this_year = 1.0f - std::min(0.4f, 0.04f / length);
    for (int layer = 0; layer < 3; ++layer) {
      if (layer == 1) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
          const float t = static_cast<float>(i) / kPieces;
          canvas_.rod(points[i], points[i + 1], radius * (1.0f - 0.6f * t), radius * (0.95f - 0.6f * t), dress_.twig,
                      dress_.twig);
        }
      }
      const int needles = layer == 0 ? count * 2 / 5 : layer == 1 ? count * 2 / 5 : count / 5;
      for (int i = 0; i < needles; ++i) {
        const float t = (static_cast<float>(i) + stream_.uniform()) / static_cast<float>(needles);
        if (t < 0.02f * bare_share) continue;
        const float hand = stream_.uniform() < 0.5f ? -1.0f : 1.0f;
        // Swept forward; those on top lie closer to the shoot. Crowded forward at the tip.
        float off = layer == 2 ? stream_.uniform(4.0f, 26.0f) : stream_.uniform(26.0f, long_needles ? 66.0f : 58.0f);
        off *= 1.0f - 0.8f * smooth_step(0.8f, 1.0f, t);
        const Vec2 foot = at(t);
        const float young = smooth_step(this_year - 0.02f, this_year + 0.02f, t);
        const float bright = 1.0f + 2.2f * spread(leaf_.colour_variation);
        const bool under = stream_.uniform() < leaf_.underside_share;
        const Vec3 old = under ? glm::mix(dress_.upper, dress_.under, 0.6f) : dress_.upper;
        // This year's needles are a little lighter all summer, fresh green in spring.
        const Vec3 fresh = season_ == Season::spring ? dress_.tip : dress_.upper * Vec3(1.35f, 1.32f, 1.15f);
        const float shade = layer == 0 ? 0.70f : layer == 1 ? 1.0f : 1.15f;
        const float reach = needle * stream_.uniform(0.72f, 1.05f) * (layer == 2 ? 0.8f : 1.0f);
        for (int f = 0; f < leaf_.fascicle; ++f) {
          const float apart = 7.0f * (static_cast<float>(f) - 0.5f * static_cast<float>(leaf_.fascicle - 1));
          const Vec2 tip = foot + heading(angle_deg + bend_deg * t + hand * off + apart) * reach;
          canvas_.needle(foot, tip, width, glm::mix(old, fresh, young) * bright, shade);
        }
      }
    }
    nodes_.push_back({at(0.75f), angle_deg + bend_deg});
    if (long_needles && season_ == Season::spring)  // a candle
      canvas_.rod(at(1.0f), at(1.0f) + heading(angle_deg + bend_deg) * std::min(0.05f, 0.8f * needle), 0.0035f, 0.002f,
                  dress_.tip, dress_.tip);
    else if (!dress_.leaves || season_ == Season::bare || season_ == Season::autumn)
      bud(at(1.0f), angle_deg + bend_deg, 1.2f * radius + 0.002f);
  }

  // Cypress: cords that branch twice, all round and green but at their foot.
  void cords() {
    const float side = canvas_.side();
    const int pairs = std::max(1, leaf_.cluster_leaves / 2);
    const float lean = spread(3.0f), reach = 0.90f * side;
    for (int i = 0; i < pairs; ++i)
      for (const int hand : {-1, 1}) {
        const float t = 0.06f + 0.80f * (static_cast<float>(i) + 0.5f * stream_.uniform() + (hand > 0 ? 0.4f : 0.0f)) /
                                    static_cast<float>(pairs);
        const float angle = static_cast<float>(hand) * stream_.uniform(28.0f, 44.0f);
        const Vec2 foot{0.0f, t * reach};
        const float length =
            std::min((0.16f + 0.34f * (1.0f - t)) * side * stream_.uniform(0.8f, 1.1f), 0.94f * room(foot, angle));
        cord(foot, angle, length, 1, 0.75f + 0.3f * stream_.uniform());
      }
    cord({0.0f, 0.0f}, lean, reach, 0, 1.0f);
  }

  // A cord with `orders` orders of side cords, its scales as alternating lighter and darker pieces.
  void cord(Vec2 base, float angle_deg, float length, int orders, float bright) {
    const float width = metres(leaf_.width_mm), bend = spread(14.0f);
    const int pieces =
        std::max(4, static_cast<int>(length / std::max(metres(leaf_.length_mm), 1.2f * canvas_.pixel())));
    std::vector<Vec2> points{base};
    for (int k = 0; k < pieces; ++k)
      points.push_back(points.back() + heading(angle_deg + bend * static_cast<float>(k) / static_cast<float>(pieces)) *
                                           (length / static_cast<float>(pieces)));
    if (orders > 0) {
      const int sides = std::max(3, static_cast<int>(length / 0.009f));
      for (int k = 0; k < sides; ++k) {
        const float t = 0.10f + 0.85f * (static_cast<float>(k) + 0.6f * stream_.uniform()) / static_cast<float>(sides);
        const float hand = k % 2 == 0 ? -1.0f : 1.0f;
        const Vec2 foot = points[static_cast<std::size_t>(t * static_cast<float>(pieces))];
        const float turn = angle_deg + bend * t + hand * stream_.uniform(32.0f, 50.0f);
        const float reach =
            std::min(length * (0.12f + 0.26f * (1.0f - t)) * stream_.uniform(0.7f, 1.1f), 0.9f * room(foot, turn));
        cord(foot, turn, reach, orders - 1, bright * stream_.uniform(0.72f, 1.1f));
      }
    }
    const Vec3 fresh = season_ == Season::spring ? dress_.tip : dress_.upper * 1.25f;
    for (int k = 0; k < pieces; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(pieces);
      const float scale = k % 2 == 0 ? 0.88f : 1.12f, half = 0.5f * width * (orders > 0 ? 1.15f : 1.0f - 0.4f * t * t);
      const Vec3 green = glm::mix(dress_.upper, fresh, smooth_step(0.6f, 1.0f, t)) * (bright * scale);
      const auto i = static_cast<std::size_t>(k);
      const bool wood = length > 0.6f * canvas_.side() && t < 0.35f;
      canvas_.rod(points[i], points[i + 1], half, half, wood ? dress_.twig : green, wood ? dress_.twig : green);
    }
    nodes_.push_back({points[points.size() / 2], angle_deg});
  }

  // Bunches at nodes spread over the twig. On a level twig what hangs is seen hanging to either side, on a drooping one
  // ahead; what stands points ahead too.
  void hang_bunches() {
    if (nodes_.empty()) return;
    const float extent = bunch_extent_m(*bloom_);
    const bool hangs = bloom_->form == BloomForm::catkin || bloom_->form == BloomForm::balls ||
                       bloom_->form == BloomForm::keys || bloom_->form == BloomForm::bracts ||
                       bloom_->form == BloomForm::drupes || bloom_->form == BloomForm::nuts ||
                       bloom_->form == BloomForm::cones;
    for (int b = 0; b < bloom_->bunches; ++b) {
      // Farthest apart among the nodes, in an order that jumps; the ends first, where light is.
      const std::size_t k = nodes_.size() - 1 - static_cast<std::size_t>(b) * 7919u % nodes_.size();
      const Node& node = nodes_[k];
      float angle = hangs ? (node.at.x < 0.0f ? -1.0f : 1.0f) * stream_.uniform(20.0f, 130.0f)
                          : 0.6f * std::clamp(node.angle_deg, -80.0f, 80.0f) + spread(18.0f);
      // Turned inward where the cell ends.
      for (int turn = 0; turn < 10 && room(node.at, angle) < extent; ++turn) angle *= 0.75f;
      if (room(node.at, angle) < 0.5f * extent) angle = 180.0f - angle;
      paint_bunch(canvas_, stream_, *bloom_, stalk_colour(), node.at, angle);
    }
  }

  const LeafLook& leaf_;
  Dress dress_;
  Season season_;
  const Bloom* bloom_;
  bool folded_;
  RandomStream stream_;
  AtlasCanvas canvas_;
  std::vector<LeafBlade> blades_;
  std::vector<Node> nodes_;
};

}  // namespace

AtlasCanvas paint_cell(const LeafLook& leaf, Season season, const Bloom* bloom, AtlasSubject subject,
                       std::uint64_t seed, int cell, int pixels, float side_m) {
  Painter painter(leaf, season, bloom, seed, cell, pixels, side_m);
  switch (subject) {
    case AtlasSubject::twig:
      return painter.twig();
    case AtlasSubject::leaf:
      return painter.single();
    case AtlasSubject::bunch:
      break;
  }
  return painter.bunch();
}

Vec3 twig_albedo(const LeafLook& leaf) { return albedo(leaf.twig_colour); }

}  // namespace bosquet::geometry
