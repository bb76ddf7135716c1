// Recovery: documents that were being edited when a session ended without saving.
//
// Files     NAME.recovery in the user's state folder ($XDG_STATE_HOME/bosquet/recovery, else ~/.local/state/...), an
//           SQLite database as project files are, with what journal.h says of it in bosquet_meta
// Model     a file that a living session holds is in use; one without edits since the last save holds nothing new
// Errors    a damaged file gives what can be read, as a project does
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/project_file.h"

namespace bosquet::scene {

/// Where recovery files lie; `of_user` is made when missing.
std::filesystem::path recovery_folder();

struct Recovery {
  std::string name;  ///< by which `bosquet recover` knows it
  std::filesystem::path file;
  std::filesystem::path project;  ///< or recipe that was open; empty when it was never saved
  std::int64_t time = 0;          ///< of the last edit, seconds since 1970
  std::uint64_t edits = 0;        ///< since the last save
  bool in_use = false;            ///< by a session that is still there
};

/// Every file with edits that are not saved, the newest first. Files without any, of sessions that are gone, are removed.
std::vector<Recovery> list_recoveries(const std::filesystem::path& folder = recovery_folder());

struct Recovered {
  Document document;
  ProjectState state;
  std::uint64_t edit = 0;  ///< number of the last edit in it
};
Result<Recovered> recover(const Recovery& recovery);

/// Removes the file, unless a session holds it.
void discard(const Recovery& recovery);

/// Removes what earlier sessions left of this project: it is saved now, whatever was declined.
void discard_stale(const std::filesystem::path& project, const std::filesystem::path& folder = recovery_folder());

/// "2026-05-01 14:03", local time.
std::string time_words(std::int64_t seconds);

}  // namespace bosquet::scene
