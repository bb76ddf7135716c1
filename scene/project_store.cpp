#include "scene/project_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "core/parallel.h"
#include "scene/project_blob.h"
#include "scene/project_text.h"
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

// A reference system as a GeoPackage tells it.
struct ReferenceSystem {
  std::int32_t id = -1;
  std::string organization;
};

ReferenceSystem reference_system(const Georeference& place) {
  if (place.crs_wkt.empty()) return {};
  // The authority of the whole stands last in the text.
  for (const std::string_view key : {"AUTHORITY[\"EPSG\",\"", "ID[\"EPSG\","}) {
    const auto at = place.crs_wkt.rfind(key);
    if (at == std::string::npos || place.crs_wkt.find('[', at + key.size()) != std::string::npos) continue;
    std::int32_t code = 0;
    const char* begin = place.crs_wkt.data() + at + key.size();
    if (std::from_chars(begin, place.crs_wkt.data() + place.crs_wkt.size(), code).ec == std::errc() && code > 1023 &&
        code < 1'000'000)
      return {code, "EPSG"};
  }
  return {100'000, "NONE"};
}

// The site's outline as GeoPackage polygon.
Bytes outline(DVec2 low, DVec2 size, std::int32_t srs) {
  constexpr std::size_t kSize = 4 + 4 + 1 + 3 * 4 + 5 * 16;
  Bytes out(kSize);
  std::size_t at = 0;
  const auto put = [&](const auto& value) {
    std::memcpy(out.data() + at, &value, sizeof value);
    at += sizeof value;
  };
  for (char c : {'G', 'P', '\0', '\1'}) put(c);
  put(srs);
  put('\1'), put(std::uint32_t{3}), put(std::uint32_t{1}), put(std::uint32_t{5});
  for (const DVec2 corner : {DVec2{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}) {
    const DVec2 p = low + corner * size;
    put(p.x), put(p.y);
  }
  return out;
}

// The sections of blobs that are grids, and the grid of each.
template <class Terrain, class Visit>
void each_grid(Terrain& t, const Visit& visit) {
  visit("height", t.height.grid());
  visit("exclusion", t.exclusion.grid());
  visit("density", t.density.grid());
  visit("area_cells", t.areas.grid());
  visit("ponds", t.ponds);
}

// A grid that is not there yet has one cell, and nothing in the file.
template <class T>
bool stored(const terrain::TiledGrid<T>& grid) {
  return grid.size() != IVec2{1};
}

// Large blobs are cut, so that a row is 64 to 256 kB.
constexpr std::size_t kPartBytes = std::size_t{256} << 10;
// Bundles compressed at a time: memory against the number of parallel loops.
constexpr std::size_t kBundlesAtOnce = 64;

using BlobKey = std::pair<std::int64_t, std::int64_t>;

std::string words_of_part(const std::string& section) {
  if (section == "height") return "the ground's height";
  if (section == "exclusion") return "areas barred from planting";
  if (section == "density") return "planting density";
  if (section == "area_cells") return "covers of areas";
  return section;
}

}  // namespace

// Writes one document; `next` is what the database will hold.
class StoreWriter {
 public:
  StoreWriter(Database& database, const ProjectStore::Known& before, const Document& document)
      : database_(database), before_(before), document_(document), next_(before) {
    next_.document = document, next_.any = true;
  }

  Result<ProjectStore::Known> write(const ProjectMeta& meta) {
    for (const auto& step : {&StoreWriter::write_place, &StoreWriter::write_texts, &StoreWriter::write_ground,
                             &StoreWriter::write_meshes, &StoreWriter::write_trees, &StoreWriter::write_digests})
      if (auto done = (this->*step)(); !done) return done.error();
    if (auto done = write_meta(meta); !done) return done.error();
    return std::move(next_);
  }

 private:
  const Document* before() const { return before_.any ? &before_.document : nullptr; }
  bool same_place() const {
    return before_.any && before_.document.place == document_.place &&
           before_.document.terrain->size_m() == document_.terrain->size_m();
  }

  // Reference system, contents and outline.
  Result<void> write_place() {
    const ReferenceSystem srs = reference_system(document_.place);
    srs_ = srs.id;
    if (same_place()) return {};
    if (auto done = database_.run("DELETE FROM gpkg_geometry_columns; DELETE FROM gpkg_contents; DELETE FROM site;"
                                  "DELETE FROM gpkg_spatial_ref_sys WHERE srs_id NOT IN (-1, 0, 4326)");
        !done)
      return done;
    if (srs.id > 0 && srs.id != 4326) {
      auto add = database_.prepare("INSERT INTO gpkg_spatial_ref_sys VALUES (?, ?, ?, ?, ?, NULL)");
      if (!add) return add.error();
      add->bind(0, srs.organization == "EPSG" ? fmt::format("EPSG:{}", srs.id) : std::string("Site"));
      add->bind(1, std::int64_t{srs.id}).bind(2, srs.organization).bind(3, std::int64_t{srs.id});
      add->bind(4, document_.place.crs_wkt);
      if (auto done = add->run(); !done) return done;
    }
    const DVec2 low = document_.place.south_west, size(document_.terrain->size_m());
    auto contents = database_.prepare(
        "INSERT INTO gpkg_contents (table_name, data_type, identifier, min_x, min_y, max_x, max_y, srs_id)"
        " VALUES (?1, ?2, ?1, ?3, ?4, ?5, ?6, ?7)");
    if (!contents) return contents.error();
    for (const char* table : {"trees", "site", "bosquet_meta"}) {
      const bool features = std::string_view(table) != "bosquet_meta";
      contents->bind(0, std::string_view(table)).bind(1, std::string_view(features ? "features" : "attributes"));
      if (features) {
        contents->bind(2, low.x).bind(3, low.y).bind(4, low.x + size.x).bind(5, low.y + size.y);
        contents->bind(6, std::int64_t{srs_});
      } else {
        for (int place = 2; place < 7; ++place) contents->bind_null(place);
      }
      if (auto done = contents->run(); !done) return done;
    }
    if (auto done =
            database_.run(fmt::format("INSERT INTO gpkg_geometry_columns VALUES ('trees', 'geom', 'POINT', {0}, "
                                      "0, 0), ('site', 'geom', 'POLYGON', {0}, 0, 0)",
                                      srs_));
        !done)
      return done;
    auto site = database_.prepare("INSERT INTO site (id, geom, name) VALUES (1, ?, 'site')");
    if (!site) return site.error();
    const Bytes ring = outline(low, size, srs_);
    site->bind(0, std::span<const std::byte>(ring));
    return site->run();
  }

  Result<void> write_texts() {
    auto put = database_.prepare(
        "INSERT INTO bosquet_text (section, number, name, json) VALUES (?1, ?2, ?3, ?4)"
        " ON CONFLICT (section, number) DO UPDATE SET name = excluded.name, json = excluded.json");
    if (!put) return put.error();
    auto cut = database_.prepare("DELETE FROM bosquet_text WHERE section = ?1 AND number >= ?2");
    if (!cut) return cut.error();
    for (const char* section : kTextSections) {
      std::vector<Hash128>& hashes = next_.texts[section];
      const std::size_t old = hashes.size();
      const std::vector<TextRow> rows = text_rows(section, document_, before());
      hashes.resize(rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].json.empty()) continue;  // as before
        const Hash128 hash = Hasher128().add(rows[i].name).add(rows[i].json).digest();
        if (i < old && hash == hashes[i]) continue;
        hashes[i] = hash;
        put->bind(0, std::string_view(section)).bind(1, static_cast<std::int64_t>(i));
        put->bind(2, rows[i].name).bind(3, rows[i].json);
        if (auto done = put->run(); !done) return done;
      }
      if (rows.size() < old) {
        cut->bind(0, std::string_view(section)).bind(1, static_cast<std::int64_t>(rows.size()));
        if (auto done = cut->run(); !done) return done;
      }
      Hasher128 all;
      for (const Hash128& hash : hashes) all.add(hash);
      digest(section, all.digest(), rows.size());
    }
    return {};
  }

  Result<void> put_blob(const std::string& section, BlobKey key, std::size_t size, const Hash128& checksum,
                        std::span<const std::byte> data) {
    if (!put_blob_) {
      auto put = database_.prepare(
          "INSERT INTO bosquet_blob (section, item, part, size, checksum, data) VALUES (?1, ?2, ?3, ?4, ?5, ?6)"
          " ON CONFLICT (section, item, part) DO UPDATE SET size = excluded.size, checksum = excluded.checksum,"
          " data = excluded.data");
      if (!put) return put.error();
      put_blob_ = std::move(*put);
    }
    next_.blobs[section][key] = checksum;
    put_blob_->bind(0, section).bind(1, key.first).bind(2, key.second).bind(3, static_cast<std::int64_t>(size));
    put_blob_->bind(4, hex_digits(checksum)).bind(5, data);
    return put_blob_->run();
  }

  // Rows of a section that the document has no more.
  Result<void> cut_blobs(const std::string& section, const std::set<BlobKey>& wanted) {
    auto& known = next_.blobs[section];
    for (auto it = known.begin(); it != known.end();) {
      if (wanted.contains(it->first)) {
        ++it;
        continue;
      }
      if (auto done =
              database_.run(fmt::format("DELETE FROM bosquet_blob WHERE section = '{}' AND item = {} AND part = {}",
                                        section, it->first.first, it->first.second));
          !done)
        return done;
      it = known.erase(it);
    }
    return {};
  }

  void digest_blobs(const std::string& section) {
    Hasher128 all;
    const auto& known = next_.blobs[section];
    for (const auto& [key, hash] : known)
      all.add(static_cast<std::uint64_t>(key.first)).add(static_cast<std::uint64_t>(key.second)).add(hash);
    digest(section, all.digest(), known.size());
  }

  Result<void> write_ground() {
    Result<void> done;
    const terrain::Terrain& ground = *document_.terrain;
    if (before() && before()->terrain == document_.terrain) return {};
    each_grid(ground, [&](const char* section, const auto& grid) {
      if (done) done = write_grid(section, grid);
    });
    return done;
  }

  template <class T>
  Result<void> write_grid(const std::string& section, const terrain::TiledGrid<T>& grid) {
    const terrain::TiledGrid<T>* old = nullptr;
    if (before())
      each_grid(*before()->terrain, [&](const char* name, const auto& other) {
        if constexpr (std::is_same_v<std::decay_t<decltype(other)>, terrain::TiledGrid<T>>)
          if (section == name && other.size() == grid.size()) old = &other;
      });
    if (old && old->shares_all(grid)) return {};
    std::set<BlobKey> wanted;
    if (stored(grid)) {
      const Bundles<T> bundles(grid.tiles());
      auto& known = next_.blobs[section];
      std::vector<std::size_t> changed;
      for (std::size_t b = 0; b < bundles.size(); ++b) {
        wanted.insert({0, static_cast<std::int64_t>(b)});
        bool same = old && known.contains({0, static_cast<std::int64_t>(b)});
        if (same) bundles.for_each(b, [&](IVec2 t) { same = same && old->shares_tile(grid, t); });
        if (!same) changed.push_back(b);
      }
      for (std::size_t begin = 0; begin < changed.size(); begin += kBundlesAtOnce) {
        const std::size_t n = std::min(kBundlesAtOnce, changed.size() - begin);
        std::vector<Bytes> data(n);
        std::vector<Hash128> checksum(n);
        std::vector<std::size_t> size(n);
        const auto pack = [&](std::size_t i) {
          const Bytes raw = bytes_of(grid, changed[begin + i]);
          checksum[i] = Hasher128().add(std::span<const std::byte>(raw)).digest();
          size[i] = raw.size();
          data[i] = compress(raw);
        };
        // A stroke touches a few: no other thread is woken for them.
        if (n <= 4)
          for (std::size_t i = 0; i < n; ++i) pack(i);
        else
          parallel_for(n, pack);
        for (std::size_t i = 0; i < n; ++i) {
          const BlobKey key{0, static_cast<std::int64_t>(changed[begin + i])};
          if (const auto found = known.find(key); found != known.end() && found->second == checksum[i]) continue;
          if (auto done = put_blob(section, key, size[i], checksum[i], data[i]); !done) return done;
        }
      }
    }
    if (auto done = cut_blobs(section, wanted); !done) return done;
    digest_blobs(section);
    return {};
  }

  // Obstacle meshes and hero skeletons, each under its id.
  template <class Item, class Get>
  Result<void> write_shapes(const std::string& section, const SharedList<Item>& items, const SharedList<Item>* old,
                            const Get& get) {
    if (old && old->shares(items)) return {};
    std::map<std::int32_t, const void*> there;
    if (old)
      for (const Item& item : *old) there.emplace(item.id, get(item).get());
    std::set<BlobKey> wanted;
    for (const Item& item : items) {
      const auto& shape = get(item);
      if (!shape) continue;
      if (const auto found = there.find(item.id); found != there.end() && found->second == shape.get()) {
        for (const auto& [key, hash] : next_.blobs[section])
          if (key.first == item.id) wanted.insert(key);
        continue;
      }
      const Bytes bytes = bytes_of(*shape);
      for (std::size_t part = 0, at = 0; at < bytes.size(); ++part, at += kPartBytes) {
        const auto piece = std::span(bytes).subspan(at, std::min(kPartBytes, bytes.size() - at));
        const BlobKey key{item.id, static_cast<std::int64_t>(part)};
        wanted.insert(key);
        if (auto done = put_blob(section, key, piece.size(), Hasher128().add(piece).digest(), compress(piece)); !done)
          return done;
      }
    }
    if (auto done = cut_blobs(section, wanted); !done) return done;
    digest_blobs(section);
    return {};
  }

  Result<void> write_meshes() {
    if (auto done = write_shapes(
            "mesh", document_.obstacles, before() ? &before()->obstacles : nullptr,
            [](const Obstacle& o) -> const auto& { return o.mesh; });
        !done)
      return done;
    return write_shapes(
        "skeleton", document_.heroes, before() ? &before()->heroes : nullptr,
        [](const HeroTree& h) -> const auto& { return h.skeleton; });
  }

  Result<void> write_trees() {
    const Trees& now = *document_.trees;
    const std::vector<std::string> labels = species_labels(document_);
    // A tree's row tells its species by name and its place in the site's coordinates.
    const bool all = !same_place() || !begins_with(labels, species_labels(before_.document));
    if (!all && before_.document.trees == document_.trees) return {};
    auto rows = TreeRows::writer(database_, document_, srs_);
    if (!rows) return rows.error();
    if (all) {
      if (auto done = database_.run("DELETE FROM trees"); !done) return done;
      for (const Tree& tree : now)
        if (auto done = rows->put(tree); !done) return done;
    } else if (auto done = write_changed_trees(*rows, *before_.document.trees, now); !done) {
      return done;
    }
    Hasher128 digests;
    for (const Tree& tree : now) digests.add(TreeRows::hash(tree, document_.place, labels, srs_));
    digest("trees", digests.digest(), now.size());
    return {};
  }

  static bool begins_with(const std::vector<std::string>& labels, const std::vector<std::string>& old) {
    return old.size() <= labels.size() && std::equal(old.begin(), old.end(), labels.begin());
  }

  // Trees of blocks that only one of the documents has, by id.
  static Result<void> write_changed_trees(TreeRows& rows, const Trees& old, const Trees& now) {
    std::set<const Trees::Block*> shared;
    for (const auto& block : old.blocks()) shared.insert(block.get());
    std::vector<const Tree*> came, went;
    std::set<const Trees::Block*> kept;
    for (const auto& block : now.blocks()) {
      if (shared.contains(block.get()))
        kept.insert(block.get());
      else
        for (const Tree& tree : *block) came.push_back(&tree);
    }
    for (const auto& block : old.blocks())
      if (!kept.contains(block.get()))
        for (const Tree& tree : *block) went.push_back(&tree);
    std::size_t w = 0;
    for (const Tree* tree : came) {
      for (; w < went.size() && went[w]->id < tree->id; ++w)
        if (auto done = rows.remove(went[w]->id); !done) return done;
      const bool there = w < went.size() && went[w]->id == tree->id;
      if (there && *went[w] == *tree) {
        ++w;
        continue;
      }
      if (there) ++w;
      if (auto done = rows.put(*tree); !done) return done;
    }
    for (; w < went.size(); ++w)
      if (auto done = rows.remove(went[w]->id); !done) return done;
    return {};
  }

  void digest(const std::string& section, const Hash128& hash, std::size_t rows) { digests_[section] = {hash, rows}; }

  Result<void> write_digests() {
    auto put = database_.prepare(
        "INSERT INTO bosquet_digest (section, rows, digest) VALUES (?1, ?2, ?3)"
        " ON CONFLICT (section) DO UPDATE SET rows = excluded.rows, digest = excluded.digest");
    if (!put) return put.error();
    for (const auto& [section, what] : digests_) {
      const auto& [hash, rows] = what;
      if (const auto old = before_.digests.find(section); old != before_.digests.end() && old->second == hash) continue;
      next_.digests[section] = hash;
      put->bind(0, section).bind(1, static_cast<std::int64_t>(rows)).bind(2, hex_digits(hash));
      if (auto done = put->run(); !done) return done;
    }
    return {};
  }

  Result<void> write_meta(const ProjectMeta& meta) {
    auto put = database_.prepare(
        "INSERT INTO bosquet_meta (name, value) VALUES (?1, ?2) ON CONFLICT (name) DO UPDATE SET value = "
        "excluded.value");
    if (!put) return put.error();
    ProjectMeta all = meta;
    all["format"] = std::to_string(kProjectFormat);
    for (const auto& [name, value] : all) {
      if (const auto old = before_.meta.find(name); old != before_.meta.end() && old->second == value) continue;
      next_.meta[name] = value;
      put->bind(0, name).bind(1, value);
      if (auto done = put->run(); !done) return done;
    }
    return {};
  }

  Database& database_;
  const ProjectStore::Known& before_;
  const Document& document_;
  ProjectStore::Known next_;
  std::int32_t srs_ = -1;
  std::optional<Statement> put_blob_;
  std::map<std::string, std::pair<Hash128, std::size_t>> digests_;
};

// Reads one database.
class StoreReader {
 public:
  explicit StoreReader(Database& database) : database_(database) {}

  Result<StoredDocument> read(ProjectStore::Known& known) {
    read_meta();
    read_stored_digests();
    read_texts();
    if (auto done = read_ground(); !done) return done.error();
    read_blobs();
    finish_grids();
    finish_shapes();
    read_all_trees();
    // Counters never give an id twice, whatever the file says.
    settle_counters(document());
    if (out_.problems.empty() && !out_.trees_edited) {
      known.any = true, known.document = document(), known.texts = std::move(texts_), known.blobs = std::move(blobs_);
      known.digests = std::move(digests_), known.meta = out_.meta;
    } else {
      known = {};
    }
    return std::move(out_);
  }

 private:
  Document& document() { return out_.document; }
  void problem(std::string words) { out_.problems.push_back(std::move(words)); }

  void read_meta() {
    auto rows = database_.prepare("SELECT name, value FROM bosquet_meta");
    if (!rows) return problem("facts about the file");
    while (rows->step()) out_.meta[std::string(rows->text(0))] = rows->text(1);
    if (rows->failed()) problem("facts about the file");
  }

  void read_stored_digests() {
    auto rows = database_.prepare("SELECT section, rows, digest FROM bosquet_digest");
    if (!rows) return problem("checksums of the sections");
    while (rows->step())
      stored_[std::string(rows->text(0))] = {std::string(rows->text(2)),
                                             static_cast<std::size_t>(std::max<std::int64_t>(0, rows->integer(1)))};
    if (rows->failed()) problem("checksums of the sections");
  }

  // Whether a section is what was saved.
  bool check(const std::string& section, const Hash128& hash, std::size_t rows) {
    digests_[section] = hash;
    const auto found = stored_.find(section);
    return found != stored_.end() && found->second.second == rows && found->second.first == hex_digits(hash);
  }
  std::size_t stored_rows(const std::string& section) const {
    const auto found = stored_.find(section);
    return found == stored_.end() ? 0 : found->second.second;
  }

  // All rows of a table, whatever pages are damaged: from the front, then what lies behind from the back.
  template <class Take>
  void scan(const std::string& columns, const std::string& table, const Take& take) {
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    auto forward = database_.prepare(fmt::format("SELECT id, {} FROM {} NOT INDEXED ORDER BY id", columns, table));
    if (!forward) return problem(forward.error().message);
    while (forward->step()) last = std::max(last, forward->integer(0)), take(*forward);
    if (!forward->failed()) return;
    if (auto backward =
            database_.prepare(fmt::format("SELECT id, {} FROM {} NOT INDEXED ORDER BY id DESC", columns, table)))
      while (backward->step() && backward->integer(0) > last) take(*backward);
  }

  void read_texts() {
    std::map<std::string, std::map<std::int64_t, TextRow>> found;
    scan("section, number, name, json", "bosquet_text", [&](Statement& row) {
      if (row.is_integer(2) && row.integer(2) >= 0)
        found[std::string(row.text(1))][row.integer(2)] = {std::string(row.text(3)), std::string(row.text(4))};
    });
    for (const char* section : kTextSections) {
      const auto& there = found[section];
      // As many rows as were saved; a missing one keeps the places of the others. A count that is none is not believed.
      const std::size_t last = there.empty() ? 0 : static_cast<std::size_t>(there.rbegin()->first) + 1;
      std::size_t n = std::max(there.size(), std::min(stored_rows(section), there.size() + 1000));
      if (last > n && last <= there.size() + 1000) n = last;
      std::vector<TextRow> rows(n);
      std::vector<Hash128>& hashes = texts_[section];
      Hasher128 all;
      for (std::size_t i = 0; i < n; ++i) {
        if (const auto row = there.find(static_cast<std::int64_t>(i)); row != there.end()) rows[i] = row->second;
        hashes.push_back(Hasher128().add(rows[i].name).add(rows[i].json).digest());
        all.add(hashes.back());
      }
      const std::size_t before = text_.problems.size();
      text_.read(section, rows);
      if (!check(section, all.digest(), n) && text_.problems.size() == before)
        text_.problems.push_back(fmt::format("{}: not what was saved", section));
    }
    for (std::string& words : text_.problems) problem(std::move(words));
  }

  Result<void> read_ground() {
    if (!text_.ground) {
      // The outline still tells the site's size.
      auto site = database_.prepare("SELECT min_x, min_y, max_x, max_y FROM gpkg_contents WHERE table_name = 'site'");
      if (site && site->step()) {
        const Vec2 size(static_cast<float>(site->number(2) - site->number(0)),
                        static_cast<float>(site->number(3) - site->number(1)));
        if (auto lattice = terrain::make_lattice(size)) text_.ground = GroundFrame{*lattice, std::nullopt};
      }
    }
    if (!text_.ground) return Error{fmt::format("{}: the site itself cannot be read", database_.file())};
    const terrain::Lattice& lattice = text_.ground->lattice;
    ground_ = terrain::make_terrain(terrain::Heightfield(lattice));
    ground_.water_level_m = text_.ground->water_level_m;
    for (const terrain::Area& area : text_.areas)
      if (ground_.areas.add(lattice, area) == 0) problem(fmt::format("area '{}'", area.name));
    return {};
  }

  // What a grid is to be like, as the ground's frame says; 0 cells when it has none in the file.
  IVec2 cells_of(const std::string& section) const {
    const GroundFrame& frame = *text_.ground;
    if (section == "height") return frame.lattice.cells + 1;
    if (section == "area_cells") return ground_.areas.empty() ? IVec2{1} : frame.areas;
    if (section == "ponds") return frame.ponds;
    return frame.lattice.cells;
  }

  void read_blobs() {
    scan("section, item, part, size, checksum, data", "bosquet_blob", [&](Statement& row) {
      const std::string section(row.text(1));
      const BlobKey key{row.integer(2), row.integer(3)};
      const std::int64_t size = row.integer(4);
      constexpr std::int64_t kMost = std::int64_t{1} << 20;
      auto bytes = size >= 0 && size <= kMost && row.is_blob(6)
                       ? decompress(row.bytes(6), static_cast<std::size_t>(size))
                       : std::nullopt;
      if (!bytes) return;
      const Hash128 hash = Hasher128().add(std::span<const std::byte>(*bytes)).digest();
      if (row.text(5) != hex_digits(hash)) return;
      blobs_[section][key] = hash;
      data_[section][key] = std::move(*bytes);
    });
  }

  void finish_grids() {
    each_grid(ground_, [&](const char* section, auto& grid) { finish_grid(section, grid); });
    out_.document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground_));
  }

  template <class T>
  void finish_grid(const std::string& section, terrain::TiledGrid<T>& grid) {
    const IVec2 cells = cells_of(section);
    const auto& parts = data_[section];
    std::size_t lost = 0, all = 0;
    if (cells != IVec2{1}) {
      const auto first = parts.find({0, 0});
      const T everywhere = first == parts.end() ? grid.at(0, 0) : first_value<T>(first->second);
      Bytes value(Bundles<T>::kValue);
      if (first != parts.end() && first->second.size() >= value.size())
        std::copy_n(first->second.begin(), value.size(), value.begin());
      grid = terrain::TiledGrid<T>(cells, everywhere);
      const Bundles<T> bundles(grid.tiles());
      terrain::TileEditor<T> editor(grid);
      all = bundles.size();
      for (std::size_t b = 0; b < all; ++b) {
        const auto found = parts.find({0, static_cast<std::int64_t>(b)});
        if (found == parts.end() || found->second.size() != bundles.bytes(b) || !sound<T>(found->second))
          ++lost;
        else
          put_bytes(editor, bundles, b, found->second, value);
      }
    }
    if (lost) problem(fmt::format("{}: {} of {} parts", words_of_part(section), lost, all));
    check_blobs(section, lost == 0);
    data_.erase(section);
  }

  // Values that later stages rely on: heights are numbers, areas are in the table.
  template <class T>
  bool sound(const Bytes& bytes) const {
    constexpr std::size_t kValue = Bundles<T>::kValue;
    if constexpr (std::is_same_v<T, float>) {
      for (std::size_t at = 0; at < bytes.size(); at += kValue)
        if (!std::isfinite(first_value<T>(std::span(bytes).subspan(at)))) return false;
    } else if constexpr (std::is_same_v<T, terrain::AreaCell>) {
      for (std::size_t at = 0; at < bytes.size(); at += kValue) {
        const auto cell = first_value<T>(std::span(bytes).subspan(at));
        if (cell.top >= ground_.areas.count() || cell.under >= ground_.areas.count()) return false;
      }
    } else if constexpr (std::is_same_v<T, terrain::AreaId>) {
      for (std::size_t at = 0; at < bytes.size(); at += kValue)
        if (first_value<T>(std::span(bytes).subspan(at)) >= ground_.areas.count()) return false;
    }
    return true;
  }

  void check_blobs(const std::string& section, bool complete) {
    Hasher128 all;
    const auto& known = blobs_[section];
    for (const auto& [key, hash] : known)
      all.add(static_cast<std::uint64_t>(key.first)).add(static_cast<std::uint64_t>(key.second)).add(hash);
    if (!check(section, all.digest(), known.size()) && complete && (stored_.contains(section) || !known.empty()))
      problem(fmt::format("{}: not what was saved", words_of_part(section)));
  }

  // The bytes of one item, its parts joined; empty when there is none.
  Bytes joined(const std::string& section, std::int32_t item) {
    Bytes out;
    const auto& parts = data_[section];
    std::int64_t next = 0;
    for (auto it = parts.lower_bound({item, 0}); it != parts.end() && it->first == BlobKey{item, next}; ++it, ++next)
      out.insert(out.end(), it->second.begin(), it->second.end());
    return out;
  }

  void finish_shapes() {
    bool complete = true;
    std::vector<Obstacle> obstacles;
    for (Obstacle o : document().obstacles) {
      const Bytes bytes = joined("mesh", o.id);
      if (auto mesh = mesh_of(bytes)) {
        o.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
        obstacles.push_back(std::move(o));
      } else {
        complete = false, problem(fmt::format("obstacle '{}'", o.name));
      }
    }
    document().obstacles = std::move(obstacles);
    check_blobs("mesh", complete);

    complete = true;
    std::vector<HeroTree> heroes;
    for (HeroTree h : document().heroes) {
      auto skeleton = skeleton_of(joined("skeleton", h.id));
      if (skeleton && h.species < document().species.size()) {
        h.skeleton = std::make_shared<const growth::Skeleton>(std::move(*skeleton));
        heroes.push_back(std::move(h));
      } else {
        complete = false, problem(fmt::format("hero tree '{}'", h.name));
      }
    }
    document().heroes = std::move(heroes);
    check_blobs("skeleton", complete);
    data_.clear();
  }

  void read_all_trees() {
    ReadTrees read = read_trees(database_, document());
    Hasher128 all;
    for (const Hash128& hash : read.hashes) all.add(hash);
    const std::size_t saved = stored_rows("trees");
    const bool same = check("trees", all.digest(), read.trees.size());
    if (document().species.empty() && !read.trees.empty()) {
      problem("all species");
      if (auto oak = builtin_species("english_oak"))
        document().species = {std::make_shared<const Species>(std::move(*oak))};
    }
    if (!read.whole)
      problem(saved > read.trees.size() ? fmt::format("trees: {} of {}", saved - read.trees.size(), saved)
                                        : "trees: an unknown number");
    else if (!same)
      out_.trees_edited = true;
    for (std::string& note : read.notes) (out_.trees_edited ? out_.notes : out_.problems).push_back(std::move(note));
    document().trees = std::make_shared<const Trees>(std::move(read.trees));
  }

  Database& database_;
  StoredDocument out_;
  TextReader text_{out_.document, {}, {}, {}};
  terrain::Terrain ground_;
  std::map<std::string, std::pair<std::string, std::size_t>> stored_;  // digests as the file has them
  std::map<std::string, std::vector<Hash128>> texts_;
  std::map<std::string, std::map<BlobKey, Hash128>> blobs_;
  std::map<std::string, std::map<BlobKey, Bytes>> data_;
  std::map<std::string, Hash128> digests_;
};

Result<void> ProjectStore::create_tables(Database& database) {
  if (auto done = database.run(kPragmas); !done) return done;
  if (auto done = database.run(kTables); !done) return done;
  return database.run(tree_table());
}

Result<void> ProjectStore::write(Database& database, const Document& document, const ProjectMeta& meta) {
  if (auto begun = database.run("BEGIN IMMEDIATE"); !begun) return begun;
  auto next = StoreWriter(database, known_, document).write(meta);
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
  auto read = StoreReader(database).read(known_);
  (void)database.run("COMMIT").operator bool();
  return read;
}

bool ProjectStore::holds_what_is_known(Database& database) const {
  ProjectStore other;
  const auto read = other.read(database);
  return read && read->problems.empty() && !read->trees_edited && other.known_.digests == known_.digests;
}

}  // namespace bosquet::scene
