// Project trees: a document's trees as rows of a GeoPackage feature table.
//
// Format    id, geom (a point), then one column for each field of a tree in tree_columns(): a new field is one line there
// Species   by name, so that people can read and change it; a name that stands twice in a document gets a number
// Holds     a row read back is the tree that was written; its hash is over the row's values as they stand
// Errors    values that are none (another program may write anything) are read as their defaults, and noted
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"
#include "scene/project_database.h"
#include "scene/project_hash.h"

namespace bosquet::scene {

/// CREATE TABLE of the trees.
std::string tree_table();

/// Names by which rows tell species, in the document's order.
std::vector<std::string> species_labels(const Document& document);

/// The fields of tree_columns() as texts, for tables that people read: their names, a tree's values, and a value put back
/// (false when there is no such field or the text is none of its values).
std::vector<std::string> tree_field_names();
std::vector<std::string> tree_fields(const Tree& tree);
bool set_tree_field(Tree& tree, std::string_view name, std::string_view text);

class TreeRows {
 public:
  /// Rows of documents with this reference system and these species.
  static Result<TreeRows> writer(Database& database, const Document& document, std::int32_t srs);

  Result<void> put(const Tree& tree);
  Result<void> remove(std::int32_t id);
  /// The hash of a row, without writing it.
  static Hash128 hash(const Tree& tree, const Georeference& place, const std::vector<std::string>& labels,
                      std::int32_t srs);

 private:
  TreeRows(Statement put, Statement remove) : put_(std::move(put)), remove_(std::move(remove)) {}
  Statement put_, remove_;
  Georeference place_;
  std::vector<std::string> labels_;
  std::int32_t srs_ = 0;
};

struct ReadTrees {
  std::vector<Tree> trees;
  std::vector<Hash128> hashes;     ///< of the rows, one for each tree
  std::vector<std::string> notes;  ///< values that are none
  bool whole = true;               ///< every row could be read
};

ReadTrees read_trees(Database& database, const Document& document);

}  // namespace bosquet::scene
