// File output: a file that appears whole or not at all.
//
// Model     bytes go to a hidden file in the target's folder; commit() flushes them to the disk, closes and renames it
//           over the target. Without commit() the hidden file is removed and an older target is untouched.
// Decision  a target that exists and is no regular file (a pipe, /dev/stdout) is written to directly; a symbolic link
//           stays a link and the file it points to is replaced
// Errors    every write is checked, the first failure is kept and returned by commit(): kind `input` when the folder is
//           missing, may not be written, or the target is a folder or read-only; kind `cannot_finish` when the disk is full or fails.
//           Messages name the path.
// Cost      writes of 4 MiB and more go to the system as they are, smaller ones are gathered
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace bosquet::exchange {

class FileOutput {
 public:
  /// Opens the hidden file; fails at once when the target cannot be made.
  static Result<FileOutput> create(const std::filesystem::path& target);

  FileOutput(FileOutput&& other) noexcept;
  FileOutput& operator=(FileOutput&& other) noexcept;
  ~FileOutput();

  /// After a failure further bytes are dropped; failed() says so early, commit() returns the error.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  template <class T>
  void write_values(std::span<const T> values) {
    write(std::as_bytes(values));
  }

  bool failed() const { return failure_ != 0; }
  std::uint64_t bytes() const { return bytes_; }
  const std::filesystem::path& target() const { return target_; }

  /// Makes the file appear. Call it once; returns the number of bytes written.
  Result<std::uint64_t> commit();

 private:
  FileOutput() = default;
  void flush();
  void write_through(const std::byte* data, std::size_t n);
  void discard();

  std::filesystem::path target_, hidden_;  ///< hidden_ is empty when written directly
  std::vector<std::byte> buffer_;
  std::uint64_t bytes_ = 0;
  int descriptor_ = -1;
  int failure_ = 0;  ///< errno of the first failure
};

/// The whole file in one call.
Result<std::uint64_t> write_file(const std::filesystem::path& target, std::span<const std::byte> bytes);
Result<std::uint64_t> write_file(const std::filesystem::path& target, std::string_view text);

/// The path's ending in lower case, with its dot: what kind of file is meant.
std::string lower_ending(const std::filesystem::path& path);

/// All bytes of a regular file of at most `limit` bytes; the message names path, size and limit.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t limit);

}  // namespace bosquet::exchange
