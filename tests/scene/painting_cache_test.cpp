#include "scene/painting_cache.h"

#include <gtest/gtest.h>

#include <chrono>

#include "scene/materials.h"
#include "tests/scene/sample_document.h"
#include "tests/scene/scratch_files.h"

namespace bosquet::scene {
namespace {

namespace fs = std::filesystem;

class PaintingCacheTest : public ScratchTest {
 protected:
  static std::vector<Image> two_images() {
    std::vector<Image> images{Image(5, 3, 4), Image(0, 0, 3)};
    for (std::size_t i = 0; i < images[0].pixels.size(); ++i) images[0].pixels[i] = static_cast<std::uint8_t>(7 * i);
    return images;
  }
  fs::path only_file() const { return fs::directory_iterator(folder_)->path(); }
  static void put(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }
};

TEST_F(PaintingCacheTest, ImagesComeBackUnderTheirKeyOnly) {
  const PaintingCache cache(folder_);
  EXPECT_FALSE(cache.find(7));
  cache.store(7, two_images());
  const auto found = cache.find(7);
  ASSERT_TRUE(found && found->size() == 2);
  EXPECT_EQ((*found)[0].pixels, two_images()[0].pixels);
  EXPECT_EQ((*found)[0].width, 5);
  EXPECT_EQ((*found)[0].channels, 4);
  EXPECT_TRUE((*found)[1].empty());
  EXPECT_FALSE(cache.find(8));
}

TEST_F(PaintingCacheTest, AFileWithAnyByteChangedOrMissingIsNone) {
  const PaintingCache cache(folder_);
  cache.store(7, two_images());
  const fs::path path = only_file();
  const std::string whole = contents(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string other = whole;
    other[i] = static_cast<char>(other[i] ^ 0x10);
    put(path, other);
    EXPECT_FALSE(cache.find(7)) << "byte " << i;
    put(path, whole.substr(0, i));
    EXPECT_FALSE(cache.find(7)) << i << " bytes";
  }
  put(path, whole + "x");
  EXPECT_FALSE(cache.find(7));
  put(path, whole);
  EXPECT_TRUE(cache.find(7));
}

TEST_F(PaintingCacheTest, WhatWasNotUsedForLongestMakesRoom) {
  std::vector<Image> large{Image(100, 100, 4)};
  const PaintingCache cache(folder_, 100'000);
  const auto age = [&](std::uint64_t key, int hours) {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (std::stoull(entry.path().stem().string(), nullptr, 16) == key)
        fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  cache.store(1, large), cache.store(2, large);
  age(1, 2), age(2, 3);
  EXPECT_TRUE(cache.find(2));  // used now
  cache.store(3, large);
  EXPECT_FALSE(cache.find(1));
  EXPECT_TRUE(cache.find(2));
  EXPECT_TRUE(cache.find(3));
}

TEST_F(PaintingCacheTest, AFolderThatCannotBeMadeOnlyKeepsNothing) {
  put(folder_ / "file", "");
  for (const fs::path& folder : {fs::path(), folder_ / "file" / "below"}) {
    const PaintingCache cache(folder);
    cache.store(7, two_images());
    EXPECT_FALSE(cache.find(7));
  }
}

TEST_F(PaintingCacheTest, MaterialsAreTheSameWithACacheAndPaintedAnewOnlyWhereTheLookDiffers) {
  const PaintingCache cache(folder_);
  Species species = *sample_document("rowan", {{2, 2}}, {4, 4}, 0.5f).species.front();
  const auto plain = species_materials(species, geometry::Season::summer);
  const auto expect_same = [&](const std::vector<Material>& other) {
    ASSERT_EQ(other.size(), plain.size());
    for (std::size_t m = 0; m < plain.size(); ++m) {
      EXPECT_EQ(other[m].base_colour->pixels, plain[m].base_colour->pixels);
      EXPECT_EQ(other[m].normal ? other[m].normal->pixels : std::vector<std::uint8_t>(),
                plain[m].normal ? plain[m].normal->pixels : std::vector<std::uint8_t>());
    }
  };
  expect_same(species_materials(species, geometry::Season::summer, &cache));
  ASSERT_EQ(files(), 2u);
  expect_same(species_materials(species, geometry::Season::summer, &cache));
  EXPECT_EQ(files(), 2u);
  species.look.leaf.length_mm *= 1.5f;  // bark knows twigs, but its key is of the whole look
  EXPECT_NE(species_materials(species, geometry::Season::summer, &cache)[kLeafPart].base_colour->pixels,
            plain[kLeafPart].base_colour->pixels);
  EXPECT_EQ(files(), 4u);
}

}  // namespace
}  // namespace bosquet::scene
