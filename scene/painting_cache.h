// Painting cache: textures as they were painted, kept between runs by a hash of what they were painted from.
//
// Format    <16 hex digits>.pixels: eight letters, a checksum of what follows, the number of images, and for each its
//           width, height, channels (32-bit, little-endian) and its pixels as they are, about 5 MB a species and season
// Decision  not compressed: unpacking would take a good part of the time that painting does
// Decision  a key holds painter_version(), a hash of the painters' sources, so that another version of the program finds
//           nothing of this one; what has not been used for longest goes when all take more than most_bytes
// Holds     a file appears whole or not at all, so several programs may share the folder; one that is damaged is no file
//           and is painted anew
// Errors    none: a folder that cannot be made, read or written only makes things slower
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "core/image.h"

namespace bosquet::scene {

class PaintingCache {
 public:
  static constexpr std::uint64_t kMostBytes = std::uint64_t{512} << 20;

  /// In `folder`, made when first needed; an empty path keeps nothing.
  explicit PaintingCache(std::filesystem::path folder, std::uint64_t most_bytes = kMostBytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  /// The images stored under `key`, or nothing.
  std::optional<std::vector<Image>> find(std::uint64_t key) const;
  void store(std::uint64_t key, const std::vector<Image>& images) const;

 private:
  std::filesystem::path file(std::uint64_t key) const;
  void make_room() const;
  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

/// Differs whenever a source file differs that painting depends on.
std::uint64_t painter_version();

}  // namespace bosquet::scene
