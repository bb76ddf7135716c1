#include "scene/document_digest.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/hash.h"
#include "scene/species.h"
#include "terrain/difference.h"

namespace bosquet::scene {
namespace {

/// Two hashes side by side, of the same words.
class Hasher128 {
 public:
  void word(std::uint64_t w) {
    a_ = (a_ ^ w) * 0x9e3779b97f4a7c15ull, a_ ^= a_ >> 32;
    b_ = mix_bits(b_ + w) + 0xd1b54a32d192ed03ull;
  }
  template <class T>
  requires std::is_integral_v<T> || std::is_enum_v<T> Hasher128& add(T v) {
    word(static_cast<std::uint64_t>(static_cast<std::int64_t>(v)));
    return *this;
  }
  Hasher128& add(float v) { return word(std::bit_cast<std::uint32_t>(v + 0.0f)), *this; }
  Hasher128& add(double v) { return word(std::bit_cast<std::uint64_t>(v + 0.0)), *this; }
  Hasher128& add(Vec2 v) { return add(v.x).add(v.y); }
  Hasher128& add(const Vec3& v) { return add(v.x).add(v.y).add(v.z); }
  Hasher128& add(std::string_view text) {
    word(text.size());
    std::uint64_t w = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      w = w << 8 | static_cast<unsigned char>(text[i]);
      if (i % 8 == 7 || i + 1 == text.size()) word(w), w = 0;
    }
    return *this;
  }
  Hasher128& add(const std::string& text) { return add(std::string_view(text)); }
  template <class T>
  Hasher128& add(const std::optional<T>& v) {
    add(v.has_value());
    if (v) add(*v);
    return *this;
  }
  Digest128 digest() const { return {mix_bits(a_ + b_), mix_bits(mix_bits(a_) ^ b_)}; }

 private:
  std::uint64_t a_ = 0x243f6a8885a308d3ull, b_ = 0x13198a2e03707344ull;
};

Digest128& operator+=(Digest128& sum, const Digest128& d) {
  const std::uint64_t low = sum.low + d.low;
  sum.high += d.high + (low < sum.low);
  sum.low = low;
  return sum;
}
Digest128& operator-=(Digest128& sum, const Digest128& d) {
  sum.high -= d.high + (sum.low < d.low);
  sum.low -= d.low;
  return sum;
}

/// Adds every described field, with its name.
struct Describer {
  Hasher128& hash;
  template <class Info, class Value>
  void operator()(const Info& info, const Value& v) {
    hash.add(info.name);
    if constexpr (requires { hash.add(v); }) {
      hash.add(v);
    } else {  // tables
      hash.add(v.size());
      for (const auto& item : v) describe(item, *this);
    }
  }
};

template <class P>
void add_described(Hasher128& hash, const P& parameters) {
  Describer visit{hash};
  describe(parameters, visit);
}

Digest128 of_tree(const Tree& tree) {
  Hasher128 hash;
  hash.add(tree.id).add(tree.key).add(tree.species).add(tree.at).add(tree.scale_height).add(tree.scale_width);
  hash.add(tree.trunk_diameter_m).add(tree.measured).add(tree.status).add(tree.clear_stem_m);
  const crowns::ClippedForm& form = tree.form;
  hash.add(form.kind).add(form.width_m).add(form.depth_m).add(form.height_m).add(form.rotation_deg).add(form.centre);
  hash.add(tree.inventory_name).add(tree.inventory_id).add(tree.locked);
  hash.add(tree.overrides.size());
  for (const ParameterOverride& o : tree.overrides) {
    hash.add(o.key).add(o.value.index());
    std::visit([&](const auto& v) { hash.add(v); }, o.value);
  }
  hash.add(tree.studio_edits.size());
  for (const std::string& operation : tree.studio_edits) hash.add(operation);
  return hash.digest();
}

Digest128 of_species(const Species& species) {
  Hasher128 hash;
  hash.add(species.name).add(species.botanical_name).add(species.common_names.size());
  for (const std::string& name : species.common_names) hash.add(name);
  hash.add(species.genus_words.size());
  for (const std::string& word : species.genus_words) hash.add(word);
  hash.add(species.derived);
  add_described(hash, species.shape);
  add_described(hash, species.planting);
  add_described(hash, species.growth);
  add_described(hash, species.look);
  Describer visit{hash};
  geometry::describe_foliage(species.foliage, visit);
  add_described(hash, species.allometry);
  hash.add(species.sizes.size());
  for (const OpenGrownSize& size : species.sizes) add_described(hash, size);
  return hash.digest();
}

void add_mesh(Hasher128& hash, const TriangleMesh& mesh) {
  hash.add(mesh.positions.size());
  for (const Vec3& p : mesh.positions) hash.add(p);
  hash.add(mesh.indices.size());
  for (std::uint32_t i : mesh.indices) hash.word(i);
}

Digest128 of_obstacle(const Obstacle& o) {
  Hasher128 hash;
  hash.add(o.id).add(o.name).add(o.low_y).add(o.high_y).add(o.outline != nullptr);
  // The prism follows from its outline.
  if (o.outline) {
    hash.add(o.outline->ring.size());
    for (Vec2 p : o.outline->ring) hash.add(p);
    hash.add(o.outline->holes.size());
    for (const auto& hole : o.outline->holes) {
      hash.add(hole.size());
      for (Vec2 p : hole) hash.add(p);
    }
  } else {
    add_mesh(hash, *o.mesh);
  }
  return hash.digest();
}

Digest128 of_hero(const HeroTree& h) {
  Hasher128 hash;
  hash.add(h.id).add(h.name).add(h.species).add(h.key).add(h.at);
  const growth::Skeleton& s = *h.skeleton;
  hash.add(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    hash.add(s.parent[i]).add(s.axis[i]).add(s.order[i]).add(s.distal[i]).add(s.radius[i]).add(s.born[i]);
    hash.add(s.shed[i]).add(s.light[i]).add(s.vigor[i]).add(s.own_pipes(i));
  }
  hash.add(s.seasons).add(s.internode_length_m).add(s.detail).add(s.tip_diameter_m).add(s.pipe_exponent);
  return hash.digest();
}

void add_value(Hasher128& hash, float v) { hash.add(v); }
void add_value(Hasher128& hash, std::uint8_t v) { hash.word(v); }
void add_value(Hasher128& hash, terrain::AreaId v) { hash.word(v); }
void add_value(Hasher128& hash, const terrain::AreaCell& c) {
  // An area that covers nothing or is covered wholly is not told.
  hash.word(std::uint64_t{c.top} << 32 | std::uint64_t{c.under} << 16 | c.cover);
}

/// A tile with its place, without what lies beyond the grid's edge.
template <class T>
Digest128 of_tile(const terrain::TiledGrid<T>& grid, IVec2 tile, int which) {
  constexpr int kEdge = terrain::TiledGrid<T>::kTile;
  Hasher128 hash;
  hash.add(which).add(tile.x).add(tile.y);
  const IVec2 in = glm::min(grid.size() - tile * kEdge, IVec2(kEdge));
  const auto& values = grid.tile(tile);
  for (int j = 0; j < in.y; ++j)
    for (int i = 0; i < in.x; ++i) add_value(hash, values[terrain::TiledGrid<T>::inside(i, j)]);
  return hash.digest();
}

template <class T>
Digest128 of_grid(const terrain::TiledGrid<T>& grid, int which) {
  Digest128 sum;
  for (int y = 0; y < grid.tiles().y; ++y)
    for (int x = 0; x < grid.tiles().x; ++x) sum += of_tile(grid, {x, y}, which);
  return sum;
}

/// What the tiles' digests add up to after an edit.
template <class T>
void update_grid(Digest128& sum, const terrain::TiledGrid<T>& before, const terrain::TiledGrid<T>& after, int which) {
  if (before.size() != after.size()) {
    sum = of_grid(after, which);
    return;
  }
  for (IVec2 tile : terrain::changed_tiles(before, after)) {
    sum -= of_tile(before, tile, which);
    sum += of_tile(after, tile, which);
  }
}

enum Grid { kHeight, kExclusion, kDensity, kAreas, kPonds, kGrids };
using GridSums = std::array<Digest128, kGrids>;

Digest128 of_ground(const terrain::Terrain& ground, const GridSums& sums) {
  Hasher128 hash;
  const terrain::Lattice& lattice = ground.height.lattice();
  hash.add(lattice.size_m).add(lattice.cell_m).add(lattice.cells.x).add(lattice.cells.y).add(ground.water_level_m);
  hash.add(ground.areas.count());
  for (const terrain::Area& area : ground.areas.all())
    hash.add(area.name).add(area.kind).add(area.cover).add(area.water_level_m);
  for (const Digest128& sum : sums) hash.word(sum.high), hash.word(sum.low);
  return hash.digest();
}

GridSums grid_sums(const terrain::Terrain& t) {
  return {of_grid(t.height.grid(), kHeight), of_grid(t.exclusion.grid(), kExclusion),
          of_grid(t.density.grid(), kDensity), of_grid(t.areas.grid(), kAreas), of_grid(t.ponds, kPonds)};
}

template <class List, class Of>
Digest128 of_list(const List& list, const Of& of) {
  Hasher128 hash;
  hash.add(list.size());
  for (const auto& item : list) {
    const Digest128 d = of(item);
    hash.word(d.high), hash.word(d.low);
  }
  return hash.digest();
}

Digest128 of_site(const Document& d) {
  Hasher128 hash;
  hash.add(d.seed).add(d.place.latitude_deg).add(d.place.longitude_deg);
  hash.add(d.place.south_west.x).add(d.place.south_west.y).add(d.place.crs_wkt);
  hash.add(d.next_tree_id).add(d.next_standing_id).add(d.next_block);
  return hash.digest();
}

Digest128 of_planting(const Document& d) {
  Hasher128 hash;
  hash.add(d.interactions.size());
  for (const distribution::Interaction& i : d.interactions) add_described(hash, i);
  hash.add(d.species_bar.size());
  for (const distribution::MixEntry& e : d.species_bar)
    hash.add(e.species).add(e.probability).add(e.scale_min).add(e.scale_max);
  return hash.digest();
}

Digest128 of_settings(const Document& d) {
  Hasher128 hash;
  add_described(hash, d.space);
  hash.add(d.space.keep_ticks);
  add_described(hash, d.asymmetry);
  add_described(hash, d.light);
  hash.add(d.cameras.size());
  for (const Camera& c : d.cameras) hash.add(c.name).add(c.eye).add(c.target).add(c.vertical_fov_deg);
  // Files from before there were figures keep their digests.
  if (!d.figures.empty()) hash.add(d.figures.size());
  for (const Figure& f : d.figures) hash.add(f.at).add(f.heading_deg);
  hash.add(d.sun.azimuth_deg).add(d.sun.elevation_deg).add(d.max_triangles);
  add_described(hash, d.clearance);
  add_described(hash, d.plan);
  add_described(hash, d.underlay);
  hash.add(d.underlay.file).add(d.underlay.south_west.x).add(d.underlay.south_west.y);
  // Files from before there was grass keep their digests.
  if (d.ground_cover != GroundCover{}) add_described(hash, d.ground_cover);
  return hash.digest();
}

Digest128 of_trees(const Trees& trees) {
  Digest128 sum;
  for (const Tree& tree : trees) sum += of_tree(tree);
  return sum;
}

}  // namespace

std::string hex_digits(const Digest128& digest) {
  return bosquet::hex_digits(digest.high) + bosquet::hex_digits(digest.low);
}

Digest128 SectionDigests::all() const {
  Hasher128 hash;
  for (const Digest128& d : of) hash.word(d.high), hash.word(d.low);
  return hash.digest();
}

/// The last document with the digests of its parts.
struct DigestKeeper::Kept {
  std::optional<Document> document;
  SectionDigests digests;
  GridSums grids;
  Digest128 tree_sum;
};

DigestKeeper::DigestKeeper() : kept_(std::make_unique<Kept>()) {}
DigestKeeper::~DigestKeeper() = default;
DigestKeeper::DigestKeeper(DigestKeeper&&) noexcept = default;
DigestKeeper& DigestKeeper::operator=(DigestKeeper&&) noexcept = default;

SectionDigests DigestKeeper::of(const Document& document) {
  Kept& kept = *kept_;
  const Document* before = kept.document ? &*kept.document : nullptr;
  SectionDigests& out = kept.digests;

  out[Section::site] = of_site(document);
  out[Section::planting] = of_planting(document);
  out[Section::settings] = of_settings(document);
  if (!before || !before->species.shares(document.species))
    out[Section::species] = of_list(document.species, [](const auto& s) { return of_species(*s); });
  if (!before || !before->obstacles.shares(document.obstacles))
    out[Section::obstacles] = of_list(document.obstacles, of_obstacle);
  if (!before || !before->heroes.shares(document.heroes)) out[Section::heroes] = of_list(document.heroes, of_hero);

  if (!before) {
    kept.grids = grid_sums(*document.terrain);
  } else if (before->terrain != document.terrain) {
    const terrain::Terrain &a = *before->terrain, &b = *document.terrain;
    update_grid(kept.grids[kHeight], a.height.grid(), b.height.grid(), kHeight);
    update_grid(kept.grids[kExclusion], a.exclusion.grid(), b.exclusion.grid(), kExclusion);
    update_grid(kept.grids[kDensity], a.density.grid(), b.density.grid(), kDensity);
    update_grid(kept.grids[kAreas], a.areas.grid(), b.areas.grid(), kAreas);
    update_grid(kept.grids[kPonds], a.ponds, b.ponds, kPonds);
  }
  out[Section::ground] = of_ground(*document.terrain, kept.grids);

  if (!before) {
    kept.tree_sum = of_trees(*document.trees);
  } else if (before->trees != document.trees) {
    // Blocks that only one of them holds.
    std::vector<const Trees::Block*> old, now;
    for (const auto& block : before->trees->blocks()) old.push_back(block.get());
    for (const auto& block : document.trees->blocks()) now.push_back(block.get());
    std::sort(old.begin(), old.end()), std::sort(now.begin(), now.end());
    const auto each = [](const auto& some, const auto& others, const auto& act) {
      for (const Trees::Block* block : some)
        if (!std::binary_search(others.begin(), others.end(), block))
          for (const Tree& tree : *block) act(of_tree(tree));
    };
    each(old, now, [&](const Digest128& d) { kept.tree_sum -= d; });
    each(now, old, [&](const Digest128& d) { kept.tree_sum += d; });
  }
  Hasher128 hash;
  hash.add(document.trees->size());
  hash.word(kept.tree_sum.high), hash.word(kept.tree_sum.low);
  out[Section::trees] = hash.digest();

  kept.document = document;
  return out;
}

SectionDigests digest(const Document& document) { return DigestKeeper().of(document); }

}  // namespace bosquet::scene
