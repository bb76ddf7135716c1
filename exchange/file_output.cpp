#include "exchange/file_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/write_protection.h"

namespace bosquet::exchange {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{4} << 20;

std::atomic<unsigned> files_begun{0};

// A short name of our own: the target's may be as long as the file system allows.
std::filesystem::path hidden_name(const std::filesystem::path& target) {
  return target.parent_path() / fmt::format(".bosquet-{}-{}.part", ::getpid(), files_begun.fetch_add(1));
}

// What a link at the end of the path points to, so that the link itself survives the rename.
std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code none;
  for (int hops = 0; hops < 16 && std::filesystem::is_symlink(path, none); ++hops) {
    const auto to = std::filesystem::read_symlink(path, none);
    if (none) break;
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path;
}

Error describe(const std::filesystem::path& target, int number) {
  const std::string path = target.string();
  const auto folder = target.parent_path().empty() ? std::string(".") : target.parent_path().string();
  switch (number) {
    case ENOENT:
    case ENOTDIR:
      if (std::error_code ec; std::filesystem::is_directory(folder, ec))
        return {fmt::format("cannot write {}: no file can be made in {}", path, folder)};
      return {fmt::format("cannot write {}: there is no folder {}", path, folder)};
    case EACCES:
    case EPERM:
    case EROFS:
      return {fmt::format("cannot write {}: no permission to write in {}", path, folder)};
    case EISDIR:
      return {fmt::format("cannot write {}: it is a folder", path)};
    case ENAMETOOLONG:
      return {fmt::format("cannot write {}: the name is too long", path)};
    case ENOSPC:
    case EDQUOT:
      return cannot_finish(fmt::format("cannot write {}: the disk is full", path));
    case EFBIG:
      return cannot_finish(fmt::format("cannot write {}: a file size limit is reached", path));
    default:
      return cannot_finish(fmt::format("cannot write {}: {}", path, std::strerror(number)));
  }
}

}  // namespace

Result<FileOutput> FileOutput::create(const std::filesystem::path& target) {
  FileOutput file;
  file.target_ = target;
  if (target.filename().empty() || target.filename() == "." || target.filename() == "..")
    return describe(target, EISDIR);

  if (auto fine = check_replaceable(target); !fine) return fine.error();
  const auto real = behind_links(target);
  struct stat old {};
  const bool exists = ::stat(real.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) return describe(target, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    file.descriptor_ = ::open(real.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    // A killed run may have left its hidden file behind, and process numbers come again: take the next name.
    do {
      file.hidden_ = hidden_name(real);
      file.descriptor_ = ::open(file.hidden_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file.descriptor_ < 0 && errno == EEXIST);
  }
  if (file.descriptor_ < 0) {
    file.hidden_.clear();
    return describe(target, errno);
  }
  if (exists && !file.hidden_.empty()) (void)::fchmod(file.descriptor_, old.st_mode & 07777);
  file.buffer_.reserve(kBufferBytes);
  return file;
}

FileOutput::FileOutput(FileOutput&& other) noexcept { *this = std::move(other); }

FileOutput& FileOutput::operator=(FileOutput&& other) noexcept {
  if (this == &other) return *this;
  discard();
  target_ = std::move(other.target_);
  hidden_ = std::exchange(other.hidden_, {});
  buffer_ = std::move(other.buffer_);
  bytes_ = other.bytes_;
  descriptor_ = std::exchange(other.descriptor_, -1);
  failure_ = other.failure_;
  return *this;
}

FileOutput::~FileOutput() { discard(); }

void FileOutput::discard() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!hidden_.empty()) ::unlink(hidden_.c_str());
  hidden_.clear();
}

void FileOutput::write(std::span<const std::byte> bytes) {
  if (failure_ || bytes.empty()) return;
  bytes_ += bytes.size();
  if (buffer_.size() + bytes.size() > kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes)
    write_through(bytes.data(), bytes.size());
  else
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void FileOutput::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void FileOutput::write_through(const std::byte* data, std::size_t n) {
  while (n > 0 && !failure_) {
    const ssize_t written = ::write(descriptor_, data, std::min(n, kBufferBytes));
    if (written < 0) {
      if (errno != EINTR) failure_ = errno;
    } else if (written == 0) {
      failure_ = ENOSPC;
    } else {
      data += written, n -= static_cast<std::size_t>(written);
    }
  }
}

Result<std::uint64_t> FileOutput::commit() {
  assert(descriptor_ >= 0);
  if (!failure_) flush();
  // A full disk may first be noticed here; pipes and terminals cannot be synced and say EINVAL.
  if (!failure_ && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) failure_ = errno;
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (!failure_ && closed != 0 && errno != EINTR) failure_ = errno;
  if (!failure_ && !hidden_.empty()) {
    if (::rename(hidden_.c_str(), behind_links(target_).c_str()) != 0)
      failure_ = errno;
    else
      hidden_.clear();
  }
  if (failure_) {
    discard();
    return describe(target_, failure_);
  }
  return bytes_;
}

Result<std::uint64_t> write_file(const std::filesystem::path& target, std::span<const std::byte> bytes) {
  auto file = FileOutput::create(target);
  if (!file) return file.error();
  file->write(bytes);
  return file->commit();
}

Result<std::uint64_t> write_file(const std::filesystem::path& target, std::string_view text) {
  return write_file(target, std::as_bytes(std::span(text.data(), text.size())));
}

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t limit) {
  const std::string name = path.string();
  struct Closer {
    int descriptor;
    ~Closer() {
      if (descriptor >= 0) ::close(descriptor);
    }
  };
  const Closer file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.descriptor < 0) {
    if (errno == ENOENT || errno == ENOTDIR) return Error{fmt::format("there is no file {}", name)};
    return Error{fmt::format("cannot read {}: {}", name, std::strerror(errno))};
  }
  struct stat facts {};
  if (::fstat(file.descriptor, &facts) != 0)
    return Error{fmt::format("cannot read {}: {}", name, std::strerror(errno))};
  if (S_ISDIR(facts.st_mode)) return Error{fmt::format("cannot read {}: it is a folder", name)};
  if (!S_ISREG(facts.st_mode)) return Error{fmt::format("cannot read {}: it is no regular file", name)};
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  if (size > limit) return Error{fmt::format("{} has {} bytes; at most {} are read", name, size, limit)};

  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::read(file.descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{fmt::format("cannot read {}: {}", name, std::strerror(errno))};
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace bosquet::exchange
