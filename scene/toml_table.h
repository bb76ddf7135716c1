// TOML tables read into described parameters, with every mistake told by file, line and key.
//
// A TomlTable is a visitor (core/parameter.h): `describe(parameters, table)` reads every field that the file gives and
// leaves the others at their defaults; hand-made formats ask for keys one by one. finish() then refuses keys that
// nobody asked for, with the nearest known name.
//
// Errors    the first mistake found is kept by the TomlFile; readers go on, so callers check once at the end
// Frame     none; numbers are kept in the unit of the file
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/result.h"

namespace bosquet::scene {

class TomlFile;

class TomlTable {
 public:
  // Described fields.
  void operator()(const Real& info, float& value);
  void operator()(const Real& info, double& value);
  void operator()(const Whole& info, int& value);
  void operator()(const Switch& info, bool& value);
  void operator()(const Colour& info, Vec3& value);
  void operator()(const Text& info, std::string& value);
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& info, Enum& value) { value = static_cast<Enum>(choice(info, static_cast<int>(value))); }
  template <class Item>
  void operator()(const Tables& info, std::vector<Item>& items) {
    std::vector<TomlTable> found = tables(info.name);
    if (!found.empty()) items.clear();
    for (TomlTable& table : found) {
      items.emplace_back();
      describe(items.back(), table);
      table.finish();
    }
  }

  // Keys asked for by hand; nothing when the key is not there, or when it is wrong (then an error is noted).
  bool has(std::string_view key) const;
  std::optional<double> number(std::string_view key, double low, double high);
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t low, std::int64_t high);
  /// A whole number of 64 bits without sign; as a text when it has more than TOML's 63.
  std::optional<std::uint64_t> natural(std::string_view key);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<std::vector<std::string>> texts(std::string_view key);
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count);  ///< exactly `count` of them
  std::optional<std::vector<Vec2>> points(std::string_view key);                        ///< [[x, y], ...]
  /// Keys of a table whose values are numbers, in file order: {oak = 2, birch = 1}.
  std::optional<std::vector<std::pair<std::string, double>>> weights(std::string_view key);
  std::optional<TomlTable> table(std::string_view key);
  std::vector<TomlTable> tables(std::string_view key);  ///< [[key]]: every one; [key]: one

  /// Notes an error at `key` (or at the table itself when it has no such key): "file:line: message".
  void error(std::string_view key, const std::string& message);
  /// Refuses keys that nobody asked for.
  void finish();

 private:
  friend class TomlFile;
  struct State;
  explicit TomlTable(std::shared_ptr<State> state) : state_(std::move(state)) {}
  int choice(const Choice& info, int value);
  std::shared_ptr<State> state_;
};

class TomlFile {
 public:
  /// Reads and parses a file; text that nests too deep to be meant is refused before it is parsed.
  static Result<TomlFile> read(const std::filesystem::path& path);
  static Result<TomlFile> parse(std::string_view text, std::string name);

  TomlTable root() const;
  /// The first mistake noted by any table of this file.
  Result<void> check() const;

 private:
  struct Contents;
  friend class TomlTable;
  std::shared_ptr<Contents> contents_;
};

/// The name among `known` that `wrong` was probably meant to be; empty when none is near.
std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known);

}  // namespace bosquet::scene
