#include "scene/recovery.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>

#include "scene/project_database.h"
#include "scene/project_lock.h"
#include "scene/project_store.h"

namespace bosquet::scene {
namespace {

namespace fs = std::filesystem;

template <class Number>
Number number_of(const std::string& text) {
  Number n = 0;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

void remove_files(const fs::path& file) {
  std::error_code ec;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) fs::remove(fs::path(file.string() + suffix), ec);
}

// What a file says of itself; no name when it says nothing.
Recovery describe_file(const fs::path& file) {
  Recovery found;
  found.file = file;
  auto database = Database::open(file, Database::Mode::read_write);
  if (!database) return found;
  const auto value = [&](const char* name) {
    return database->text(fmt::format("SELECT value FROM bosquet_meta WHERE name = '{}'", name)).value_or("");
  };
  if (!database->has_table("bosquet_meta")) return found;
  found.name = file.stem().string();
  found.project = value("project");
  found.time = number_of<std::int64_t>(value("time"));
  found.edits = number_of<std::uint64_t>(value("edits"));
  return found;
}

}  // namespace

fs::path recovery_folder() {
  fs::path state;
  if (const char* told = std::getenv("XDG_STATE_HOME"); told && *told) {
    state = told;
  } else if (const char* home = std::getenv("HOME"); home && *home) {
    state = fs::path(home) / ".local" / "state";
  } else {
    const passwd* user = ::getpwuid(::getuid());
    state = fs::path(user && user->pw_dir ? user->pw_dir : "/tmp") / ".local" / "state";
  }
  return state / "bosquet" / "recovery";
}

std::vector<Recovery> list_recoveries(const fs::path& folder) {
  std::vector<Recovery> all;
  std::error_code ec;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ec)) {
    if (entry.path().extension() != ".recovery") continue;
    // Held while it is looked at, so that two programs do not clean up at once.
    const auto lock = ProjectLock::take(entry.path());
    if (!lock) {
      // SQLite lets others read what a session writes.
      Recovery live = describe_file(entry.path());
      live.in_use = true;
      if (!live.name.empty()) all.push_back(std::move(live));
      continue;
    }
    Recovery found = describe_file(entry.path());
    if (found.name.empty() || found.edits == 0)
      remove_files(entry.path());
    else
      all.push_back(std::move(found));
  }
  std::sort(all.begin(), all.end(),
            [](const Recovery& a, const Recovery& b) { return a.time != b.time ? a.time > b.time : a.name < b.name; });
  return all;
}

Result<Recovered> recover(const Recovery& recovery) {
  ProjectOptions options;
  options.to_write = false;
  auto file = ProjectFile::open(recovery.file, options);
  if (!file) return file.error();
  Recovered out{file->document(), file->state(), 0};
  out.state.read_only.clear();
  auto database = Database::open(recovery.file, Database::Mode::read_write);
  if (!database) return database.error();
  out.edit =
      number_of<std::uint64_t>(database->text("SELECT value FROM bosquet_meta WHERE name = 'edit'").value_or(""));
  return out;
}

void discard(const Recovery& recovery) {
  if (const auto lock = ProjectLock::take(recovery.file)) remove_files(recovery.file);
}

void discard_stale(const fs::path& project, const fs::path& folder) {
  std::error_code ec;
  const fs::path saved = fs::absolute(project, ec);
  for (const Recovery& old : list_recoveries(folder))
    if (!old.in_use && old.project == saved) discard(old);
}

std::string time_words(std::int64_t seconds) {
  const std::time_t time = static_cast<std::time_t>(seconds);
  std::tm local{};
  char text[32];
  if (!::localtime_r(&time, &local) || !std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local)) return "?";
  return text;
}

}  // namespace bosquet::scene
