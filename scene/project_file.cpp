#include "scene/project_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "core/write_protection.h"
#include "scene/project_lock.h"
#include "scene/project_store.h"

namespace bosquet::scene {
namespace {

namespace fs = std::filesystem;

// Ending of the name that a file has until it is whole.
constexpr std::string_view kForerunner = ".part";
// What a project says of the file that it was made from, until it is edited.
constexpr const char* kMadeFrom = "made_from";

// Which file a path names now.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;
  bool operator==(const FileIdentity&) const = default;
};

std::optional<FileIdentity> identity(const fs::path& path) {
  struct stat there {};
  if (::stat(path.c_str(), &there) != 0) return {};
  return FileIdentity{there.st_dev, there.st_ino};
}

fs::path beside(const fs::path& file, const std::string& suffix) { return fs::path(file.string() + suffix); }

// A link stays a link: the file it points to is meant.
fs::path resolved(const fs::path& path) {
  std::error_code ec;
  const fs::path target = fs::is_symlink(path, ec) ? fs::canonical(path, ec) : fs::absolute(path, ec);
  return ec ? path : target;
}

Result<void> sync_folder(const fs::path& file) {
  const int folder = ::open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return {};  // a folder that may be written but not read
  ::fsync(folder);
  ::close(folder);
  return {};
}

// What an earlier crash left to be undone in a file must be undone before another takes its name: SQLite would put it
// into the new one.
void settle_journal(const fs::path& path) {
  std::error_code ec;
  if (!fs::exists(beside(path, "-journal"), ec) && !fs::exists(beside(path, "-wal"), ec)) return;
  if (auto old = Database::open(path, Database::Mode::read_write))
    (void)old->integer("SELECT count(*) FROM sqlite_schema");
}

// Unfinished files that crashes left beside a project. Whoever holds its lock may call them that.
void remove_forerunners(const fs::path& path) {
  const std::string begin = "." + path.filename().string() + "-";
  std::error_code ec;
  for (fs::directory_iterator at(path.parent_path(), ec), end; !ec && at != end; at.increment(ec)) {
    const std::string name = at->path().filename().string();
    if (name.size() == begin.size() + 6 + kForerunner.size() && name.starts_with(begin) &&
        name.ends_with(kForerunner)) {
      std::error_code gone;
      fs::remove(at->path(), gone);
    }
  }
}

// A new file at `path`, whole or not at all; `store` knows then what is in it.
Result<void> write_new(const fs::path& path, const Document& document, const std::string& made_from,
                       ProjectStore& store) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) return Error{fmt::format("{}: is a folder, not a file", path.string())};
  if (auto fine = check_replaceable(path); !fine) return fine;
  remove_forerunners(path);
  std::string hidden = (path.parent_path() / ("." + path.filename().string() + "-XXXXXX")).string();
  hidden += kForerunner;
  const int descriptor = ::mkstemps(hidden.data(), static_cast<int>(kForerunner.size()));
  if (descriptor < 0)
    return Error{fmt::format("{}: cannot be written; its folder is missing or may not be written", path.string())};
  ::fchmod(descriptor, 0644);
  ::close(descriptor);
  store.forget();
  Result<void> done = [&]() -> Result<void> {
    auto database = Database::open(hidden, Database::Mode::read_write);
    if (!database) return database.error();
    // Nothing to roll back to: without its commit the file goes.
    if (auto set = database->run("PRAGMA journal_mode = OFF; PRAGMA synchronous = FULL"); !set) return set;
    if (auto made = ProjectStore::create_tables(*database); !made) return made;
    return store.write(*database, document, made_from.empty() ? ProjectMeta() : ProjectMeta{{kMadeFrom, made_from}});
  }();
  if (done) {
    settle_journal(path);
    for (const char* suffix : {"-journal", "-wal", "-shm"}) fs::remove(beside(path, suffix), ec);
    fs::rename(hidden, path, ec);
    if (ec) done = cannot_finish(fmt::format("{}: cannot be replaced ({})", path.string(), ec.message()));
  }
  if (!done) {
    fs::remove(hidden, ec);
    store.forget();
    // People know the file by its name, not by that of its forerunner.
    Error wrong = done.error();
    if (const auto at = wrong.message.find(hidden); at != std::string::npos)
      wrong.message.replace(at, hidden.size(), path.string());
    return wrong;
  }
  return sync_folder(path);
}

Result<Database> open_as_it_is(const fs::path& path, bool& whole) {
  auto database = Database::open(path, Database::Mode::read_write);
  whole = database && database->integer("SELECT count(*) FROM sqlite_schema").has_value();
  if (whole) return database;
  // A file shorter than it says opens only when asked to overlook that.
  auto damaged = Database::open(path, Database::Mode::read_write, true);
  if (!damaged) return damaged;
  if (!damaged->integer("SELECT count(*) FROM sqlite_schema"))
    return Error{fmt::format("{}: is no project, or damaged from its first bytes on", path.string())};
  return damaged;
}

// Brings a copy to this version's format.
Result<void> migrate(Database& copy, int from, std::span<const Migration> steps) {
  for (int format = from; format < kProjectFormat; ++format) {
    bool found = false;
    for (const Migration& step : steps) {
      if (step.from != format) continue;
      found = true;
      if (auto done = copy.run(step.sql); !done)
        return Error{fmt::format("{}: cannot be brought from format {} to {} ({})", copy.file(), format, format + 1,
                                 done.error().message)};
    }
    if (!found)
      return Error{fmt::format("{}: has format {}; this version reads formats from {} to {}", copy.file(), from,
                               steps.empty() ? kProjectFormat : steps.front().from, kProjectFormat)};
  }
  return copy.run(fmt::format("UPDATE bosquet_meta SET value = '{}' WHERE name = 'format'", kProjectFormat));
}

}  // namespace

std::span<const Migration> migrations() { return {}; }

std::vector<std::string> lines(const ProjectState& state) {
  std::vector<std::string> out;
  if (state.damaged) {
    out.push_back(state.missing.empty() ? "the file is damaged, but everything could be read"
                                        : "the file is damaged; missing or not as saved:");
    for (const std::string& part : state.missing) out.push_back("  " + part);
  }
  if (state.edited_elsewhere) out.push_back("its trees were edited by another program since it was saved");
  for (const std::string& note : state.notes) out.push_back("  " + note);
  if (state.migrated_from)
    out.push_back(
        fmt::format("it has the older format {}; saving writes format {}", *state.migrated_from, kProjectFormat));
  if (!state.read_only.empty()) out.push_back("read-only: " + state.read_only);
  return out;
}

struct ProjectFile::Open {
  fs::path path;
  std::optional<ProjectLock> lock;
  std::optional<Database> database;  ///< missing: the next save writes a new file
  ProjectStore store;
  Document document;
  ProjectState state;
  std::string made_from;
  std::optional<FileIdentity> file;
  std::int64_t version = 0;  ///< changes when another connection commits
  bool save_failed = false;  ///< another connection may have undone what was left of it

  void remember() {
    file = identity(path);
    version = database ? database->integer("PRAGMA data_version").value_or(0) : 0;
  }

  // After a new file took the name: the same contents, by a connection of its own.
  Result<void> connect() {
    auto opened = Database::open(path, Database::Mode::read_write);
    if (!opened) return opened.error();
    if (auto set = opened->run("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL"); !set) return set;
    database = std::move(*opened);
    remember();
    return {};
  }
};

ProjectFile::ProjectFile(std::unique_ptr<Open> open) : open_(std::move(open)) {}
ProjectFile::ProjectFile(ProjectFile&&) noexcept = default;
ProjectFile& ProjectFile::operator=(ProjectFile&&) noexcept = default;
ProjectFile::~ProjectFile() = default;

const fs::path& ProjectFile::path() const { return open_->path; }
const Document& ProjectFile::document() const { return open_->document; }
const ProjectState& ProjectFile::state() const { return open_->state; }
const std::string& ProjectFile::made_from() const { return open_->made_from; }

Result<ProjectFile> ProjectFile::open(const fs::path& path, const ProjectOptions& options) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) return Error{fmt::format("{}: is a folder, not a project", path.string())};
  if (!fs::is_regular_file(path, ec)) return Error{fmt::format("{}: there is no such project", path.string())};
  if (::access(path.c_str(), R_OK) != 0) return Error{fmt::format("{}: may not be read", path.string())};
  if (fs::file_size(path, ec) == 0) return Error{fmt::format("{}: is empty", path.string())};

  auto open = std::make_unique<Open>();
  open->path = resolved(path);
  ProjectState& state = open->state;
  if (options.to_write) {
    ProjectLock::Refusal why{};
    open->lock = ProjectLock::take(open->path, &why);
    if (!open->lock)
      state.read_only =
          why == ProjectLock::Refusal::held ? "another window has it open" : "its folder may not be written";
    else if (::access(open->path.c_str(), W_OK) != 0)
      state.read_only = "the file may not be written";
  } else {
    state.read_only = "it is only looked at";
  }

  bool whole = true;
  auto database = open_as_it_is(open->path, whole);
  if (!database) return database.error();
  if (!database->has_table("bosquet_meta"))
    return Error{fmt::format("{}: is a database, but no bosquet project", path.string())};
  const std::vector<std::string> damage = database->damage();
  state.damaged = !whole || !damage.empty();

  int format = kProjectFormat;
  if (const auto text = database->text("SELECT value FROM bosquet_meta WHERE name = 'format'"))
    std::from_chars(text->data(), text->data() + text->size(), format);
  else
    state.damaged = true, state.missing.push_back("the format's number");
  if (format > kProjectFormat)
    return Error{fmt::format("{}: has format {}, made by a newer version; this one reads formats up to {}",
                             path.string(), format, kProjectFormat)};
  if (format < kProjectFormat) {
    auto copy = Database::copy_in_memory(*database);
    if (!copy) return copy.error();
    if (auto done = migrate(*copy, format, options.migrations); !done) return done.error();
    state.migrated_from = format;
    database = std::move(copy);
  }

  auto stored = open->store.read(*database);
  if (!stored) return stored.error();
  open->document = std::move(stored->document);
  if (!stored->trees_edited) open->made_from = stored->meta[kMadeFrom];
  for (std::string& problem : stored->problems) state.missing.push_back(std::move(problem));
  state.damaged = state.damaged || !state.missing.empty();
  state.edited_elsewhere = stored->trees_edited && !state.damaged;
  if (stored->trees_edited && state.damaged) state.missing.push_back("trees: not what was saved");
  state.notes = std::move(stored->notes);
  if (state.damaged && state.read_only.empty()) state.read_only = "it is damaged; save it under another name";

  // Spatial indexes of other programs would not follow our changes.
  const bool indexed = database->has_table("rtree_trees_geom");
  if (state.read_only.empty() && !state.edited_elsewhere && !state.migrated_from && !indexed) {
    if (auto set = database->run("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL"); !set) return set.error();
    open->database = std::move(*database);
  } else {
    open->store.forget();
  }
  open->remember();
  return ProjectFile(std::move(open));
}

Result<ProjectFile> ProjectFile::create(const fs::path& path, const Document& document, const std::string& made_from) {
  ProjectFile file(std::make_unique<Open>());
  if (auto done = file.write_as(document, path, made_from); !done) return done.error();
  return file;
}

bool ProjectFile::changed_meanwhile() const {
  if (open_->file != identity(open_->path)) return true;
  return open_->database && open_->database->integer("PRAGMA data_version").value_or(open_->version) != open_->version;
}

Result<void> ProjectFile::save(const Document& document, bool over_edits) {
  if (!open_->state.read_only.empty())
    return Error{fmt::format("{}: cannot be saved: {}", open_->path.string(), open_->state.read_only)};
  const bool gone = !identity(open_->path);
  bool changed = !gone && changed_meanwhile();
  if (changed && open_->save_failed && open_->file == identity(open_->path) && open_->database &&
      open_->store.holds_what_is_known(*open_->database)) {
    open_->remember();
    changed = false;
  }
  if ((open_->state.edited_elsewhere || changed) && !over_edits)
    return Error{
        fmt::format("{}: was changed by another program; save over it, or under another name", open_->path.string())};
  if (!open_->database || gone || changed) return save_as(document, open_->path);
  // What is saved from now on is nobody's product.
  const ProjectMeta meta = open_->made_from.empty() ? ProjectMeta() : ProjectMeta{{kMadeFrom, ""}};
  auto done = open_->store.write(*open_->database, document, meta);
  if (done) open_->made_from.clear();
  open_->save_failed = !done;
  if (done) open_->document = document;
  return done;
}

Result<void> ProjectFile::save_as(const Document& document, const fs::path& path) {
  return write_as(document, path, {});
}

Result<void> ProjectFile::write_as(const Document& document, const fs::path& path, const std::string& made_from) {
  const fs::path target = resolved(path);
  const bool same = open_->lock && target == open_->path;
  std::optional<ProjectLock> lock;
  if (!same) {
    ProjectLock::Refusal why{};
    lock = ProjectLock::take(target, &why);
    if (!lock)
      return Error{
          why == ProjectLock::Refusal::held
              ? fmt::format("{}: another window has it open", target.string())
              : fmt::format("{}: cannot be written; its folder is missing or may not be written", target.string())};
  }
  ProjectStore store;
  if (auto done = write_new(target, document, made_from, store); !done) return done;
  if (!same) open_->lock = std::move(lock);
  open_->database.reset();
  open_->path = target;
  open_->store = std::move(store);
  open_->document = document;
  open_->state = {};
  open_->made_from = made_from;
  return open_->connect();
}

Result<ReadProject> read_project(const fs::path& path) {
  ProjectOptions options;
  options.to_write = false;
  auto file = ProjectFile::open(path, options);
  if (!file) return file.error();
  ReadProject read{file->document(), file->state(), file->made_from()};
  read.state.read_only.clear();
  return read;
}

Result<std::uint64_t> write_project(const Document& document, const fs::path& path, const std::string& made_from) {
  auto file = ProjectFile::create(path, document, made_from);
  if (!file) return file.error();
  std::error_code ec;
  return fs::file_size(file->path(), ec);
}

}  // namespace bosquet::scene
