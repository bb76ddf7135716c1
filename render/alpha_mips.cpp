#include "render/alpha_mips.h"

#include <algorithm>
#include <cmath>

#include "core/vec.h"
#include "render/srgb.h"

namespace bosquet::render {
namespace {

/// One level while it is being made: linear colour, alpha, all 0..1.
struct Level {
  int width, height;
  std::vector<Vec4> texels;
  Vec4& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  const Vec4& at(int x, int y) const { return const_cast<Level&>(*this).at(x, y); }
};

std::uint8_t to_byte(float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); }

Level read(const Image& image, TextureKind kind) {
  Level level{image.width, image.height, {}};
  level.texels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const int n = image.channels;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const std::uint8_t rgb[3] = {p[0], n >= 3 ? p[1] : p[0], n >= 3 ? p[2] : p[0]};
      Vec4& t = level.at(x, y);
      for (int c = 0; c < 3; ++c)
        t[c] = kind == TextureKind::colour ? linear_of_srgb(rgb[c]) : static_cast<float>(rgb[c]) / 255.0f;
      t.a = n == 4 ? static_cast<float>(p[3]) / 255.0f : 1.0f;
    }
  return level;
}

/// Half the size; odd sides drop their last row, single ones stay.
Level half(const Level& from, TextureKind kind) {
  Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.texels.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      Vec3 weighted(0.0f), plain(0.0f);
      float alpha = 0;
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          const Vec4& t = from.at(std::min(2 * x + i, from.width - 1), std::min(2 * y + j, from.height - 1));
          weighted += Vec3(t) * t.a, plain += Vec3(t), alpha += t.a;
        }
      const bool by_alpha = kind == TextureKind::colour && alpha > 1e-3f;
      to.at(x, y) = Vec4(by_alpha ? weighted / alpha : plain * 0.25f, alpha * 0.25f);
    }
  return to;
}

/// Share of a level's area, sampled bilinearly at 3 x 3 points a texel, with alpha * scale >= cutoff.
float cover_of(const Level& level, float cutoff, float scale) {
  constexpr int kPoints = 3;
  std::size_t passed = 0;
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const int x1 = std::min(x + 1, level.width - 1), y1 = std::min(y + 1, level.height - 1);
      const float a = level.at(x, y).a, b = level.at(x1, y).a, c = level.at(x, y1).a, d = level.at(x1, y1).a;
      for (int j = 0; j < kPoints; ++j)
        for (int i = 0; i < kPoints; ++i) {
          const float u = (static_cast<float>(i) + 0.5f) / kPoints, v = (static_cast<float>(j) + 0.5f) / kPoints;
          const float alpha = glm::mix(glm::mix(a, b, u), glm::mix(c, d, u), v);
          passed += std::min(alpha * scale, 1.0f) >= cutoff;
        }
    }
  return static_cast<float>(passed) / static_cast<float>(level.texels.size() * kPoints * kPoints);
}

/// Scale of alpha at which the level covers `wanted`.
float scale_for_cover(const Level& level, float cutoff, float wanted) {
  float low = 0.25f, high = 8.0f;
  for (int step = 0; step < 12; ++step) {
    const float middle = std::sqrt(low * high);
    (cover_of(level, cutoff, middle) < wanted ? low : high) = middle;
  }
  // Of the two sides of the jump take the nearer.
  const float below = wanted - cover_of(level, cutoff, low), above = cover_of(level, cutoff, high) - wanted;
  return below <= above ? low : high;
}

Image write(const Level& level, TextureKind kind, float scale) {
  Image image(level.width, level.height, 4);
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const Vec4& t = level.at(x, y);
      std::uint8_t* p = image.at(x, y);
      for (int c = 0; c < 3; ++c) p[c] = kind == TextureKind::colour ? srgb_of_linear(t[c]) : to_byte(t[c]);
      p[3] = to_byte(t.a * scale);
    }
  return image;
}

}  // namespace

std::vector<Image> mip_chain(const Image& image, TextureKind kind, float cutoff) {
  Level level = read(image, kind);
  const bool keep = cutoff > 0.0f && cutoff < 1.0f && image.channels == 4;
  const float wanted = keep ? cover_of(level, cutoff, 1.0f) : 0.0f;
  std::vector<Image> chain;
  chain.push_back(write(level, kind, 1.0f));
  while (level.width > 1 || level.height > 1) {
    level = half(level, kind);
    chain.push_back(write(level, kind, keep && wanted > 0.0f ? scale_for_cover(level, cutoff, wanted) : 1.0f));
  }
  return chain;
}

float cover(const Image& rgba, float cutoff) { return cover_of(read(rgba, TextureKind::normal), cutoff, 1.0f); }

}  // namespace bosquet::render
