#include "crowns/canopy_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/parallel.h"
#include "crowns/region_runs.h"
#include "crowns/sky.h"
#include "crowns/space_layout.h"

namespace bosquet::crowns {
namespace {

constexpr int kTileBits = 5;
constexpr std::int32_t kTile = 1 << kTileBits;
constexpr std::int32_t kLanes = 8;  // cells of a row that are followed together
constexpr int kCellBits = 8;        // a cell's edge in the units that voxels are laid into it with
constexpr int kDensityBits = 10;    // leaf area density is rounded to 2^-10

/// Cells low to high, both included.
struct CellBox {
  IVec3 low{std::numeric_limits<std::int32_t>::max()}, high{std::numeric_limits<std::int32_t>::lowest()};

  bool empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  IVec3 size() const { return high - low + 1; }
  void add(const CellBox& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
};

// One axis of voxels over the cells: voxel n spans begin(n) to begin(n + 1), in 1/256 m.
struct Axis {
  double edge_m;

  std::int32_t begin(std::int32_t voxel) const {
    return static_cast<std::int32_t>(std::floor(voxel * edge_m * (1 << kCellBits) + 0.5));
  }
  std::int32_t first_cell(std::int32_t voxel) const { return begin(voxel) >> kCellBits; }
  std::int32_t last_cell(std::int32_t voxel) const { return (begin(voxel + 1) - 1) >> kCellBits; }
};

// Calls visit(cell, overlap) for the cells that [from, to) lies in.
template <class Visit>
void spread(std::int32_t from, std::int32_t to, const Visit& visit) {
  while (from < to) {
    const std::int32_t cell = from >> kCellBits, end = std::min(to, (cell + 1) << kCellBits);
    visit(cell, end - from);
    from = end;
  }
}

std::size_t cell_count(IVec3 cells) {
  return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(cells.z);
}
std::size_t cell_index(IVec3 cell, IVec3 cells) {
  return (static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(cells.z) + static_cast<std::size_t>(cell.z)) *
             static_cast<std::size_t>(cells.x) +
         static_cast<std::size_t>(cell.x);
}

struct TileOrder {
  bool operator()(IVec2 a, IVec2 b) const { return by_north_then_east(a, b); }
};

}  // namespace

class LightBuilder {
 public:
  using Foliage = CanopyLight::Foliage;
  using Tile = CanopyLight::Tile;

  LightBuilder(const CrownSpace& space, const LightOptions& options)
      : space_(space), plan_{static_cast<double>(space.voxel_m())}, up_{static_cast<double>(space.layer_m())} {
    light_.options_ = options;
    light_.trees_.resize(space.claimants().size());
    for (std::size_t i = 0; i < light_.trees_.size(); ++i) light_.trees_[i].key = space.claimants()[i].key;
  }

  CanopyLight whole(Progress* progress) {
    if (progress) progress->begin("canopy light", light_.trees_.size());
    parallel_for(light_.trees_.size(), [&](std::size_t i) {
      if (progress && progress->cancelled()) return;
      light_.trees_[i].foliage = std::make_shared<const Foliage>(foliage_of(i));
    });
    if (progress && progress->cancelled()) return {};
    sum_tiles();
    look_up();
    parallel_for(light_.trees_.size(), [&](std::size_t i) {
      if (progress && progress->cancelled()) return;
      light_.trees_[i].light = std::make_shared<const TreeLight>(light_of(i));
      if (progress) progress->advance();
    });
    if (progress && progress->cancelled()) return {};
    return std::move(light_);
  }

  LightUpdate update(const CanopyLight& before, std::span<const std::size_t> regions_changed) {
    const std::size_t trees = light_.trees_.size();
    std::vector<std::uint8_t> dirty(trees, 0);
    for (std::size_t i : regions_changed) dirty[i] = 1;

    // Each tree beside its former self; those without one have come, those left over have gone.
    std::unordered_map<std::uint64_t, std::size_t> former;
    for (std::size_t i = 0; i < before.trees_.size(); ++i) former.emplace(before.trees_[i].key, i);
    std::vector<const CanopyLight::Tree*> was(trees, nullptr);
    std::vector<std::pair<const Foliage*, const Foliage*>> edits;
    for (std::size_t i = 0; i < trees; ++i) {
      if (const auto found = former.find(light_.trees_[i].key); found != former.end()) {
        was[i] = &before.trees_[found->second];
        former.erase(found);
      } else {
        dirty[i] = 1;
      }
      if (!dirty[i]) light_.trees_[i] = *was[i];
    }
    parallel_for(trees, [&](std::size_t i) {
      if (dirty[i]) light_.trees_[i].foliage = std::make_shared<const Foliage>(foliage_of(i));
    });
    for (std::size_t i = 0; i < trees; ++i)
      if (dirty[i]) edits.emplace_back(was[i] ? was[i]->foliage.get() : nullptr, light_.trees_[i].foliage.get());
    for (const auto& [key, i] : former) edits.emplace_back(before.trees_[i].foliage.get(), nullptr);

    light_.tiles_ = before.tiles_;
    const std::vector<CellBox> touched = edit_tiles(edits);
    look_up();
    spread_dirt(touched, dirty);
    parallel_for(trees, [&](std::size_t i) {
      if (!dirty[i]) return;
      TreeLight light = light_of(i);
      const bool same = was[i] && *was[i]->light == light;
      light_.trees_[i].light = same ? was[i]->light : std::make_shared<const TreeLight>(std::move(light));
      if (same) dirty[i] = 0;
    });
    LightUpdate out;
    for (std::size_t i = 0; i < trees; ++i)
      if (dirty[i]) out.changed.push_back(i);
    out.light = std::move(light_);
    return out;
  }

 private:
  // The cells that a tree's region touches.
  CellBox cells_of(std::size_t claimant) const {
    CellBox box;
    for (const LayerShare& s : space_.shares(claimant))
      box.add({{plan_.first_cell(s.low.x), up_.first_cell(s.layer), plan_.first_cell(s.low.y)},
               {plan_.last_cell(s.high.x), up_.last_cell(s.layer), plan_.last_cell(s.high.y)}});
    return box;
  }

  // Leaf area of a tree in each cell: its voxels inside the ellipsoid, laid into the cells that they overlap.
  Foliage foliage_of(std::size_t claimant) const {
    const Claimant& tree = space_.claimants()[claimant];
    const double voxel = plan_.edge_m, layer = up_.edge_m;
    const double radius = static_cast<double>(tree.crown_radius_m());
    const double half_height = 0.5 * static_cast<double>(tree.scale_height * tree.shape.crown_height_m());
    const double middle = static_cast<double>(tree.top_y()) - half_height;
    if (!(radius > 0.0) || !(half_height > 0.0)) return {};

    struct Row {
      std::int32_t layer, north, first, last;
    };
    std::vector<Row> rows;
    CellBox box;
    for_each_run(space_, claimant,
                 [&](const LayerShare& share, std::int32_t north, std::int32_t first, std::int32_t last) {
                   const double y = ((share.layer + 0.5) * layer - middle) / half_height;
                   const double z = ((north + 0.5) * voxel - static_cast<double>(tree.base.y)) / radius;
                   const double left = 1.0 - y * y - z * z;
                   if (left < 0.0) return;
                   const double half_chord = radius * std::sqrt(left), x = static_cast<double>(tree.base.x);
                   const double west = std::ceil((x - half_chord) / voxel - 0.5),
                                east = std::floor((x + half_chord) / voxel - 0.5);
                   if (west > last || east < first) return;
                   const Row row{share.layer, north, std::max(first, static_cast<std::int32_t>(west)),
                                 std::min(last, static_cast<std::int32_t>(east))};
                   if (row.first > row.last) return;
                   rows.push_back(row);
                   box.add({{plan_.first_cell(row.first), up_.first_cell(row.layer), plan_.first_cell(north)},
                            {plan_.last_cell(row.last), up_.last_cell(row.layer), plan_.last_cell(north)}});
                 });
    if (rows.empty()) return {};

    // Volume in 2^-24 m3 first, so that the density is applied and rounded once a cell.
    Foliage foliage{box.low, box.size(), {}};
    std::vector<std::uint32_t> volume(cell_count(foliage.cells), 0);
    for (const Row& row : rows)
      spread(up_.begin(row.layer), up_.begin(row.layer + 1), [&](std::int32_t y, std::int32_t dy) {
        spread(plan_.begin(row.north), plan_.begin(row.north + 1), [&](std::int32_t z, std::int32_t dz) {
          std::uint32_t* cells = volume.data() + cell_index({0, y - box.low.y, z - box.low.z}, foliage.cells);
          spread(plan_.begin(row.first), plan_.begin(row.last + 1), [&](std::int32_t x, std::int32_t dx) {
            cells[x - box.low.x] += static_cast<std::uint32_t>(dx * dy * dz);
          });
        });
      });

    constexpr int kShift = 3 * kCellBits + kDensityBits - kLeafBits;
    const auto density =
        static_cast<std::uint64_t>(static_cast<double>(tree.shape.leaf_area_density) * (1 << kDensityBits) + 0.5);
    foliage.leaf.resize(volume.size());
    for (std::size_t c = 0; c < volume.size(); ++c)
      foliage.leaf[c] =
          static_cast<std::uint16_t>((volume[c] * density + (std::uint64_t{1} << (kShift - 1))) >> kShift);
    return foliage;
  }

  // Tiles under the foliage of all trees. Every tile gathers what lies over it, so that no two threads write to one.
  void sum_tiles() {
    struct Plot {
      std::int32_t first = std::numeric_limits<std::int32_t>::max();
      std::int32_t end = std::numeric_limits<std::int32_t>::lowest();
      std::vector<const Foliage*> over;
    };
    std::map<IVec2, Plot, TileOrder> plots;
    for (const auto& tree : light_.trees_)
      for_each_tile(*tree.foliage, [&](IVec2 tile) {
        Plot& plot = plots[tile];
        plot.first = std::min(plot.first, tree.foliage->low.y);
        plot.end = std::max(plot.end, tree.foliage->low.y + tree.foliage->cells.y);
        plot.over.push_back(tree.foliage.get());
      });
    std::vector<std::pair<IVec2, const Plot*>> order;
    for (const auto& [tile, plot] : plots) order.emplace_back(tile, &plot);
    light_.tiles_.resize(order.size());
    parallel_for(order.size(), [&](std::size_t n) {
      const auto& [at, plot] = order[n];
      Tile tile{at, plot->first, plot->end - plot->first, {}};
      tile.leaf.assign(static_cast<std::size_t>(tile.layers) * kTile * kTile, 0);
      for (const Foliage* foliage : plot->over) lay(tile, *foliage, 1);
      light_.tiles_[n] = std::make_shared<const Tile>(std::move(tile));
    });
  }

  template <class Visit>
  static void for_each_tile(const Foliage& f, const Visit& visit) {
    if (f.leaf.empty()) return;
    for (std::int32_t n = f.low.z >> kTileBits; n <= (f.low.z + f.cells.z - 1) >> kTileBits; ++n)
      for (std::int32_t e = f.low.x >> kTileBits; e <= (f.low.x + f.cells.x - 1) >> kTileBits; ++e) visit(IVec2{e, n});
  }

  // Adds (or takes away) what of the foliage stands over a tile that has all its layers.
  static void lay(Tile& tile, const Foliage& f, int sign) {
    const IVec2 corner = tile.tile * kTile;
    const std::int32_t west = std::max(f.low.x, corner.x), east = std::min(f.low.x + f.cells.x, corner.x + kTile);
    const std::int32_t south = std::max(f.low.z, corner.y), north = std::min(f.low.z + f.cells.z, corner.y + kTile);
    for (std::int32_t y = 0; y < f.cells.y; ++y)
      for (std::int32_t z = south; z < north; ++z) {
        const std::uint16_t* from = f.leaf.data() + cell_index({west - f.low.x, y, z - f.low.z}, f.cells);
        std::uint32_t* to =
            tile.leaf.data() +
            static_cast<std::size_t>(((f.low.y + y - tile.first) * kTile + (z - corner.y)) * kTile + (west - corner.x));
        for (std::int32_t x = 0; x < east - west; ++x) to[x] = sign > 0 ? to[x] + from[x] : to[x] - from[x];
      }
  }

  // Replaces the first foliage of each pair by the second; returns the boxes of cells whose sums may differ.
  std::vector<CellBox> edit_tiles(const std::vector<std::pair<const Foliage*, const Foliage*>>& edits) {
    std::map<IVec2, std::shared_ptr<const Tile>, TileOrder> tiles;
    for (const auto& tile : light_.tiles_) tiles.emplace(tile->tile, tile);
    std::map<IVec2, Tile, TileOrder> opened;
    std::vector<CellBox> touched;
    const auto apply = [&](const Foliage* foliage, int sign) {
      if (!foliage || foliage->leaf.empty()) return;
      touched.push_back({foliage->low, foliage->low + foliage->cells - 1});
      for_each_tile(*foliage, [&](IVec2 at) {
        auto open = opened.find(at);
        if (open == opened.end()) {
          const auto held = tiles.find(at);
          open = opened.emplace(at, held == tiles.end() ? Tile{at, foliage->low.y, 0, {}} : *held->second).first;
        }
        Tile& tile = open->second;
        deepen(tile, foliage->low.y, foliage->low.y + foliage->cells.y);
        lay(tile, *foliage, sign);
      });
    };
    for (const auto& [old, now] : edits) {
      if (old && now && old->low == now->low && old->cells == now->cells && old->leaf == now->leaf) continue;
      apply(now, 1);
      apply(old, -1);
    }
    for (auto& [at, tile] : opened) tiles[at] = std::make_shared<const Tile>(std::move(tile));
    light_.tiles_.clear();
    for (auto& [at, tile] : tiles) light_.tiles_.push_back(std::move(tile));
    return touched;
  }

  // Gives a tile layers first..end - 1 too.
  static void deepen(Tile& tile, std::int32_t first, std::int32_t end) {
    constexpr std::size_t kLayer = static_cast<std::size_t>(kTile) * kTile;
    if (tile.layers == 0) tile.first = first;
    if (first < tile.first) {
      tile.leaf.insert(tile.leaf.begin(), static_cast<std::size_t>(tile.first - first) * kLayer, 0u);
      tile.layers += tile.first - first;
      tile.first = first;
    }
    tile.layers = std::max(tile.layers, end - tile.first);
    tile.leaf.resize(static_cast<std::size_t>(tile.layers) * kLayer, 0u);
  }

  // Directions as high as the canopy is.
  void look_up() {
    std::int32_t bottom = std::numeric_limits<std::int32_t>::max(), top = std::numeric_limits<std::int32_t>::lowest();
    for (const auto& tile : light_.tiles_) top = std::max(top, tile->first + tile->layers);
    for (std::size_t i = 0; i < light_.trees_.size(); ++i)
      if (const auto shares = space_.shares(i); !shares.empty())
        bottom = std::min(bottom, up_.first_cell(shares.front().layer));
    rays_ = sky_rays(light_.options_.light_reach_m, bottom < top ? top - bottom : 0);
    margin_ = 0;
    for (const SkyRay& ray : rays_)
      for (const IVec3& s : ray.steps) margin_ = std::max({margin_, std::abs(s.x), std::abs(s.z)});
  }

  // Marks the trees whose light may see one of the boxes.
  void spread_dirt(const std::vector<CellBox>& touched, std::vector<std::uint8_t>& dirty) const {
    parallel_for(
        dirty.size(),
        [&](std::size_t i) {
          if (dirty[i]) return;
          const CellBox own = cells_of(i);
          for (const CellBox& b : touched)
            if (b.high.y >= own.low.y && b.low.x <= own.high.x + margin_ && b.high.x >= own.low.x - margin_ &&
                b.low.z <= own.high.z + margin_ && b.high.z >= own.low.z - margin_) {
              dirty[i] = 1;
              return;
            }
        },
        64);
  }

  TreeLight light_of(std::size_t claimant) const {
    const CellBox box = cells_of(claimant);
    if (box.empty()) return {};
    const IVec3 cells = box.size();

    // What the others hold of all cells that its light may pass.
    Surroundings around = surroundings(claimant, box);
    if (!around.shaded) return {};

    std::vector<std::uint8_t> touched(cell_count(cells) + kLanes, 0);
    for_each_run(space_, claimant,
                 [&](const LayerShare& share, std::int32_t north, std::int32_t first, std::int32_t last) {
                   for (std::int32_t y = up_.first_cell(share.layer); y <= up_.last_cell(share.layer); ++y)
                     for (std::int32_t z = plan_.first_cell(north); z <= plan_.last_cell(north); ++z) {
                       std::uint8_t* row = touched.data() + cell_index({0, y - box.low.y, z - box.low.z}, cells);
                       std::fill(row + (plan_.first_cell(first) - box.low.x),
                                 row + (plan_.last_cell(last) - box.low.x) + 1, std::uint8_t{1});
                     }
                 });
    return finish(claimant, box, touched, levels(around, cells, touched));
  }

  // Leaf area of all others: the tree's cells stand margin_ within it, and it reaches as high as foliage does.
  struct Surroundings {
    IVec3 cells{0};
    std::vector<std::uint32_t> leaf;
    bool shaded = false;
  };

  Surroundings surroundings(std::size_t claimant, const CellBox& box) const {
    Surroundings around;
    const IVec2 from = IVec2{box.low.x, box.low.z} - margin_, to = IVec2{box.high.x, box.high.z} + margin_;
    std::vector<const Tile*> tiles;
    std::int32_t top = box.low.y;
    for (std::int32_t n = from.y >> kTileBits; n <= to.y >> kTileBits; ++n)
      for (std::int32_t e = from.x >> kTileBits; e <= to.x >> kTileBits; ++e)
        if (const Tile* tile = light_.find_tile({e, n})) {
          tiles.push_back(tile);
          top = std::max(top, tile->first + tile->layers);
        }
    if (top == box.low.y) return around;
    // Rows end with room for the last lanes.
    around.cells = {to.x - from.x + 1 + kLanes, top - box.low.y, to.y - from.y + 1};
    around.leaf.assign(cell_count(around.cells), 0);
    const auto row = [&](std::int32_t y, std::int32_t north, std::int32_t east) {
      return around.leaf.data() + cell_index({east - from.x, y - box.low.y, north - from.y}, around.cells);
    };
    for (const Tile* tile : tiles) {
      const IVec2 corner = tile->tile * kTile;
      const std::int32_t west = std::max(from.x, corner.x), east = std::min(to.x + 1, corner.x + kTile);
      for (std::int32_t y = std::max(tile->first, box.low.y); y < tile->first + tile->layers; ++y)
        for (std::int32_t n = std::max(from.y, corner.y); n < std::min(to.y + 1, corner.y + kTile); ++n) {
          const std::uint32_t* held =
              tile->leaf.data() +
              static_cast<std::size_t>(((y - tile->first) * kTile + (n - corner.y)) * kTile + (west - corner.x));
          std::copy_n(held, east - west, row(y, n, west));
        }
    }
    const Foliage& own = *light_.trees_[claimant].foliage;
    for (std::int32_t y = 0; y < own.cells.y; ++y)
      for (std::int32_t z = 0; z < own.cells.z; ++z) {
        const std::uint16_t* held = own.leaf.data() + cell_index({0, y, z}, own.cells);
        std::uint32_t* others = row(own.low.y + y, own.low.z + z, own.low.x);
        for (std::int32_t x = 0; x < own.cells.x; ++x) others[x] -= held[x];
      }
    around.shaded = std::any_of(around.leaf.begin(), around.leaf.end(), [](std::uint32_t leaf) { return leaf != 0; });
    return around;
  }

  // The level of every touched cell, fifteen elsewhere.
  std::vector<std::uint8_t> levels(const Surroundings& around, IVec3 cells,
                                   const std::vector<std::uint8_t>& touched) const {
    std::vector<std::vector<std::ptrdiff_t>> offsets(rays_.size());
    for (std::size_t r = 0; r < rays_.size(); ++r)
      for (const IVec3& s : rays_[r].steps)
        offsets[r].push_back((std::ptrdiff_t{s.y} * around.cells.z + s.z) * around.cells.x + s.x);

    std::vector<std::uint8_t> level(cell_count(cells), 15);
    std::vector<std::size_t> below_top(rays_.size());
    for (std::int32_t y = 0; y < std::min(cells.y, around.cells.y); ++y) {
      for (std::size_t r = 0; r < rays_.size(); ++r) {
        const std::vector<IVec3>& steps = rays_[r].steps;
        below_top[r] = static_cast<std::size_t>(
            std::partition_point(steps.begin(), steps.end(), [&](const IVec3& s) { return y + s.y < around.cells.y; }) -
            steps.begin());
      }
      for (std::int32_t z = 0; z < cells.z; ++z)
        for (std::int32_t x = 0; x < cells.x; x += kLanes) {
          const std::size_t cell = cell_index({x, y, z}, cells);
          const std::int32_t lanes = std::min(kLanes, cells.x - x);
          if (std::all_of(&touched[cell], &touched[cell] + lanes, [](std::uint8_t t) { return t == 0; })) continue;
          const std::uint32_t* here = around.leaf.data() + cell_index({x + margin_, y, z + margin_}, around.cells);
          std::array<std::uint64_t, kLanes> light{};
          for (std::size_t r = 0; r < rays_.size(); ++r) {
            std::array<std::uint32_t, kLanes> path{};
            for (std::size_t s = 0; s < below_top[r]; ++s) {
              const std::uint32_t* there = here + offsets[r][s];
              for (std::size_t l = 0; l < kLanes; ++l) path[l] += there[l];
            }
            for (std::size_t l = 0; l < kLanes; ++l)
              light[l] += std::uint64_t{rays_[r].weight} * attenuation_.passed(here[l] + 2 * path[l]);
          }
          for (std::int32_t l = 0; l < lanes; ++l)
            if (touched[cell + static_cast<std::size_t>(l)])
              level[cell + static_cast<std::size_t>(l)] = Attenuation::level(light[static_cast<std::size_t>(l)]);
        }
    }
    return level;
  }

  // The grid in the tree's frame, one cell wider on all sides.
  TreeLight finish(std::size_t claimant, const CellBox& box, const std::vector<std::uint8_t>& touched,
                   const std::vector<std::uint8_t>& level) const {
    if (std::all_of(level.begin(), level.end(), [](std::uint8_t l) { return l == 15; })) return {};
    const Claimant& tree = space_.claimants()[claimant];
    const IVec3 cells = box.size();
    TreeLight out;
    out.cells = cells + 2;
    out.low = {static_cast<float>(box.low.x - 1 - static_cast<double>(tree.base.x)),
               static_cast<float>(box.low.y - 1 - static_cast<double>(tree.ground_y)),
               static_cast<float>(static_cast<double>(tree.base.y) - (box.high.z + 2))};
    out.level.assign(cell_count(out.cells), 15);
    std::vector<std::uint8_t> inside(out.level.size(), 0);
    // Cell (x, y, z) of the box, -1 to cells, in the grid, whose third axis runs south.
    const auto place = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      return cell_index({x + 1, y + 1, cells.z - z}, out.cells);
    };
    const auto for_each_touched = [&](const auto& visit) {
      std::size_t c = 0;
      for (std::int32_t y = 0; y < cells.y; ++y)
        for (std::int32_t z = 0; z < cells.z; ++z)
          for (std::int32_t x = 0; x < cells.x; ++x, ++c)
            if (touched[c]) visit(x, y, z, level[c]);
    };
    for_each_touched([&](std::int32_t x, std::int32_t y, std::int32_t z, std::uint8_t l) {
      out.level[place(x, y, z)] = l;
      inside[place(x, y, z)] = 1;
    });
    for_each_touched([&](std::int32_t x, std::int32_t y, std::int32_t z, std::uint8_t l) {
      if (l == 15) return;
      for (std::int32_t dy = -1; dy <= 1; ++dy)
        for (std::int32_t dz = -1; dz <= 1; ++dz)
          for (std::int32_t dx = -1; dx <= 1; ++dx)
            if (const std::size_t at = place(x + dx, y + dy, z + dz); !inside[at])
              out.level[at] = std::min(out.level[at], l);
    });
    return out;
  }

  const CrownSpace& space_;
  Axis plan_, up_;
  CanopyLight light_;
  std::vector<SkyRay> rays_;
  std::int32_t margin_ = 0;
  Attenuation attenuation_;
};

const CanopyLight::Tile* CanopyLight::find_tile(IVec2 tile) const {
  const auto at = std::lower_bound(tiles_.begin(), tiles_.end(), tile,
                                   [](const auto& held, IVec2 asked) { return by_north_then_east(held->tile, asked); });
  return at != tiles_.end() && (*at)->tile == tile ? at->get() : nullptr;
}

double CanopyLight::leaf_area_m2(IVec3 cell) const {
  const Tile* tile = find_tile({cell.x >> kTileBits, cell.z >> kTileBits});
  if (!tile || cell.y < tile->first || cell.y >= tile->first + tile->layers) return 0.0;
  const std::int32_t east = cell.x & (kTile - 1), north = cell.z & (kTile - 1);
  return tile->leaf[static_cast<std::size_t>(((cell.y - tile->first) * kTile + north) * kTile + east)] * 0x1p-14;
}

double CanopyLight::leaf_area_m2(IVec3 cell, std::size_t claimant) const {
  const Foliage& f = *trees_[claimant].foliage;
  const IVec3 c = cell - f.low;
  if (c.x < 0 || c.y < 0 || c.z < 0 || c.x >= f.cells.x || c.y >= f.cells.y || c.z >= f.cells.z) return 0.0;
  return f.leaf[cell_index(c, f.cells)] * 0x1p-14;
}

std::size_t CanopyLight::bytes() const {
  std::size_t sum = 0;
  for (const auto& tile : tiles_) sum += tile->leaf.size() * sizeof(std::uint32_t);
  for (const Tree& tree : trees_) sum += tree.foliage->leaf.size() * sizeof(std::uint16_t) + tree.light->level.size();
  return sum;
}

CanopyLight canopy_light(const CrownSpace& space, const LightOptions& options, Progress* progress) {
  return LightBuilder(space, options).whole(progress);
}

LightUpdate update_canopy_light(const CanopyLight& before, const CrownSpace& space,
                                std::span<const std::size_t> regions_changed) {
  return LightBuilder(space, before.options()).update(before, regions_changed);
}

}  // namespace bosquet::crowns
