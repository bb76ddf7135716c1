// Divides the volume above a terrain: tiles where trees can reach, fronts layer by layer, then what hangs below a base.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <thread>
#include <unordered_map>

#include "core/parallel.h"
#include "crowns/crown_space.h"
#include "crowns/propagation.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

constexpr std::int32_t kEdge = kTileEdge;
constexpr std::int32_t kNoGround = std::numeric_limits<std::int32_t>::max();  // first layer of a column off the domain
constexpr double kMostVoxel = 20.0;                                           // as described
// Scratch of one layer at work: cell, open flag, result.
constexpr double kScratchBytes = 16 + 1 + 4 + 8;

std::uint64_t packed(IVec2 v) {
  return (std::uint64_t{static_cast<std::uint32_t>(v.y)} << 32) | static_cast<std::uint32_t>(v.x);
}
IVec2 tile_of(IVec2 column) { return {column.x >> 6, column.y >> 6}; }
std::size_t inside(IVec2 column) {
  return static_cast<std::size_t>((column.y & (kEdge - 1)) * kEdge + (column.x & (kEdge - 1)));
}

// A tree on the lattice.
struct Placed {
  double east = 0, north = 0;      // columns
  double reach = 0;                // columns
  std::int32_t base = 0, top = 0;  // layers [base, top)
  IVec2 root{0};                   // column
};

// Columns that the domain holds, both ends included.
struct Domain {
  IVec2 low{0}, high{0};
  bool contains(IVec2 c) const { return c.x >= low.x && c.y >= low.y && c.x <= high.x && c.y <= high.y; }
};

// A tile before its voxels.
struct Plot {
  IVec2 tile{0};
  std::int32_t bottom = std::numeric_limits<std::int32_t>::max();  // layers [bottom, top)
  std::int32_t top = std::numeric_limits<std::int32_t>::lowest();
  std::int32_t highest_base = std::numeric_limits<std::int32_t>::lowest();
  std::vector<std::int32_t> ground;                           // lowest layer above ground, for each column
  std::int32_t west = -1, east = -1, south = -1, north = -1;  // plots beside it
};

// Checks that a field lies in its described range.
struct RangeCheck {
  std::string problem;
  void operator()(const Real& r, float value) {
    const double v = static_cast<double>(value);
    if (problem.empty() && !(v >= static_cast<float>(r.low) && v <= static_cast<float>(r.high)))
      problem = fmt::format("{} = {} is out of range: {} to {} {}", r.name, value, r.low, r.high, r.unit);
  }
};

std::string unusable(const Claimant& t) {
  const auto wrong = [](float v) { return !std::isfinite(v); };
  if (wrong(t.base.x) || wrong(t.base.y) || wrong(t.ground_y)) return "its base is not a number";
  const float sizes[] = {t.scale_height, t.scale_width, t.shape.crown_width_m, t.shape.mature_height_m};
  for (float v : sizes)
    if (wrong(v) || v <= 0.0f) return fmt::format("its size {} must be above 0", v);
  if (wrong(t.shape.trunk_width_m) || t.shape.trunk_width_m < 0.0f) return "its trunk is not a number";
  return {};
}

// Voxel edge with some room to spare, two digits, rounded up.
double rounded_up(double v) {
  double unit = 0.01;
  while (v / unit > 99.0) unit *= 10.0;
  return std::ceil(v / unit) * unit;
}

}  // namespace

class SpaceBuilder {
 public:
  SpaceBuilder(std::span<const Claimant> trees, const terrain::Terrain& terrain, const SpaceOptions& options)
      : trees_(trees), terrain_(terrain), options_(options) {}

  Result<CrownSpace> build(Progress* progress) {
    if (auto checked = check(); !checked) return checked.error();
    if (auto fits = check_columns(); !fits) return fits.error();
    if (const double bytes = plan(); bytes > 0) return too_large(bytes);
    space_.voxel_m_ = options_.voxel_m;
    space_.layer_m_ = options_.layer_m;
    space_.claimants_.assign(trees_.begin(), trees_.end());
    allocate();
    if (!divide(progress)) return cannot_finish("dividing the space was cancelled");
    hang_below_bases();
    count_shares();
    for (auto& tile : tiles_) space_.tiles_.push_back(std::move(tile));
    return std::move(space_);
  }

 private:
  Result<void> check() const {
    RangeCheck range;
    describe(options_, range);
    if (!range.problem.empty()) return Error{"crown space: " + range.problem};
    for (const Claimant& t : trees_)
      if (const std::string why = unusable(t); !why.empty())
        return Error{fmt::format("crown space: tree {} cannot take part, {}", t.id, why)};
    return {};
  }

  // Each tree needs a column of its own.
  Result<void> check_columns() {
    place();
    const double columns = (domain_.high.x - domain_.low.x + 1.0) * (domain_.high.y - domain_.low.y + 1.0);
    if (static_cast<double>(trees_.size()) <= columns) return {};
    return Error{
        fmt::format("crown space: {} trees do not fit the site's {} columns of voxel_m = {}; use a smaller voxel_m",
                    trees_.size(), columns, options_.voxel_m)};
  }

  // Where trees stand and which tiles they need. Returns 0, or the bytes that it would take when they are too many.
  double plan() {
    place();
    choose_roots();
    if (const double bytes = plan_tiles(); bytes > byte_limit()) return bytes;
    if (const double bytes = needed_bytes(); bytes > byte_limit()) return bytes;  // not yet with what lies below bases
    sample_ground();
    if (const double bytes = needed_bytes(); bytes > byte_limit()) return bytes;
    return 0;
  }

  void place() {
    const double voxel = static_cast<double>(options_.voxel_m), layer = static_cast<double>(options_.layer_m);
    double longest = 0;
    placed_.clear();
    for (const Claimant& t : trees_) {
      Placed p;
      p.east = static_cast<double>(t.base.x) / voxel;
      p.north = static_cast<double>(t.base.y) / voxel;
      p.reach = static_cast<double>(options_.reach_factor) * static_cast<double>(t.crown_radius_m()) / voxel;
      p.base = static_cast<std::int32_t>(std::floor(static_cast<double>(t.ground_y) / layer));
      p.top = std::max(p.base + 1, static_cast<std::int32_t>(std::ceil(static_cast<double>(t.top_y()) / layer)));
      longest = std::max(longest, p.reach);
      placed_.push_back(p);
    }

    // Columns whose centres lie on the site or its overhang.
    double overhang = static_cast<double>(options_.overhang_m) / voxel;
    if (overhang < 0) overhang = std::isfinite(longest) ? longest : 0.0;
    constexpr double kSlack = 1e-4;  // a site of 128 x 0.2344 m holds 128 columns
    const Vec2 size = terrain_.size_m();
    const auto first = static_cast<std::int32_t>(std::ceil(-overhang - 0.5 - kSlack));
    const auto last = [&](float metres) {
      return std::max(
          first, static_cast<std::int32_t>(std::floor(static_cast<double>(metres) / voxel + overhang - 0.5 + kSlack)));
    };
    domain_ = {IVec2{first}, {last(size.x), last(size.y)}};

    // Places of the keys settle ties.
    std::vector<std::size_t> order(trees_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return trees_[a].key != trees_[b].key ? trees_[a].key < trees_[b].key : trees_[a].id < trees_[b].id;
    });
    by_key_ = std::move(order);
    rank_.resize(trees_.size());
    for (std::size_t r = 0; r < by_key_.size(); ++r) rank_[by_key_[r]] = static_cast<std::int32_t>(r);
  }

  // The voxel under a base is its tree's; of several in one, the lowest key has it and the others take the nearest
  // free.
  void choose_roots() {
    std::unordered_map<std::uint64_t, std::size_t> taken;
    std::vector<std::size_t> displaced;
    for (std::size_t t : by_key_) {
      Placed& p = placed_[t];
      p.root = glm::clamp(IVec2{static_cast<int>(std::floor(p.east)), static_cast<int>(std::floor(p.north))},
                          domain_.low, domain_.high);
      if (!taken.emplace(packed(p.root), t).second) displaced.push_back(t);
    }
    for (std::size_t t : displaced) {
      Placed& p = placed_[t];
      // Rings of growing radius; one more ring than the first hit, as corners are farther than edges.
      const IVec2 own = p.root;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::int32_t ring = 1; ring <= nearest + 1.0; ++ring)
        for (std::int32_t j = own.y - ring; j <= own.y + ring; ++j)
          for (std::int32_t i = own.x - ring; i <= own.x + ring; ++i) {
            const bool on_ring = std::max(std::abs(i - own.x), std::abs(j - own.y)) == ring;
            if (!on_ring || !domain_.contains({i, j}) || taken.contains(packed({i, j}))) continue;
            const double x = i + 0.5 - p.east, y = j + 0.5 - p.north, distance = std::sqrt(x * x + y * y);
            if (distance < nearest) nearest = distance, p.root = {i, j};
          }
      taken.emplace(packed(p.root), t);
    }
  }

  // Tiles that some tree reaches, with the layers of the trees that reach them. Returns the bytes of their voxels,
  // which is a lower bound when they are too many.
  double plan_tiles() {
    std::unordered_map<std::uint64_t, std::size_t> index;
    const auto reached = [&](IVec2 tile, const Placed& p) {
      const auto [at, added] = index.emplace(packed(tile), plots_.size());
      if (added) plots_.emplace_back().tile = tile;
      Plot& plot = plots_[at->second];
      plot.bottom = std::min(plot.bottom, p.base);
      plot.top = std::max(plot.top, p.top);
      plot.highest_base = std::max(plot.highest_base, p.base);
    };
    for (const Placed& p : placed_) {
      reached(tile_of(p.root), p);
      const auto clipped = [&](double v, int axis) {
        return static_cast<std::int32_t>(
            std::clamp(std::floor(v), static_cast<double>(domain_.low[axis]), static_cast<double>(domain_.high[axis])));
      };
      const IVec2 from = tile_of({clipped(p.east - p.reach, 0), clipped(p.north - p.reach, 1)});
      const IVec2 to = tile_of({clipped(p.east + p.reach, 0), clipped(p.north + p.reach, 1)});
      const double tile_bytes = kTileColumns * voxel_bytes();
      const double box = (to.x - from.x + 1.0) * (to.y - from.y + 1.0) * (p.top - p.base) * tile_bytes;
      const double held = static_cast<double>(plots_.size()) * tile_bytes;
      // A disc fills more than half of its box but for the rounding to tiles.
      if (std::max(0.5 * box, held) > byte_limit()) return std::max(0.5 * box, held);
      for (std::int32_t n = from.y; n <= to.y; ++n)
        for (std::int32_t e = from.x; e <= to.x; ++e) {
          const double x = p.east - std::clamp(p.east, e * 64.0, e * 64.0 + 64.0);
          const double y = p.north - std::clamp(p.north, n * 64.0, n * 64.0 + 64.0);
          if (x * x + y * y <= p.reach * p.reach) reached({e, n}, p);
        }
    }

    std::sort(plots_.begin(), plots_.end(), [](const Plot& a, const Plot& b) {
      return a.tile.y < b.tile.y || (a.tile.y == b.tile.y && a.tile.x < b.tile.x);
    });
    for (std::size_t i = 0; i < plots_.size(); ++i) index[packed(plots_[i].tile)] = i;
    const auto beside = [&](IVec2 tile) {
      const auto at = index.find(packed(tile));
      return at == index.end() ? -1 : static_cast<std::int32_t>(at->second);
    };
    for (Plot& p : plots_) {
      p.west = beside(p.tile + IVec2{-1, 0}), p.east = beside(p.tile + IVec2{1, 0});
      p.south = beside(p.tile + IVec2{0, -1}), p.north = beside(p.tile + IVec2{0, 1});
    }
    return 0;
  }

  // A voxel exists when a part of it lies above the ground at its column's centre.
  void sample_ground() {
    parallel_for(plots_.size(), [&](std::size_t n) {
      Plot& plot = plots_[n];
      plot.ground.assign(static_cast<std::size_t>(kTileColumns), kNoGround);
      std::int32_t lowest = plot.bottom;
      for (std::int32_t j = 0; j < kEdge; ++j)
        for (std::int32_t i = 0; i < kEdge; ++i) {
          const IVec2 column = plot.tile * kEdge + IVec2{i, j};
          if (!domain_.contains(column)) continue;
          const Vec2 centre = (Vec2(column) + 0.5f) * options_.voxel_m;
          const auto layer = static_cast<std::int32_t>(std::floor(terrain_.ground(centre) / options_.layer_m));
          plot.ground[static_cast<std::size_t>(j * kEdge + i)] = layer;
          lowest = std::min(lowest, layer);
        }
      plot.bottom = lowest;
    });
  }

  double byte_limit() const { return static_cast<double>(options_.memory_gb) * 1e9; }
  double voxel_bytes() const { return options_.keep_ticks ? 12.0 : 4.0; }

  // Voxels, and a layer at work on every core.
  double needed_bytes() const {
    double voxels = 0;
    for (const Plot& p : plots_) voxels += static_cast<double>(p.top - p.bottom) * kTileColumns;
    const double busy = std::max(1u, std::thread::hardware_concurrency());
    return voxels * voxel_bytes() + busy * static_cast<double>(plots_.size()) * kTileColumns * kScratchBytes;
  }

  // Tries larger voxels until one fits.
  Error too_large(double bytes) const {
    SpaceOptions tried = options_;
    std::string advice = "no voxel_m would fit: raise layer_m or limit the reach";
    for (double grow = std::sqrt(bytes / byte_limit()); grow * static_cast<double>(options_.voxel_m) <= kMostVoxel;
         grow *= 1.1) {
      tried.voxel_m = static_cast<float>(rounded_up(grow * static_cast<double>(options_.voxel_m)));
      SpaceBuilder larger(trees_, terrain_, tried);
      if (!larger.check_columns() || larger.plan() > 0) continue;
      advice = fmt::format("voxel_m = {} would fit", tried.voxel_m);
      break;
    }
    return {
        fmt::format("crown space: {} trees with voxel_m = {} and layer_m = {} need at least {:.2g} GB, but memory_gb = "
                    "{}; {}",
                    trees_.size(), options_.voxel_m, options_.layer_m, bytes / 1e9, options_.memory_gb, advice)};
  }

  void allocate() {
    tiles_.resize(plots_.size());
    parallel_for(plots_.size(), [&](std::size_t n) {
      const Plot& plot = plots_[n];
      auto tile = std::make_shared<SpaceTile>();
      tile->tile = plot.tile;
      tile->first_layer = plot.bottom;
      tile->layers = plot.top - plot.bottom;
      const std::size_t voxels = static_cast<std::size_t>(tile->layers) * static_cast<std::size_t>(kTileColumns);
      tile->owner.assign(voxels, kFree);
      if (options_.keep_ticks) tile->ticks.assign(voxels, 0);
      tiles_[n] = std::move(tile);
    });
    first_layer_ = std::numeric_limits<std::int32_t>::max();
    std::int32_t last = std::numeric_limits<std::int32_t>::lowest();
    for (const Plot& p : plots_) first_layer_ = std::min(first_layer_, p.bottom), last = std::max(last, p.top);
    layers_ = plots_.empty() ? 0 : static_cast<std::size_t>(last - first_layer_);
  }

  // All layers; false when cancelled.
  bool divide(Progress* progress) {
    std::vector<float> costs(layers_, 0.0f);
    for (const Plot& p : plots_)
      for (std::int32_t k = p.bottom; k < p.top; ++k) costs[static_cast<std::size_t>(k - first_layer_)] += 1.0f;
    if (progress) progress->begin("dividing the space", layers_);
    parallel_dearest_first(costs, [&](std::size_t n) {
      if (progress && progress->cancelled()) return;
      divide_layer(first_layer_ + static_cast<std::int32_t>(n));
      if (progress) progress->advance();
    });
    return !(progress && progress->cancelled());
  }

  void divide_layer(std::int32_t layer) {
    // Blocks are the tiles that hold the layer.
    LayerCells cells;
    std::vector<std::size_t> plot_of;
    std::vector<std::int32_t> block_of(plots_.size(), LayerCells::kNoBlock);
    for (std::size_t n = 0; n < plots_.size(); ++n) {
      if (!tiles_[n]->has(layer)) continue;
      block_of[n] = static_cast<std::int32_t>(plot_of.size());
      plot_of.push_back(n);
    }
    const auto block = [&](std::int32_t plot) {
      return plot < 0 ? LayerCells::kNoBlock : block_of[static_cast<std::size_t>(plot)];
    };
    cells.open.reserve(plot_of.size() * static_cast<std::size_t>(kTileColumns));
    for (std::size_t n : plot_of) {
      const Plot& p = plots_[n];
      cells.blocks.push_back({p.tile * kEdge, block(p.west), block(p.east), block(p.south), block(p.north)});
      for (std::int32_t ground : p.ground) cells.open.push_back(ground <= layer);
    }

    // Trees whose shapes reach the layer.
    std::vector<Front> fronts;
    for (std::size_t t = 0; t < trees_.size(); ++t) {
      const Placed& p = placed_[t];
      if (layer < p.base || layer >= p.top) continue;
      const std::size_t home = plot_at(tile_of(p.root));
      Front f;
      f.east = p.east;
      f.north = p.north;
      f.trunk = static_cast<double>(trees_[t].trunk_radius_m()) / static_cast<double>(options_.voxel_m);
      f.slowness = front_slowness(trees_[t].projected_area_m2(), options_.speed_exponent, options_.voxel_m);
      f.reach_squared = p.reach * p.reach;
      f.root = static_cast<std::uint32_t>(
          static_cast<std::size_t>(block_of[home]) * static_cast<std::size_t>(kTileColumns) + inside(p.root));
      f.rank = rank_[t];
      f.owner = static_cast<std::int32_t>(t);
      fronts.push_back(f);
    }
    if (fronts.empty()) return;

    // Write to this layer's own slices.
    const LayerResult result = propagate(fronts, cells);
    for (std::size_t b = 0; b < plot_of.size(); ++b) {
      SpaceTile& tile = *tiles_[plot_of[b]];
      const std::size_t from = b * static_cast<std::size_t>(kTileColumns), to = tile.offset(layer);
      for (std::size_t c = 0; c < static_cast<std::size_t>(kTileColumns); ++c) {
        const std::int32_t f = result.front[from + c];
        if (f != LayerResult::kUnclaimed) tile.owner[to + c] = fronts[static_cast<std::size_t>(f)].owner;
      }
      if (options_.keep_ticks)
        std::copy_n(result.ticks.begin() + static_cast<std::ptrdiff_t>(from), kTileColumns,
                    tile.ticks.begin() + static_cast<std::ptrdiff_t>(to));
    }
  }

  std::size_t plot_at(IVec2 tile) const {
    const auto at = std::lower_bound(plots_.begin(), plots_.end(), tile, [](const Plot& p, IVec2 asked) {
      return p.tile.y < asked.y || (p.tile.y == asked.y && p.tile.x < asked.x);
    });
    return static_cast<std::size_t>(at - plots_.begin());
  }

  // Free voxels above ground but below the base of the tree that owns the voxel above them go to that tree.
  void hang_below_bases() {
    constexpr auto kColumns = static_cast<std::size_t>(kTileColumns);
    parallel_for(plots_.size(), [&](std::size_t n) {
      const Plot& plot = plots_[n];
      SpaceTile& tile = *tiles_[n];
      for (std::int32_t k = std::min(plot.highest_base, plot.top - 1) - 1; k >= plot.bottom; --k) {
        std::int32_t* here = tile.owner.data() + tile.offset(k);
        const std::int32_t* above = here + kColumns;
        for (std::size_t c = 0; c < kColumns; ++c) {
          if (here[c] != kFree || above[c] < 0 || k < plot.ground[c]) continue;
          if (placed_[static_cast<std::size_t>(above[c])].base <= k) continue;
          here[c] = above[c];
          if (options_.keep_ticks) tile.ticks[tile.offset(k) + c] = tile.ticks[tile.offset(k + 1) + c];
        }
      }
    });
  }

  // What each tree owns of each layer, from whole numbers only.
  void count_shares() {
    struct Found {
      std::size_t claimant;
      LayerShare share;
    };
    std::vector<std::vector<Found>> found(layers_);
    parallel_for(layers_, [&](std::size_t n) {
      const std::int32_t layer = first_layer_ + static_cast<std::int32_t>(n);
      std::vector<LayerShare> shares(trees_.size());
      for (const auto& tile : tiles_) {
        if (!tile->has(layer)) continue;
        const std::int32_t* row = tile->owner.data() + tile->offset(layer);
        for (std::int32_t j = 0; j < kEdge; ++j, row += kEdge)
          for (std::int32_t i = 0; i < kEdge;) {
            const std::int32_t owner = row[i], from = i;
            while (i < kEdge && row[i] == owner) ++i;
            if (owner < 0) continue;
            add_run(shares[static_cast<std::size_t>(owner)], tile->tile * kEdge + IVec2{from, j}, i - from);
          }
      }
      for (std::size_t t = 0; t < shares.size(); ++t) {
        if (shares[t].voxels == 0) continue;
        shares[t].layer = layer;
        found[n].push_back({t, shares[t]});
      }
    });

    // Count, prefix sum, fill: by claimant, then by layer.
    space_.first_share_.assign(trees_.size() + 1, 0);
    for (const auto& layer : found)
      for (const Found& f : layer) ++space_.first_share_[f.claimant + 1];
    std::partial_sum(space_.first_share_.begin(), space_.first_share_.end(), space_.first_share_.begin());
    space_.shares_.resize(space_.first_share_.back());
    std::vector<std::size_t> next(space_.first_share_.begin(), space_.first_share_.end() - 1);
    for (const auto& layer : found)
      for (const Found& f : layer) {
        space_.shares_[next[f.claimant]++] = f.share;
        space_.claimed_ += static_cast<std::size_t>(f.share.voxels);
      }
  }

  // Adds `n` voxels from `first` eastwards.
  static void add_run(LayerShare& share, IVec2 first, std::int32_t n) {
    const IVec2 last = first + IVec2{n - 1, 0};
    share.low = share.voxels == 0 ? first : glm::min(share.low, first);
    share.high = share.voxels == 0 ? last : glm::max(share.high, last);
    share.voxels += n;
    share.east_sum += (std::int64_t{first.x} + last.x) * n / 2;
    share.north_sum += std::int64_t{first.y} * n;
  }

  std::span<const Claimant> trees_;
  const terrain::Terrain& terrain_;
  const SpaceOptions& options_;
  CrownSpace space_;
  std::vector<Placed> placed_;
  std::vector<std::size_t> by_key_;
  std::vector<std::int32_t> rank_;
  Domain domain_;
  std::vector<Plot> plots_;
  std::vector<std::shared_ptr<SpaceTile>> tiles_;
  std::int32_t first_layer_ = 0;
  std::size_t layers_ = 0;
};

Result<CrownSpace> divide_space(std::span<const Claimant> trees, const terrain::Terrain& terrain,
                                const SpaceOptions& options, Progress* progress) {
  return SpaceBuilder(trees, terrain, options).build(progress);
}

}  // namespace bosquet::crowns
