#include "geometry/bark_texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/random.h"
#include "core/scalar.h"
#include "geometry/bark_skins.h"
#include "geometry/shares.h"
#include "geometry/texture_colour.h"
#include "geometry/texture_relief.h"

namespace bosquet::geometry {
namespace {

// Ridges, between two extremes. Upright: tall jittered cells are the ridges and their borders the furrows; borders that
// cross the grain are shallow, so that ridges run on and join. Criss-cross: two families of bent ridges that slant to
// either side and cross, with lens-shaped furrows between.
class Ridges {
 public:
  Ridges(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 4),
        width_(0.01f * look.feature_width_cm / look.tile_m),
        cells_(seed, 10, cells_per_tile(look, look.feature_width_cm), cells_per_tile(look, look.feature_length_cm),
               0.8f, look.feature_length_cm / look.feature_width_cm),
        around_(static_cast<float>(cells_per_tile(look, 2.1f * look.feature_width_cm))),
        up_(static_cast<float>(cells_per_tile(look, 1.7f * look.feature_length_cm))),
        bend_left_(seed, 12, static_cast<int>(around_), static_cast<int>(up_), 3),
        bend_right_(seed, 13, static_cast<int>(around_), static_cast<int>(up_), 3),
        strength_(seed, 14, static_cast<int>(around_), 2 * static_cast<int>(up_), 2),
        crust_(seed, 11, cells_per_tile(look, 0.5f * look.feature_width_cm),
               cells_per_tile(look, look.feature_width_cm), 1.0f, 2.0f) {}

  BarkPoint operator()(float u, float v) const {
    const float fine = grain_.fine(u, v), broad = grain_.broad(u, v);
    const float wu = u + 0.42f * width_ * grain_.warp_u(u, v) + 0.03f * width_ * fine;
    const float wv = v + 0.30f * width_ * grain_.warp_v(u, v);
    const float fibre = grain_.fibre(wu, v);
    const TileCells::Hit hit = cells_(wu, wv);
    const float tone = cells_.random(hit.cell, 3);
    // Each border has its own depth and width.
    const float depth = 0.5f + 0.5f * cells_.random(hit.cell, hit.second, 1);
    const float half_width = 0.08f + 0.15f * cells_.random(hit.cell, hit.second, 2);
    const float edge = hit.border + 0.09f * fine + 0.06f * fibre;
    const float island = 1.0f - depth * (1.0f - smooth_step(0.4f * half_width, 1.6f * half_width, edge));
    // The net: where neither family stands, a furrow. A ridge weakens here and there.
    const float left = strand(around_ * wu + up_ * v + 0.55f * bend_left_(u, v), strength_(u, v), fine + fibre);
    const float right = strand(around_ * wu - up_ * v + 0.55f * bend_right_(u, v), strength_(v, u), fine - fibre);
    const float net = std::max(left, right);
    const float body = island + (net - island) * look_.criss_cross;
    // The crest splits into small long blocks and fibres.
    const TileCells::Hit block = crust_(wu + 0.2f * width_ * fibre, v + 0.15f * width_ * fine);
    const float split = (1.0f - smooth_step(0.0f, 0.20f, block.border + 0.12f * fine)) *
                        smooth_step(0.25f, 0.75f, crust_.random(block.cell, block.second, 1)) *
                        smooth_step(0.3f, 0.8f, body);
    const float plate = crust_.random(block.cell, 1) - 0.5f;
    const float height = look_.furrow_depth_cm * (0.85f * body - 0.13f * split + 0.05f * plate * body + 0.09f * fine +
                                                  0.07f * fibre + 0.05f * tone);
    // Dark below, weathered pale on the crests, freckled by the grain.
    const float lit = clamp01(body - 0.38f * split);
    Vec3 colour = glm::mix(palette_.furrow, palette_.top, lit * (0.30f + 0.70f * lit));
    const float weather = 0.98f + 0.30f * (body - 0.6f) + 0.22f * plate + 0.14f * (tone - 0.5f) + 0.75f * fine +
                          0.55f * fibre + 0.20f * broad;
    colour *= std::max(0.25f, weather);
    const float growth = look_.lichen * smooth_step(0.05f, 0.45f, grain_.broad(v, u) + 0.45f * fine) * lit;
    return {height, glm::mix(colour, palette_.lichen * weather, 0.5f * growth)};
  }

 private:
  // A ridge's height at this phase across its family.
  static float strand(float phase, float strength, float rough) {
    const float whole = static_cast<float>(static_cast<int>(phase + 1024.0f)) - 1024.0f;
    const float off = std::fabs(phase - whole - 0.5f) + 0.07f * rough;
    return (0.80f + 0.55f * std::min(0.2f, strength)) * (1.0f - smooth_step(0.19f, 0.34f, off));
  }

  BarkLook look_;
  Palette palette_;
  Grain grain_;
  float width_;  ///< a ridge's, in tiles
  TileCells cells_;
  float around_, up_;  ///< ridges of a family that one meets going round and up a tile
  TileFractal bend_left_, bend_right_, strength_;
  TileCells crust_;
};

// Scales: thin round plates, each at its own level, so that the higher one's rim stands over the lower one and shades
// it; old scales are grey, where they fell the younger bark shows reddish.
class Scales {
 public:
  Scales(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 4),
        width_(0.01f * look.feature_width_cm / look.tile_m),
        large_(seed, 20, cells_per_tile(look, look.feature_width_cm),
               cells_per_tile(look, 1.2f * look.feature_width_cm), 0.95f, 1.2f),
        small_(seed, 21, cells_per_tile(look, 0.5f * look.feature_width_cm),
               cells_per_tile(look, 0.6f * look.feature_width_cm), 1.0f, 1.2f),
        streaks_(seed, 22, cells_per_tile(look, 3.0f), cells_per_tile(look, 25.0f), 3) {}

  BarkPoint operator()(float u, float v) const {
    const float fine = grain_.fine(u, v), fibre = grain_.fibre(u, v), broad = grain_.broad(u, v);
    const float wu = u + 0.45f * width_ * grain_.warp_u(u, v) + 0.14f * width_ * fine;
    const float wv = v + 0.45f * width_ * grain_.warp_v(u, v) + 0.14f * width_ * grain_.fine(v, u);
    const Scale big = scale(large_, wu, wv), little = scale(small_, wu, wv);
    // A quarter of the large scales have fallen or broken into small ones.
    const bool broken = big.level < 0.25f;
    const float level = broken ? 0.15f + 0.30f * little.level : 0.3f + 0.7f * big.level;
    const float shade = std::max(broken ? 0.75f * little.shade : 0.35f * little.shade, big.shade);
    const float rim = broken ? little.rim : big.rim;
    const float height = look_.furrow_depth_cm * (level + 0.10f * rim - 0.3f * shade + 0.08f * fine);
    Vec3 colour = glm::mix(palette_.top, palette_.furrow, shade);
    const Vec3 red{1.10f, 0.94f, 0.82f}, grey{1.0f, 1.0f, 1.0f};
    colour *= glm::mix(red, grey, smooth_step(0.0f, 0.9f, level + 0.5f * broad));
    colour *= std::max(0.3f, 0.78f + 0.28f * level + 0.55f * fine + 0.25f * fibre + 0.30f * rim + 0.25f * broad);
    const float streak = look_.marks * smooth_step(0.30f, 0.62f, streaks_(u, v) + 0.15f * fine);
    colour = glm::mix(colour, palette_.mark, 0.7f * streak);
    const float growth = look_.lichen * smooth_step(0.05f, 0.45f, grain_.broad(v, u) + 0.45f * fine) * (1.0f - shade);
    return {height, glm::mix(colour, palette_.lichen, 0.5f * growth)};
  }

 private:
  struct Scale {
    float level, shade, rim;
  };
  static Scale scale(const TileCells& cells, float u, float v) {
    const TileCells::Hit hit = cells(u, v);
    const float own = cells.random(hit.cell, 1), other = cells.random(hit.second, 1);
    // Rims lift most at their lower edge (offset grows down the image), and shade what lies below them.
    const float lower = 0.55f + 0.45f * std::clamp(2.0f * hit.offset.y, -1.0f, 1.0f);
    const float step = own - other, reach = 0.10f + 0.26f * std::fabs(step);
    Scale s{own, 0.0f, 0.0f};
    const float gap = 1.0f - smooth_step(0.0f, 0.10f, hit.border);
    if (step < 0.0f) {
      s.shade = (1.0f - smooth_step(0.0f, reach, hit.border)) * smooth_step(0.0f, 0.3f, -step) * (1.2f - lower);
    } else {
      s.rim = (1.0f - smooth_step(0.03f, 0.20f, hit.border)) * smooth_step(0.0f, 0.4f, step) * lower;
    }
    s.shade = std::min(1.0f, std::max(s.shade, 0.75f * gap));
    return s;
  }

  BarkLook look_;
  Palette palette_;
  Grain grain_;
  float width_;
  TileCells large_, small_;
  TileFractal streaks_;
};

// Paper: pale sheets in faint level bands, with lenticels, curling edges and dark rough rhombs.
class Paper {
 public:
  Paper(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 5),
        bands_(seed, 30, 2, cells_per_tile(look, 4.0f), 4, 0.6f),
        sheets_(seed, 31, 1, 7, 3, 0.35f),
        rough_(seed, 32, cells_per_tile(look, 3.0f), cells_per_tile(look, 3.0f), 4, 0.6f),
        cracks_(seed, 33, cells_per_tile(look, 1.8f), cells_per_tile(look, 3.2f), 0.9f, 1.8f) {
    const float cm = 0.01f / look.tile_m, tile_cm2 = 1e4f * look.tile_m * look.tile_m;
    // Lenticels: about one on 25 cm2 when marks = 1, in loose level rows.
    RandomStream stream(seed, 34, Purpose::texture);
    const int lenticels = static_cast<int>(look.marks * tile_cm2 / 14.0f);
    float row = 0.0f;
    for (int i = 0; i < lenticels; ++i) {
      if (i % 3 == 0) row = stream.uniform();
      const float t = stream.uniform();
      const float half_length = (0.15f + 0.85f * t * t) * 0.5f * look.feature_width_cm * cm;
      add({stream.uniform(), row + 1.2f * cm * stream.uniform(-1.0f, 1.0f), half_length,
           (0.07f + 0.12f * stream.uniform()) * cm * (0.7f + 0.6f * t), stream.uniform(0.45f, 1.0f), false});
    }
    // Rhombs: about one on 700 cm2 when patches = 1, wider than high when small.
    const int rhombs = static_cast<int>(look.patches * tile_cm2 / 420.0f + 0.5f);
    for (int i = 0; i < rhombs; ++i) {
      const float t = stream.uniform();
      const float half_height = (0.25f + 0.75f * t * t) * 0.5f * look.feature_length_cm * cm;
      // Spread evenly down the tile.
      const float v = (static_cast<float>(i) + stream.uniform(0.2f, 0.8f)) / static_cast<float>(rhombs);
      const float u = stream.uniform();
      add({u, v, half_height * stream.uniform(0.8f, 1.5f), half_height, 1.0f, true});
    }
  }

  BarkPoint operator()(float u, float v) const {
    const float cm = 0.01f / look_.tile_m;
    const float fine = grain_.fine(u, v), band = bands_(u, v), rough = rough_(u, v);
    // Sheets: thin layers that end in a level ragged line and curl up there.
    const float sheet = 5.0f * (sheets_(u, v) + 0.035f * rough + 0.012f * fine);
    const float step = sheet - static_cast<float>(static_cast<int>(sheet + 64.0f) - 64);
    const float curl = smooth_step(0.90f, 0.985f, step) * smooth_step(0.1f, 0.5f, grain_.broad(u, v) + 0.25f);
    float height = 0.02f * step + 0.06f * curl + 0.010f * band + 0.008f * fine;
    Vec3 colour = palette_.top * (0.93f + 0.16f * band + 0.07f * fine + 0.05f * grain_.broad(u, v));
    // Faint rose and grey in the bands, a shadow under each curl.
    colour = glm::mix(colour, palette_.top * Vec3(0.95f, 0.80f, 0.68f), 0.8f * smooth_step(0.10f, 0.5f, band));
    colour *=
        1.0f - 0.42f * (1.0f - smooth_step(0.0f, 0.06f, step)) * smooth_step(0.1f, 0.5f, grain_.broad(u, v) + 0.25f);
    // Stamps that reach this row.
    float lens = 0.0f, rhomb = 0.0f, smudge = 0.0f;
    for (const Stamp& s : stamps_.at(v)) {
      const float dx = wrapped(u - s.u) / s.half_width, dy = wrapped(v - s.v) / s.half_height;
      const float ax = std::fabs(dx), ay = std::fabs(dy);
      if (s.rhomb) {
        // A lozenge, drawn out to the sides into a level wrinkle (the branch's moustache).
        if (ax > 1.9f || ay > 1.4f) continue;
        const float inside = 1.0f - (ax + ay + 1.1f * ax * ay) + 0.5f * rough + 0.4f * fine;
        const float wrinkle = (1.5f - ax) * smooth_step(0.16f, 0.02f + 0.1f * 0.5f, ay + 0.10f * rough);
        rhomb = std::max(rhomb, smooth_step(0.0f, 0.16f, inside));
        smudge = std::max(smudge, smooth_step(-0.9f, 0.1f, inside));
        lens = std::max(lens, 0.7f * clamp01(wrinkle));
      } else {
        if (ax > 1.2f || ay > 1.6f) continue;
        const float r2 = ax * ax * ax * ax + ay * ay + 0.35f * fine;
        lens = std::max(lens, s.strength * (1.0f - smooth_step(0.45f, 1.05f, r2)));
      }
    }
    colour = glm::mix(colour, palette_.mark * (0.8f + 0.3f * fine), 0.92f * lens);
    colour *= 1.0f - 0.35f * smudge * smooth_step(-0.3f, 0.5f, rough + fine);
    height += 0.03f * lens;
    // Inside a rhomb the bark is thick, black and cracked into blocks.
    if (rhomb > 0.0f) {
      const TileCells::Hit hit = cracks_(u + 0.8f * cm * rough, v);
      const float block = smooth_step(0.03f, 0.22f, hit.border + 0.06f * fine);
      const Vec3 inner = glm::mix(0.35f * palette_.patch, 1.5f * palette_.patch,
                                  block * (0.55f + 0.45f * cracks_.random(hit.cell, 1))) *
                         (1.0f + 0.6f * fine);
      colour = glm::mix(colour, inner, rhomb);
      height += rhomb * look_.furrow_depth_cm * (0.25f + 0.5f * block + 0.1f * rough);
    }
    const float growth = look_.lichen * smooth_step(0.05f, 0.5f, grain_.broad(v, u) + 0.3f * fine) * (1.0f - rhomb);
    return {height, glm::mix(colour, palette_.lichen, 0.5f * growth)};
  }

 private:
  struct Stamp {
    float u, v, half_width, half_height, strength;
    bool rhomb;
  };
  void add(const Stamp& s) { stamps_.add(s, 1.7f * s.half_height); }

  BarkLook look_;
  Palette palette_;
  Grain grain_;
  TileFractal bands_, sheets_, rough_;
  TileCells cracks_;
  StampRows<Stamp> stamps_;
};

template <class Form>
BarkTextures paint(const Form& form, const Look& look, const Palette& palette, int size) {
  BarkTextures out{Image(size, size, 3), {}};
  Relief relief(size, 100.0f * look.bark.tile_m);
  std::vector<Vec3> colours(relief.heights.size());
  const float pixel = 1.0f / static_cast<float>(size);
  const auto rows = static_cast<std::size_t>(size);
  parallel_for(
      rows,
      [&](std::size_t y) {
        for (int x = 0; x < size; ++x) {
          const BarkPoint p = form((static_cast<float>(x) + 0.5f) * pixel, (static_cast<float>(y) + 0.5f) * pixel);
          relief.at(x, static_cast<int>(y)) = p.height;
          colours[y * rows + static_cast<std::size_t>(x)] = p.colour;
        }
      },
      16);
  // Sky light that does not reach the bottom of furrows, over about one and a half centimetres.
  const int radius = std::max(1, static_cast<int>(0.015f / look.bark.tile_m * static_cast<float>(size)));
  const Relief hollow = hollowness(relief, radius);
  const Vec3 scale = bark_reference(look) / glm::max(palette.top, Vec3(1e-4f));
  parallel_for(
      rows,
      [&](std::size_t y) {
        for (int x = 0; x < size; ++x) {
          const float below = std::max(0.0f, hollow.at(x, static_cast<int>(y)));
          const Vec3 c = colours[y * rows + static_cast<std::size_t>(x)] / (1.0f + 0.9f * below);
          put_srgb(out.base_colour.at(x, static_cast<int>(y)), c * scale);
        }
      },
      16);
  out.normal = normal_map(relief, 1.6f);
  return out;
}

}  // namespace

BarkTextures make_bark(const Look& look, std::uint64_t seed, int size) {
  assert(size >= 64 && size <= 4096 && (size & (size - 1)) == 0);
  const BarkLook& bark = look.bark;
  const Palette palette{linear_from_srgb(bark.colour), linear_from_srgb(bark.furrow_colour),
                        linear_from_srgb(bark.mark_colour), linear_from_srgb(bark.patch_colour),
                        linear_from_srgb(srgb(0x7E8A68))};
  switch (bark.form) {
    case BarkForm::ridges:
    case BarkForm::plates:
      return paint(Ridges(bark, palette, seed), look, palette, size);
    case BarkForm::scales:
      return paint(Scales(bark, palette, seed), look, palette, size);
    case BarkForm::paper:
      return paint(Paper(bark, palette, seed), look, palette, size);
    case BarkForm::mosaic:
      return paint(Mosaic(bark, palette, seed), look, palette, size);
    case BarkForm::strips:
      return paint(Strips(bark, palette, seed), look, palette, size);
    case BarkForm::smooth:
      break;
  }
  return paint(Smooth(bark, palette, seed), look, palette, size);
}

}  // namespace bosquet::geometry
