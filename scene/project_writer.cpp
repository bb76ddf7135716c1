#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <set>

#include "core/parallel.h"
#include "scene/project_blob.h"
#include "scene/project_rows.h"
#include "scene/project_text.h"
#include "scene/project_trees.h"

namespace bosquet::scene {
namespace {

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

// A grid that is not there yet has one cell, and nothing in the file.
template <class T>
bool stored(const terrain::TiledGrid<T>& grid) {
  return grid.size() != IVec2{1};
}

// Large blobs are cut, so that a row is 64 to 256 kB.
constexpr std::size_t kPartBytes = std::size_t{256} << 10;
// Bundles compressed at a time: memory against the number of parallel loops.
constexpr std::size_t kBundlesAtOnce = 64;

// Writes one document; `next` is what the database will hold.
class StoreWriter {
 public:
  StoreWriter(Database& database, const KnownRows& before, const Document& document)
      : database_(database), before_(before), document_(document), next_(before) {
    next_.document = document, next_.any = true;
  }

  Result<KnownRows> write(const ProjectMeta& meta) {
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
  const KnownRows& before_;
  const Document& document_;
  KnownRows next_;
  std::int32_t srs_ = -1;
  std::optional<Statement> put_blob_;
  std::map<std::string, std::pair<Hash128, std::size_t>> digests_;
};

}  // namespace

Result<KnownRows> write_rows(Database& database, const KnownRows& before, const Document& document,
                             const ProjectMeta& meta) {
  return StoreWriter(database, before, document).write(meta);
}

}  // namespace bosquet::scene
