// Journal: every edit of a session on the disk within a second, so that a crash or a power cut loses none.
//
// Model     the editing thread hands over each document (record), which costs it a copy of pointers; a thread of the
//           journal's own writes the newest one, as far as it differs from the last it wrote, into a database in the
//           user's state folder (recovery.h), and so on. Edits that come while it writes are written together
// Decision  journal mode WAL with synchronous FULL: a commit costs one sync and survives a power cut (with NORMAL one may
//           lose everything since the last checkpoint)
// Decision  the document that the session began with is written at once, before any edit, so that the first edit is as
//           quick as the others
// Meta      project: file that is open, or nothing; time: of the last edit; edits: number since the last save; edit: the
//           number that its recorder gave the last one
// Errors    what cannot be written (disk full) is kept in problem() until a later write succeeds; editing goes on
// Threads   all functions from any thread
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/result.h"
#include "scene/document.h"
#include "scene/recovery.h"

namespace bosquet::scene {

class Journal {
 public:
  /// A recovery file of its own for this session. `project`, or the recipe that was opened, is empty for a document that was
  /// never saved.
  static Result<std::unique_ptr<Journal>> start(Document document, const std::filesystem::path& project,
                                                const std::filesystem::path& folder = recovery_folder());
  /// Waits for what was recorded; removes the file when nothing in it is unsaved.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The document after edit number `edit` (rising; undo and redo are edits too). Returns at once.
  void record(Document document, std::uint64_t edit);
  /// The document is saved as `project` with edit number `edit` as its last: nothing up to there needs to be recovered,
  /// and what earlier sessions left of this project goes.
  void saved(const std::filesystem::path& project, std::uint64_t edit);

  /// Number of the last edit that is on the disk.
  std::uint64_t durable() const;
  /// Waits until everything recorded is on the disk, or could not be written.
  void wait();
  /// Why the last write failed; empty when it did not.
  std::string problem() const;
  const std::filesystem::path& file() const;

 private:
  struct State;
  explicit Journal(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace bosquet::scene
