#include "ui/script.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

namespace bosquet::ui {
namespace {

// Words after the command: least, most, and how many of the first must be numbers.
struct Shape {
  std::size_t least, most, numbers;
};

const std::map<std::string, Shape, std::less<>>& commands() {
  static const std::map<std::string, Shape, std::less<>> known{
      {"wait", {1, 1, 1}},    {"settle", {0, 1, 1}}, {"move", {2, 2, 2}},   {"press", {0, 1, 0}},
      {"release", {0, 1, 0}}, {"click", {2, 3, 2}},  {"drag", {4, 5, 4}},   {"scroll", {1, 1, 1}},
      {"key", {1, 1, 0}},     {"type", {1, 64, 0}},  {"tool", {1, 4, 0}},   {"radius", {1, 1, 1}},
      {"camera", {6, 6, 6}},  {"ground", {2, 2, 2}}, {"open", {1, 1, 0}},   {"save", {1, 1, 0}},
      {"year", {1, 1, 1}},    {"plan", {0, 0, 0}},   {"trees", {0, 0, 0}},  {"screenshot", {1, 1, 0}},
      {"expect", {2, 8, 0}},  {"export", {1, 1, 0}}, {"select", {1, 8, 8}}, {"undo", {0, 0, 0}},
      {"redo", {0, 0, 0}}};
  return known;
}

bool is_number(const std::string& word) {
  float value = 0;
  const auto end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, value);
  return read.ec == std::errc() && read.ptr == end;
}

}  // namespace

Result<Script> parse_script(std::string_view text, const std::filesystem::path& file) {
  Script script;
  script.file = file;
  std::istringstream in{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = line.substr(0, line.find('#'));
    ScriptLine one;
    one.number = number;
    std::istringstream words(line);
    for (std::string word; words >> word;) one.words.push_back(word);
    if (one.words.empty()) continue;
    const auto fail = [&](const std::string& what) {
      return Error{fmt::format("{}:{}: {}", file.string(), number, what)};
    };
    const auto known = commands().find(one.words[0]);
    if (known == commands().end()) {
      std::string names;
      for (const auto& [name, shape] : commands()) names += (names.empty() ? "" : ", ") + name;
      return fail(fmt::format("'{}' is no command; there are: {}", one.words[0], names));
    }
    const Shape& shape = known->second;
    const std::size_t given = one.words.size() - 1;
    if (given < shape.least || given > shape.most)
      return fail(fmt::format(
          "'{}' takes {} words after it, not {}", one.words[0],
          shape.least == shape.most ? fmt::format("{}", shape.least) : fmt::format("{} to {}", shape.least, shape.most),
          given));
    for (std::size_t i = 1; i <= std::min(given, shape.numbers); ++i)
      if (!is_number(one.words[i])) return fail(fmt::format("'{}' is not a number", one.words[i]));
    script.lines.push_back(std::move(one));
  }
  return script;
}

Result<Script> read_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Error{file.string() + ": cannot be read"};
  std::ostringstream text;
  text << in.rdbuf();
  return parse_script(text.str(), file);
}

}  // namespace bosquet::ui
