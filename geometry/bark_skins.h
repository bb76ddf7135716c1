// Bark skins: barks without furrows. Smooth (beech, hazel), mosaic (plane), strips (cypress).
//
// Model     smooth: level wrinkles; the scars that shed branches leave, an eye with a moustache of two wrinkles drooping
//           to either side; raised lenticels. mosaic: plates that flaked off at three times, the last ones bare and
//           pale. strips: long fibrous ribbons side by side, lifted at their lower ends, redder bark between
// Frame     bark_parts.h
#pragma once

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/bark_parts.h"

namespace bosquet::geometry {

class Smooth {
 public:
  Smooth(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 5),
        wrinkles_(seed, 40, 3, cells_per_tile(look, 2.0f), 4, 0.6f) {
    RandomStream stream(seed, 41, Purpose::texture);
    const float cm = 0.01f / look.tile_m, tile_cm2 = 1e4f * look.tile_m * look.tile_m;
    // Scars: about one on 1,200 cm2 when patches = 1; lenticels: one on 6 cm2 when marks = 1.
    const int scars = static_cast<int>(look.patches * tile_cm2 / 1200.0f + 0.5f);
    for (int i = 0; i < scars; ++i) {
      const float half = 0.5f * look.feature_length_cm * cm * stream.uniform(0.35f, 1.0f);
      const float v = (static_cast<float>(i) + stream.uniform(0.2f, 0.8f)) / static_cast<float>(scars);
      stamps_.add({stream.uniform(), v, half, true}, 4.0f * half);
    }
    const int lenticels = static_cast<int>(look.marks * tile_cm2 / 6.0f);
    for (int i = 0; i < lenticels; ++i) {
      const float half = 0.5f * look.feature_width_cm * cm * stream.uniform(0.3f, 1.0f);
      stamps_.add({stream.uniform(), stream.uniform(), half, false}, 1.5f * half);
    }
  }

  BarkPoint operator()(float u, float v) const {
    const float fine = grain_.fine(u, v), broad = grain_.broad(u, v), wrinkle = wrinkles_(u, v);
    const float line = smooth_step(0.25f, 0.55f, wrinkle);
    const float tone = 0.98f + 0.14f * broad + 0.10f * fine - 0.14f * line + 0.06f * wrinkle;
    Vec3 colour = glm::mix(palette_.top, palette_.furrow, 0.35f * line) * tone;
    const float growth = look_.lichen * smooth_step(-0.05f, 0.45f, grain_.broad(v, u) + 0.35f * fine);
    colour = glm::mix(colour, palette_.lichen, 0.6f * growth);
    float height = look_.furrow_depth_cm * (0.5f - 0.5f * line + 0.2f * fine);
    for (const Stamp& s : stamps_.at(v)) {
      const float x = wrapped(u - s.u) / s.half, y = wrapped(v - s.v) / s.half;
      if (!s.scar) {
        const float inside = 1.0f - smooth_step(0.5f, 1.0f, std::sqrt(x * x + 1.6f * y * y) + 0.3f * fine);
        colour = glm::mix(colour, palette_.mark, 0.85f * inside);
        height += 0.05f * inside;
        continue;
      }
      if (std::fabs(x) > 3.2f || y < -1.2f || y > 3.4f) continue;
      const float ring = std::sqrt(x * x + 2.2f * y * y) + 0.25f * fine;
      const float eye = 1.0f - smooth_step(0.35f, 0.75f, ring);
      const float rim = smooth_step(0.6f, 0.85f, ring) * (1.0f - smooth_step(0.85f, 1.25f, ring));
      // The moustache droops to both sides and thins out.
      const float droop = y - 0.35f * std::fabs(x) - 0.12f * x * x + 0.15f * fine;
      const float whisker = smooth_step(0.7f, 1.0f, ring) * (1.0f - smooth_step(0.05f, 0.22f, std::fabs(droop))) *
                            (1.0f - smooth_step(1.2f, 3.0f, std::fabs(x)));
      colour = glm::mix(colour, palette_.patch * (0.9f + 0.6f * fine), std::max(0.75f * eye, 0.75f * whisker));
      colour *= 1.0f - 0.12f * rim;
      height += 0.25f * rim - 0.15f * eye - 0.08f * whisker;
    }
    return {height, colour};
  }

 private:
  struct Stamp {
    float u, v, half;  ///< in tiles
    bool scar;
  };
  BarkLook look_;
  Palette palette_;
  Grain grain_;
  TileFractal wrinkles_;
  StampRows<Stamp> stamps_;
};

class Mosaic {
 public:
  Mosaic(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 4),
        width_(0.01f * look.feature_width_cm / look.tile_m),
        jag_(seed, 50, cells_per_tile(look, 0.45f * look.feature_width_cm),
             cells_per_tile(look, 0.45f * look.feature_width_cm), 4, 0.55f),
        old_(seed, 51, cells_per_tile(look, look.feature_width_cm), cells_per_tile(look, look.feature_length_cm), 1.0f,
             look.feature_length_cm / look.feature_width_cm),
        middle_(seed, 52, cells_per_tile(look, 0.75f * look.feature_width_cm),
                cells_per_tile(look, 0.8f * look.feature_length_cm), 1.0f, 1.1f),
        fallen_(seed, 53, cells_per_tile(look, 0.6f * look.feature_width_cm),
                cells_per_tile(look, 0.5f * look.feature_length_cm), 1.0f, 1.0f) {}

  BarkPoint operator()(float u, float v) const {
    const float fine = grain_.fine(u, v), broad = grain_.broad(u, v), fibre = grain_.fibre(u, v);
    const float wu = u + 0.38f * width_ * jag_(u, v), wv = v + 0.38f * width_ * jag_(v, u);
    // Bare wood, pale; on it what has stayed.
    Vec3 colour = palette_.top * (1.0f + 0.10f * broad + 0.08f * fine);
    float height = 0.0f, shade = 0.0f;
    const auto lay = [&](const TileCells& cells, float share, const Vec3& own, float level) {
      const TileCells::Hit hit = cells(wu, wv);
      const bool here = cells.random(hit.cell, 1) < share, beside = cells.random(hit.second, 1) < share;
      if (here) {
        const float tone = 0.88f + 0.22f * cells.random(hit.cell, 2) + 0.16f * fine + 0.10f * fibre + 0.10f * broad;
        const float rim = beside ? 0.0f : 1.0f - smooth_step(0.0f, 0.10f, hit.border);
        colour = own * (tone * (1.0f + 0.10f * rim)), height = level * (1.0f - 0.4f * rim), shade = 0.0f;
      } else if (beside) {
        // The plate's edge throws its shade on what lies lower.
        shade = std::max(shade, 1.0f - smooth_step(0.0f, 0.13f, hit.border));
      }
    };
    lay(middle_, 0.56f, palette_.mark, 0.5f);
    lay(old_, 0.54f, palette_.patch, 1.0f);
    // Lately fallen pieces: bare again, the freshest with a greenish tinge.
    const TileCells::Hit hit = fallen_(wv, wu);
    if (fallen_.random(hit.cell, 1) < 0.16f) {
      const float edge = smooth_step(0.0f, 0.08f, hit.border);
      const Vec3 fresh = palette_.top * glm::mix(Vec3(1.0f), Vec3(0.97f, 1.02f, 0.92f), fallen_.random(hit.cell, 2));
      colour = glm::mix(0.6f * colour, fresh * (1.0f + 0.08f * fine), edge), height *= 1.0f - edge;
    }
    colour *= 1.0f - 0.45f * shade;
    const float growth = look_.lichen * smooth_step(0.1f, 0.5f, grain_.broad(v, u) + 0.3f * fine);
    return {look_.furrow_depth_cm * (height + 0.10f * fine), glm::mix(colour, palette_.lichen, 0.4f * growth)};
  }

 private:
  BarkLook look_;
  Palette palette_;
  Grain grain_;
  float width_;
  TileFractal jag_;
  TileCells old_, middle_, fallen_;
};

class Strips {
 public:
  Strips(const BarkLook& look, const Palette& palette, std::uint64_t seed)
      : look_(look),
        palette_(palette),
        grain_(seed, look, 4),
        width_(0.01f * look.feature_width_cm / look.tile_m),
        ribbons_(seed, 60, cells_per_tile(look, look.feature_width_cm), cells_per_tile(look, look.feature_length_cm),
                 0.9f, look.feature_length_cm / look.feature_width_cm),
        threads_(seed, 61, cells_per_tile(look, 0.16f * look.feature_width_cm), cells_per_tile(look, 11.0f), 4, 0.6f),
        sway_(seed, 62, 3, 2, 3) {}

  BarkPoint operator()(float u, float v) const {
    const float fine = grain_.fine(u, v), broad = grain_.broad(u, v), thread = threads_(u, v);
    const float wu = u + 1.6f * width_ * sway_(u, v) + 0.18f * width_ * thread, wv = v + 0.6f * width_ * fine;
    const TileCells::Hit hit = ribbons_(wu, wv);
    const float own = ribbons_.random(hit.cell, 1), beside = ribbons_.random(hit.second, 1);
    const float gap = 1.0f - smooth_step(0.02f, 0.16f + 0.10f * own, hit.border + 0.08f * thread);
    // Ribbons lie over each other; ends stand off and show what is under.
    const float below = own < beside ? 1.0f - smooth_step(0.0f, 0.35f, hit.border) : 0.0f;
    const float end = smooth_step(0.30f, 0.48f, hit.offset.y) * ribbons_.random(hit.cell, 2);
    const float body = (1.0f - gap) * (1.0f - 0.5f * below);
    Vec3 colour = glm::mix(palette_.mark, palette_.top, 0.35f + 0.65f * own) *
                  std::max(0.3f, 0.92f + 0.45f * thread + 0.25f * fine + 0.15f * broad + 0.12f * end);
    colour = glm::mix(colour, palette_.furrow * (1.0f + 0.5f * thread), 1.0f - body);
    const float growth = look_.lichen * smooth_step(0.05f, 0.5f, grain_.broad(v, u) + 0.3f * fine) * body;
    return {look_.furrow_depth_cm * (0.8f * body + 0.25f * own + 0.18f * thread + 0.25f * end),
            glm::mix(colour, palette_.lichen, 0.45f * growth)};
  }

 private:
  BarkLook look_;
  Palette palette_;
  Grain grain_;
  float width_;
  TileCells ribbons_;
  TileFractal threads_, sway_;
};

}  // namespace bosquet::geometry
