#include "scene/project_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace bosquet::scene {

std::optional<ProjectLock> ProjectLock::take(const std::filesystem::path& file, Refusal* why) {
  const std::filesystem::path hidden =
      file.parent_path() / (std::string(".").append(file.filename().string()) + ".lock");
  for (;;) {
    const int descriptor = ::open(hidden.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) {
      if (why) *why = Refusal::not_writable;
      return {};
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      if (why) *why = errno == EWOULDBLOCK ? Refusal::held : Refusal::not_writable;
      ::close(descriptor);
      return {};
    }
    // The last holder may have removed the file after it was opened here; then the lock is on nothing.
    struct stat ours {
    }, there{};
    if (::fstat(descriptor, &ours) == 0 && ::stat(hidden.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
        ours.st_dev == there.st_dev)
      return ProjectLock(hidden, descriptor);
    ::close(descriptor);
  }
}

ProjectLock::ProjectLock(ProjectLock&& other) noexcept
    : hidden_(std::move(other.hidden_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ProjectLock& ProjectLock::operator=(ProjectLock&& other) noexcept {
  std::swap(hidden_, other.hidden_), std::swap(descriptor_, other.descriptor_);
  return *this;
}

ProjectLock::~ProjectLock() {
  if (descriptor_ < 0) return;
  ::unlink(hidden_.c_str());
  ::close(descriptor_);
}

}  // namespace bosquet::scene
