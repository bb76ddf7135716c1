#include "ui/thumbnails.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "exchange/texture_cache.h"
#include "render/headless_context.h"
#include "scene/species.h"

namespace bosquet::ui {
namespace {

TEST(Thumbnails, AreForgottenWithTheSpeciesOfAClosedDocument) {
  auto context = render::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bosquet-thumbnails-test";
  const char* const had = std::getenv("XDG_CACHE_HOME");
  const std::string before = had ? had : "";
  ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  std::vector<std::shared_ptr<const scene::Species>> species;
  for (const char* name : {"rowan", "silver_birch"}) {
    auto read = scene::builtin_species(name);
    ASSERT_TRUE(read) << read.error().message;
    species.push_back(std::make_shared<const scene::Species>(std::move(*read)));
  }
  // Pictures that are on the disk need not be drawn.
  const exchange::TextureCache cache(folder / "bosquet" / "thumbnails");
  const Image picture(kThumbnail_px, kThumbnail_px, 4);
  for (const auto& one : species)
    cache.store(thumbnail_key(one), exchange::ImageFormat::png, exchange::encode_png(picture));
  {
    Thumbnails thumbnails;
    const auto wait = [&] {
      for (int i = 0; i < 2000 && !thumbnails.settled(); ++i) {
        thumbnails.collect();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    };
    for (const auto& one : species) thumbnails.of(one);
    wait();
    const unsigned rowan = thumbnails.of(species[0]);
    EXPECT_NE(rowan, 0u);
    EXPECT_NE(thumbnails.of(species[1]), 0u);
    thumbnails.keep({species[0]});
    EXPECT_EQ(thumbnails.of(species[0]), rowan);
    EXPECT_EQ(thumbnails.of(species[1]), 0u);
    wait();
    EXPECT_NE(thumbnails.of(species[1]), 0u);
  }
  had ? ::setenv("XDG_CACHE_HOME", before.c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bosquet::ui
