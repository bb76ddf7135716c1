// Failing VFS: SQLite's way to the disk, with a fault after so many operations.
//
// Model     a shim over the usual VFS, made the default one while it lives. Writes, syncs, truncations, opens and deletions
//           are counted; from number `fail_at` on they fail, once or for good
#pragma once

namespace bosquet::scene {

class FailingVfs {
 public:
  enum class Fault { disk_full, io_error };

  FailingVfs();
  ~FailingVfs();
  FailingVfs(const FailingVfs&) = delete;
  FailingVfs& operator=(const FailingVfs&) = delete;

  /// The operation with this number from now on (1 is the next) fails, and all after it when `for_good`.
  void fail_at(int operation, Fault fault, bool for_good);
  void heal();
  int operations() const;  ///< since the last fail_at or heal
  bool failed() const;     ///< a fault was met
};

}  // namespace bosquet::scene
