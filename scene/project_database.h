// Project database: SQLite as projects and recovery files use it, with every result checked.
//
// Model     one connection, used by one thread at a time. A statement is prepared once and run often; values are bound
//           and read by position, from 0 on.
// Errors    a full disk, a failing device or a database in use: kind cannot_finish. A file that is none, is damaged or
//           may not be written: kind input. Messages name the file; failed() of a statement tells that a scan ended
//           early, with the rows before it read
// Decision  schemas of files are not trusted (no functions of theirs run), and cells are checked when pages are read
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace bosquet::scene {

class Statement {
 public:
  Statement(Statement&&) noexcept;
  Statement& operator=(Statement&&) noexcept;
  ~Statement();

  Statement& bind(int place, std::int64_t value);
  Statement& bind(int place, double value);
  Statement& bind(int place, std::string_view text);
  Statement& bind(int place, std::span<const std::byte> bytes);
  Statement& bind_null(int place);

  /// Goes to the next row; false at the end, or when the scan failed.
  bool step();
  bool failed() const { return failure_ != 0; }
  /// Runs a statement without rows and makes it ready to be bound again.
  Result<void> run();
  /// Makes it ready to be bound and stepped again.
  void reset();

  bool is_null(int column) const;
  bool is_integer(int column) const;
  bool is_number(int column) const;
  bool is_text(int column) const;
  bool is_blob(int column) const;
  std::int64_t integer(int column) const;
  double number(int column) const;
  std::string_view text(int column) const;             ///< valid until the next step
  std::span<const std::byte> bytes(int column) const;  ///< valid until the next step

  Error error() const;

 private:
  friend class Database;
  Statement(sqlite3_stmt* handle, std::string file) : handle_(handle), file_(std::move(file)) {}
  void note(int code);

  sqlite3_stmt* handle_ = nullptr;
  std::string file_;
  int failure_ = 0;
};

class Database {
 public:
  enum class Mode {
    read_only,   ///< nothing is written, not even what a crash left to be undone
    read_write,  ///< as far as the system allows, else to be read only: see writable()
    create,      ///< made when missing
  };

  /// `damaged` opens files whose size is not what they say.
  static Result<Database> open(const std::filesystem::path& path, Mode mode, bool damaged = false);
  /// A copy of `from` in memory.
  static Result<Database> copy_in_memory(const Database& from);
  static Result<Database> in_memory();

  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database();

  /// Statements without values or rows, separated by semicolons.
  Result<void> run(const std::string& sql);
  Result<Statement> prepare(std::string_view sql);
  /// The first column of the first row of a query as a number or a text; nothing when there is none or it fails.
  std::optional<std::int64_t> integer(std::string_view sql);
  std::optional<std::string> text(std::string_view sql);

  bool writable() const;
  /// False inside run("BEGIN").
  bool idle() const;
  /// What integrity_check finds, at most `most` lines; empty when all is well.
  std::vector<std::string> damage(int most = 20);
  bool has_table(std::string_view name);
  std::vector<std::string> columns(std::string_view table);
  const std::string& file() const { return file_; }

 private:
  Database(sqlite3* handle, std::string file) : handle_(handle), file_(std::move(file)) {}
  Error error() const;

  sqlite3* handle_ = nullptr;
  std::string file_;
};

}  // namespace bosquet::scene
