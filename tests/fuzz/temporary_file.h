// The bytes of a fuzz case as a file, for readers that open files.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace bosquet::fuzz {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& ending) {
    const std::filesystem::path memory = "/dev/shm";
    std::error_code ec;
    const auto folder = std::filesystem::is_directory(memory, ec) ? memory : std::filesystem::temp_directory_path();
    path_ = folder / ("bosquet-fuzz-" + std::to_string(::getpid()) + ending);
  }
  ~TemporaryFile() { remove(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& put(const std::uint8_t* data, std::size_t size) {
    remove();
    if (std::FILE* out = std::fopen(path_.c_str(), "wb")) {
      std::fwrite(data, 1, size, out);
      std::fclose(out);
    }
    return path_;
  }

 private:
  void remove() {
    std::error_code ec;
    for (const char* suffix : {"", "-journal", "-wal", "-shm", ".aux.xml"})
      std::filesystem::remove(path_.string() + suffix, ec);
  }
  std::filesystem::path path_;
};

}  // namespace bosquet::fuzz
