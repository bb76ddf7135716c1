#include "exchange/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

#include "exchange/csv.h"
#include "exchange/file_output.h"

namespace bosquet::exchange {
namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;

// No tree is larger; what is beyond is a slip or another unit.
constexpr double kTallest = 130, kThickest = 15, kWidest = 100;  // metres
constexpr double kTrunkInMetres = 3.5;  // a trunk column without unit holds cm when any value is larger

// --- text ---

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// A column's name for comparing: lower case, one underscore for each run of other signs than letters and digits.
std::string plain(std::string_view name) {
  std::string out;
  for (unsigned char c : lower(name)) {
    const bool sign = c < 128 && !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9');
    if (!sign)
      out += static_cast<char>(c);
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

bool valid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const int follow = c < 0x80                ? 0
                       : c >= 0xc2 && c < 0xe0 ? 1
                       : c >= 0xe0 && c < 0xf0 ? 2
                       : c >= 0xf0 && c < 0xf5 ? 3
                                               : -1;
    if (follow < 0 || i + static_cast<std::size_t>(follow) >= text.size()) return false;
    for (int k = 1; k <= follow; ++k)
      if ((static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0xc0) != 0x80) return false;
    i += static_cast<std::size_t>(follow) + 1;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (unsigned char c : text) {
    if (c < 0x80) {
      out += static_cast<char>(c);
    } else {
      out += static_cast<char>(0xc0 | (c >> 6));
      out += static_cast<char>(0x80 | (c & 0x3f));
    }
  }
  return out;
}

// For messages: what was found, not more than fits a line.
std::string excerpt(const std::string& text) {
  if (text.size() <= 40) return '"' + text + '"';
  std::size_t end = 37;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not inside a letter
  return '"' + text.substr(0, end) + "...\"";
}

// --- columns ---

struct Unit {
  std::string_view suffix;
  double metres;
};
constexpr std::array kUnits{Unit{"_m", 1},         Unit{"_cm", 0.01},       Unit{"_mm", 0.001},  Unit{"_in", 0.0254},
                            Unit{"_inch", 0.0254}, Unit{"_inches", 0.0254}, Unit{"_ft", 0.3048}, Unit{"_feet", 0.3048},
                            Unit{"_metres", 1},    Unit{"_meters", 1}};

constexpr std::array<std::string_view, 8> kEast{"x",       "east",    "easting", "e",
                                                "x_coord", "coord_x", "utm_x",   "rechtswert"};
constexpr std::array<std::string_view, 8> kNorth{"y",       "north",   "northing", "n",
                                                 "y_coord", "coord_y", "utm_y",    "hochwert"};
constexpr std::array<std::string_view, 9> kSpecies{"species",     "botanical_name", "scientific_name",
                                                   "latin_name",  "species_name",   "tree_species",
                                                   "common_name", "taxon",          "baumart"};
constexpr std::array<std::string_view, 5> kHeight{"height", "tree_height", "total_height", "h", "baumhoehe"};
constexpr std::array<std::string_view, 8> kTrunk{
    "dbh", "diameter",        "trunk_diameter", "stem_diameter", "diam", "diameter_at_breast_height",
    "bhd", "stammdurchmesser"};
constexpr std::array<std::string_view, 7> kGirth{
    "girth", "circumference", "trunk_circumference", "gbh", "trunk_girth", "stammumfang", "umfang"};
constexpr std::array<std::string_view, 8> kCrown{"crown_diameter", "crown_width", "crown_spread",     "crown", "spread",
                                                 "canopy_spread",  "crown_diam",  "kronendurchmesser"};
constexpr std::array<std::string_view, 7> kId{"id", "tree_id", "treeid", "tree_no", "tag", "tree_tag", "baumnummer"};
constexpr std::array<std::string_view, 6> kDegrees{"lon", "longitude", "lng", "long", "lat", "latitude"};

struct Column {
  int index = -1;  ///< -1: not there
  double metres = 1;
  bool has_unit = false;
  bool girth = false;
};

struct Header {
  std::vector<std::string> names, plain_names;
};

// Splits a unit off a column's name.
std::string without_unit(const std::string& name, Column& column) {
  for (const Unit& unit : kUnits) {
    if (!std::string_view(name).ends_with(unit.suffix) || name.size() == unit.suffix.size()) continue;
    column.metres = unit.metres, column.has_unit = true;
    return name.substr(0, name.size() - unit.suffix.size());
  }
  return name;
}

// The first column (in the order of the usual names) that bears one of them, with or without unit.
Column find(const Header& header, std::span<const std::string_view> usual) {
  for (std::string_view wanted : usual)
    for (std::size_t i = 0; i < header.names.size(); ++i) {
      Column column;
      if (header.plain_names[i] != wanted && without_unit(header.plain_names[i], column) != wanted) continue;
      if (header.plain_names[i] == wanted) column = {};  // the whole name is meant, not a unit
      column.index = static_cast<int>(i);
      return column;
    }
  return {};
}

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

Result<Column> column_for(const Header& header, const std::string& given, std::span<const std::string_view> usual,
                          const std::string& file, const char* what) {
  if (given.empty()) return find(header, usual);
  for (std::size_t i = 0; i < header.names.size(); ++i) {
    if (header.names[i] != given && header.plain_names[i] != plain(given)) continue;
    Column column;
    const std::string stem = without_unit(header.plain_names[i], column);
    column.index = static_cast<int>(i);
    column.girth = std::find(kGirth.begin(), kGirth.end(), stem) != kGirth.end();
    return column;
  }
  return Error{fmt::format("{}: there is no column \"{}\" for the {}; the columns are {}", file, given, what,
                           list(header.names))};
}

struct Columns {
  Column east, north, species, height, trunk, crown, id;
};

Result<Columns> find_columns(const Header& header, const InventoryColumns& given, const std::string& file) {
  Columns out;
  const auto take = [&](Column& into, const std::string& name, std::span<const std::string_view> usual,
                        const char* what) -> Result<void> {
    auto column = column_for(header, name, usual, file, what);
    if (!column) return column.error();
    into = *column;
    return {};
  };
  if (auto r = take(out.east, given.east, kEast, "position east"); !r) return r.error();
  if (auto r = take(out.north, given.north, kNorth, "position north"); !r) return r.error();
  if (auto r = take(out.species, given.species, kSpecies, "species"); !r) return r.error();
  if (auto r = take(out.height, given.height, kHeight, "height"); !r) return r.error();
  if (auto r = take(out.trunk, given.trunk_diameter, kTrunk, "trunk diameter"); !r) return r.error();
  if (auto r = take(out.crown, given.crown_diameter, kCrown, "crown diameter"); !r) return r.error();
  if (auto r = take(out.id, given.id, kId, "id"); !r) return r.error();
  if (out.trunk.index < 0) {
    out.trunk = find(header, kGirth);
    out.trunk.girth = true;
  }
  if (out.east.index >= 0 && out.north.index >= 0) return out;
  if (find(header, kDegrees).index >= 0)
    return Error{fmt::format("{} gives positions in degrees; metres east and north (x_m, y_m) are needed", file)};
  return Error{fmt::format("{}: no columns for the position found among {}; usual names are x_m and y_m", file,
                           list(header.names))};
}

// --- numbers ---

enum class Reading { number, missing, text };

// Words for "not measured" in real inventories.
bool means_missing(std::string_view text) {
  if (text.empty()) return true;
  const std::string word = lower(text);
  return word == "na" || word == "n/a" || word == "null" || word == "none" || word == "nan" || word == "-" ||
         word == "?";
}

Reading read_number(std::string& text, bool decimal_comma, double& value) {
  if (means_missing(text)) return Reading::missing;
  if (decimal_comma && text.find('.') == std::string::npos)
    if (const auto comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  const char *begin = text.data(), *end = begin + text.size();
  if (*begin == '+') ++begin;
  const auto [stop, failed] = std::from_chars(begin, end, value);
  return failed == std::errc() && stop == end && std::isfinite(value) ? Reading::number : Reading::text;
}

// --- rows ---

class RowReader {
 public:
  RowReader(const Header& header, const Columns& columns, bool decimal_comma, const InventoryOptions& options,
            Inventory& out)
      : header_(header), columns_(columns), decimal_comma_(decimal_comma), options_(options), out_(out) {}

  void read(std::vector<std::string>& fields, int line) {
    while (fields.size() > header_.names.size() && fields.back().empty()) fields.pop_back();
    if (fields.size() > header_.names.size())
      return refuse(line, fmt::format("{} fields, but the header has {}", fields.size(), header_.names.size()));
    fields.resize(header_.names.size());

    InventoryTree tree;
    tree.line = line;
    DVec2 place;
    if (!position(fields, line, columns_.east, place.x) || !position(fields, line, columns_.north, place.y)) return;
    tree.plan = place - options_.south_west;
    if (options_.size_m) {
      const DVec2 size = *options_.size_m;
      if (tree.plan.x < 0 || tree.plan.y < 0 || tree.plan.x > size.x || tree.plan.y > size.y)
        return refuse(line, fmt::format("position {:.10g}, {:.10g} lies outside the site of {:g} x {:g} m", tree.plan.x,
                                        tree.plan.y, size.x, size.y));
    }
    if (columns_.species.index >= 0) tree.species = fields[static_cast<std::size_t>(columns_.species.index)];
    if (columns_.id.index >= 0) tree.id = fields[static_cast<std::size_t>(columns_.id.index)];
    tree.height_m = length(fields, line, columns_.height, kTallest);
    tree.trunk_diameter_m = length(fields, line, columns_.trunk, kThickest);
    tree.crown_diameter_m = length(fields, line, columns_.crown, kWidest);
    out_.trees.push_back(std::move(tree));
  }

 private:
  void refuse(int line, std::string reason) { out_.problems.push_back({line, std::move(reason), false}); }
  void note(int line, std::string reason) { out_.problems.push_back({line, std::move(reason), true}); }

  const std::string& name(const Column& column) const { return header_.names[static_cast<std::size_t>(column.index)]; }

  bool position(std::vector<std::string>& fields, int line, const Column& column, double& out) {
    std::string& text = fields[static_cast<std::size_t>(column.index)];
    double value = 0;
    switch (read_number(text, decimal_comma_, value)) {
      case Reading::missing:
        refuse(line, fmt::format("{} is missing", name(column)));
        return false;
      case Reading::text:
        refuse(line, fmt::format("{} is {}, not a number", name(column), excerpt(text)));
        return false;
      case Reading::number:
        break;
    }
    out = value * column.metres;
    return true;
  }

  std::optional<float> length(std::vector<std::string>& fields, int line, const Column& column, double largest) {
    if (column.index < 0) return std::nullopt;
    std::string& text = fields[static_cast<std::size_t>(column.index)];
    double value = 0;
    switch (read_number(text, decimal_comma_, value)) {
      case Reading::missing:
        return std::nullopt;
      case Reading::text:
        note(line, fmt::format("{} is {}, not a number", name(column), excerpt(text)));
        return std::nullopt;
      case Reading::number:
        break;
    }
    const double metres = value * column.metres / (column.girth ? std::numbers::pi : 1.0);
    if (metres > 0 && metres <= largest) return static_cast<float>(metres);
    note(line, value <= 0 ? fmt::format("{} is {}, not above 0", name(column), text)
                          : fmt::format("{} is {}, which would be {:g} m; at most {:g} m are possible", name(column),
                                        text, metres, largest));
    return std::nullopt;
  }

  const Header& header_;
  const Columns& columns_;
  bool decimal_comma_;
  const InventoryOptions& options_;
  Inventory& out_;
};

// Whether a trunk column without unit can be metres.
bool fits_metres(std::string_view body, char separator, const Column& trunk) {
  CsvReader rows(body, separator);
  std::vector<std::string> fields;
  rows.next(fields);  // the header
  while (rows.next(fields)) {
    double value = 0;
    const auto i = static_cast<std::size_t>(trunk.index);
    if (i < fields.size() && read_number(fields[i], separator != ',', value) == Reading::number &&
        value > kTrunkInMetres * (trunk.girth ? std::numbers::pi : 1.0))
      return false;
  }
  return true;
}

}  // namespace

Result<Inventory> parse_inventory(std::string_view text, const std::string& name, const InventoryOptions& options) {
  Inventory out;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return Error{fmt::format("{} is UTF-16 text; save it as UTF-8", name)};
  if (text.find('\0') != std::string_view::npos) return Error{fmt::format("{} is no text file", name)};
  std::string converted;
  if (!valid_utf8(text)) {
    converted = from_latin1(text);
    text = converted;
    out.notes.push_back("not UTF-8, read as Latin-1");
  }

  const char separator = guess_separator(text);
  CsvReader rows(text, separator);
  Header header;
  if (!rows.next(header.names))
    return Error{fmt::format("{} is empty: a header row and a row for each tree are needed", name)};
  for (const std::string& column : header.names) header.plain_names.push_back(plain(column));
  auto columns = find_columns(header, options.columns, name);
  if (!columns) return columns.error();

  Column& trunk = columns->trunk;
  if (trunk.index >= 0 && !trunk.has_unit) {
    const bool metres = fits_metres(text, separator, trunk);
    trunk.metres = metres ? 1 : 0.01;
    out.notes.push_back(fmt::format("column {} names no unit; taken as {}",
                                    header.names[static_cast<std::size_t>(trunk.index)], metres ? "m" : "cm"));
  }
  const auto found = [&](const Column& column) {
    return column.index >= 0 ? header.names[static_cast<std::size_t>(column.index)] : std::string();
  };
  out.columns = {found(columns->east),  found(columns->north), found(columns->species), found(columns->height),
                 found(columns->trunk), found(columns->crown), found(columns->id)};

  RowReader reader(header, *columns, separator != ',', options, out);
  std::vector<std::string> fields;
  while (rows.next(fields)) reader.read(fields, rows.line());
  return out;
}

Result<Inventory> read_inventory(const std::filesystem::path& path, const InventoryOptions& options) {
  const auto bytes = read_file(path, kMaxFileBytes);
  if (!bytes) return bytes.error();
  return parse_inventory({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(), options);
}

std::vector<std::string> problem_lines(const std::vector<RowProblem>& problems, const std::string& name,
                                       std::size_t most) {
  std::vector<std::string> out;
  for (const RowProblem& p : problems) {
    if (out.size() == most) break;
    out.push_back(fmt::format("{}:{}: {}{}", name, p.line, p.reason,
                              p.kept ? "; the tree is planted without it" : "; the row is left out"));
  }
  if (problems.size() > most) {
    std::string rest = fmt::format("{}: and {} more, in lines", name, problems.size() - most);
    for (std::size_t i = most; i < problems.size(); ++i)
      rest += fmt::format("{}{}", i == most ? " " : ", ", problems[i].line);
    out.push_back(std::move(rest));
  }
  return out;
}

}  // namespace bosquet::exchange
