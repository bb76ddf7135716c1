// Tree table: somebody's list of trees as rows of text under named columns, whatever file it came in.
//
// Format    CSV text here; features of a vector file in vector_table.h. Text is UTF-8 with or without mark, or Latin-1;
//           separator , ; or tab
// Model     rows come one after the other, so that a large file needs little memory, and can be gone through again
// Errors    empty, binary or UTF-16 text
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

struct TableRow {
  int line = 0;                     ///< in the file, or the feature's number
  std::vector<std::string> fields;  ///< one for each column, and what was too much
  std::optional<DVec2> place;       ///< of a feature, in the file's coordinates
  std::string problem;              ///< why it cannot be used; empty when it can
};

class TreeTable {
 public:
  virtual ~TreeTable() = default;

  /// The next row, or false at the end. `row` is overwritten.
  virtual bool next(TableRow& row) = 0;
  /// Back to the first row.
  virtual void restart() = 0;

  std::vector<std::string> columns;
  bool decimal_comma = false;      ///< a lone comma in a number is its decimal mark
  bool has_places = false;         ///< rows are features with a geometry
  std::string crs_wkt;             ///< of the places; empty when unknown
  bool crs_assumed = false;        ///< the file does not say it, its format does
  double metres_per_unit = 1;      ///< of places without a reference system
  std::vector<std::string> notes;  ///< what was assumed; not the file's name
};

/// `text` must outlive the table. `name` is for messages.
Result<std::unique_ptr<TreeTable>> csv_table(std::string_view text, const std::string& name);

}  // namespace bosquet::exchange
