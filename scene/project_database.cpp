#include "scene/project_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cassert>

namespace bosquet::scene {
namespace {

// Another program may be in the middle of a transaction.
constexpr int kPatience_ms = 2000;

Error error_of(int code, const char* words, const std::string& file) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return cannot_finish(fmt::format("{}: the disk is full", file));
    case SQLITE_IOERR:
      return cannot_finish(fmt::format("{}: reading or writing failed ({})", file, words));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return cannot_finish(fmt::format("{}: another program is using it", file));
    case SQLITE_NOMEM:
      return cannot_finish(fmt::format("{}: out of memory", file));
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return {fmt::format("{}: may not be read or written, or its folder may not", file)};
    case SQLITE_NOTADB:
      return {fmt::format("{}: is no project, or damaged from its first bytes on", file)};
    case SQLITE_CORRUPT:
      return {fmt::format("{}: is damaged", file)};
    default:
      return {fmt::format("{}: {}", file, words)};
  }
}

}  // namespace

Statement::Statement(Statement&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), file_(std::move(other.file_)), failure_(other.failure_) {}

Statement& Statement::operator=(Statement&& other) noexcept {
  std::swap(handle_, other.handle_), std::swap(file_, other.file_), std::swap(failure_, other.failure_);
  return *this;
}

Statement::~Statement() { sqlite3_finalize(handle_); }

void Statement::note(int code) {
  if (code != SQLITE_OK && failure_ == 0) failure_ = code;
}

Statement& Statement::bind(int place, std::int64_t value) {
  note(sqlite3_bind_int64(handle_, place + 1, value));
  return *this;
}

Statement& Statement::bind(int place, double value) {
  note(sqlite3_bind_double(handle_, place + 1, value));
  return *this;
}

Statement& Statement::bind(int place, std::string_view text) {
  // A null pointer would mean NULL.
  note(sqlite3_bind_text64(handle_, place + 1, text.empty() ? "" : text.data(), text.size(), SQLITE_TRANSIENT,
                           SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int place, std::span<const std::byte> bytes) {
  note(bytes.empty() ? sqlite3_bind_zeroblob(handle_, place + 1, 0)
                     : sqlite3_bind_blob64(handle_, place + 1, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null(int place) {
  note(sqlite3_bind_null(handle_, place + 1));
  return *this;
}

bool Statement::step() {
  if (failure_) return false;
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) note(code);
  return false;
}

Result<void> Statement::run() {
  while (step()) {
  }
  if (failed()) {
    Error wrong = error();
    reset();
    return wrong;
  }
  reset();
  return {};
}

void Statement::reset() {
  sqlite3_reset(handle_);
  failure_ = 0;
}

bool Statement::is_null(int c) const { return sqlite3_column_type(handle_, c) == SQLITE_NULL; }
bool Statement::is_integer(int c) const { return sqlite3_column_type(handle_, c) == SQLITE_INTEGER; }
bool Statement::is_number(int c) const { return is_integer(c) || sqlite3_column_type(handle_, c) == SQLITE_FLOAT; }
bool Statement::is_text(int c) const { return sqlite3_column_type(handle_, c) == SQLITE_TEXT; }
bool Statement::is_blob(int c) const { return sqlite3_column_type(handle_, c) == SQLITE_BLOB; }
std::int64_t Statement::integer(int c) const { return sqlite3_column_int64(handle_, c); }
double Statement::number(int c) const { return sqlite3_column_double(handle_, c); }

std::string_view Statement::text(int c) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(handle_, c));
  return data ? std::string_view(data, static_cast<std::size_t>(sqlite3_column_bytes(handle_, c))) : std::string_view();
}

std::span<const std::byte> Statement::bytes(int c) const {
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(handle_, c));
  if (!data) return {};
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(handle_, c))};
}

Error Statement::error() const { return error_of(failure_, sqlite3_errmsg(sqlite3_db_handle(handle_)), file_); }

Result<Database> Database::open(const std::filesystem::path& path, Mode mode, bool damaged) {
  const int flags = mode == Mode::read_only    ? SQLITE_OPEN_READONLY
                    : mode == Mode::read_write ? SQLITE_OPEN_READWRITE
                                               : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* handle = nullptr;
  // The path as it stands, never as an URI.
  int code = sqlite3_open_v2(path.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  Database opened(handle, path.string());
  if (code != SQLITE_OK) return error_of(code, handle ? sqlite3_errmsg(handle) : "out of memory", path.string());
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kPatience_ms);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  if (auto set = opened.run(damaged ? "PRAGMA writable_schema = ON" : "PRAGMA cell_size_check = ON"); !set)
    return set.error();
  return opened;
}

Result<Database> Database::in_memory() { return open(":memory:", Mode::create); }

Result<Database> Database::copy_in_memory(const Database& from) {
  auto copy = in_memory();
  if (!copy) return copy;
  copy->file_ = from.file_;
  sqlite3_backup* backup = sqlite3_backup_init(copy->handle_, "main", from.handle_, "main");
  if (!backup) return copy->error();
  const int code = sqlite3_backup_step(backup, -1);
  sqlite3_backup_finish(backup);
  if (code != SQLITE_DONE) return error_of(code, sqlite3_errstr(code), from.file_);
  return copy;
}

Database::Database(Database&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), file_(std::move(other.file_)) {}

Database& Database::operator=(Database&& other) noexcept {
  std::swap(handle_, other.handle_), std::swap(file_, other.file_);
  return *this;
}

Database::~Database() { sqlite3_close_v2(handle_); }

Error Database::error() const { return error_of(sqlite3_extended_errcode(handle_), sqlite3_errmsg(handle_), file_); }

Result<void> Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) return error();
  return {};
}

Result<Statement> Database::prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr) != SQLITE_OK)
    return error();
  return Statement(statement, file_);
}

std::optional<std::int64_t> Database::integer(std::string_view sql) {
  auto statement = prepare(sql);
  if (!statement || !statement->step() || !statement->is_integer(0)) return {};
  return statement->integer(0);
}

std::optional<std::string> Database::text(std::string_view sql) {
  auto statement = prepare(sql);
  if (!statement || !statement->step() || !statement->is_text(0)) return {};
  return std::string(statement->text(0));
}

bool Database::writable() const { return sqlite3_db_readonly(handle_, "main") == 0; }
bool Database::idle() const { return sqlite3_get_autocommit(handle_) != 0; }

std::vector<std::string> Database::damage(int most) {
  std::vector<std::string> found;
  auto statement = prepare(fmt::format("PRAGMA integrity_check({})", most));
  if (!statement) return {statement.error().message};
  while (statement->step())
    if (statement->text(0) != "ok") found.emplace_back(statement->text(0));
  if (statement->failed()) found.push_back(statement->error().message);
  return found;
}

bool Database::has_table(std::string_view name) { return !columns(name).empty(); }

std::vector<std::string> Database::columns(std::string_view table) {
  std::vector<std::string> names;
  auto statement = prepare("SELECT name FROM pragma_table_info(?1)");
  if (!statement) return names;
  statement->bind(0, table);
  while (statement->step()) names.emplace_back(statement->text(0));
  return names;
}

}  // namespace bosquet::scene
