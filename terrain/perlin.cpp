#include "terrain/perlin.h"

#include <array>
#include <cmath>

#include "core/random.h"
#include "core/scalar.h"

namespace bosquet::terrain {
namespace {

constexpr int kDirections = 64;

const std::array<Vec2, kDirections>& directions() {
  static const auto table = [] {
    std::array<Vec2, kDirections> d;
    for (int n = 0; n < kDirections; ++n) {
      const SinCos turn = sin_cos(2.0f * kPi * static_cast<float>(n) / kDirections);
      d[static_cast<std::size_t>(n)] = {turn.cos, turn.sin};
    }
    return d;
  }();
  return table;
}

// Gradient noise with unit gradients: 0 at lattice corners, |noise| <= sqrt(1/2).
float gradient_noise(const RandomStream& corners, Vec2 p) {
  const float x0 = std::floor(p.x), y0 = std::floor(p.y);
  const auto i = static_cast<std::int64_t>(x0), j = static_cast<std::int64_t>(y0);
  const auto corner = [&](int a, int b) {
    const auto id = (static_cast<std::uint64_t>(i + a) << 32) ^ (static_cast<std::uint64_t>(j + b) & 0xffffffffu);
    const Vec2 g = directions()[corners.at(id) % kDirections];
    return g.x * (p.x - x0 - static_cast<float>(a)) + g.y * (p.y - y0 - static_cast<float>(b));
  };
  const auto fade = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
  const float u = fade(p.x - x0), v = fade(p.y - y0);
  const float a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
  const float south = a + (b - a) * u, north = c + (d - c) * u;
  return south + (north - south) * v;
}

}  // namespace

float perlin_height(const PerlinNoise& noise, std::uint64_t seed, Vec2 plan) {
  float sum = 0.0f, share = 1.0f, shares = 0.0f;
  Vec2 p = plan / noise.scale_m;
  for (int octave = 0; octave < noise.octaves; ++octave) {
    sum += share * gradient_noise(RandomStream(seed, static_cast<std::uint64_t>(octave), Purpose::terrain), p);
    shares += share;
    share *= 0.5f;
    p *= 2.0f;
  }
  constexpr float kSqrt2 = 1.41421356f;
  return noise.amplitude_m * kSqrt2 * sum / shares;
}

Heightfield with_noise(const Heightfield& field, const PerlinNoise& noise, std::uint64_t seed) {
  if (!(noise.amplitude_m > 0.0f)) return field;
  return Heightfield(field.lattice(), [&](Vec2 plan) { return field.at(plan) + perlin_height(noise, seed, plan); });
}

}  // namespace bosquet::terrain
