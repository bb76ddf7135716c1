#include "geometry/atlas_blade.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/scalar.h"

namespace bosquet::geometry {
namespace {

constexpr float kPalmateCentre = 0.16f;  // where the main veins of a palmate blade meet

float clamp01(float x) { return std::clamp(x, 0.0f, 1.0f); }
float fraction(float x) { return x - static_cast<float>(static_cast<int>(x)); }  // x >= 0

// A tooth that leans to the tip: rises over most of its length, falls at once.
float tooth(float phase) {
  const float f = fraction(phase);
  return f < 0.8f ? f / 0.8f : (1.0f - f) / 0.2f;
}

// Half width of an unlobed blade at station t, greatest 1 at `widest`.
float simple_envelope(const LeafLook& look, float t) {
  if (t < look.widest) {
    const float s = 1.0f - t / look.widest;
    const float base = look.outline == LeafOutline::ovate_deltoid ? 3.2f
                       : look.outline == LeafOutline::cordate     ? 4.0f
                                                                  : 2.0f;
    return 1.0f - pow(s, base);
  }
  const float s = (t - look.widest) / (1.0f - look.widest);
  return pow(1.0f - s, 0.55f + 2.4f * look.point) * (1.0f + (0.35f + 1.6f * look.point) * s);
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
    : palmate_(look.outline == LeafOutline::palmate) {
  RandomStream stream(seed, mix_bits(variant + 100), Purpose::texture);
  veins_ = std::max(1, look.vein_pairs);
  vein_spacing_ = 0.88f / static_cast<float>(veins_);
  if (palmate_) {
    make_palmate(look, stream);
  } else {
    make_profiles(look, stream);
  }
}

void LeafBlade::make_profiles(const LeafLook& look, RandomStream& stream) {
  const bool lobed = look.outline == LeafOutline::pinnate_lobed && look.lobes > 0;
  const float half = 0.5f * look.width_mm / look.length_mm;
  const float lobes = static_cast<float>(look.lobes);
  constexpr float kFirst = 0.10f;  // the lowest bay
  sweep_ = lobed ? 0.55f : look.margin == LeafMargin::entire ? 0.0f : 0.35f;
  vein_sweep_ = lobed ? sweep_ : look.outline == LeafOutline::lanceolate ? 1.6f : 0.85f;
  if (look.outline == LeafOutline::lanceolate) vein_strength_ = 0.3f;
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
        width = simple_envelope(look, t);
        const float fine = look.length_mm / 3.0f, taper = smooth_step(0.03f, 0.15f, t) * (1.0f - t * t);
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
  // Radius over the angle from the tip, 0 .. pi, each side; lobes at equal angles up to 140 degrees.
  const float count = static_cast<float>(std::max(1, look.lobes / 2));
  const float between = radians(125.0f) / count;
  for (Profile& side : sides_) {
    const float size = stream.uniform(0.94f, 1.04f), phase = stream.uniform();
    for (int i = 0; i <= kStations; ++i) {
      const float angle = kPi * static_cast<float>(i) / static_cast<float>(kStations);
      const float lobe = angle / between, nearest = std::min(static_cast<float>(static_cast<int>(lobe + 0.5f)), count);
      const float off = std::fabs(lobe - nearest);
      const float reach = (1.0f - kPalmateCentre) * (1.0f - 0.52f * smooth_step(0.0f, kPi, nearest * between));
      float radius = reach * (1.0f - look.lobe_depth * smooth_step(0.0f, 0.52f, off));
      if (off > 0.5f) radius *= 1.0f - 0.75f * smooth_step(0.5f, 1.1f, off);  // toward the stalk
      if (look.margin != LeafMargin::entire) radius *= 1.0f + 0.10f * (tooth(lobe * 3.0f + phase) - 0.5f);
      side.width[static_cast<std::size_t>(i)] = size * radius;
      side.slant[static_cast<std::size_t>(i)] = 0.7f;
    }
  }
  half_width_ = std::max(0.5f * look.width_mm / look.length_mm, 0.75f);
  overhang_ = 0.2f;
}

float LeafBlade::profile_distance(float u, float v) const {
  const Profile& side = sides_[u < 0.0f ? 0 : 1];
  const float across = std::fabs(u), t = v - sweep_ * across * (1.12f - v);
  if (t <= 0.0f) return -std::max(across, -t) * 0.85f - 0.001f;
  if (t >= 1.0f) return -(t - 1.0f) - 0.5f * across - 0.001f;
  const float x = t * static_cast<float>(kStations);
  const auto i = static_cast<std::size_t>(x);
  const float f = x - static_cast<float>(i);
  const float width = side.width[i] + (side.width[i + 1] - side.width[i]) * f;
  return (width - across) * (side.slant[i] + (side.slant[i + 1] - side.slant[i]) * f);
}

float LeafBlade::palmate_distance(float u, float v) const {
  const float y = v - kPalmateCentre, r = std::sqrt(u * u + y * y);
  const Profile& side = sides_[u < 0.0f ? 0 : 1];
  const float x = atan2(std::fabs(u), y) / kPi * static_cast<float>(kStations);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(x), kStations - 1);
  const float radius = side.width[i] + (side.width[i + 1] - side.width[i]) * (x - static_cast<float>(i));
  return 0.75f * (radius - r);
}

float LeafBlade::distance(float u, float v) const { return palmate_ ? palmate_distance(u, v) : profile_distance(u, v); }

BladePoint LeafBlade::at(float u, float v, float pixel) const {
  BladePoint p{distance(u, v), 0.0f, {0.0f, 0.0f}};
  if (p.distance < -pixel) return p;
  const float across = std::fabs(u), side = u < 0.0f ? -1.0f : 1.0f;
  // A line of half thickness h seen through pixels: spread over at least one, fainter by as much.
  const auto line = [pixel](float distance, float h) {
    const float spread = std::max(h, 0.6f * pixel);
    return (1.0f - smooth_step(0.4f * spread, 1.3f * spread, distance)) * (h / spread);
  };
  if (palmate_) {
    const float y = v - kPalmateCentre, r = std::sqrt(u * u + y * y), angle = atan2(across, y);
    const float between = radians(125.0f) / 2.0f;
    const float off = std::fabs(angle / between - static_cast<float>(static_cast<int>(angle / between + 0.5f)));
    p.vein = line(off * between * r, 0.010f * clamp01(1.1f - r));
    p.slope = {side * 0.25f * (0.5f - off), 0.0f};
    return p;
  }
  // Midrib, thinning to the tip.
  p.vein = line(across, 0.012f * (1.15f - v));
  // Side veins rise from the midrib by vein_sweep_, bending forward.
  const float station = v - vein_sweep_ * across * (1.12f - v) * (1.0f + 0.6f * across);
  const float phase = (station - vein_first_) / vein_spacing_;
  const float nearest =
      phase <= 0.0f ? 0.0f
                    : std::min(static_cast<float>(static_cast<int>(phase + 0.5f)), static_cast<float>(veins_ - 1));
  const float off = phase - nearest;
  const float slant = 1.0f / std::sqrt(1.0f + vein_sweep_ * vein_sweep_);
  p.vein = std::max(p.vein, vein_strength_ * line(std::fabs(off) * vein_spacing_ * slant,
                                                  0.0055f * clamp01(4.0f * p.distance / half_width_ + 0.25f)));
  // Pillows: the surface falls toward veins on both sides.
  const float pillow = std::clamp(off * 2.0f, -1.0f, 1.0f);
  const float fold = 0.22f;
  p.slope = {side * (fold - 0.12f * pillow * vein_sweep_ * slant), 0.20f * pillow * slant};
  return p;
}

}  // namespace bosquet::geometry
