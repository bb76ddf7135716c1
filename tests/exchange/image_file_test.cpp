#include "exchange/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/random.h"
#include "exchange/file_output.h"
#include "exchange/texture_cache.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  RandomStream stream(1, 2, Purpose::texture);
  for (auto& p : image.pixels) p = static_cast<std::uint8_t>(stream.below(256));
  return image;
}

// Slow waves, as bark and ground are: what JPEG is for.
Image waves(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(128 + 100 * std::sin(0.05 * x + c) * std::cos(0.04 * y));
  return image;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.pixels.size());
}

TEST(Png, ReturnsTheSamePixelsForEveryNumberOfChannels) {
  for (int channels : {1, 3, 4}) {
    const Image image = noise(37, 23, channels);
    const auto back = decode_image(encode_png(image), "test");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->width, 37);
    EXPECT_EQ(back->height, 23);
    EXPECT_EQ(back->channels, channels);
    EXPECT_EQ(back->pixels, image.pixels);
  }
}

TEST(Jpeg, ReturnsNearlyTheSamePixels) {
  for (int channels : {1, 3}) {
    const Image image = waves(120, 90, channels);
    const auto back = decode_image(encode_jpeg(image), "test");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->channels, channels);
    EXPECT_LT(mean_difference(*back, image), 2.0);  // quality 90 on smooth content
  }
}

TEST(Jpeg, FullChromaKeepsDirectionsThatHalfChromaBlurs) {
  // Red and green change from pixel to pixel, as in a map of normals.
  Image image(64, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      auto* p = image.at(x, y);
      p[0] = x % 2 ? 90 : 166, p[1] = y % 2 ? 90 : 166, p[2] = 250;
    }
  const auto half = decode_image(encode_jpeg(image, Chroma::half), "half");
  const auto full = decode_image(encode_jpeg(image, Chroma::full), "full");
  ASSERT_TRUE(half && full);
  EXPECT_LT(2 * mean_difference(*full, image), mean_difference(*half, image));
}

TEST(Jpeg, DropsAlpha) {
  Image image = waves(32, 32, 4);
  const auto back = decode_image(encode_jpeg(image), "test");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->channels, 3);
}

TEST(Images, SameImageSameBytes) {
  EXPECT_EQ(encode_png(noise(50, 50, 4)), encode_png(noise(50, 50, 4)));
  EXPECT_EQ(encode_jpeg(noise(50, 50, 3)), encode_jpeg(noise(50, 50, 3)));
}

TEST(Images, DamagedBytesAreAnErrorAndNeverACrash) {
  for (const Bytes& good : {encode_png(noise(40, 40, 4)), encode_jpeg(noise(40, 40, 3))}) {
    EXPECT_FALSE(decode_image(std::span(good).first(good.size() / 2), "half"));
    EXPECT_FALSE(decode_image(std::span(good).first(9), "head"));
    // Any byte may be wrong; whatever comes back is an image or an error.
    RandomStream stream(3, 4, Purpose::texture);
    for (int i = 0; i < 300; ++i) {
      Bytes bad = good;
      bad[stream.below(static_cast<std::uint32_t>(bad.size()))] ^= static_cast<std::byte>(1 + stream.below(255));
      if (const auto image = decode_image(bad, "bad"))
        EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(image->width * image->height * image->channels));
      else
        EXPECT_FALSE(image.error().message.empty());
    }
  }
  EXPECT_FALSE(decode_image({}, "empty"));
}

TEST(Images, MoreThanTheAllowedPixelsAreRefusedByName) {
  for (const Bytes& bytes : {encode_png(noise(40, 40, 3)), encode_jpeg(noise(40, 40, 3))}) {
    const auto image = decode_image(bytes, "huge.png", 1599);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("huge.png has 40 x 40 pixels; at most 1599"), std::string::npos);
  }
}

TEST(Images, FilesGoByTheirEnding) {
  const ScratchFolder folder;
  const Image image = waves(20, 10, 3);
  ASSERT_TRUE(write_image(folder / "a.png", image));
  ASSERT_TRUE(write_image(folder / "a.JPG", image));
  EXPECT_EQ(slurp(folder / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_image(folder / "a.png")->pixels, image.pixels);
  EXPECT_TRUE(read_image(folder / "a.JPG"));
  const auto wrong = write_image(folder / "a.bmp", image);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find(".png, .jpg or .jpeg"), std::string::npos);
}

TEST(TextureCache, ReturnsWhatWasStoredUnderTheSameKeyAndFormatOnly) {
  const ScratchFolder folder;
  const TextureCache cache(folder / "deep/er");
  const Bytes bytes = encode_png(noise(8, 8, 4));
  EXPECT_FALSE(cache.find(7, ImageFormat::png));
  cache.store(7, ImageFormat::png, bytes);
  ASSERT_TRUE(cache.find(7, ImageFormat::png));
  EXPECT_EQ(*cache.find(7, ImageFormat::png), bytes);
  EXPECT_FALSE(cache.find(8, ImageFormat::png));
  EXPECT_FALSE(cache.find(7, ImageFormat::jpeg));
}

TEST(TextureCache, AFileCutShortIsNotFound) {
  const ScratchFolder folder;
  const TextureCache cache(folder.path());
  for (auto [format, bytes] : {std::pair{ImageFormat::png, encode_png(noise(8, 8, 4))},
                               std::pair{ImageFormat::jpeg, encode_jpeg(noise(8, 8, 3))}}) {
    cache.store(1, format, bytes);
    EXPECT_TRUE(cache.find(1, format));
    bytes.pop_back();
    cache.store(2, format, bytes);
    EXPECT_FALSE(cache.find(2, format));
  }
}

TEST(TextureCache, AFolderThatCannotBeMadeOnlyCachesNothing) {
  const ScratchFolder folder;
  spit(folder / "file", "");
  const TextureCache blocked(folder / "file/in/the/way"), none{std::filesystem::path()};
  for (const TextureCache* cache : {&blocked, &none}) {
    cache->store(1, ImageFormat::png, encode_png(noise(8, 8, 4)));
    EXPECT_FALSE(cache->find(1, ImageFormat::png));
  }
}

TEST(TextureCache, LivesInTheUsersCacheFolder) {
  const char* old = std::getenv("XDG_CACHE_HOME");
  const std::string kept = old ? old : "";
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(TextureCache::of_user().folder(), "/somewhere/bosquet/textures");
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // not allowed by the XDG rules
  ::setenv("HOME", "/home/nobody", 1);
  EXPECT_EQ(TextureCache::of_user().folder(), "/home/nobody/.cache/bosquet/textures");
  if (old)
    ::setenv("XDG_CACHE_HOME", kept.c_str(), 1);
  else
    ::unsetenv("XDG_CACHE_HOME");
}

TEST(ContentKey, ChangesWithEveryPixelAndTheShape) {
  const Image image = noise(9, 7, 3);
  const std::uint64_t key = content_key(image);
  EXPECT_EQ(content_key(noise(9, 7, 3)), key);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    Image other = image;
    other.pixels[i] ^= 1;
    EXPECT_NE(content_key(other), key);
  }
  Image turned = image;
  std::swap(turned.width, turned.height);
  EXPECT_NE(content_key(turned), key);
}

}  // namespace
}  // namespace bosquet::exchange
