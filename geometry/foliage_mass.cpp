#include "geometry/foliage_mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "core/scalar.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

// How many twigs a mass may have; of these the number is taken whose cover is nearest to that of the twig itself, so that
// a card shows as much leaf at this level as at the one before.
constexpr int kMostTwigs = 48;
constexpr std::array<int, 7> kTwigCounts{8, 11, 15, 20, 27, 36, kMostTwigs};
// Half the width of the mass as a share of the cell, before its twigs stick out.
constexpr float kMassRadius = 0.36f;
// Light that the twigs farthest behind show.
constexpr float kBackShade = 0.6f;

struct Texel {
  Vec3 colour{0.0f};  ///< linear, premultiplied
  float alpha = 0.0f;
};

// One upper cell at a quarter of its pixels, so that sampling it three times smaller does not sparkle.
struct Twig {
  int side = 0;
  std::vector<Texel> texels;

  Twig(const Image& atlas, int variant) : side(atlas.width / 4) {
    texels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        Texel& t = texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
        for (int k = 0; k < 4; ++k) {
          const std::uint8_t* p = atlas.at(variant * atlas.width / 2 + 2 * x + (k & 1), 2 * y + (k >> 1));
          const float alpha = static_cast<float>(p[3]) / 255.0f;
          const auto channel = [&](int c) { return linear_from_srgb(static_cast<float>(p[c]) / 255.0f); };
          t.colour += 0.25f * alpha * Vec3(channel(0), channel(1), channel(2));
          t.alpha += 0.25f * alpha;
        }
      }
  }
  // (u, v) in the cell, v from the top.
  Texel at(float u, float v) const {
    const int x = static_cast<int>(u * static_cast<float>(side)), y = static_cast<int>(v * static_cast<float>(side));
    if (!(u >= 0.0f && v >= 0.0f) || x >= side || y >= side) return {};
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
  }
};

struct Placed {
  Vec2 foot{0.0f};   ///< in the cell, 0..1, v from the top
  Vec2 along{0.0f};  ///< unit vector from foot to tip
  float size = kTwigScale, shade = 1.0f;
  int variant = 0;
};

// Strands side by side, twigs along them.
constexpr int kStrands = 5;
std::vector<Placed> hang_twigs(int cell, std::uint64_t seed, int count) {
  RandomStream random(seed, mix_bits(700 + static_cast<std::uint64_t>(cell)), Purpose::texture);
  std::vector<Placed> twigs;
  for (int k = 0; k < count; ++k) {
    Placed twig;
    const int strand = k % kStrands;
    const float side = 2.0f * (static_cast<float>(strand) + 0.5f) / static_cast<float>(kStrands) - 1.0f;
    // The outer ones are shorter, so that the card has no corners.
    const float reach = 0.36f - 0.1f * side * side;
    twig.along = glm::normalize(Vec2(0.1f * random.uniform(-1.0f, 1.0f), -1.0f));
    twig.size = kTwigScale * random.uniform(0.85f, 1.15f);
    twig.foot = Vec2(0.5f + 0.4f * side + 0.02f * random.uniform(-1.0f, 1.0f),
                     0.5f + reach * random.uniform(-1.0f, 1.0f) + 0.5f * twig.size);
    const float front = static_cast<float>(k) / static_cast<float>(count - 1);
    twig.shade = kBackShade + (1.0f - kBackShade) * front;
    twig.variant = cell;
    twigs.push_back(twig);
  }
  return twigs;
}

std::vector<Placed> place_twigs(int cell, ClusterForm form, std::uint64_t seed, int count) {
  if (form == ClusterForm::strings) return hang_twigs(cell, seed, count);
  RandomStream random(seed, mix_bits(700 + static_cast<std::uint64_t>(cell)), Purpose::texture);
  std::vector<Placed> twigs;
  for (int k = 0; k < count; ++k) {
    // Uniform in a disc; twigs point outward and up, as they do all around a bough.
    const float radius = kMassRadius * std::sqrt(random.uniform());
    const SinCos around = sin_cos(2.0f * kPi * random.uniform());
    const Vec2 place = radius * Vec2(around.cos, around.sin);
    const float lean = 0.9f * random.uniform(-1.0f, 1.0f);
    const Vec2 out = glm::normalize(place / kMassRadius + Vec2(lean, -0.9f));
    Placed twig;
    twig.along = out;
    twig.size = kTwigScale * random.uniform(0.85f, 1.15f);
    twig.foot = Vec2(0.5f, 0.55f) + place - 0.45f * twig.size * out;
    const float front = static_cast<float>(k) / static_cast<float>(count - 1);
    twig.shade = kBackShade + (1.0f - kBackShade) * front;
    twig.variant = cell;  // in a season with a bloom only the first shows it
    twigs.push_back(twig);
  }
  return twigs;
}

Texel paint(const std::vector<Placed>& placed, const std::array<Twig, 2>& twigs, Vec2 at) {
  Texel sum;
  for (const Placed& p : placed) {
    const Vec2 d = at - p.foot;
    const float v = 1.0f - glm::dot(d, p.along) / p.size;
    const float u = 0.5f + (d.y * p.along.x - d.x * p.along.y) / p.size;
    const Texel t = twigs[static_cast<std::size_t>(p.variant)].at(u, v);
    sum.colour = sum.colour * (1.0f - t.alpha) + p.shade * t.colour;
    sum.alpha = sum.alpha * (1.0f - t.alpha) + t.alpha;
  }
  return sum;
}

}  // namespace

namespace {

// Mean of some texels, colour not premultiplied.
Texel mean_of(const std::vector<Texel>& texels) {
  Texel all;
  for (const Texel& t : texels) all.colour += t.colour, all.alpha += t.alpha;
  const Vec3 colour = all.alpha > 0.0f ? all.colour / all.alpha : Vec3(0.0f);
  return {colour, all.alpha / static_cast<float>(texels.size())};
}

bool on_card(Vec2 at) {
  const Vec2 rim = glm::min(at, 1.0f - at);
  return std::min(rim.x, rim.y) > kAtlasMargin;
}

// The placement whose cover, probed on a coarse grid, is nearest to the twig's.
std::vector<Placed> as_full_as(float cover, const std::array<Twig, 2>& twigs, int cell, ClusterForm form,
                               std::uint64_t seed) {
  constexpr int kProbes = 48;
  std::vector<Placed> best;
  float least = 2.0f;
  for (const int count : kTwigCounts) {
    std::vector<Placed> placed = place_twigs(cell, form, seed, count);
    float sum = 0.0f;
    for (int y = 0; y < kProbes; ++y)
      for (int x = 0; x < kProbes; ++x) sum += paint(placed, twigs, (Vec2(x, y) + 0.5f) / float{kProbes}).alpha;
    const float off = std::fabs(sum / (kProbes * kProbes) - cover);
    if (off < least) least = off, best = std::move(placed);
  }
  return best;
}

}  // namespace

LeafAtlas make_foliage_mass(const LeafAtlas& leaves, ClusterForm form, std::uint64_t seed) {
  const std::array<Twig, 2> twigs{Twig(leaves.base_colour, 0), Twig(leaves.base_colour, 1)};
  const int side = leaves.base_colour.width / 4;
  LeafAtlas mass;
  Image& image = mass.base_colour = Image(2 * side, 2 * side, 4);
  for (int cell = 0; cell < 2; ++cell) {
    const Texel twig = mean_of(twigs[static_cast<std::size_t>(cell)].texels);
    const std::vector<Placed> placed = as_full_as(twig.alpha, twigs, cell, form, seed);
    std::vector<Texel> texels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    parallel_for(static_cast<std::size_t>(side), [&](std::size_t y) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(side); ++x) {
        const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(side);
        if (on_card(at)) texels[y * static_cast<std::size_t>(side) + x] = paint(placed, twigs, at);
      }
    });
    // What shade among the twigs takes from the mean colour is given back, for it to stay that of the twig. Where
    // nothing stands the mean colour goes on, so that filtering finds no dark rim.
    const Vec3 mean = mean_of(texels).colour, back = twig.colour / glm::max(mean, Vec3(1e-4f));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Texel& t =
            texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
        std::uint8_t* pixel = image.at(cell * side + x, y);
        put_srgb(pixel, back * (t.alpha > 0.01f ? t.colour / t.alpha : mean));
        pixel[3] = unit_byte(t.alpha);
      }
  }
  return mass;
}

}  // namespace bosquet::geometry
