#include "exchange/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "core/letters.h"
#include "exchange/file_output.h"
#include "exchange/number_text.h"
#include "exchange/reference_system.h"
#include "exchange/site_frame.h"
#include "exchange/tree_table.h"
#include "exchange/vector_table.h"

namespace bosquet::exchange {
namespace {

constexpr std::uint64_t kMaxTableBytes = std::uint64_t{1} << 30;

// No tree is larger; what is beyond is a slip or another unit.
constexpr double kTallest = 130, kThickest = 15, kWidest = 100, kOldest = 5000;  // metres, years
constexpr double kTrunkInMetres = 3.5;  // a trunk column without unit holds cm when any value is larger

// For messages: what was found, not more than fits a line.
std::string excerpt(const std::string& text) {
  if (text.size() <= 40) return '"' + text + '"';
  std::size_t end = 37;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not inside a letter
  return '"' + text.substr(0, end) + "...\"";
}

struct StatusWord {
  std::string_view word;
  scene::TreeStatus status;
};
using enum scene::TreeStatus;
constexpr StatusWord kStatusWords[]{{"proposed", proposed},
                                    {"planned", proposed},
                                    {"new", proposed},
                                    {"plant", proposed},
                                    {"planting", proposed},
                                    {"to_plant", proposed},
                                    {"geplant", proposed},
                                    {"neu", proposed},
                                    {"neupflanzung", proposed},
                                    {"pflanzung", proposed},
                                    {"ersatzpflanzung", proposed},
                                    {"projete", proposed},
                                    {"propose", proposed},
                                    {"nouveau", proposed},
                                    {"plantation", proposed},
                                    {"a_planter", proposed},
                                    {"existing", existing},
                                    {"retain", existing},
                                    {"retained", existing},
                                    {"to_retain", existing},
                                    {"keep", existing},
                                    {"bestand", existing},
                                    {"bestehend", existing},
                                    {"vorhanden", existing},
                                    {"erhalten", existing},
                                    {"erhalt", existing},
                                    {"existant", existing},
                                    {"conserve", existing},
                                    {"a_conserver", existing},
                                    {"maintenu", existing},
                                    {"alive", existing},
                                    {"remove", to_remove},
                                    {"to_remove", to_remove},
                                    {"removed", to_remove},
                                    {"removal", to_remove},
                                    {"fell", to_remove},
                                    {"to_fell", to_remove},
                                    {"felled", to_remove},
                                    {"felling", to_remove},
                                    {"faellen", to_remove},
                                    {"zu_faellen", to_remove},
                                    {"faellung", to_remove},
                                    {"rodung", to_remove},
                                    {"roden", to_remove},
                                    {"entfernen", to_remove},
                                    {"entfaellt", to_remove},
                                    {"abattre", to_remove},
                                    {"a_abattre", to_remove},
                                    {"abattage", to_remove},
                                    {"supprimer", to_remove},
                                    {"a_supprimer", to_remove},
                                    {"protected", to_protect},
                                    {"protect", to_protect},
                                    {"to_protect", to_protect},
                                    {"tpo", to_protect},
                                    {"geschuetzt", to_protect},
                                    {"schuetzen", to_protect},
                                    {"zu_schuetzen", to_protect},
                                    {"naturdenkmal", to_protect},
                                    {"protege", to_protect},
                                    {"a_proteger", to_protect},
                                    {"remarquable", to_protect},
                                    {"heritage", to_protect},
                                    {"veteran", to_protect}};

constexpr InventoryField kNumberFields[]{
    InventoryField::east,           InventoryField::north,      InventoryField::height, InventoryField::trunk_diameter,
    InventoryField::crown_diameter, InventoryField::clear_stem, InventoryField::age};
using MarksOfColumns = std::vector<NumberMarks>;  ///< one for each column of the table

// What decimal marks the columns with numbers have.
MarksOfColumns look_at_marks(TreeTable& table, const FoundColumns& columns) {
  std::vector<SeenMarks> seen(table.columns.size());
  TableRow row;
  while (table.next(row)) {
    if (!row.problem.empty()) continue;
    for (const InventoryField field : kNumberFields)
      if (const int i = columns[field].index; i >= 0)
        seen[static_cast<std::size_t>(i)].look(row.fields[static_cast<std::size_t>(i)]);
  }
  table.restart();
  SeenMarks all;
  for (const SeenMarks& column : seen) {
    all.commas += column.commas;
    all.clear_commas += column.clear_commas, all.clear_points += column.clear_points;
  }
  MarksOfColumns marks;
  for (const SeenMarks& column : seen) marks.push_back(marks_of(column, all, table.decimal_comma));
  return marks;
}

class RowReader {
 public:
  RowReader(const TreeTable& table, const FoundColumns& columns, const MarksOfColumns& marks, bool by_columns,
            Inventory& out)
      : table_(table), columns_(columns), marks_(marks), by_columns_(by_columns), out_(out) {}

  void read(TableRow& row) {
    line_ = row.line;
    if (!row.problem.empty()) return refuse(row.problem);
    fields_ = &row.fields;

    InventoryTree tree;
    tree.line = row.line;
    if (by_columns_) {
      if (!position(columns_[InventoryField::east], tree.plan.x) ||
          !position(columns_[InventoryField::north], tree.plan.y))
        return;
    } else if (!row.place || !std::isfinite(row.place->x) || !std::isfinite(row.place->y)) {
      return refuse("its place is no number");
    } else {
      tree.plan = *row.place;
    }
    tree.species = name();
    // A file of ours has its own id and, beside it, the one that an inventory gave.
    tree.id = columns_.inventory_id >= 0 ? text(columns_.inventory_id) : text(columns_[InventoryField::id].index);
    if (columns_.inventory_name >= 0) tree.name_kept = text(columns_.inventory_name);
    if (const std::string surveyed = text(columns_.surveyed); surveyed == "0" || surveyed == "false")
      tree.surveyed = false;
    tree.height_m = length(columns_[InventoryField::height], kTallest);
    tree.trunk_diameter_m = length(columns_[InventoryField::trunk_diameter], kThickest);
    tree.crown_diameter_m = length(columns_[InventoryField::crown_diameter], kWidest);
    tree.clear_stem_m = length(columns_[InventoryField::clear_stem], kTallest, true);
    if (tree.clear_stem_m && tree.height_m && *tree.clear_stem_m >= *tree.height_m) {
      note(fmt::format("{} is {:g} m, not below the height of {:g} m", column(columns_[InventoryField::clear_stem]),
                       *tree.clear_stem_m, *tree.height_m));
      tree.clear_stem_m.reset();
    }
    tree.age_years = years(columns_[InventoryField::age]);
    tree.status = status(columns_[InventoryField::status]);
    out_.trees.push_back(std::move(tree));
  }

 private:
  void refuse(std::string reason) { out_.problems.push_back({line_, std::move(reason), false}); }
  void note(std::string reason) { out_.problems.push_back({line_, std::move(reason), true}); }

  const std::string& column(const FoundColumn& c) const { return table_.columns[static_cast<std::size_t>(c.index)]; }
  const std::string& text(int index) const {
    static const std::string none;
    return index >= 0 ? (*fields_)[static_cast<std::size_t>(index)] : none;
  }

  // Genus, species and cultivar may stand in columns of their own: "Acer", "platanoides", "Globosum".
  std::string name() const {
    std::string out = text(columns_[InventoryField::species].index);
    if (const std::string& genus = text(columns_.genus); !genus.empty()) {
      const bool epithet =
          !out.empty() && !(out.front() >= 'A' && out.front() <= 'Z') && out.find(' ') == std::string::npos;
      if (out.empty())
        out = genus;
      else if (epithet && genus.find(' ') == std::string::npos)
        out = genus + ' ' + out;
    }
    if (const std::string& cultivar = text(columns_.cultivar);
        !cultivar.empty() && out.find(cultivar) == std::string::npos)
      out += cultivar.front() == '\'' ? ' ' + cultivar : " '" + cultivar + '\'';
    return out;
  }

  NumberText number_in(const FoundColumn& c) const {
    return read_number(text(c.index), marks_[static_cast<std::size_t>(c.index)]);
  }
  // "1.234" in a file that has decimal commas.
  std::string doubt(const FoundColumn& c) const {
    const std::string& said = text(c.index);
    const char mark = said[said.find_first_of(".,")];
    std::string whole = said, decimal = said;
    whole.erase(whole.find(mark), 1), decimal[decimal.find(mark)] = mark == '.' ? ',' : '.';
    return fmt::format("{} is \"{}\", which may be {} or {}: the file's decimals stand behind a {}", column(c), said,
                       whole, decimal, mark == '.' ? "comma" : "point");
  }

  bool position(const FoundColumn& c, double& out) {
    const NumberText number = number_in(c);
    switch (number.reading) {
      case NumberReading::missing:
        refuse(fmt::format("{} is missing", column(c)));
        return false;
      case NumberReading::text:
        refuse(fmt::format("{} is {}, not a number", column(c), excerpt(text(c.index))));
        return false;
      case NumberReading::doubtful:
        refuse(doubt(c));
        return false;
      case NumberReading::number:
        break;
    }
    out = number.value * c.metres;
    return true;
  }

  std::optional<double> number(const FoundColumn& c, std::optional<double>* metres) {
    if (c.index < 0) return {};
    const NumberText read = number_in(c);
    if (read.reading == NumberReading::doubtful) note(doubt(c));
    if (read.reading == NumberReading::text)
      note(fmt::format("{} is {}, not a number", column(c), excerpt(text(c.index))));
    if (read.reading != NumberReading::number) return {};
    if (metres) *metres = read.metres;
    return read.value;
  }

  std::optional<float> length(const FoundColumn& c, double largest, bool may_be_zero = false) {
    std::optional<double> unit;
    const auto value = number(c, &unit);
    if (!value) return {};
    if (may_be_zero && *value == 0) return {};
    const double metres = *value * unit.value_or(c.metres) / (c.girth ? std::numbers::pi : 1.0);
    if (metres > 0 && metres <= largest) return static_cast<float>(metres);
    const std::string& said = text(c.index);
    note(*value <= 0 ? fmt::format("{} is {}, not above 0", column(c), said)
                     : fmt::format("{} is {}, which would be {:g} m; at most {:g} m are possible", column(c), said,
                                   metres, largest));
    return {};
  }

  std::optional<float> years(const FoundColumn& c) {
    const auto value = number(c, nullptr);
    if (!value) return {};
    if (*value > 0 && *value <= kOldest) return static_cast<float>(*value);
    note(fmt::format("{} is {}, no age in years", column(c), text(c.index)));
    return {};
  }

  std::optional<scene::TreeStatus> status(const FoundColumn& c) {
    const std::string& said = text(c.index);
    if (said.empty()) return {};
    const std::string word = folded_words(said);
    for (const StatusWord& known : kStatusWords)
      if (known.word == word) return known.status;
    note(fmt::format("{} is {}, none of proposed, existing, to_remove, protected", column(c), excerpt(said)));
    return {};
  }

  const TreeTable& table_;
  const FoundColumns& columns_;
  const MarksOfColumns& marks_;
  bool by_columns_;
  Inventory& out_;
  int line_ = 0;
  const std::vector<std::string>* fields_ = nullptr;
};

// Whether a trunk column without unit can be metres.
bool fits_metres(TreeTable& table, const FoundColumn& trunk, const NumberMarks& marks) {
  TableRow row;
  bool fits = true;
  while (fits && table.next(row)) {
    const auto i = static_cast<std::size_t>(trunk.index);
    if (!row.problem.empty() || i >= row.fields.size()) continue;
    const NumberText number = read_number(row.fields[i], marks);
    fits = number.reading != NumberReading::number || number.metres ||
           number.value <= kTrunkInMetres * (trunk.girth ? std::numbers::pi : 1.0);
  }
  table.restart();
  return fits;
}

// Coordinates of the file become places on the site; what is not on it goes.
Result<void> locate(Inventory& inventory, const FrameOf& frame, const std::string& name) {
  std::vector<DVec2> places;
  places.reserve(inventory.trees.size());
  for (const InventoryTree& tree : inventory.trees) places.push_back(tree.plan);
  auto on_site = onto_site(std::move(places), frame);
  if (!on_site) return Error{fmt::format("{}: {}", name, on_site.error().message)};
  inventory.place = std::move(on_site->place);
  for (std::string& note : on_site->notes) inventory.notes.push_back(std::move(note));

  std::size_t kept = 0;
  for (std::size_t i = 0; i < inventory.trees.size(); ++i) {
    InventoryTree& tree = inventory.trees[i];
    tree.plan = on_site->plan[i];
    std::string reason;
    if (!std::isfinite(tree.plan.x) || !std::isfinite(tree.plan.y))
      reason = "its position is no place in the site's reference system";
    else if (frame.size_m &&
             (tree.plan.x < 0 || tree.plan.y < 0 || tree.plan.x > frame.size_m->x || tree.plan.y > frame.size_m->y))
      reason = fmt::format("position {:.10g}, {:.10g} lies outside the site of {:g} x {:g} m", tree.plan.x, tree.plan.y,
                           frame.size_m->x, frame.size_m->y);
    if (!reason.empty()) {
      inventory.problems.push_back({tree.line, std::move(reason), false});
      continue;
    }
    if (kept != i) inventory.trees[kept] = std::move(tree);
    ++kept;
  }
  inventory.trees.resize(kept);
  std::stable_sort(inventory.problems.begin(), inventory.problems.end(),
                   [](const RowProblem& a, const RowProblem& b) { return a.line < b.line; });
  return {};
}

Result<Inventory> read(TreeTable& table, const std::string& name, const InventoryOptions& options) {
  Inventory out;
  out.features = table.has_places;
  out.notes = table.notes;
  const bool by_columns = !table.has_places || (!options.columns.east.empty() && !options.columns.north.empty());
  auto columns = find_columns(table.columns, options.columns, options.units, by_columns, name);
  if (!columns) return columns.error();

  FrameOf frame{table.crs_wkt,      table.crs_assumed, table.metres_per_unit,
                options.south_west, options.site,      options.size_m};
  if (by_columns) {
    frame.metres_per_unit = 1;  // the columns' own units have done it
    frame.crs_wkt = (*columns)[InventoryField::east].degrees ? degrees_system() : std::string();
    frame.crs_assumed = false;
  } else if (!options.units.position.empty()) {
    frame.metres_per_unit = metres_of_unit(options.units.position).value_or(1);
  }
  if (!options.crs.empty()) {
    auto wkt = reference_system(options.crs);
    if (!wkt) return Error{fmt::format("{}: {}", name, wkt.error().message)};
    frame.crs_wkt = *wkt, frame.crs_assumed = false;
  }

  const MarksOfColumns marks = look_at_marks(table, *columns);
  if (FoundColumn& trunk = (*columns)[InventoryField::trunk_diameter]; trunk.index >= 0 && !trunk.has_unit) {
    const bool metres = fits_metres(table, trunk, marks[static_cast<std::size_t>(trunk.index)]);
    trunk.metres = metres ? 1 : 0.01;
    out.notes.push_back(fmt::format("column {} names no unit; taken as {}",
                                    table.columns[static_cast<std::size_t>(trunk.index)], metres ? "m" : "cm"));
  }
  for (std::size_t f = 0; f < kInventoryFields; ++f) {
    const auto field = static_cast<InventoryField>(f);
    const bool unused = !by_columns && (field == InventoryField::east || field == InventoryField::north);
    if (const int i = (*columns)[field].index; i >= 0 && !unused)
      out.columns[field] = table.columns[static_cast<std::size_t>(i)];
  }

  RowReader reader(table, *columns, marks, by_columns, out);
  TableRow row;
  while (table.next(row)) reader.read(row);
  if (auto located = locate(out, frame, name); !located) return located.error();
  return out;
}

}  // namespace

bool is_vector_file(const std::filesystem::path& path) {
  const std::string ending = folded_letters(path.extension().string());
  for (const char* known : {".geojson", ".json", ".gpkg", ".shp", ".dxf", ".kml", ".gml", ".fgb", ".tab", ".sqlite"})
    if (ending == known) return true;
  return false;
}

Result<Inventory> parse_inventory(std::string_view text, const std::string& name, const InventoryOptions& options) {
  auto table = csv_table(text, name);
  if (!table) return table.error();
  return read(**table, name, options);
}

Result<Inventory> read_inventory(const std::filesystem::path& path, const InventoryOptions& options) {
  if (is_vector_file(path)) {
    auto table = vector_table(path, options.layer);
    if (!table) return table.error();
    return read(**table, path.string(), options);
  }
  const auto bytes = read_file(path, kMaxTableBytes);
  if (!bytes) return bytes.error();
  return parse_inventory({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(), options);
}

std::vector<std::string> problem_lines(const std::vector<RowProblem>& problems, const std::string& name, bool features,
                                       std::size_t most) {
  std::vector<std::string> out;
  for (const RowProblem& p : problems) {
    if (out.size() == most) break;
    const std::string where =
        features ? fmt::format("{}: feature {}", name, p.line) : fmt::format("{}:{}", name, p.line);
    out.push_back(fmt::format("{}: {}{}", where, p.reason,
                              p.kept ? "; the tree is planted without it" : "; the row is left out"));
  }
  if (problems.size() > most) {
    std::string rest =
        fmt::format("{}: and {} more, in {}", name, problems.size() - most, features ? "features" : "lines");
    for (std::size_t i = most; i < problems.size(); ++i)
      rest += fmt::format("{}{}", i == most ? " " : ", ", problems[i].line);
    out.push_back(std::move(rest));
  }
  return out;
}

}  // namespace bosquet::exchange
