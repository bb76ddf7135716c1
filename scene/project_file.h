// Project file: NAME.bosquet, a document on the disk.
//
// Format    project_store.h; an SQLite database that is a GeoPackage too, so that other programs show and edit its trees
// Model     save() is one transaction that writes only what changed since the last save or opening. save_as(), and a
//           save over something else than what was opened, write a new file beside the target, sync it and rename it
// Decision  journal_mode DELETE and synchronous FULL: a copied file is whole without others beside it, and what was saved
//           survives a power cut
// Opening   an older format is migrated in a copy in memory, and written as the new one at the next save; a newer one is
//           refused. A damaged file opens read-only with all that can be read, and lists what is missing. When the trees
//           are whole but not those that were saved, another program edited them: ask before saving over it. A file that
//           another window holds opens read-only
// Errors    a save that fails (disk full, no permission, another program) leaves the file as it was, and may be tried again
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::scene {

/// Statements that make format `from` + 1 of format `from`.
struct Migration {
  int from = 0;
  const char* sql = "";
};
/// Those that this version knows, in order. Format 1 is the first.
std::span<const Migration> migrations();

/// What opening found; all false and empty for a file as it was saved.
struct ProjectState {
  std::string read_only;             ///< why it cannot be saved under its name; empty when it can
  bool damaged = false;              ///< `missing` could not be read
  std::vector<std::string> missing;  ///< "obstacle 'shed'", "trees: 3 of 10000"
  bool edited_elsewhere = false;     ///< another program changed its trees since it was saved here
  std::vector<std::string> notes;    ///< what of that edit could not be understood
  std::optional<int> migrated_from;  ///< the older format that the file on the disk still has
};

/// The state in words for people, a line each.
std::vector<std::string> lines(const ProjectState& state);

struct ProjectOptions {
  bool to_write = true;  ///< false: only looked at, and not held against other windows
  std::span<const Migration> migrations = scene::migrations();
};

class ProjectFile {
 public:
  static Result<ProjectFile> open(const std::filesystem::path& path, const ProjectOptions& options = {});
  /// Writes a new file, or replaces one, and holds it.
  static Result<ProjectFile> create(const std::filesystem::path& path, const Document& document,
                                    const std::string& made_from = {});

  ProjectFile(ProjectFile&&) noexcept;
  ProjectFile& operator=(ProjectFile&&) noexcept;
  ~ProjectFile();

  const std::filesystem::path& path() const;
  /// The document as it was opened or last saved.
  const Document& document() const;
  const ProjectState& state() const;
  /// What write_project() was told that it was made from; empty once it was saved or edited since.
  const std::string& made_from() const;
  /// Whether another program has changed or replaced the file since it was opened or last saved.
  bool changed_meanwhile() const;

  /// Refuses when the file was edited elsewhere or changed meanwhile, unless `over_edits` says that it may be lost.
  Result<void> save(const Document& document, bool over_edits = false);
  /// This file, and the lock with it, is the other one from then on; after an error it stays what it was.
  Result<void> save_as(const Document& document, const std::filesystem::path& path);

 private:
  struct Open;
  explicit ProjectFile(std::unique_ptr<Open> open);
  Result<void> write_as(const Document& document, const std::filesystem::path& path, const std::string& made_from);
  std::unique_ptr<Open> open_;
};

/// A project that is only read, as commands do.
struct ReadProject {
  Document document;
  ProjectState state;
  std::string made_from;  ///< as ProjectFile says
};
Result<ReadProject> read_project(const std::filesystem::path& path);

/// A project of its own, written whole; returns its bytes. `made_from` names, for whoever makes it anew, what it is
/// a product of as long as nobody edits it.
Result<std::uint64_t> write_project(const Document& document, const std::filesystem::path& path,
                                    const std::string& made_from = {});

}  // namespace bosquet::scene
