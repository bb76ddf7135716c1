// Project lock: who may write a project file.
//
// Model     flock on a hidden file beside it (".NAME.lock"), so the system frees it with the process, however that ends.
//           SQLite's own locks would shut readers out too
// Holds     the hidden file goes when its holder lets go
#pragma once

#include <filesystem>
#include <optional>

namespace bosquet::scene {

class ProjectLock {
 public:
  enum class Refusal { held, not_writable };

  /// Nothing when another holder (of this process too) has it, or when the folder may not be written; `why` says which.
  static std::optional<ProjectLock> take(const std::filesystem::path& file, Refusal* why = nullptr);

  ProjectLock(ProjectLock&& other) noexcept;
  ProjectLock& operator=(ProjectLock&& other) noexcept;
  ~ProjectLock();

 private:
  ProjectLock(std::filesystem::path hidden, int descriptor) : hidden_(std::move(hidden)), descriptor_(descriptor) {}
  std::filesystem::path hidden_;
  int descriptor_ = -1;
};

}  // namespace bosquet::scene
