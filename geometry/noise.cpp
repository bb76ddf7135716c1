#include "geometry/noise.h"

#include <algorithm>
#include <cassert>

#include "core/random.h"
#include "core/scalar.h"

namespace bosquet::geometry {
namespace {

// Largest integer not above x, |x| < 2^31, without the C library.
int floor_int(float x) {
  const int i = static_cast<int>(x);
  return static_cast<float>(i) > x ? i - 1 : i;
}

// Points lie in or near the tile, so this takes a step or two where % takes a division.
int wrap(int i, int n) {
  while (i >= n) i -= n;
  while (i < 0) i += n;
  return i;
}

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

float unit(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

}  // namespace

TileNoise::TileNoise(std::uint64_t seed, std::uint64_t key, int nx, int ny)
    : nx_(nx), ny_(ny), gradients_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)) {
  assert(nx > 0 && ny > 0);
  RandomStream stream(seed, key, Purpose::texture);
  for (Vec2& g : gradients_) {
    const SinCos a = sin_cos(2.0f * kPi * stream.uniform());
    g = {a.cos, a.sin};
  }
}

float TileNoise::operator()(float u, float v) const {
  const float x = u * static_cast<float>(nx_), y = v * static_cast<float>(ny_);
  const int xi = floor_int(x), yi = floor_int(y);
  const float fx = x - static_cast<float>(xi), fy = y - static_cast<float>(yi);
  const int x0 = wrap(xi, nx_), x1 = x0 + 1 == nx_ ? 0 : x0 + 1;
  const int y0 = wrap(yi, ny_), y1 = y0 + 1 == ny_ ? 0 : y0 + 1;
  const Vec2 *row0 = gradients_.data() + y0 * nx_, *row1 = gradients_.data() + y1 * nx_;
  const auto dot = [](Vec2 g, float dx, float dy) { return g.x * dx + g.y * dy; };
  const float a = dot(row0[x0], fx, fy), b = dot(row0[x1], fx - 1.0f, fy);
  const float c = dot(row1[x0], fx, fy - 1.0f), d = dot(row1[x1], fx - 1.0f, fy - 1.0f);
  const float sx = fade(fx), sy = fade(fy);
  const float top = a + (b - a) * sx, bottom = c + (d - c) * sx;
  return 1.41421356f * (top + (bottom - top) * sy);
}

TileFractal::TileFractal(std::uint64_t seed, std::uint64_t key, int nx, int ny, int octaves, float gain) : gain_(gain) {
  float weight = 1.0f, sum = 0.0f;
  for (int o = 0; o < octaves; ++o, weight *= gain, nx *= 2, ny *= 2) {
    octaves_.emplace_back(seed, mix_bits(key) + static_cast<std::uint64_t>(o), nx, ny);
    sum += weight;
  }
  norm_ = 1.0f / sum;
}

float TileFractal::operator()(float u, float v) const {
  float sum = 0.0f, weight = norm_;
  for (const TileNoise& noise : octaves_) sum += weight * noise(u, v), weight *= gain_;
  return sum;
}

TileCells::TileCells(std::uint64_t seed, std::uint64_t key, int nx, int ny, float jitter, float stretch)
    : nx_(nx), ny_(ny), inverse_stretch_(1.0f / stretch), key_(mix_bits(seed + mix_bits(key))) {
  assert(nx >= 2 && ny >= 2 && ny % 2 == 0);
  RandomStream stream(seed, key, Purpose::texture);
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const float jx = stream.uniform(-0.5f, 0.5f) * jitter, jy = stream.uniform(-0.5f, 0.5f) * jitter;
      centres_.push_back(
          {static_cast<float>(x) + 0.5f + (y % 2 == 1 ? 0.5f : 0.0f) + jx, static_cast<float>(y) + 0.5f + jy});
    }
  }
}

TileCells::Hit TileCells::operator()(float u, float v) const {
  const float px = u * static_cast<float>(nx_), py = v * static_cast<float>(ny_);
  const int xi = floor_int(px), yi = floor_int(py);
  // Centres lie up to one cell right of their lattice cell and half a cell around it: five by three suffice for the
  // nearest; the border is taken against the same candidates.
  struct Candidate {
    Vec2 to;  // from the point to the centre
    std::uint32_t cell;
    float d2;
  } candidates[15];
  int count = 0, best = 0, columns[5];
  for (int dx = -2; dx <= 2; ++dx) columns[dx + 2] = wrap(xi + dx, nx_);
  for (int dy = -1; dy <= 1; ++dy) {
    const int y = yi + dy, wy = wrap(y, ny_);
    for (int dx = -2; dx <= 2; ++dx) {
      const int x = xi + dx, wx = columns[dx + 2];
      const auto cell = static_cast<std::uint32_t>(wy * nx_ + wx);
      const Vec2 to{centres_[cell].x + static_cast<float>(x - wx) - px,
                    centres_[cell].y + static_cast<float>(y - wy) - py};
      candidates[count] = {to, cell, to.x * to.x + to.y * to.y};
      if (candidates[count].d2 < candidates[best].d2) best = count;
      ++count;
    }
  }
  // Distance to the bisector with each other candidate, measured in cell widths; the smallest is the border. Squares
  // are compared, crosswise, so that only the winner costs a division and a root.
  const Candidate& near = candidates[best];
  Hit hit{near.cell, near.cell, -near.to, 0.0f};
  float best_rise2 = 64.0f, best_length2 = 1.0f;
  for (int i = 0; i < count; ++i) {
    if (i == best) continue;
    const Vec2 between = candidates[i].to - near.to, normal{between.x, between.y * inverse_stretch_};
    const float length2 = normal.x * normal.x + normal.y * normal.y, rise = candidates[i].d2 - near.d2;
    if (rise * rise * best_length2 >= best_rise2 * length2) continue;
    best_rise2 = rise * rise, best_length2 = length2, hit.second = candidates[i].cell;
  }
  hit.border = 0.5f * std::sqrt(best_rise2 / best_length2);
  return hit;
}

float TileCells::random(std::uint32_t cell, std::uint64_t what) const {
  return unit(mix_bits(mix_bits(key_ + cell) + what));
}

float TileCells::random(std::uint32_t a, std::uint32_t b, std::uint64_t what) const {
  const std::uint64_t low = std::min(a, b), high = std::max(a, b);
  return unit(mix_bits(mix_bits(key_ + (low << 32 | high)) + what + 0x51ull));
}

}  // namespace bosquet::geometry
