#include "geometry/ground_texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/scalar.h"
#include "geometry/ground_finish.h"
#include "geometry/noise.h"
#include "geometry/texture_relief.h"

namespace bosquet::geometry {
namespace {

// Blades of grass and crumbs of litter, listed by the band of rows they touch so that rows can be painted in parallel.
// Later ones lie on top.
struct Stroke {
  Vec2 from, along;      // in tiles; from the foot to the tip
  float half, inverse2;  // half width in tiles, 1 / length squared
  float tone, height;
};

constexpr int kBands = 64;
constexpr float kLitterShare = 0.25f;

struct Sward {
  std::vector<Stroke> strokes;
  std::vector<std::uint32_t> bands[kBands];
};

Sward sow(std::uint64_t seed, const TileFractal& growth) {
  Sward sward;
  RandomStream stream(seed, 71, Purpose::texture);
  constexpr int kStrokes = 44000;
  for (int i = 0; i < kStrokes; ++i) {
    const Vec2 from{stream.uniform(), stream.uniform()};
    const float lush = growth(from.x, from.y), turn = 2.0f * kPi * stream.uniform();
    const bool litter = stream.uniform() < kLitterShare - 0.3f * lush;
    const float length_m =
        litter ? stream.uniform(0.006f, 0.02f) : stream.uniform(0.015f, 0.055f) * (1.0f + 0.6f * lush);
    const float half_m = litter ? stream.uniform(0.003f, 0.008f) : stream.uniform(0.0020f, 0.0045f);
    const SinCos a = sin_cos(turn);
    const Vec2 along = Vec2(a.sin, a.cos) * (length_m / kGroundTileM);
    // Later strokes are the upper ones: lighter.
    const float level = static_cast<float>(i) / kStrokes;
    const float tone = (litter ? 0.72f : 0.45f + 0.55f * level + 0.2f * lush) * stream.uniform(0.65f, 1.35f);
    sward.strokes.push_back({from, along, half_m / kGroundTileM, 1.0f / glm::dot(along, along), tone,
                             (litter ? 0.4f : 0.3f + 0.7f * level)});
    const float low = std::min(from.y, from.y + along.y) - 0.005f, high = std::max(from.y, from.y + along.y) + 0.005f;
    for (int b = static_cast<int>((low + 1.0f) * kBands); b <= static_cast<int>((high + 1.0f) * kBands); ++b) {
      sward.bands[b % kBands].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return sward;
}

float nearest_image(float d) { return d > 0.5f ? d - 1.0f : d < -0.5f ? d + 1.0f : d; }

}  // namespace

GroundTextures make_ground(std::uint64_t seed, int size) {
  assert(size >= 64 && size <= 4096 && (size & (size - 1)) == 0);
  const TileFractal growth(seed, 70, 5, 5, 3), soil(seed, 72, 48, 48, 4, 0.7f);
  const Sward sward = sow(seed, growth);
  const auto n = static_cast<std::size_t>(size);
  const float pixel = 1.0f / static_cast<float>(size);
  std::vector<Vec3> colours(n * n);
  Relief relief(size, 100.0f * kGroundTileM);

  // One task a band of rows: soil first, then its strokes in order.
  parallel_for(kBands, [&](std::size_t band) {
    const int y0 = static_cast<int>(band) * size / kBands, y1 = static_cast<int>(band + 1) * size / kBands;
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < size; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) * pixel, v = (static_cast<float>(y) + 0.5f) * pixel;
        const float grain = soil(u, v), lush = growth(u, v);
        colours[static_cast<std::size_t>(y) * n + static_cast<std::size_t>(x)] =
            Vec3(1.05f, 0.98f, 0.90f) * (0.45f + 0.35f * grain + 0.08f * lush);
        relief.at(x, y) = 0.9f * grain;
      }
    }
    for (const std::uint32_t s : sward.bands[band]) {
      const Stroke& stroke = sward.strokes[s];
      const float reach = stroke.half + pixel;
      const float left = std::min(0.0f, stroke.along.x) - reach, right = std::max(0.0f, stroke.along.x) + reach;
      const int x0 = static_cast<int>((stroke.from.x + left + 1.0f) * static_cast<float>(size)) - size;
      const int x1 = static_cast<int>((stroke.from.x + right + 1.0f) * static_cast<float>(size)) - size + 1;
      for (int y = y0; y < y1; ++y) {
        const float dy = nearest_image((static_cast<float>(y) + 0.5f) * pixel - stroke.from.y);
        if (dy < std::min(0.0f, stroke.along.y) - reach || dy > std::max(0.0f, stroke.along.y) + reach) continue;
        for (int xi = x0; xi < x1; ++xi) {
          const Vec2 from{(static_cast<float>(xi) + 0.5f) * pixel - stroke.from.x, dy};
          const float t = std::clamp(glm::dot(from, stroke.along) * stroke.inverse2, 0.0f, 1.0f);
          const Vec2 off = from - stroke.along * t;
          const float half = stroke.half * (1.0f - 0.7f * t), seen = std::max(half, 0.5f * pixel);
          const float cover =
              std::clamp(0.5f + (seen - std::sqrt(glm::dot(off, off))) * static_cast<float>(size), 0.0f, 1.0f) *
              std::min(1.0f, 1.3f * half / seen);
          if (cover <= 0.0f) continue;
          const int x = (xi + size) % size;
          Vec3& c = colours[static_cast<std::size_t>(y) * n + static_cast<std::size_t>(x)];
          // The foot lies in the shade of its neighbours.
          c = glm::mix(c, Vec3(0.97f, 1.02f, 0.94f) * (stroke.tone * (0.65f + 0.5f * t)), cover);
          relief.at(x, y) += (stroke.height * (0.4f + 0.6f * t) * 1.6f - relief.at(x, y)) * 0.7f * cover;
        }
      }
    }
  });

  return finish_ground(colours, relief);
}

Vec3 cover_colour(terrain::Cover cover) {
  switch (cover) {
    case terrain::Cover::gravel:
      return kGravelColour;
    case terrain::Cover::paving:
      return kPavingColour;
    case terrain::Cover::grass:
      return kLawnColour;
    case terrain::Cover::soil:
      return kSoilColour;
    case terrain::Cover::natural:
      break;
  }
  return kMeadowColour;
}

}  // namespace bosquet::geometry
