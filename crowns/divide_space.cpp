// Divides the volume above a terrain: tiles where anything can claim, obstacles, fronts layer by layer, what hangs below
// a base, hero trees.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <thread>
#include <unordered_map>

#include "core/parallel.h"
#include "crowns/crown_space.h"
#include "crowns/propagation.h"
#include "crowns/space_layout.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

constexpr double kMostVoxel = 20.0;  // as described
// Scratch of one layer at work: cell, open flag, result.
constexpr double kScratchBytes = 16 + 1 + 4 + 8;

// A tile before its voxels.
struct Plot {
  IVec2 tile{0};
  std::int32_t bottom = std::numeric_limits<std::int32_t>::max();  // layers [bottom, top)
  std::int32_t top = std::numeric_limits<std::int32_t>::lowest();
  std::int32_t highest_base = std::numeric_limits<std::int32_t>::lowest();
  std::shared_ptr<const std::vector<std::int32_t>> ground;
  std::int32_t west = -1, east = -1, south = -1, north = -1;  // plots beside it
};

// Voxel edge with some room to spare, two digits, rounded up.
double rounded_up(double v) {
  double unit = 0.01;
  while (v / unit > 99.0) unit *= 10.0;
  return std::ceil(v / unit) * unit;
}

}  // namespace

class SpaceBuilder {
 public:
  SpaceBuilder(std::span<const Claimant> trees, const Standing& standing, const terrain::Terrain& terrain,
               const SpaceOptions& options)
      : trees_(trees), standing_(standing), terrain_(terrain), options_(options) {}

  Result<CrownSpace> build(Progress* progress) {
    if (auto checked = check_input(trees_, standing_, options_); !checked) return checked.error();
    auto layout = lay_out(trees_, standing_, terrain_.size_m(), options_);
    if (!layout) return layout.error();
    layout_ = std::move(*layout);
    if (const double bytes = plan(); bytes > 0) return too_large(bytes);
    space_.options_ = options_;
    space_.claimants_.assign(trees_.begin(), trees_.end());
    space_.standing_ = standing_;
    space_.slot_of_.resize(trees_.size());
    std::iota(space_.slot_of_.begin(), space_.slot_of_.end(), 0);
    space_.claimant_of_ = space_.slot_of_;
    allocate();
    if (!divide(progress)) return cannot_finish("dividing the space was cancelled");
    parallel_for(tiles_.size(), [&](std::size_t n) {
      hang_below_bases(*tiles_[n],
                       [&](std::int32_t slot) { return layout_.placed[static_cast<std::size_t>(slot)].base; });
      claim_for_heroes(*tiles_[n], layout_);
    });
    count_shares();
    for (auto& tile : tiles_) space_.tiles_.push_back(std::move(tile));
    space_.layout_ = std::make_shared<const SpaceLayout>(std::move(layout_));
    return std::move(space_);
  }

 private:
  // Which tiles are needed. Returns 0, or the bytes that it would take when they are too many.
  double plan() {
    if (const double bytes = plan_tiles(); bytes > byte_limit()) return bytes;
    if (const double bytes = needed_bytes(); bytes > byte_limit()) return bytes;  // not yet with what lies below bases
    sample_ground();
    if (const double bytes = needed_bytes(); bytes > byte_limit()) return bytes;
    return 0;
  }

  // Tiles where something can claim, with the layers that it needs. Returns the bytes of their voxels, which is a lower
  // bound when they are too many.
  double plan_tiles() {
    std::unordered_map<std::uint64_t, std::size_t> index;
    const auto plot = [&](IVec2 tile) -> Plot& {
      const auto [at, added] = index.emplace(packed(tile), plots_.size());
      if (added) plots_.emplace_back().tile = tile;
      return plots_[at->second];
    };
    const auto reached = [&](IVec2 tile, std::int32_t base, std::int32_t top, std::int32_t highest_base) {
      Plot& p = plot(tile);
      p.bottom = std::min(p.bottom, base);
      p.top = std::max(p.top, top);
      p.highest_base = std::max(p.highest_base, highest_base);
    };
    const Domain& domain = layout_.domain;
    const double tile_bytes = kTileColumns * voxel_bytes();
    Plot everywhere;
    for (const Placed& p : layout_.placed) {
      const auto side = [&](int axis) {
        const double at = axis == 0 ? p.east : p.north;
        return (std::min(at + p.reach, domain.high[axis] + 1.0) - std::max(at - p.reach, 1.0 * domain.low[axis])) /
               64.0;
      };
      // A disc fills more than half of its box but for the rounding to tiles.
      const double disc = 0.5 * std::max(side(0), 0.0) * std::max(side(1), 0.0) * (p.top - p.base) * tile_bytes;
      const double held = static_cast<double>(plots_.size()) * tile_bytes;
      if (std::max(disc, held) > byte_limit()) return std::max(disc, held);
      if (reaches_everything(p, domain)) {
        everywhere.bottom = std::min(everywhere.bottom, p.base);
        everywhere.top = std::max(everywhere.top, p.top);
        everywhere.highest_base = std::max(everywhere.highest_base, p.base);
      } else {
        for_each_tile_reached(p, domain, [&](IVec2 tile) { reached(tile, p.base, p.top, p.base); });
      }
    }
    if (everywhere.bottom < everywhere.top)
      for (std::int32_t n = tile_of(domain.low).y; n <= tile_of(domain.high).y; ++n)
        for (std::int32_t e = tile_of(domain.low).x; e <= tile_of(domain.high).x; ++e)
          reached({e, n}, everywhere.bottom, everywhere.top, everywhere.highest_base);
    if (double bytes = plan_standing(reached, tile_bytes); bytes > 0) return bytes;

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

  // Tiles of obstacles and of hero trees.
  template <class Reached>
  double plan_standing(const Reached& reached, double tile_bytes) {
    constexpr std::int32_t kNoBase = std::numeric_limits<std::int32_t>::lowest();
    for (const Obstacle& o : standing_.obstacles)
      for (const ColumnSpan& s : o.volume->spans) {
        if (!layout_.domain.contains(s.column)) continue;
        reached(tile_of(s.column), s.high - 1, s.high, kNoBase);  // down to the ground, whose height comes later
        if (static_cast<double>(plots_.size()) * tile_bytes > byte_limit())
          return static_cast<double>(plots_.size()) * tile_bytes;
      }
    for (const auto& [tile, voxels] : layout_.heroes)
      for (const HeroVoxel& v : voxels)
        reached({static_cast<std::int32_t>(tile & 0xffffffffu), static_cast<std::int32_t>(tile >> 32)}, v.layer,
                v.layer + 1, kNoBase);
    return 0;
  }

  // A voxel exists when a part of it lies above the ground at its column's centre.
  void sample_ground() {
    parallel_for(plots_.size(), [&](std::size_t n) {
      Plot& plot = plots_[n];
      plot.ground = ground_layers(plot.tile, terrain_, layout_.domain, options_);
      plot.bottom = std::min(plot.bottom, *std::min_element(plot.ground->begin(), plot.ground->end()));
      plot.top = std::max(plot.top, plot.bottom);
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

  // Tries larger voxels until one fits. Obstacles are left out of the trial: they are few and made for one voxel size.
  Error too_large(double bytes) const {
    SpaceOptions tried = options_;
    const Standing nothing;
    std::string advice = "no voxel_m would fit: raise layer_m or limit the reach";
    for (double grow = std::sqrt(bytes / byte_limit()); grow * static_cast<double>(options_.voxel_m) <= kMostVoxel;
         grow *= 1.1) {
      tried.voxel_m = static_cast<float>(rounded_up(grow * static_cast<double>(options_.voxel_m)));
      SpaceBuilder larger(trees_, nothing, terrain_, tried);
      auto layout = lay_out(trees_, nothing, terrain_.size_m(), tried);
      if (!layout) continue;
      larger.layout_ = std::move(*layout);
      if (larger.plan() > 0) continue;
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
      tile->highest_base = plot.highest_base;
      tile->ground = plot.ground;
      const std::size_t voxels = static_cast<std::size_t>(tile->layers) * static_cast<std::size_t>(kTileColumns);
      tile->owner.assign(voxels, kFree);
      if (options_.keep_ticks) tile->ticks.assign(voxels, 0);
      claim_for_obstacles(*tile, standing_);
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
    constexpr auto kColumns = static_cast<std::size_t>(kTileColumns);
    cells.open.reserve(plot_of.size() * kColumns);
    for (std::size_t n : plot_of) {
      const Plot& p = plots_[n];
      cells.blocks.push_back({p.tile * kTileEdge, block(p.west), block(p.east), block(p.south), block(p.north)});
      const std::int32_t* owner = tiles_[n]->owner.data() + tiles_[n]->offset(layer);
      for (std::size_t c = 0; c < kColumns; ++c) cells.open.push_back((*p.ground)[c] <= layer && owner[c] == kFree);
    }

    // Trees whose shapes reach the layer.
    std::vector<Front> fronts;
    for (std::size_t t = 0; t < trees_.size(); ++t) {
      const Placed& p = layout_.placed[t];
      if (!p.takes_part(layer)) continue;
      const std::size_t home = plot_at(tile_of(p.root));
      Front f = front_of(p, layout_.rank[t]);
      f.root = static_cast<std::uint32_t>(static_cast<std::size_t>(block_of[home]) * kColumns + inside(p.root));
      f.owner = static_cast<std::int32_t>(t);
      fronts.push_back(f);
    }
    if (fronts.empty()) return;

    // Write to this layer's own slices.
    const LayerResult result = propagate(fronts, cells);
    for (std::size_t b = 0; b < plot_of.size(); ++b) {
      SpaceTile& tile = *tiles_[plot_of[b]];
      const std::size_t from = b * kColumns, to = tile.offset(layer);
      for (std::size_t c = 0; c < kColumns; ++c) {
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
        for (std::int32_t j = 0; j < kTileEdge; ++j, row += kTileEdge)
          for (std::int32_t i = 0; i < kTileEdge;) {
            const std::int32_t owner = row[i], from = i;
            while (i < kTileEdge && row[i] == owner) ++i;
            if (owner < 0) continue;
            add_run(shares[static_cast<std::size_t>(owner)], tile->tile * kTileEdge + IVec2{from, j}, i - from);
          }
      }
      for (std::size_t t = 0; t < shares.size(); ++t) {
        if (shares[t].voxels == 0) continue;
        shares[t].layer = layer;
        found[n].push_back({t, shares[t]});
      }
    });

    // By claimant, then by layer.
    std::vector<std::vector<LayerShare>> of(trees_.size());
    for (const auto& layer : found)
      for (const Found& f : layer) {
        of[f.claimant].push_back(f.share);
        space_.claimed_ += static_cast<std::size_t>(f.share.voxels);
      }
    for (auto& shares : of)
      space_.shares_.push_back(std::make_shared<const std::vector<LayerShare>>(std::move(shares)));
  }

  std::span<const Claimant> trees_;
  const Standing& standing_;
  const terrain::Terrain& terrain_;
  const SpaceOptions& options_;
  SpaceLayout layout_;
  CrownSpace space_;
  std::vector<Plot> plots_;
  std::vector<std::shared_ptr<SpaceTile>> tiles_;
  std::int32_t first_layer_ = 0;
  std::size_t layers_ = 0;
};

Result<CrownSpace> divide_space(std::span<const Claimant> trees, const Standing& standing,
                                const terrain::Terrain& terrain, const SpaceOptions& options, Progress* progress) {
  return SpaceBuilder(trees, sorted(standing), terrain, options).build(progress);
}

Result<CrownSpace> divide_space(std::span<const Claimant> trees, const terrain::Terrain& terrain,
                                const SpaceOptions& options, Progress* progress) {
  return divide_space(trees, {}, terrain, options, progress);
}

}  // namespace bosquet::crowns
