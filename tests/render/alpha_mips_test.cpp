#include "render/alpha_mips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace bosquet::render {
namespace {

/// Ellipses of opaque leaf on empty ground of another colour.
Image leaf_cutout(int size, int leaves) {
  Image image(size, size, 4);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      std::uint8_t* p = image.at(x, y);
      p[0] = 255, p[1] = 0, p[2] = 255, p[3] = 0;
    }
  RandomStream random(1, 2, Purpose::texture);
  for (int k = 0; k < leaves; ++k) {
    const float cx = random.uniform() * static_cast<float>(size), cy = random.uniform() * static_cast<float>(size);
    const float turn = random.uniform() * 6.28f, c = std::cos(turn), s = std::sin(turn);
    const float long_half = static_cast<float>(size) * 0.09f, short_half = static_cast<float>(size) * 0.03f;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - cy;
        const float u = (dx * c + dy * s) / long_half, v = (dy * c - dx * s) / short_half;
        if (u * u + v * v > 1) continue;
        std::uint8_t* p = image.at(x, y);
        p[0] = 60, p[1] = 120, p[2] = 30, p[3] = 255;
      }
  }
  return image;
}

TEST(MipChain, KeepsTheCoverOfACutOutAtEveryLevel) {
  const Image image = leaf_cutout(128, 14);
  const float wanted = cover(image, 0.5f);
  ASSERT_GT(wanted, 0.1f);
  ASSERT_LT(wanted, 0.6f);
  const std::vector<Image> chain = mip_chain(image, TextureKind::colour, 0.5f);
  ASSERT_EQ(chain.size(), 8u);
  for (const Image& level : chain) {
    if (level.width < 8) break;  // fewer texels than leaves cannot tell shares apart
    EXPECT_NEAR(cover(level, 0.5f), wanted, 0.05f * wanted + 0.5f / static_cast<float>(level.width * level.width))
        << level.width;
  }
}

TEST(MipChain, PlainAveragingWouldLoseTheCover) {
  // What the scaling is for: without it the same leaves thin out by more than a third.
  const Image image = leaf_cutout(128, 14);
  const std::vector<Image> plain = mip_chain(image, TextureKind::colour, 0.0f);
  EXPECT_LT(cover(plain[4], 0.5f), 0.67f * cover(image, 0.5f));
}

TEST(MipChain, NeverMixesTheColourOfEmptyTexelsIn) {
  for (const Image& level : mip_chain(leaf_cutout(64, 10), TextureKind::colour, 0.5f))
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x) {
        const std::uint8_t* p = level.at(x, y);
        if (p[3] < 8) continue;
        EXPECT_LE(std::abs(p[0] - 60) + std::abs(p[1] - 120) + std::abs(p[2] - 30), 3);
      }
}

TEST(MipChain, AveragesColourInLinearLight) {
  Image checker(2, 2, 3);
  for (int i = 0; i < 12; ++i) checker.pixels[static_cast<std::size_t>(i)] = (i / 3 + i / 6) % 2 ? 255 : 0;
  // Half of the light of white is sRGB 188.
  EXPECT_NEAR(mip_chain(checker, TextureKind::colour, 0.0f).back().pixels[0], 188, 1);
}

TEST(MipChain, ReachesOnePixelForAnySize) {
  for (const auto& [w, h] : {std::pair{1, 1}, {5, 3}, {64, 1}, {3, 100}}) {
    const std::vector<Image> chain = mip_chain(Image(w, h, 4), TextureKind::colour, 0.5f);
    EXPECT_EQ(chain.back().width, 1);
    EXPECT_EQ(chain.back().height, 1);
    EXPECT_EQ(static_cast<int>(chain.size()), 1 + static_cast<int>(std::log2(std::max(w, h))));
  }
}

}  // namespace
}  // namespace bosquet::render
