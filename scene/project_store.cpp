#include "scene/project_store.h"

#include "scene/project_rows.h"
#include "scene/project_trees.h"

namespace bosquet::scene {
namespace {

// GeoPackage 1.3: readers find feature tables by these and no other numbers.
constexpr const char* kPragmas = "PRAGMA application_id = 0x47504B47; PRAGMA user_version = 10300;";

constexpr const char* kTables = R"sql(
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY,
  organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL,
  srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE site (id INTEGER PRIMARY KEY NOT NULL, geom POLYGON, name TEXT);
CREATE TABLE bosquet_meta (id INTEGER PRIMARY KEY NOT NULL, name TEXT UNIQUE NOT NULL, value TEXT);
CREATE TABLE bosquet_text (id INTEGER PRIMARY KEY NOT NULL, section TEXT NOT NULL, number INTEGER NOT NULL, name TEXT,
  json TEXT, UNIQUE (section, number));
CREATE TABLE bosquet_blob (id INTEGER PRIMARY KEY NOT NULL, section TEXT NOT NULL, item INTEGER NOT NULL,
  part INTEGER NOT NULL, size INTEGER NOT NULL, checksum TEXT NOT NULL, data BLOB, UNIQUE (section, item, part));
CREATE TABLE bosquet_digest (id INTEGER PRIMARY KEY NOT NULL, section TEXT UNIQUE NOT NULL, rows INTEGER NOT NULL,
  digest TEXT NOT NULL);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]', 'longitude/latitude coordinates in decimal degrees on the WGS 84 spheroid');
)sql";

}  // namespace

Result<void> ProjectStore::create_tables(Database& database) {
  if (auto done = database.run(kPragmas); !done) return done;
  if (auto done = database.run(kTables); !done) return done;
  return database.run(tree_table());
}

Result<void> ProjectStore::write(Database& database, const Document& document, const ProjectMeta& meta) {
  if (auto begun = database.run("BEGIN IMMEDIATE"); !begun) return begun;
  auto next = write_rows(database, known_, document, meta);
  Result<void> done = next ? database.run("COMMIT") : Result<void>(next.error());
  if (!done) {
    // Some failures have rolled back already.
    if (!database.idle()) (void)database.run("ROLLBACK").operator bool();
    return done;
  }
  known_ = std::move(*next);
  return {};
}

Result<StoredDocument> ProjectStore::read(Database& database) {
  // One transaction: what is read is of one moment, whatever another program saves meanwhile.
  (void)database.run("BEGIN").operator bool();
  known_ = {};
  auto read = read_rows(database, known_);
  (void)database.run("COMMIT").operator bool();
  return read;
}

bool ProjectStore::holds_what_is_known(Database& database) const {
  ProjectStore other;
  const auto read = other.read(database);
  return read && read->problems.empty() && !read->trees_edited && other.known_.digests == known_.digests;
}

}  // namespace bosquet::scene
