// Tree inventory: surveyed trees from somebody's file.
//
// Format    CSV text (tree_table.h), or points of a vector file: GeoJSON, GeoPackage, Shapefile, DXF (vector_table.h)
// Columns   found by their usual English, German or French names or named by the caller (inventory_columns.h). Genus and
//           cultivar in columns of their own are joined to the name
// Units     lengths in metres by the unit at the end of the column's name or behind the number ("12 m"), or as the caller
//           says. Trunk diameters and girths without unit are cm when any exceeds 3.5 m, else m (see notes); other lengths
//           without unit are m. Girths are divided by pi
// Frame     plan: (east, north) from the site's south-west corner; site_frame.h tells how it comes about
// Decision  a row without a usable position, or outside the site, is left out; a size that is text or impossible is
//           ignored and the tree kept. Both are reported with line (or feature) and reason
// Errors    missing or empty file, no header, no position columns, a named column that is not there, an unknown unit or
//           reference system
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "exchange/inventory_columns.h"
#include "scene/document.h"
#include "scene/tree.h"

namespace bosquet::exchange {

struct InventoryOptions {
  InventoryColumns columns;
  InventoryUnits units;
  std::string crs;                  ///< of the file's coordinates, before what the file itself says: EPSG:25832
  std::string layer;                ///< of a vector file; empty: all with points
  std::optional<DVec2> south_west;  ///< the site's corner in the file's coordinates
  scene::Georeference site;         ///< counts when `south_west` is not given
  std::optional<DVec2> size_m;      ///< rows outside the site are refused when given
};

struct InventoryTree {
  int line = 0;         ///< in the file, the header is line 1; the number of a feature
  DVec2 plan{0.0};      ///< metres east and north of the site's south-west corner
  std::string species;  ///< as in the file; may be empty
  std::optional<float> height_m, trunk_diameter_m, crown_diameter_m;
  std::string id;  ///< as in the file; may be empty
  std::optional<scene::TreeStatus> status;
  std::optional<float> clear_stem_m, age_years;
  /// In files that Bosquet wrote: what an earlier inventory called it, which may be nothing.
  std::optional<std::string> name_kept;
  bool surveyed = true;   ///< in files that Bosquet wrote: false where sizes are those it will have

  bool operator==(const InventoryTree&) const = default;
};

struct RowProblem {
  int line = 0;
  std::string reason;
  bool kept = false;  ///< the tree is there, without what the problem is about
};

struct Inventory {
  std::vector<InventoryTree> trees;
  std::vector<RowProblem> problems;          ///< by line
  std::vector<std::string> notes;            ///< what was assumed (units, encoding); not the file's name
  InventoryColumns columns;                  ///< the names found; empty where there is none
  bool features = false;                     ///< lines are numbers of features
  std::optional<scene::Georeference> place;  ///< that the site gets by this file, when it had none
};

Result<Inventory> read_inventory(const std::filesystem::path& path, const InventoryOptions& options = {});

/// CSV from text; `name` is for messages.
Result<Inventory> parse_inventory(std::string_view text, const std::string& name, const InventoryOptions& options = {});

/// Messages for people: "trees.csv:17: ..." for the first `most` problems, then one line with the rest's line numbers;
/// "trees.gpkg: feature 17: ..." for features.
std::vector<std::string> problem_lines(const std::vector<RowProblem>& problems, const std::string& name,
                                       bool features = false, std::size_t most = 20);

/// A file's ending is one of vector files, not of text.
bool is_vector_file(const std::filesystem::path& path);

}  // namespace bosquet::exchange
