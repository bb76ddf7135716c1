// Inventory columns: which column of somebody's tree list holds what, and in which unit.
//
// Model     names are compared folded (core/letters.h): usual English, German and French ones are known, with or without
//           a unit at their end (_m _cm _mm _in _ft and words for them)
// Decision  the first of the usual names that is there counts, in the order of the list, not of the file
// Errors    a column that was named but is not there; no position; a unit that is none
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace bosquet::exchange {

enum class InventoryField { east, north, species, height, trunk_diameter, crown_diameter, id, status, clear_stem, age };
/// As recipes name them.
inline constexpr std::array<std::string_view, 10> kInventoryFieldNames{
    "east", "north", "species", "height", "trunk_diameter", "crown_diameter", "id", "status", "clear_stem", "age"};
inline constexpr std::size_t kInventoryFields = kInventoryFieldNames.size();

/// Names of columns in the file; an empty one is looked for by the usual names.
struct InventoryColumns {
  std::string east, north, species, height, trunk_diameter, crown_diameter, id, status, clear_stem, age;

  std::string& operator[](InventoryField field);
  const std::string& operator[](InventoryField field) const;
};

/// Units that stand for what columns' names say: m, cm, mm, in, ft. An empty one leaves it to the name. `position`
/// counts for east and north.
struct InventoryUnits {
  std::string position, height, trunk_diameter, crown_diameter, clear_stem;
};

struct FoundColumn {
  int index = -1;  ///< -1: not there
  double metres = 1;
  bool has_unit = false;
  bool girth = false;
  bool degrees = false;
};

struct FoundColumns {
  std::array<FoundColumn, kInventoryFields> field;
  int genus = -1, cultivar = -1;  ///< of names that are spread over several columns
  // What Bosquet itself writes beside them, so that its own files come back whole.
  int inventory_name = -1, inventory_id = -1, surveyed = -1;

  const FoundColumn& operator[](InventoryField f) const { return field[static_cast<std::size_t>(f)]; }
  FoundColumn& operator[](InventoryField f) { return field[static_cast<std::size_t>(f)]; }
};

/// Metres of one unit by its short name or its word, in English, German or French.
std::optional<double> metres_of_unit(std::string_view unit);

/// `positions_needed` is false for files whose rows have places of their own. `file` is for messages.
Result<FoundColumns> find_columns(const std::vector<std::string>& names, const InventoryColumns& given,
                                  const InventoryUnits& units, bool positions_needed, const std::string& file);

}  // namespace bosquet::exchange
