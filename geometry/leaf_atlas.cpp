#include "geometry/leaf_atlas.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/scalar.h"
#include "geometry/atlas_blade.h"
#include "geometry/atlas_canvas.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

constexpr int kBlades = 4;  // outlines that a tree's leaves take turns with

Vec2 heading(float angle_deg) {  // 0 up, positive to the right
  const SinCos a = sin_cos(radians(angle_deg));
  return {a.sin, a.cos};
}

// The colours of one season, linear albedo.
struct Dress {
  Vec3 upper, edge, under, twig, bud, tip;
  bool leaves = true;

  Dress(const LeafLook& leaf, Season season)
      : twig(kLeafAlbedo * linear_from_srgb(leaf.twig_colour)), bud(kLeafAlbedo * linear_from_srgb(leaf.bud_colour)) {
    const auto albedo = [](const Vec3& c) { return kLeafAlbedo * linear_from_srgb(c); };
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

// Paints the twigs and leaves of one cell.
class Painter {
 public:
  Painter(const LeafLook& leaf, const Dress& dress, Season season, std::uint64_t seed, int cell, int pixels, float side)
      : leaf_(leaf),
        dress_(dress),
        season_(season),
        stream_(seed, mix_bits(200 + static_cast<std::uint64_t>(cell)), Purpose::texture),
        canvas_(pixels, side, seed + static_cast<std::uint64_t>(cell)) {
    if (leaf.outline == LeafOutline::needle_spray) return;
    for (int i = 0; i < kBlades; ++i) blades_.emplace_back(leaf, seed, static_cast<std::uint64_t>(cell * kBlades + i));
  }

  AtlasCanvas cluster() {
    switch (leaf_.cluster) {
      case ClusterForm::tuft:
        tuft();
        break;
      case ClusterForm::alternate:
        alternate();
        break;
      case ClusterForm::strings:
        strings();
        break;
      case ClusterForm::spray:
        spray();
        break;
    }
    return std::move(canvas_);
  }

  AtlasCanvas single() {
    if (leaf_.outline == LeafOutline::needle_spray) {
      needle_shoot({0.0f, 0.0f}, 0.0f, 0.82f * canvas_.side(), 0.4f * twig(), 0.0f, 1.0f);
    } else if (dress_.leaves) {
      leaf({{0.0f, 0.0f}, stream_.uniform(-3.0f, 3.0f), metres(leaf_.length_mm), false, true});
    }
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

  static float metres(float mm) { return 0.001f * mm; }
  float twig() const { return metres(leaf_.twig_mm); }
  float spread(float x) { return stream_.uniform(-x, x); }

  // Draws the blade in toward the twig until it lies inside the cell.
  float fitted(Vec2 base, Vec2 direction, float length, float half) const {
    const float rim = 0.5f * canvas_.side() * (1.0f - 2.5f * kAtlasMargin);
    const Vec2 middle{0.0f, 0.5f * canvas_.side()}, across{direction.y, -direction.x};
    for (int i = 0; i < 24; ++i, length *= 0.93f) {
      bool inside = true;
      for (const float at : {0.45f, 0.75f, 1.0f}) {
        const float width = at < 1.0f ? half * length : 0.0f;
        for (const float s : {-1.0f, 1.0f}) {
          const Vec2 p = base + direction * (at * length) + across * (s * width) - middle;
          inside = inside && std::fabs(p.x) <= rim && std::fabs(p.y) <= rim;
        }
      }
      if (inside) break;
    }
    return length;
  }

  void leaf(const Leaf& at) {
    const LeafBlade& blade = blades_[stream_.below(kBlades)];
    const float petiole = metres(leaf_.petiole_mm) * (at.flat ? 1.0f : at.length / metres(leaf_.length_mm));
    const Vec2 direction = heading(at.angle_deg);
    // The stalk sets off more steeply than the blade hangs.
    const Vec2 stalk = glm::normalize(direction + Vec2(0.0f, 0.25f));
    const Vec2 base = at.node + stalk * petiole;
    BladePose pose;
    pose.base = base;
    pose.direction = direction;
    pose.bend = at.flat ? spread(0.05f) : spread(0.14f);
    pose.narrow = at.flat ? 1.0f : 1.0f - 0.45f * stream_.uniform() * stream_.uniform();
    pose.tilt = at.flat ? Vec2(spread(0.1f), 0.0f) : Vec2(spread(0.45f), spread(0.4f));
    pose.length = fitted(base, direction, at.length * (at.flat ? 1.0f : stream_.uniform(0.85f, 1.0f)),
                         blade.half_width() + std::fabs(pose.bend));
    pose.shadow = at.flat ? 0.0f : 0.42f;
    const float bright = 1.0f + 2.0f * spread(leaf_.colour_variation);
    const float warm = 0.6f * spread(leaf_.colour_variation);
    const Vec3 hue{1.0f + 1.5f * warm, 1.0f, 1.0f - 2.0f * warm};
    Vec3 upper = dress_.upper, edge = dress_.edge * (season_ == Season::autumn ? 1.0f : 0.86f);
    if (season_ == Season::autumn) {
      // Some have turned farther than others, some are still green about the veins.
      const float turned = stream_.uniform();
      upper = glm::mix(upper, dress_.edge, 0.75f * turned * turned);
      if (turned < 0.25f) upper = glm::mix(upper, kLeafAlbedo * linear_from_srgb(leaf_.summer), 0.45f);
    } else if (season_ == Season::summer) {
      edge = glm::mix(edge, kLeafAlbedo * linear_from_srgb(leaf_.spring), 0.10f);
    }
    pose.colour = (at.under ? dress_.under * glm::mix(Vec3(1.0f), hue, 0.3f) : upper * hue) * bright;
    pose.edge = (at.under ? 0.95f * dress_.under : edge * hue) * bright;
    pose.vein = at.under ? pose.colour * 1.25f : glm::mix(pose.colour * 1.7f, dress_.under, 0.45f);
    pose.mottle = 0.6f * leaf_.colour_variation + (season_ == Season::autumn ? 0.06f : 0.02f);
    canvas_.rod(at.node, base + direction * (0.04f * pose.length), std::max(0.00045f, 0.011f * pose.length),
                std::max(0.0003f, 0.008f * pose.length), glm::mix(pose.vein, dress_.twig, 0.35f), pose.vein);
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
    if (dress_.leaves) {
      leaf(at);
    } else {
      // Half of the axils have grown a spur or a fine side twig.
      const float size = std::max(0.003f, 1.4f * twig()), angle = 0.7f * at.angle_deg;
      Vec2 end = at.node;
      if (stream_.below(2) == 0) {
        const Vec2 direction = heading(angle);
        const float length = fitted(at.node, direction, at.length * stream_.uniform(0.3f, 0.9f) + size, 0.05f) - size;
        if (length > 0.0f) {
          end = at.node + direction * length;
          canvas_.rod(at.node, end, 0.25f * twig(), 0.15f * twig(), dress_.twig, dress_.twig);
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

  // Oak: leaves crowd round the ends of a stout shoot and of its spurs.
  void tuft() {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const float lean = spread(7.0f);
    const auto main = shoot({0.0f, 0.0f}, lean, -2.0f * lean, 0.56f * side, 3.0f, 0.55f * twig(), 0.35f * twig(), 6);
    const int total = leaf_.cluster_leaves, end = std::max(3, (total * 6 + 5) / 11),
              spur = std::max(1, (total - end) / 2);
    for (const int hand : {-1, 1}) {
      const float h = static_cast<float>(hand);
      const Vec2 foot = main[hand < 0 ? 2 : 3];
      const float angle = h * stream_.uniform(48.0f, 60.0f);
      const auto side_shoot = shoot(foot, angle, -h * 20.0f, 0.17f * side, 2.0f, 0.35f * twig(), 0.28f * twig(), 3);
      rosette(side_shoot.back(), angle - h * 12.0f, spur, 78.0f, 0.92f * length);
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
    if (!dress_.leaves) bud(end, angle_deg, std::max(0.004f, 2.0f * twig()));
  }

  // Birch, beech, elm: a slender zigzag shoot, a leaf at every bend, two side shoots.
  void alternate() {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const int total = leaf_.cluster_leaves, on_main = std::max(3, (total + 1) / 2),
              on_side = std::max(1, (total - on_main) / 2);
    const float lean = spread(5.0f);
    const auto main =
        shoot({0.0f, 0.0f}, lean, -2.0f * lean, 0.80f * side, 7.0f, 0.5f * twig(), 0.22f * twig(), on_main + 2);
    for (const int hand : {-1, 1}) {
      const float h = static_cast<float>(hand);
      const Vec2 foot = main[hand < 0 ? 1 : 2];
      const float angle = h * stream_.uniform(40.0f, 50.0f);
      const auto twig_points =
          shoot(foot, angle, -h * 22.0f, 0.40f * side, 6.0f, 0.3f * twig(), 0.18f * twig(), on_side + 1);
      along(twig_points, 1, 0.92f * length, 46.0f, hand);
    }
    along(main, 2, length, 52.0f, 1);
  }

  // Leaves alternately left and right at a shoot's points from `first` on, the last one ahead.
  void along(const std::vector<Vec2>& points, std::size_t first, float length, float angle_deg, int hand) {
    for (std::size_t i = first; i < points.size(); ++i) {
      const Vec2 ahead = glm::normalize(points[i] - points[i - 1]);
      const float shoot_deg = degrees(atan2(ahead.x, ahead.y));
      const bool last = i + 1 == points.size();
      const float off = last ? spread(12.0f) : static_cast<float>(hand) * angle_deg * (1.0f + spread(0.25f));
      hand = -hand;
      // Smaller toward the end of the shoot.
      const float t = static_cast<float>(i) / static_cast<float>(points.size());
      leaf_or_bud({points[i], shoot_deg + off, length * (1.08f - 0.28f * t) * stream_.uniform(0.85f, 1.05f),
                   stream_.uniform() < leaf_.underside_share});
    }
  }

  // Weeping willow: whips side by side, leaves along them, tips ahead.
  void strings() {
    const float side = canvas_.side(), length = metres(leaf_.length_mm);
    const int count = std::clamp(leaf_.cluster_leaves / 18, 2, 5);
    const int leaves = std::max(3, leaf_.cluster_leaves / count);
    const Vec2 root{0.0f, 1.5f * kAtlasMargin * side};
    canvas_.rod({0.0f, 0.0f}, root, 0.6f * twig(), 0.6f * twig(), dress_.twig, dress_.twig);
    for (int s = 0; s < count; ++s) {
      // Out from the common foot, then straight on, so that whips stay apart and daylight falls between them even when
      // the card is seen small. They end at unlike heights.
      const float place = (static_cast<float>(s) - 0.5f * static_cast<float>(count - 1)) / static_cast<float>(count);
      const float x = 0.95f * place * side, y = 0.22f * side, rise = std::sqrt(x * x + y * y);
      const float out = degrees(atan2(x, y)) / 0.75f;
      const int low = std::max(2, leaves / 5);
      const auto foot = shoot(root, 1.15f * out, -0.8f * out, rise, 0.0f, 0.5f * twig(), 0.45f * twig(), low);
      const float lean = spread(5.0f), reach = stream_.uniform(0.60f, 0.84f) * side - 0.5f * y;
      const auto whip =
          shoot(foot.back(), lean, -1.6f * lean, reach, 1.5f, 0.45f * twig(), 0.2f * twig(), leaves - low);
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
        const float room = (0.5f * side * (1.0f - 3.0f * kAtlasMargin) - 0.75f * metres(leaf_.length_mm)) /
                           std::fabs(heading(angle).x);
        needle_shoot(point(t), angle, std::min(length, room), 0.3f * twig(), -0.22f * angle, 0.55f + 0.45f * t);
      }
    }
    needle_shoot(point(0.0f), lean, reach, 0.5f * twig(), -2.0f * lean, 1.0f);
  }

  // A shoot clothed in needles: those behind, the wood, those to the sides and on top. The outer part is this year's.
  void needle_shoot(Vec2 base, float angle_deg, float length, float radius, float bend_deg, float bare_share) {
    const float needle = metres(leaf_.length_mm), width = metres(leaf_.width_mm);
    const float per_metre = 1500.0f;
    const int count = static_cast<int>(length * per_metre);
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
        float off = layer == 2 ? stream_.uniform(4.0f, 26.0f) : stream_.uniform(26.0f, 58.0f);
        off *= 1.0f - 0.8f * smooth_step(0.8f, 1.0f, t);
        const Vec2 foot = at(t);
        const Vec2 tip = foot + heading(angle_deg + bend_deg * t + hand * off) *
                                    (needle * stream_.uniform(0.72f, 1.05f) * (layer == 2 ? 0.8f : 1.0f));
        const float young = smooth_step(this_year - 0.02f, this_year + 0.02f, t);
        const float bright = 1.0f + 2.2f * spread(leaf_.colour_variation);
        const bool under = stream_.uniform() < leaf_.underside_share;
        const Vec3 old = under ? glm::mix(dress_.upper, dress_.under, 0.6f) : dress_.upper;
        // This year's needles are a little lighter all summer, fresh green in spring.
        const Vec3 fresh = season_ == Season::spring ? dress_.tip : dress_.upper * Vec3(1.35f, 1.32f, 1.15f);
        const float shade = layer == 0 ? 0.70f : layer == 1 ? 1.0f : 1.15f;
        canvas_.needle(foot, tip, width, glm::mix(old, fresh, young) * bright, shade);
      }
    }
    if (!dress_.leaves || season_ == Season::bare || season_ == Season::autumn)
      bud(at(1.0f), angle_deg + bend_deg, 1.2f * radius + 0.002f);
  }

  const LeafLook& leaf_;
  const Dress& dress_;
  Season season_;
  RandomStream stream_;
  AtlasCanvas canvas_;
  std::vector<LeafBlade> blades_;
};

// A texel of the whole atlas and of its coarser copies.
struct Sum {
  Vec3 colour{0.0f};
  float alpha = 0.0f;
};

// Straight colours everywhere: where nothing was painted, those of the nearest coarser copy that has any.
std::vector<Vec3> spread_colours(const std::vector<Sum>& finest, int size, const Vec3& fallback) {
  std::vector<std::vector<Sum>> levels{finest};
  for (int n = size / 2; n >= 1; n /= 2) {
    const std::vector<Sum>& fine = levels.back();
    std::vector<Sum> coarse(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        Sum& sum = coarse[static_cast<std::size_t>(y * n + x)];
        for (int k = 0; k < 4; ++k) {
          const Sum& s = fine[static_cast<std::size_t>((2 * y + k / 2) * 2 * n + 2 * x + k % 2)];
          sum.colour += s.colour, sum.alpha += s.alpha;
        }
      }
    }
    levels.push_back(std::move(coarse));
  }
  std::vector<Vec3> colours{levels.back()[0].alpha > 0.0f ? levels.back()[0].colour / levels.back()[0].alpha
                                                          : fallback};
  int n = 1;
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    n *= 2;
    std::vector<Vec3> finer(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    parallel_for(
        static_cast<std::size_t>(n),
        [&](std::size_t y) {
          for (std::size_t x = 0; x < static_cast<std::size_t>(n); ++x) {
            const std::size_t i = y * static_cast<std::size_t>(n) + x;
            const Sum& s = levels[l][i];
            finer[i] = s.alpha > 1.0f / 512.0f ? s.colour / s.alpha
                                               : colours[(y / 2) * static_cast<std::size_t>(n / 2) + x / 2];
          }
        },
        16);
    colours = std::move(finer);
  }
  return colours;
}

}  // namespace

float cluster_cell_m(const LeafLook& leaf) { return leaf.cluster_m; }

float leaf_cell_m(const LeafLook& leaf) {
  if (leaf.outline == LeafOutline::needle_spray) return 0.001f * 5.5f * leaf.length_mm;
  const float tall = 1.06f * leaf.length_mm + leaf.petiole_mm, wide = 1.12f * leaf.width_mm;
  return 0.001f * std::max(tall, wide) / (1.0f - 2.0f * kAtlasMargin);
}

LeafAtlas make_leaf_atlas(const LeafLook& leaf, Season season, std::uint64_t seed, int size) {
  assert(size >= 128 && size <= 4096 && (size & (size - 1)) == 0);
  const Dress dress(leaf, season);
  const int half = size / 2;
  std::vector<AtlasCanvas> cells;
  for (int c = 0; c < 4; ++c) cells.emplace_back(1, 1.0f, seed);
  parallel_for(4, [&](std::size_t c) {
    const float side = c < 2 ? cluster_cell_m(leaf) : leaf_cell_m(leaf);
    Painter painter(leaf, dress, season, seed, static_cast<int>(c), half, side);
    cells[c] = c < 2 ? painter.cluster() : painter.single();
  });

  LeafAtlas out{Image(size, size, 4), Image(half, half, 3)};
  const auto n = static_cast<std::size_t>(size);
  std::vector<Sum> sums(n * n);
  const auto texel = [&](int x, int y) -> const AtlasCanvas::Texel& {
    return cells[static_cast<std::size_t>((y / half) * 2 + x / half)].at(x % half, y % half);
  };
  parallel_for(
      n,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < n; ++x) {
          const AtlasCanvas::Texel& t = texel(static_cast<int>(x), static_cast<int>(y));
          sums[y * n + x] = {t.colour, t.alpha};
        }
      },
      16);
  const std::vector<Vec3> colours = spread_colours(sums, size, dress.twig);
  parallel_for(
      n,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < n; ++x) {
          std::uint8_t* pixel = out.base_colour.at(static_cast<int>(x), static_cast<int>(y));
          put_srgb(pixel, colours[y * n + x]);
          pixel[3] = unit_byte(sums[y * n + x].alpha);
        }
      },
      16);
  parallel_for(
      n / 2,
      [&](std::size_t row) {
        for (int x = 0; x < half; ++x) {
          Vec2 lean{0.0f};
          float alpha = 0.0f;
          for (int k = 0; k < 4; ++k) {
            const AtlasCanvas::Texel& t = texel(2 * x + k % 2, 2 * static_cast<int>(row) + k / 2);
            lean += t.lean, alpha += t.alpha;
          }
          if (alpha > 0.0f) lean /= alpha;
          put_normal(out.normal.at(x, static_cast<int>(row)), glm::normalize(Vec3(lean, 1.0f)));
        }
      },
      16);
  return out;
}

}  // namespace bosquet::geometry
