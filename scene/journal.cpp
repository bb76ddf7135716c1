#include "scene/journal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <optional>
#include <thread>

#include "scene/project_database.h"
#include "scene/project_lock.h"
#include "scene/project_store.h"

namespace bosquet::scene {
namespace {

namespace fs = std::filesystem;

// After a failure (a full disk) the same is tried again so often.
constexpr auto kPause = std::chrono::milliseconds(500);

struct Task {
  Document document;
  fs::path project;
  std::uint64_t edit = 0, saved = 0;
  std::int64_t time = 0;

  ProjectMeta meta() const {
    return {{"project", project.string()},
            {"edit", std::to_string(edit)},
            {"edits", std::to_string(edit > saved ? edit - saved : 0)},
            {"time", std::to_string(time)}};
  }
};

}  // namespace

struct Journal::State {
  fs::path file;
  std::optional<ProjectLock> lock;
  std::optional<Database> database;
  ProjectStore store;

  mutable std::mutex mutex;
  std::condition_variable changed;
  Task task;           ///< the newest
  bool fresh = true;   ///< not written yet
  bool ended = false;  ///< no more will come
  bool busy = false;
  std::uint64_t durable = 0;
  std::string problem;
  std::thread thread;

  void work() {
    std::unique_lock guard(mutex);
    for (;;) {
      changed.wait(guard, [&] { return fresh || ended; });
      if (!fresh) return;
      const Task now = task;
      fresh = false, busy = true;
      guard.unlock();
      const Result<void> done = store.write(*database, now.document, now.meta());
      guard.lock();
      busy = false;
      problem = done ? "" : done.error().message;
      if (done) {
        durable = now.edit;
      } else if (ended) {
        fresh = false;
      } else {
        changed.notify_all();  // who waits hears of the failure
        changed.wait_for(guard, kPause, [&] { return fresh || ended; });
        fresh = true;
      }
      changed.notify_all();
    }
  }
};

Result<std::unique_ptr<Journal>> Journal::start(Document document, const fs::path& project, const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (ec)
    return Error{
        fmt::format("{}: cannot be made ({}); edits are not kept for recovery", folder.string(), ec.message())};
  auto state = std::make_unique<State>();
  const std::string name = project.empty() ? "untitled" : project.stem().string();
  // Another session may be on the same project: a name that is free, and held before anything is in it.
  for (int n = 0; !state->lock; ++n) {
    state->file = folder / fmt::format("{}-{}{}.recovery", name, static_cast<long>(::getpid()),
                                       n == 0 ? "" : fmt::format("-{}", n));
    if (fs::exists(state->file, ec)) continue;
    ProjectLock::Refusal why{};
    state->lock = ProjectLock::take(state->file, &why);
    if (!state->lock && why == ProjectLock::Refusal::not_writable)
      return Error{fmt::format("{}: may not be written; edits are not kept for recovery", folder.string())};
  }
  auto database = Database::open(state->file, Database::Mode::create);
  if (!database) return database.error();
  if (auto set = database->run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"); !set) return set.error();
  if (auto made = ProjectStore::create_tables(*database); !made) return made.error();
  state->database = std::move(*database);
  state->task = {std::move(document), project.empty() ? fs::path() : fs::absolute(project, ec), 0, 0,
                 std::time(nullptr)};
  auto journal = std::unique_ptr<Journal>(new Journal(std::move(state)));
  return journal;
}

Journal::Journal(std::unique_ptr<State> state) : state_(std::move(state)) {
  state_->thread = std::thread([this] { state_->work(); });
}

Journal::~Journal() {
  {
    std::lock_guard guard(state_->mutex);
    state_->ended = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
  const bool unsaved = state_->task.edit > state_->task.saved;
  state_->database.reset();
  if (unsaved) return;
  std::error_code ec;
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(fs::path(state_->file.string() + suffix), ec);
}

void Journal::record(Document document, std::uint64_t edit) {
  {
    std::lock_guard guard(state_->mutex);
    state_->task.document = std::move(document);
    state_->task.edit = edit;
    state_->task.time = std::time(nullptr);
    state_->fresh = true;
  }
  state_->changed.notify_all();
}

void Journal::saved(const fs::path& project, std::uint64_t edit) {
  std::error_code ec;
  {
    std::lock_guard guard(state_->mutex);
    state_->task.project = fs::absolute(project, ec);
    state_->task.saved = edit;
    state_->fresh = true;
  }
  state_->changed.notify_all();
  discard_stale(project, state_->file.parent_path());
}

std::uint64_t Journal::durable() const {
  std::lock_guard guard(state_->mutex);
  return state_->durable;
}

void Journal::wait() {
  std::unique_lock guard(state_->mutex);
  state_->changed.wait(guard, [&] { return (!state_->fresh && !state_->busy) || !state_->problem.empty(); });
}

std::string Journal::problem() const {
  std::lock_guard guard(state_->mutex);
  return state_->problem;
}

const fs::path& Journal::file() const { return state_->file; }

}  // namespace bosquet::scene
