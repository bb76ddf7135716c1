#include "geometry/atlas_blade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/shares.h"

namespace bosquet::geometry {
namespace {

constexpr float kPalmateCentre = 0.2f;      // where the main veins of a palmate blade meet
constexpr float kLeafletAngle_deg = 58.0f;  // of leaflets to their stalk, and of the stalk's end leaflet 0
constexpr float kRachis = 0.006f;           // half the thickness of a compound leaf's stalk, in leaf lengths

float fraction(float x) { return x - static_cast<float>(static_cast<int>(x)); }  // x >= 0

// A tooth that leans to the tip: rises over most of its length, falls at once.
float tooth(float phase) {
  const float f = fraction(phase);
  return f < 0.8f ? f / 0.8f : (1.0f - f) / 0.2f;
}

// Half width of an unlobed blade at station t, greatest 1 at `widest`.
float simple_envelope(const LeafLook& look, LeafOutline outline, float t) {
  if (outline == LeafOutline::ovate_deltoid || outline == LeafOutline::lanceolate) {
    if (t < look.widest) {
      const float s = 1.0f - t / look.widest;
      return 1.0f - pow(s, outline == LeafOutline::ovate_deltoid ? 3.2f : 2.0f);
    }
    const float s = (t - look.widest) / (1.0f - look.widest);
    return pow(1.0f - s, 0.55f + 2.4f * look.point) * (1.0f + (0.35f + 1.6f * look.point) * s);
  }
  // Rounded, with a drip tip: an oval body that ends before the tip, and a narrow point.
  if (t < look.widest) {
    const float s = 1.0f - t / look.widest;
    const float round = std::sqrt(std::max(0.0f, 1.0f - s * s));
    return outline == LeafOutline::cordate ? std::sqrt(round) : round * (0.55f + 0.45f * round);
  }
  const float s = (t - look.widest) / (1.0f - look.widest);
  const float end = 1.0f - 0.9f * look.point, narrows = 1.0f - 1.6f * look.point;
  const auto body = [&](float at) {
    const float x = std::min(1.0f, at / end);
    return std::sqrt(std::max(0.0f, 1.0f - x * x)) * (1.0f - 0.12f * x);
  };
  if (s <= narrows) return body(s);
  const float x = std::max(0.0f, (1.0f - s) / (1.0f - narrows));
  return body(narrows) * x * std::sqrt(x);
}

// A lobe of a palmate blade: how far out of the bay (0) it reaches to its tip (1), x from its vein to the bay.
struct LobePoint {
  float x, reach;
};
// London plane: broad, a few large teeth. Norway maple: nearly parallel sides, long threads at the corners.
constexpr std::array<LobePoint, 7> kToothedLobe{
    {{0.0f, 1.0f}, {0.22f, 0.74f}, {0.30f, 0.77f}, {0.52f, 0.44f}, {0.60f, 0.49f}, {0.85f, 0.08f}, {1.0f, 0.0f}}};
constexpr std::array<LobePoint, 9> kThreadedLobe{{{0.0f, 1.0f},
                                                  {0.05f, 0.88f},
                                                  {0.20f, 0.66f},
                                                  {0.38f, 0.60f},
                                                  {0.46f, 0.76f},
                                                  {0.55f, 0.46f},
                                                  {0.72f, 0.22f},
                                                  {0.88f, 0.05f},
                                                  {1.0f, 0.0f}}};
constexpr std::array<LobePoint, 4> kPlainLobe{{{0.0f, 1.0f}, {0.3f, 0.72f}, {0.7f, 0.16f}, {1.0f, 0.0f}}};

template <std::size_t N>
float lobe_reach(const std::array<LobePoint, N>& lobe, float x) {
  for (std::size_t k = 1; k < N; ++k)
    if (x <= lobe[k].x)
      return lobe[k - 1].reach +
             (lobe[k].reach - lobe[k - 1].reach) * (x - lobe[k - 1].x) / (lobe[k].x - lobe[k - 1].x);
  return 0.0f;
}

// Obovate, blunt at the tip.
float lobed_envelope(const LeafLook& look, float t) {
  constexpr float kBlunt = 0.5f;
  const float rise = kBlunt * look.widest / (1.0f - look.widest);
  const auto shape = [&](float x) { return pow(x, rise) * pow(1.0f - x, kBlunt); };
  return shape(t) / shape(look.widest);
}

}  // namespace

LeafBlade::LeafBlade(const LeafLook& look, std::uint64_t seed, std::uint64_t variant)
    : build_(look.outline == LeafOutline::palmate            ? Build::palmate
             : look.outline == LeafOutline::pinnate_compound ? Build::compound
                                                             : Build::simple) {
  RandomStream stream(seed, mix_bits(variant + 100), Purpose::texture);
  veins_ = std::max(1, look.vein_pairs);
  vein_spacing_ = 0.88f / static_cast<float>(veins_);
  switch (build_) {
    case Build::simple:
      make_profiles(look, stream, look.width_mm / look.length_mm);
      break;
    case Build::palmate:
      make_palmate(look, stream);
      break;
    case Build::compound:
      make_compound(look, stream);
      break;
  }
}

void LeafBlade::make_profiles(const LeafLook& look, RandomStream& stream, float aspect) {
  const bool compound = build_ == Build::compound;
  const LeafOutline outline = compound ? LeafOutline::elliptic : look.outline;
  const bool lobed = outline == LeafOutline::pinnate_lobed && look.lobes > 0;
  const float half = 0.5f * aspect;
  const float lobes = static_cast<float>(look.lobes);
  constexpr float kFirst = 0.10f;  // the lowest bay
  sweep_ = lobed ? 0.55f : look.margin == LeafMargin::entire ? 0.0f : 0.35f;
  if (outline == LeafOutline::cordate)
    for (float& n : notch_) n = stream.uniform(0.05f, 0.12f), foot_ = std::max(foot_, 0.8f * n);
  vein_sweep_ = lobed ? sweep_ : outline == LeafOutline::lanceolate ? 1.6f : 0.85f;
  if (outline == LeafOutline::lanceolate) vein_strength_ = 0.3f;
  if (lobed) {
    // A vein into every lobe; the last half lobe is the tip.
    vein_spacing_ = (1.0f - kFirst) / (lobes + 0.5f);
    vein_first_ = kFirst + 0.5f * vein_spacing_;
    veins_ = look.lobes;
  }
  for (Profile& side : sides_) {
    std::array<float, 12> depth{}, shift{};
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = stream.uniform(0.75f, 1.2f);
      shift[i] = stream.uniform(-0.12f, 0.12f);
    }
    const float size = stream.uniform(0.93f, 1.05f), teeth_phase = stream.uniform();
    for (int i = 0; i <= kStations; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(kStations);
      float width = 0.0f;
      if (lobed) {
        width = lobed_envelope(look, std::min(t, 0.9999f));
        // Lobes are round ends side by side, of unequal width; the bays between them narrow, deepest in the middle.
        const float phase = std::max(0.0f, (t - kFirst) / vein_spacing_);
        const auto lobe = std::min<std::size_t>(static_cast<std::size_t>(phase), depth.size() - 2);
        const float low = static_cast<float>(lobe) + (lobe == 0 ? 0.0f : shift[lobe]);
        const float high = static_cast<float>(lobe) + 1.0f + shift[lobe + 1];
        const float x = std::clamp(2.0f * (phase - low) / (high - low) - 1.0f, -1.0f, 1.0f);
        const float bay = depth[x < 0.0f ? lobe : lobe + 1];
        const float round = std::sqrt(std::max(0.0f, 1.0f - 1.32f * x * x));
        const float grown = smooth_step(0.0f, 0.35f, t) * (1.0f - smooth_step(0.74f, 0.96f, t));
        if (phase < lobes + 0.5f) width *= 1.0f - look.lobe_depth * bay * (1.0f - round) * (0.3f + 0.7f * grown);
        // Ears at the base.
        width = std::max(width, 0.24f * std::sqrt(std::max(0.0f, 1.0f - (t - 0.035f) * (t - 0.035f) / 0.0013f)));
      } else {
        width = simple_envelope(look, outline, t);
        const float fine = (compound ? 26.0f : look.length_mm / 3.0f),
                    taper = smooth_step(0.03f, 0.15f, t) * (1.0f - t * t);
        const float pairs = static_cast<float>(veins_);
        switch (look.margin) {
          case LeafMargin::entire:
            break;
          case LeafMargin::fine_teeth:
            width += 0.05f * (tooth(t * std::min(fine, 34.0f) + teeth_phase) - 0.5f) * taper;
            break;
          case LeafMargin::coarse_teeth:
            width += 0.13f * (tooth(t * pairs * 1.5f + teeth_phase) - 0.5f) * taper;
            break;
          case LeafMargin::long_teeth:
            width += 0.22f * (tooth(t * pairs + teeth_phase) - 0.5f) * taper;
            break;
          case LeafMargin::double_teeth:
            width += (0.15f * (tooth(t * pairs * 1.15f + teeth_phase) - 0.4f) +
                      0.08f * (tooth(t * pairs * 3.45f + teeth_phase) - 0.5f)) *
                     taper;
            break;
        }
      }
      side.width[static_cast<std::size_t>(i)] = half * size * std::max(0.0f, width);
    }
    for (std::size_t i = 0; i <= kStations; ++i) {
      const std::size_t a = i == 0 ? 0 : i - 1, b = std::min<std::size_t>(i + 1, kStations);
      const float slope = (side.width[b] - side.width[a]) * static_cast<float>(kStations) / static_cast<float>(b - a);
      side.slant[i] = 1.0f / std::sqrt(1.0f + std::min(slope * slope, 9.0f));
    }
  }
  half_width_ = 0.0f;
  for (const Profile& side : sides_)
    half_width_ = std::max(half_width_, *std::max_element(side.width.begin(), side.width.end()));
}

void LeafBlade::make_palmate(const LeafLook& look, RandomStream& stream) {
  // Radius over the angle from the tip, 0 .. pi, each side. The middle lobe is the longest, those at the stalk short.
  lobes_each_ = std::max(1, look.lobes / 2);
  const float count = static_cast<float>(lobes_each_);
  lobe_angle_ = radians(lobes_each_ == 1 ? 62.0f : 118.0f / count);
  const float tip = 1.0f - kPalmateCentre;
  // The upper side lobes make the width.
  const float first = std::min(1.15f, 0.5f * look.width_mm / look.length_mm / sin_cos(lobe_angle_).sin / tip);
  const float last = lobes_each_ > 1 ? 0.56f * first : first;
  for (Profile& side : sides_) {
    std::array<float, 8> reach{}, at{};
    for (std::size_t k = 0; k < reach.size(); ++k) {
      const float t = count > 1.0f ? std::clamp((static_cast<float>(k) - 1.0f) / (count - 1.0f), 0.0f, 1.0f) : 0.0f;
      reach[k] = tip * (k == 0 ? 1.0f : first + (last - first) * t) * (k == 0 ? 1.0f : stream.uniform(0.93f, 1.04f));
      at[k] = lobe_angle_ * (static_cast<float>(k) + (k == 0 ? 0.0f : stream.uniform(-0.06f, 0.06f)));
    }
    const float bay_depth = 1.0f - look.lobe_depth;
    for (int i = 0; i <= kStations; ++i) {
      const float angle = kPi * static_cast<float>(i) / static_cast<float>(kStations);
      // Between which veins, and how deep the bay between them is.
      std::size_t low = 0;
      while (low + 1 <= static_cast<std::size_t>(lobes_each_) && angle > at[low + 1]) ++low;
      float radius;
      const auto shape = [&](float x) {
        return look.margin == LeafMargin::long_teeth ? lobe_reach(kThreadedLobe, x)
               : look.margin == LeafMargin::entire   ? lobe_reach(kPlainLobe, x)
                                                     : lobe_reach(kToothedLobe, x);
      };
      if (low < static_cast<std::size_t>(lobes_each_)) {
        const float middle = 0.5f * (at[low] + at[low + 1]);
        const float bay = bay_depth * std::min(reach[low], reach[low + 1]);
        const std::size_t own = angle < middle ? low : low + 1;
        const float x = std::fabs(angle - at[own]) / std::max(1e-3f, std::fabs(middle - at[own]));
        radius = bay + (reach[own] - bay) * shape(std::min(1.0f, x));
      } else {
        // From the last lobe down to the stalk.
        const float x = (angle - at[low]) / std::max(1e-3f, kPi - at[low]);
        const float base = 0.30f * tip;
        radius = base + (reach[low] - base) * shape(std::min(1.0f, 1.25f * x));
        radius *= 1.0f - 0.55f * smooth_step(0.75f, 1.0f, x);
      }
      side.width[static_cast<std::size_t>(i)] = radius;
    }
    constexpr float kStep = kPi / static_cast<float>(kStations);
    for (std::size_t i = 0; i <= kStations; ++i) {
      const std::size_t a = i == 0 ? 0 : i - 1, b = std::min<std::size_t>(i + 1, kStations);
      const float slope = (side.width[b] - side.width[a]) / (static_cast<float>(b - a) * kStep * side.width[i]);
      side.slant[i] = 1.0f / std::sqrt(1.0f + std::min(slope * slope, 12.0f));
    }
  }
  half_width_ = 0.0f;
  for (const Profile& side : sides_)
    for (int i = 0; i <= kStations; ++i)
      half_width_ = std::max(half_width_, side.width[static_cast<std::size_t>(i)] *
                                              sin_cos(kPi * static_cast<float>(i) / static_cast<float>(kStations)).sin);
  overhang_ = 0.25f;
}

void LeafBlade::make_compound(const LeafLook& look, RandomStream& stream) {
  pairs_ = std::max(1, look.lobes);
  // Leaflets as long as the width asks at their angle; the stalk's lowest fifth is bare.
  const SinCos lean = sin_cos(radians(kLeafletAngle_deg));
  leaflet_ = 0.5f * look.width_mm / look.length_mm / lean.sin;
  first_pair_ = 0.18f;
  pair_spacing_ = (1.0f - 0.9f * leaflet_ - first_pair_) / (static_cast<float>(pairs_) - 0.35f);
  make_profiles(look, stream, 0.28f);
  half_width_ = 0.5f * look.width_mm / look.length_mm * 1.06f;
}

float LeafBlade::profile_distance(float u, float v) const {
  const std::size_t hand = u < 0.0f ? 0 : 1;
  const Profile& side = sides_[hand];
  const float across = std::fabs(u), t = v - sweep_ * across * (1.12f - v);
  if (t <= 0.0f) return -std::max(across, -t) * 0.85f - 0.001f;
  if (t >= 1.0f) return -(t - 1.0f) - 0.5f * across - 0.001f;
  const float x = t * static_cast<float>(kStations);
  const auto i = static_cast<std::size_t>(x);
  const float f = x - static_cast<float>(i);
  const float width = side.width[i] + (side.width[i + 1] - side.width[i]) * f;
  const float inside = (width - across) * (side.slant[i] + (side.slant[i + 1] - side.slant[i]) * f);
  // A heart's notch, round between its ears.
  if (v < notch_[hand]) {
    const float depth = notch_[hand] - v;
    return std::min(inside, 0.7f * (across - 0.9f * depth));
  }
  return inside;
}

float LeafBlade::palmate_distance(float u, float v) const {
  const float y = v - kPalmateCentre, r = std::sqrt(u * u + y * y);
  const Profile& side = sides_[u < 0.0f ? 0 : 1];
  const float x = atan2(std::fabs(u), y) / kPi * static_cast<float>(kStations);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(x), kStations - 1);
  const float f = x - static_cast<float>(i);
  const float radius = side.width[i] + (side.width[i + 1] - side.width[i]) * f;
  return (side.slant[i] + (side.slant[i + 1] - side.slant[i]) * f) * (radius - r);
}

LeafBlade::InLeaflet LeafBlade::leaflet_at(float u, float v) const {
  static const SinCos lean = sin_cos(radians(kLeafletAngle_deg));
  const float across = std::fabs(u), hand = u < 0.0f ? -1.0f : 1.0f;
  InLeaflet best{0.0f, 0.0f, leaflet_, -1.0f};
  const auto try_leaflet = [&](float x, float y, float length) {
    const InLeaflet in{x / length, y / length, length, length * profile_distance(x / length, y / length)};
    if (in.distance > best.distance) best = in;
  };
  // The station that a line parallel to the leaflets meets the stalk at.
  const float station = (v - across * lean.cos / lean.sin - first_pair_) / pair_spacing_;
  const int nearest = static_cast<int>(station + 8.5f) - 8;
  for (int k = std::max(0, nearest - 1); k <= std::min(pairs_ - 1, nearest + 1); ++k) {
    // The lowest are shorter.
    const float length = leaflet_ * (k == 0 ? 0.78f : k == 1 ? 0.92f : 1.0f);
    const float dv = v - (first_pair_ + pair_spacing_ * static_cast<float>(k));
    const float along = across * lean.sin + dv * lean.cos, aside = across * lean.cos - dv * lean.sin;
    try_leaflet(hand * aside, along - 0.01f, length);
  }
  try_leaflet(u, v - (1.0f - 0.9f * leaflet_), 0.9f * leaflet_);
  return best;
}

float LeafBlade::rachis_distance(float u, float v) const {
  return kRachis * (1.3f - v) - std::max(std::fabs(u), v - (1.0f - 0.9f * leaflet_) > 0.0f ? 1.0f
                                                       : v < 0.0f                          ? 1.0f
                                                                                           : 0.0f);
}

float LeafBlade::distance(float u, float v) const {
  switch (build_) {
    case Build::simple:
      return profile_distance(u, v);
    case Build::palmate:
      return palmate_distance(u, v);
    case Build::compound:
      return std::max(leaflet_at(u, v).distance, rachis_distance(u, v));
  }
  return -1.0f;
}

namespace {

// A line of half thickness h seen through pixels: spread over at least one, fainter by as much.
float line(float distance, float h, float pixel) {
  const float spread = std::max(h, 0.6f * pixel);
  return (1.0f - smooth_step(0.4f * spread, 1.3f * spread, distance)) * (h / spread);
}

}  // namespace

BladePoint LeafBlade::palmate_at(float u, float v, float pixel) const {
  BladePoint p{palmate_distance(u, v), 0.0f, {0.0f, 0.0f}};
  if (p.distance < -pixel) return p;
  const float across = std::fabs(u), side = u < 0.0f ? -1.0f : 1.0f;
  const float y = v - kPalmateCentre, r = std::sqrt(u * u + y * y), angle = atan2(across, y);
  const float nearest =
      std::min(static_cast<float>(static_cast<int>(angle / lobe_angle_ + 0.5f)), static_cast<float>(lobes_each_));
  const float off = std::fabs(angle - nearest * lobe_angle_);
  p.vein = line(off * r, 0.009f * clamp01(1.05f - r), pixel);
  // Finer veins leave the main ones forward.
  const SinCos turn = sin_cos(std::min(off, 0.9f));
  const float along = r * turn.cos, aside = r * turn.sin;
  const float phase = (along - 1.1f * aside) / 0.11f + 40.0f;
  const float from = std::fabs(fraction(phase) - 0.5f);
  p.vein = std::max(p.vein, 0.5f * line((0.5f - from) * 0.11f * 0.67f, 0.004f * clamp01(5.0f * p.distance), pixel));
  p.slope = {side * (0.18f - 0.35f * std::min(off, 0.5f)), 0.16f * (fraction(phase) - 0.5f)};
  return p;
}

BladePoint LeafBlade::simple_at(float u, float v, float pixel) const {
  BladePoint p{profile_distance(u, v), 0.0f, {0.0f, 0.0f}};
  if (p.distance < -pixel) return p;
  const float across = std::fabs(u), side = u < 0.0f ? -1.0f : 1.0f;
  // Midrib, thinning to the tip.
  p.vein = line(across, 0.012f * (1.15f - v), pixel);
  // Side veins rise from the midrib by vein_sweep_, bending forward.
  const float station = v - vein_sweep_ * across * (1.12f - v) * (1.0f + 0.6f * across);
  const float phase = (station - vein_first_) / vein_spacing_;
  const float nearest =
      phase <= 0.0f ? 0.0f
                    : std::min(static_cast<float>(static_cast<int>(phase + 0.5f)), static_cast<float>(veins_ - 1));
  const float off = phase - nearest;
  const float slant = 1.0f / std::sqrt(1.0f + vein_sweep_ * vein_sweep_);
  p.vein = std::max(p.vein, vein_strength_ * line(std::fabs(off) * vein_spacing_ * slant,
                                                  0.0055f * clamp01(4.0f * p.distance / half_width_ + 0.25f), pixel));
  // Pillows: the surface falls toward veins on both sides.
  const float pillow = std::clamp(off * 2.0f, -1.0f, 1.0f);
  const float fold = 0.22f;
  p.slope = {side * (fold - 0.12f * pillow * vein_sweep_ * slant), 0.20f * pillow * slant};
  return p;
}

BladePoint LeafBlade::at(float u, float v, float pixel) const {
  switch (build_) {
    case Build::simple:
      return simple_at(u, v, pixel);
    case Build::palmate:
      return palmate_at(u, v, pixel);
    case Build::compound:
      break;
  }
  const InLeaflet in = leaflet_at(u, v);
  const float stalk = rachis_distance(u, v);
  if (stalk > in.distance) return {stalk, 1.0f, {0.0f, 0.0f}};
  BladePoint p = simple_at(in.u, in.v, pixel / in.length);
  p.distance = in.distance;
  // Slopes of a leaflet lean with it; on either side the one half is lit.
  return p;
}

}  // namespace bosquet::geometry
