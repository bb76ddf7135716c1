// Tree inventory: surveyed trees from a CSV file.
//
// Format    a header row, then one tree a row; separator , ; or tab (the commonest in the header), quotes, LF or CRLF,
//           UTF-8 with or without mark (anything else is read as Latin-1). With ; or tab a decimal comma is understood.
// Columns   found by their usual names in any case (x_m, east, easting, ...; species, botanical_name, ...; height_m;
//           dbh_m, dbh_cm, diameter_in, girth_cm, ...; crown_diameter_m; id, tree_id, ...) or named by the caller
// Units     lengths in metres by the suffix of the column's name: _m _cm _mm _in _ft. Trunk diameters without suffix
//           are cm when any exceeds 3.5, else m (see notes); other lengths without suffix are m. Girths are divided by
//           pi.
// Frame     plan: (east, north) from the site's south-west corner, after `south_west` is subtracted in double
// Decision  a row without a usable position, or outside the site, is left out; a size that is text or impossible is
//           ignored and the tree kept. Both are reported with line and reason.
// Errors    missing or empty file, no header, no position columns, a named column that is not there
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

/// Names of columns in the file; an empty one is looked for by the usual names.
struct InventoryColumns {
  std::string east, north, species, height, trunk_diameter, crown_diameter, id;
};

struct InventoryOptions {
  InventoryColumns columns;
  DVec2 south_west{0.0};        ///< the site's corner in the file's coordinates
  std::optional<DVec2> size_m;  ///< rows outside the site are refused when given
};

struct InventoryTree {
  int line = 0;         ///< in the file, the header is line 1
  DVec2 plan{0.0};      ///< metres east and north of the site's south-west corner
  std::string species;  ///< as in the file; may be empty
  std::optional<float> height_m, trunk_diameter_m, crown_diameter_m;
  std::string id;  ///< as in the file; may be empty
};

struct RowProblem {
  int line = 0;
  std::string reason;
  bool kept = false;  ///< the tree is there, without the number the problem is about
};

struct Inventory {
  std::vector<InventoryTree> trees;
  std::vector<RowProblem> problems;  ///< by line
  std::vector<std::string> notes;    ///< what was assumed (units, encoding); not the file's name
  InventoryColumns columns;          ///< the names found; empty where there is none
};

Result<Inventory> read_inventory(const std::filesystem::path& path, const InventoryOptions& options = {});

/// The same from text; `name` is for messages.
Result<Inventory> parse_inventory(std::string_view text, const std::string& name, const InventoryOptions& options = {});

/// Messages for people: "trees.csv:17: ..." for the first `most` problems, then one line with the rest's line numbers.
std::vector<std::string> problem_lines(const std::vector<RowProblem>& problems, const std::string& name,
                                       std::size_t most = 20);

}  // namespace bosquet::exchange
