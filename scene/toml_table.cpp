#include "scene/toml_table.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>

namespace bosquet::scene {

struct TomlFile::Contents {
  std::string name;
  toml::table root;
  std::optional<Error> first_error;
};

struct TomlTable::State {
  std::shared_ptr<TomlFile::Contents> file;
  const toml::table* table;
  std::set<std::string, std::less<>> asked;

  const toml::node* ask(std::string_view key) {
    asked.emplace(key);
    return table->get(key);
  }
};

namespace {

// Far beyond any file written by a person or a program of sense; deeper input overflows the parser's stack.
constexpr int kMaxNesting = 64;
constexpr std::uintmax_t kMaxBytes = std::uintmax_t{64} << 20;

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true/false";
    default:
      return "a date or time";
  }
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// Looks at brackets and at the dots of keys only, not into comments and texts.
Result<void> check_nesting(std::string_view text, const std::string& name) {
  int line = 1, depth = 0, dots = 0;
  bool key = true;  // before the line's '='
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line, dots = 0, key = true, quote = 0;
    } else if (quote) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '=') {
      key = false;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      depth = std::max(0, depth - 1);
    } else if (c == '.' && key) {
      ++dots;
    }
    if (depth > kMaxNesting)
      return Error{fmt::format("{}:{}: lists and tables nest more than {} deep", name, line, kMaxNesting)};
    // Numbers of a list that goes on over lines look like a key, so this is generous.
    if (dots > 16 * kMaxNesting)
      return Error{fmt::format("{}:{}: a key of more than {} parts", name, line, 16 * kMaxNesting)};
  }
  return {};
}

std::string range_text(double low, double high, std::string_view unit) {
  return fmt::format("{:g} to {:g}{}{}", low, high, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t d = edit_distance(wrong, name);
    if (d < best_distance) best_distance = d, best = name;
  }
  return best;
}

Result<TomlFile> TomlFile::read(const std::filesystem::path& path) {
  std::error_code ec;
  if (std::filesystem::is_directory(path, ec)) return Error{fmt::format("{} is a folder, not a file", path.string())};
  const auto bytes = std::filesystem::is_regular_file(path, ec) ? std::filesystem::file_size(path, ec) : 0;
  std::ifstream in(path, std::ios::binary);
  if (!in || ec) return Error{fmt::format("cannot open {}: no such file, or it may not be read", path.string())};
  if (bytes > kMaxBytes)
    return Error{fmt::format("{} is no recipe or species file: it has {} MB, at most {} are read", path.string(),
                             bytes >> 20, kMaxBytes >> 20)};
  std::string text(bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(bytes));
  if (in.gcount() != static_cast<std::streamsize>(bytes)) return Error{fmt::format("cannot read {}", path.string())};
  return parse(text, path.string());
}

Result<TomlFile> TomlFile::parse(std::string_view text, std::string name) {
  if (auto nested = check_nesting(text, name); !nested) return nested.error();
  TomlFile file;
  file.contents_ = std::make_shared<Contents>();
  try {
    file.contents_->root = toml::parse(text);
  } catch (const toml::parse_error& e) {
    const std::string what(e.description());
    return Error{fmt::format("{}:{}: {}{}", name, e.source().begin.line, what,
                             what.find("saw ','") == std::string::npos ? "" : "; decimals stand behind a point: 0.8")};
  }
  file.contents_->name = std::move(name);
  return file;
}

TomlTable TomlFile::root() const {
  return TomlTable(std::make_shared<TomlTable::State>(TomlTable::State{contents_, &contents_->root, {}}));
}

Result<void> TomlFile::check() const {
  if (contents_->first_error) return *contents_->first_error;
  return {};
}

void TomlTable::error(std::string_view key, const std::string& message) {
  if (state_->file->first_error) return;
  const toml::node* node = key.empty() ? nullptr : state_->table->get(key);
  const auto line = (node ? node->source() : state_->table->source()).begin.line;
  state_->file->first_error =
      Error{fmt::format("{}:{}: {}", state_->file->name, std::max<toml::source_index>(line, 1), message)};
}

void TomlTable::finish() {
  const std::vector<std::string> known(state_->asked.begin(), state_->asked.end());
  for (const auto& [key, node] : *state_->table) {
    if (state_->asked.contains(key.str())) continue;
    const std::string near = nearest_name(key.str(), known);
    error(key.str(), near.empty() ? fmt::format("unknown key '{}'; known here: {}", key.str(), fmt::join(known, ", "))
                                  : fmt::format("unknown key '{}'; did you mean '{}'?", key.str(), near));
  }
}

bool TomlTable::has(std::string_view key) const { return state_->table->contains(key); }

std::optional<double> TomlTable::number(std::string_view key, double low, double high) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_number()) {
    error(key, fmt::format("{} must be a number from {}, not {}", key, range_text(low, high, ""), type_name(*node)));
    return {};
  }
  const double value = *node->value<double>();
  if (!(value >= low && value <= high)) {  // also refuses NaN
    error(key, fmt::format("{} = {:g} is out of range; allowed: {}", key, value, range_text(low, high, "")));
    return {};
  }
  return value;
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_integer()) {
    const std::string found = node->is_floating_point() ? fmt::format("{:g}", node->as_floating_point()->get())
                                                        : std::string(type_name(*node));
    error(key, fmt::format("{} must be a whole number from {} to {}, not {}", key, low, high, found));
    return {};
  }
  const std::int64_t value = node->as_integer()->get();
  if (value < low || value > high) {
    error(key, fmt::format("{} = {} is out of range; allowed: {} to {}", key, value, low, high));
    return {};
  }
  return value;
}

std::optional<std::uint64_t> TomlTable::natural(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_string()) {
    const auto value = integer(key, 0, std::numeric_limits<std::int64_t>::max());
    return value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
  }
  const std::string& text = node->as_string()->get();
  std::uint64_t value = 0;
  const auto [end, mistake] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || mistake != std::errc() || end != text.data() + text.size()) {
    error(key, fmt::format("{} = \"{}\" must be a whole number from 0 to {}", key, text,
                           std::numeric_limits<std::uint64_t>::max()));
    return {};
  }
  return value;
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_boolean()) {
    error(key, fmt::format("{} must be true or false, not {}", key, type_name(*node)));
    return {};
  }
  return node->as_boolean()->get();
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_string()) {
    error(key, fmt::format("{} must be a text in quotes, not {}", key, type_name(*node)));
    return {};
  }
  return node->as_string()->get();
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  std::vector<std::string> values;
  const toml::array* list = node->as_array();
  for (std::size_t i = 0; list && i < list->size(); ++i)
    if (const auto* item = list->get(i)->as_string()) values.push_back(item->get());
  if (!list || values.size() != list->size()) {
    error(key, fmt::format("{} must be a list of texts, like [\"a\", \"b\"]", key));
    return {};
  }
  return values;
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t count) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  std::vector<double> values;
  const toml::array* list = node->as_array();
  for (std::size_t i = 0; list && i < list->size(); ++i)
    if (auto value = list->get(i)->value<double>(); value && std::isfinite(*value)) values.push_back(*value);
  if (!list || values.size() != count || list->size() != count) {
    error(key, fmt::format("{} must be a list of {} numbers{}", key, count,
                           list && list->size() > count
                               ? fmt::format(", not {}; decimals stand behind a point: 0.8", list->size())
                               : ""));
    return {};
  }
  return values;
}

std::optional<std::vector<Vec2>> TomlTable::points(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  std::vector<Vec2> values;
  const toml::array* list = node->as_array();
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const toml::array* pair = list->get(i)->as_array();
    if (!pair || pair->size() != 2) break;
    const auto x = pair->get(0)->value<double>(), y = pair->get(1)->value<double>();
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) break;
    values.emplace_back(static_cast<float>(*x), static_cast<float>(*y));
  }
  if (!list || values.size() != list->size() || values.empty()) {
    error(key, fmt::format("{} must be a list of points in metres, like [[10, 20], [30, 25]]", key));
    return {};
  }
  return values;
}

std::optional<std::vector<std::pair<std::string, double>>> TomlTable::weights(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  const toml::table* table = node->as_table();
  std::vector<std::pair<std::string, double>> values;
  if (table) {
    for (const auto& [name, value] : *table) {
      const auto v = value.value<double>();
      if (!v || !(*v >= 0) || !std::isfinite(*v)) break;
      values.emplace_back(name.str(), *v);
    }
  }
  if (!table || values.size() != table->size() || values.empty()) {
    error(key, fmt::format("{} must be a table of numbers of at least 0, like {{ english_oak = 2, silver_birch = 1 }}",
                           key));
    return {};
  }
  return values;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = state_->ask(key);
  if (!node) return {};
  if (!node->is_table()) {
    error(key, fmt::format("{} must be a table, not {}", key, type_name(*node)));
    return {};
  }
  return TomlTable(std::make_shared<State>(State{state_->file, node->as_table(), {}}));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = state_->ask(key);
  std::vector<TomlTable> found;
  if (!node) return found;
  auto add = [&](const toml::node& item) {
    found.push_back(TomlTable(std::make_shared<State>(State{state_->file, item.as_table(), {}})));
  };
  if (node->is_table()) {
    add(*node);
  } else if (const toml::array* list = node->as_array();
             list && (list->empty() || list->is_homogeneous(toml::node_type::table))) {
    for (const toml::node& item : *list) add(item);
  } else {
    error(key, fmt::format("{} must be tables, written [[{}]]", key, key));
  }
  return found;
}

void TomlTable::operator()(const Real& info, double& value) {
  const toml::node* node = state_->ask(info.name);
  if (!node) return;
  const std::string range = range_text(info.low, info.high, info.unit);
  if (!node->is_number())
    return error(info.name, fmt::format("{} must be a number from {}, not {}", info.name, range, type_name(*node)));
  const double v = *node->value<double>();
  if (!(v >= info.low && v <= info.high))
    return error(info.name, fmt::format("{} = {:g} is out of range; allowed: {}", info.name, v, range));
  value = v;
}

void TomlTable::operator()(const Real& info, float& value) {
  double wide = static_cast<double>(value);
  (*this)(info, wide);
  if (has(info.name)) value = static_cast<float>(wide);
}

void TomlTable::operator()(const Whole& info, int& value) {
  if (auto v = integer(info.name, info.low, info.high)) value = static_cast<int>(*v);
}

void TomlTable::operator()(const Switch& info, bool& value) {
  if (auto v = boolean(info.name)) value = *v;
}

void TomlTable::operator()(const Text& info, std::string& value) {
  if (auto v = text(info.name)) value = *v;
}

void TomlTable::operator()(const Colour& info, Vec3& value) {
  if (const toml::node* node = state_->ask(info.name); node && node->is_array()) {
    const auto parts = numbers(info.name, 3);
    if (!parts) return;
    for (int c = 0; c < 3; ++c) {
      const double v = (*parts)[static_cast<std::size_t>(c)];
      if (!(v >= 0 && v <= 1)) return error(info.name, fmt::format("{} = {:g} must be 0 to 1", info.name, v));
      value[c] = static_cast<float>(v);
    }
    return;
  }
  const auto v = text(info.name);
  if (!v) return;
  const bool hex = v->size() == 6 && v->find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  if (!hex)
    return error(info.name,
                 fmt::format("{} = \"{}\" must be a colour of six hex digits, like \"4F6B2C\"", info.name, *v));
  for (int c = 0; c < 3; ++c)
    value[c] = static_cast<float>(std::stoi(v->substr(static_cast<std::size_t>(2 * c), 2), nullptr, 16)) / 255.0f;
}

int TomlTable::choice(const Choice& info, int value) {
  const auto v = text(info.name);
  if (!v) return value;
  for (std::size_t i = 0; i < info.names.size(); ++i)
    if (info.names[i] == *v) return static_cast<int>(i);
  error(info.name, fmt::format("{} = \"{}\" is not known; allowed: {}", info.name, *v, fmt::join(info.names, ", ")));
  return value;
}

}  // namespace bosquet::scene
