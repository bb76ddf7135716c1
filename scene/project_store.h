// Project store: a document in the tables of a project or recovery database.
//
// Format    a GeoPackage 1.3 with the feature tables `trees` (points) and `site` (its outline), and beside them
//             bosquet_meta    name, value: `format` and what a file says of itself
//             bosquet_text    section, number, name, json: settings, ground, areas, species, interactions, species_bar,
//                             obstacles, heroes, cameras, figures
//             bosquet_blob    section, item, part, size, checksum, data: terrain tiles, obstacle meshes and hero
//                             skeletons, compressed (project_blob.h)
//             bosquet_digest  section, rows, digest: a 128-bit hash of each section's values, rows in order
//           Tree positions stand in the geometry in the coordinates of the site's reference system, and in east_m and
//           north_m as they are in the document; where both disagree the geometry was edited, and counts
// Model     write() knows what it wrote before and writes what differs: parts that both documents share are not looked
//           at, rows with the same text or checksum stay
// Decision  digests are taken over the values as they stand in the file, so a file that lacks a column or key of a later
//           version still has its digest right, and reads with that field's default
// Holds     a document read back equals the one that was written
// Errors    a row that cannot be read is left out, or read as its default, and listed; what else could be read is there
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "scene/document.h"
#include "scene/project_database.h"
#include "scene/project_hash.h"

namespace bosquet::scene {

/// The format that this version writes.
inline constexpr int kProjectFormat = 1;

using ProjectMeta = std::map<std::string, std::string>;

struct StoredDocument {
  Document document;
  std::vector<std::string> problems;  ///< what is missing or differs from what was saved; empty when all is well
  bool trees_edited = false;          ///< trees are whole, but are not those that were saved: another program's edit
  std::vector<std::string> notes;     ///< what of an edit by another program could not be understood
  ProjectMeta meta;
};

using BlobKey = std::pair<std::int64_t, std::int64_t>;  ///< item, part

/// What a database holds, as far as its store knows.
struct KnownRows {
  bool any = false;
  Document document;
  std::map<std::string, std::vector<Hash128>> texts;        ///< of each row, by section
  std::map<std::string, std::map<BlobKey, Hash128>> blobs;  ///< by section
  std::map<std::string, Hash128> digests;
  ProjectMeta meta;
};

class ProjectStore {
 public:
  /// Makes the tables in an empty database.
  static Result<void> create_tables(Database& database);

  /// Writes what differs from what this store wrote or read last, and `meta`, as one transaction. After an error the
  /// database is as it was.
  Result<void> write(Database& database, const Document& document, const ProjectMeta& meta);

  /// Reads all that can be read. Error only when the site itself is unknown.
  Result<StoredDocument> read(Database& database);

  /// Whether the database holds what this store wrote or read last.
  bool holds_what_is_known(Database& database) const;

  /// The next write writes everything.
  void forget() { known_ = {}; }

 private:
  KnownRows known_;
};

}  // namespace bosquet::scene
