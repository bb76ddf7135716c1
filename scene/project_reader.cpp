#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "scene/project_blob.h"
#include "scene/project_rows.h"
#include "scene/project_text.h"
#include "scene/project_trees.h"

namespace bosquet::scene {
namespace {

std::string words_of_part(const std::string& section) {
  if (section == "height") return "the ground's height";
  if (section == "exclusion") return "areas barred from planting";
  if (section == "density") return "planting density";
  if (section == "area_cells") return "covers of areas";
  return section;
}

// Reads one database.
class StoreReader {
 public:
  explicit StoreReader(Database& database) : database_(database) {}

  Result<StoredDocument> read(KnownRows& known) {
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
      // Files from before there were figures say nothing of them.
      const bool unknown = n == 0 && std::string_view(section) == "figures" && !stored_.contains(section);
      if (!check(section, all.digest(), n) && !unknown && text_.problems.size() == before)
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

}  // namespace

Result<StoredDocument> read_rows(Database& database, KnownRows& known) { return StoreReader(database).read(known); }

}  // namespace bosquet::scene
