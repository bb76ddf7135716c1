#include "exchange/texture_cache.h"

#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/hash.h"
#include "exchange/file_output.h"

namespace bosquet::exchange {
namespace {

constexpr std::uint64_t kMaxCachedBytes = std::uint64_t{256} << 20;

// A file cut short by a crash of the machine would otherwise come back for ever.
bool complete(const Bytes& bytes, ImageFormat format) {
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  const std::size_t n = bytes.size();
  if (n < 16) return false;
  if (format == ImageFormat::jpeg) return at(0) == 0xff && at(1) == 0xd8 && at(n - 2) == 0xff && at(n - 1) == 0xd9;
  return std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) == 0 &&
         std::memcmp(bytes.data() + n - 8, "IEND\xae\x42\x60\x82", 8) == 0;
}

}  // namespace

TextureCache TextureCache::of_user() {
  // The XDG rules ask for an absolute path and to ignore any other.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache == '/') return TextureCache(std::filesystem::path(cache) / "bosquet" / "textures");
  const char* home = std::getenv("HOME");
  if (home && *home == '/') return TextureCache(std::filesystem::path(home) / ".cache" / "bosquet" / "textures");
  return TextureCache({});
}

std::filesystem::path TextureCache::file(std::uint64_t key, ImageFormat format) const {
  return folder_ / (hex_digits(key) + (format == ImageFormat::png ? ".png" : ".jpg"));
}

std::optional<Bytes> TextureCache::find(std::uint64_t key, ImageFormat format) const {
  if (folder_.empty()) return std::nullopt;
  auto bytes = read_file(file(key, format), kMaxCachedBytes);
  if (!bytes || !complete(*bytes, format)) return std::nullopt;
  return *std::move(bytes);
}

void TextureCache::store(std::uint64_t key, ImageFormat format, const Bytes& bytes) const {
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  // Failing only makes the next run slower.
  (void)static_cast<bool>(write_file(file(key, format), std::span<const std::byte>(bytes)));
}

std::uint64_t content_key(const Image& image) {
  Hasher hash;
  hash.add(image.width).add(image.height).add(image.channels);
  const std::size_t words = image.pixels.size() / 8;
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t word;
    std::memcpy(&word, image.pixels.data() + 8 * i, 8);
    hash.add(word);
  }
  for (std::size_t i = 8 * words; i < image.pixels.size(); ++i) hash.add(std::uint64_t{image.pixels[i]});
  return hash.digest();
}

}  // namespace bosquet::exchange
