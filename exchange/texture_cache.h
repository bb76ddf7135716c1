// Texture cache: encoded images kept between runs, by a hash of what they were made from.
//
// Where     $XDG_CACHE_HOME/bosquet/textures, else ~/.cache/bosquet/textures; <16 hex digits>.png or .jpg
// Holds     a file appears whole or not at all, so several programs may share the folder; a hash covers everything that
//           shapes the bytes (look, generator version, format), so a file found is the file wanted
// Errors    none: a folder that cannot be made, read or written only makes things slower
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/image.h"
#include "exchange/image_file.h"

namespace bosquet::exchange {

class TextureCache {
 public:
  /// In the user's cache folder; caches nothing when there is none.
  static TextureCache of_user();

  /// In `folder`, made when first needed; an empty path caches nothing.
  explicit TextureCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The bytes stored under `key`, or nothing (also when they do not begin as a file of that format).
  std::optional<Bytes> find(std::uint64_t key, ImageFormat format) const;
  void store(std::uint64_t key, ImageFormat format, const Bytes& bytes) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file(std::uint64_t key, ImageFormat format) const;
  std::filesystem::path folder_;
};

/// A key from the pixels themselves, for images whose origin is not known.
std::uint64_t content_key(const Image& image);

}  // namespace bosquet::exchange
