#include "scene/painting_cache.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "core/hash.h"

namespace bosquet::scene {
namespace {

namespace fs = std::filesystem;

constexpr char kMagic[] = "bqpixel1";
constexpr std::size_t kMagicBytes = 8, kHeadBytes = kMagicBytes + 8;
constexpr std::uint32_t kMostImages = 16, kMostSide = 8192;
constexpr std::uint64_t kMostFileBytes = std::uint64_t{256} << 20;
constexpr const char* kEnding = ".pixels";

std::uint64_t checksum_of(const char* bytes, std::size_t n) {
  Hasher hash;
  hash.add(std::uint64_t{n});
  for (; n >= 8; bytes += 8, n -= 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes, 8);
    hash.add(word);
  }
  std::uint64_t rest = 0;
  std::memcpy(&rest, bytes, n);
  return hash.add(rest).digest();
}

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Reads values one after another; none beyond the end.
class Reader {
 public:
  Reader(const char* begin, const char* end) : at_(begin), end_(end) {}
  std::optional<std::uint32_t> number() {
    if (end_ - at_ < 4) return {};
    std::uint32_t value;
    std::memcpy(&value, at_, 4);
    at_ += 4;
    return value;
  }
  bool bytes(std::vector<std::uint8_t>& to) {
    if (static_cast<std::size_t>(end_ - at_) < to.size()) return false;
    std::copy_n(at_, to.size(), to.begin());
    at_ += to.size();
    return true;
  }
  bool at_end() const { return at_ == end_; }

 private:
  const char *at_, *end_;
};

std::optional<std::vector<Image>> images_of(const std::string& file) {
  if (file.size() < kHeadBytes || std::memcmp(file.data(), kMagic, kMagicBytes) != 0) return {};
  std::uint64_t sum;
  std::memcpy(&sum, file.data() + kMagicBytes, 8);
  if (sum != checksum_of(file.data() + kHeadBytes, file.size() - kHeadBytes)) return {};
  Reader in(file.data() + kHeadBytes, file.data() + file.size());
  const auto count = in.number();
  if (!count || *count > kMostImages) return {};
  std::vector<Image> images;
  for (std::uint32_t k = 0; k < *count; ++k) {
    const auto width = in.number(), height = in.number(), channels = in.number();
    if (!channels || *width > kMostSide || *height > kMostSide || *channels > 4) return {};
    Image& image =
        images.emplace_back(static_cast<int>(*width), static_cast<int>(*height), static_cast<int>(*channels));
    if (!in.bytes(image.pixels)) return {};
  }
  if (!in.at_end()) return {};
  return images;
}

std::optional<std::string> whole_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const std::streamoff size = in.tellg();
  if (size < 0 || static_cast<std::uint64_t>(size) > kMostFileBytes) return {};
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.seekg(0);
  if (!in.read(bytes.data(), size)) return {};
  return bytes;
}

}  // namespace

fs::path PaintingCache::file(std::uint64_t key) const { return folder_ / (bosquet::hex_digits(key) + kEnding); }

std::optional<std::vector<Image>> PaintingCache::find(std::uint64_t key) const {
  if (folder_.empty()) return {};
  const fs::path path = file(key);
  const auto bytes = whole_file(path);
  if (!bytes) return {};
  auto images = images_of(*bytes);
  std::error_code ignored;
  if (images) fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // used now
  return images;
}

void PaintingCache::store(std::uint64_t key, const std::vector<Image>& images) const {
  if (folder_.empty()) return;
  std::string bytes(kMagic, kMagicBytes);
  put(bytes, std::uint64_t{0});
  put(bytes, static_cast<std::uint32_t>(images.size()));
  for (const Image& image : images) {
    for (const int n : {image.width, image.height, image.channels}) put(bytes, static_cast<std::uint32_t>(n));
    bytes.append(reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size());
  }
  const std::uint64_t sum = checksum_of(bytes.data() + kHeadBytes, bytes.size() - kHeadBytes);
  std::memcpy(bytes.data() + kMagicBytes, &sum, 8);

  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  std::string hidden = (folder_ / (".painting-XXXXXX")).string();
  const int descriptor = ::mkstemp(hidden.data());
  if (descriptor < 0) return;
  std::FILE* out = ::fdopen(descriptor, "wb");
  const bool written = out && std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  if (out && std::fclose(out) == 0 && written)
    fs::rename(hidden, file(key), ignored);
  else
    fs::remove(hidden, ignored);
  make_room();
}

void PaintingCache::make_room() const {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
  };
  std::vector<Entry> entries;
  std::uint64_t all = 0;
  std::error_code ec;
  for (fs::directory_iterator it(folder_, ec), end; !ec && it != end; it.increment(ec)) {
    std::error_code gone;
    if (it->path().extension() != kEnding) continue;
    const std::uint64_t bytes = it->file_size(gone);
    const fs::file_time_type used = it->last_write_time(gone);
    if (gone) continue;
    entries.push_back({it->path(), used, bytes});
    all += bytes;
  }
  if (all <= most_bytes_) return;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (all <= most_bytes_) break;
    if (fs::remove(entry.path, ec)) all -= entry.bytes;
  }
}

}  // namespace bosquet::scene
