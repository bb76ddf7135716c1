#include "crowns/layer_update.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "crowns/propagation.h"

namespace bosquet::crowns {
namespace {

// Rings of neighbours that are divided with the edited trees at first.
constexpr int kRings = 2;

class LayerUpdate {
 public:
  LayerUpdate(SpaceEdit& edit, std::int32_t layer) : edit_(edit), layer_(layer) {}

  void run() {
    joined_.assign(edit_.claimant.size(), 0);
    begin();
    if (set_.empty()) return;
    for (int ring = 0; ring < kRings; ++ring) join_neighbours();
    do divide();
    while (widen());
  }

  std::vector<LayerSheet>& sheets() { return sheets_; }

 private:
  // The edited trees, and those that own a voxel which an edit takes or beside one that it frees.
  void begin() {
    for (std::int32_t slot : edit_.edited) {
      const Placed *was = edit_.old_place(slot), *is = edit_.new_place(slot);
      if (was && was->takes_part(layer_)) join(slot);
      if (!is || !is->takes_part(layer_)) continue;
      join(slot);
      join(before(is->root));
    }
    for (const Obstacle* o : edit_.new_obstacles)
      for (const ColumnSpan& s : o->volume->spans)
        if (spans(s)) join(before_if_held(s.column));
    for (const Obstacle* o : edit_.gone_obstacles)
      for (const ColumnSpan& s : o->volume->spans)
        if (spans(s))
          for (IVec2 step : kBeside)
            if (const std::int32_t slot = before_if_held(s.column + step); slot >= 0)
              join(slot), sheet_at(tile_of(s.column));  // it may go on into the voxel
    for (const GroundEdit& g : edit_.ground_edits) {
      if (layer_ < g.low || layer_ >= g.high) continue;
      if (!g.opened) {
        join(before_if_held(g.column));
        continue;
      }
      for (IVec2 step : kBeside)
        if (const std::int32_t slot = before_if_held(g.column + step); slot >= 0)
          join(slot), sheet_at(tile_of(g.column));
    }
  }
  bool spans(const ColumnSpan& s) const { return s.low <= layer_ && layer_ < s.high; }

  void join(std::int32_t slot) {
    if (slot < 0 || joined_[static_cast<std::size_t>(slot)]) return;
    joined_[static_cast<std::size_t>(slot)] = 1;
    set_.push_back(slot);
  }
  bool has_joined(std::int32_t slot) const { return slot >= 0 && joined_[static_cast<std::size_t>(slot)]; }

  // Sheets, loaded when first asked for; kGone off the domain.
  std::int32_t sheet_at(IVec2 tile) {
    if (!sheets_.empty() && sheets_[static_cast<std::size_t>(last_)].tile == tile) return last_;
    const auto [at, added] = index_.emplace(packed(tile), static_cast<std::int32_t>(sheets_.size()));
    if (added) load(tile);
    return last_ = at->second;
  }

  void load(IVec2 tile) {
    LayerSheet sheet;
    sheet.tile = tile;
    sheet.before.assign(kSheetColumns, kFree);
    if (const SpaceTile* held = edit_.before.find_tile(tile); held && held->has(layer_)) {
      const std::size_t offset = held->offset(layer_);
      std::copy_n(held->owner.begin() + static_cast<std::ptrdiff_t>(offset), kSheetColumns, sheet.before.begin());
      const auto under = std::partition_point(held->under_heroes.begin(), held->under_heroes.end(),
                                              [&](const SpaceTile::Under& u) { return u.place < offset; });
      for (auto u = under; u != held->under_heroes.end() && u->place < offset + kSheetColumns; ++u)
        sheet.before[u->place - offset] = u->owner;
      const bool hangs = layer_ < held->highest_base;
      for (std::int32_t& owner : sheet.before)
        if (owner < 0 || (hangs && edit_.old_place(owner)->base > layer_)) owner = kFree;
    }
    sheet.now = sheet.before;
    sheet.divided.assign(kSheetColumns, 0);
    sheet.open.assign(kSheetColumns, 0);
    const auto ground = edit_.ground_of(tile);
    for (std::size_t c = 0; c < kSheetColumns; ++c) sheet.open[c] = (*ground)[c] <= layer_;
    for (const Obstacle& o : edit_.standing.obstacles)
      for_each_span(*o.volume, tile, [&](const ColumnSpan& s) {
        if (spans(s)) sheet.open[inside(s.column)] = 0;
      });
    sheets_.push_back(std::move(sheet));
  }

  std::int32_t before(IVec2 column) {
    return sheets_[static_cast<std::size_t>(sheet_at(tile_of(column)))].before[inside(column)];
  }
  // Without loading tiles where nobody was.
  std::int32_t before_if_held(IVec2 column) {
    const SpaceTile* held = edit_.before.find_tile(tile_of(column));
    return held && held->has(layer_) ? before(column) : kFree;
  }

  // Calls visit(column) for every voxel that a tree had in this layer, and some more around them.
  template <class Visit>
  void for_each_column(std::int32_t slot, const Visit& visit) {
    const std::int32_t claimant = static_cast<std::size_t>(slot) < edit_.old_claimant.size()
                                      ? edit_.old_claimant[static_cast<std::size_t>(slot)]
                                      : kGone;
    if (claimant == kGone) return;
    const auto shares = edit_.before.shares(static_cast<std::size_t>(claimant));
    const auto at =
        std::partition_point(shares.begin(), shares.end(), [&](const LayerShare& s) { return s.layer < layer_; });
    if (at != shares.end() && at->layer == layer_)
      for (std::int32_t j = at->low.y; j <= at->high.y; ++j)
        for (std::int32_t i = at->low.x; i <= at->high.x; ++i) visit(IVec2{i, j});
    const auto key = std::tuple(slot, layer_);
    for (auto h = std::partition_point(edit_.hidden.begin(), edit_.hidden.end(),
                                       [&](const HiddenVoxel& x) { return std::tuple(x.slot, x.layer) < key; });
         h != edit_.hidden.end() && std::tuple(h->slot, h->layer) == key; ++h)
      visit(h->column);
  }

  void join_neighbours() {
    const std::size_t size = set_.size();
    for (; ringed_ < size; ++ringed_) {
      const std::int32_t slot = set_[ringed_];
      for_each_column(slot, [&](IVec2 c) {
        if (before(c) != slot) return;
        for (IVec2 step : kBeside) join(before_if_held(c + step));
      });
    }
  }

  void divide() {
    // All that the joined trees had is loaded, so that it is theirs to divide again.
    std::vector<Front> fronts;
    for (std::int32_t slot : set_) {
      for_each_column(slot, [&](IVec2 c) { sheet_at(tile_of(c)); });
      const Placed* p = edit_.new_place(slot);
      if (!p || !p->takes_part(layer_)) continue;
      fronts.push_back(
          front_of(*p, edit_.layout.rank[static_cast<std::size_t>(edit_.claimant[static_cast<std::size_t>(slot)])]));
      fronts.back().owner = slot;
      fronts.back().root = static_cast<std::uint32_t>(sheet_at(tile_of(p->root)) * kTileColumns) +
                           static_cast<std::uint32_t>(inside(p->root));
    }
    LayerCells cells;
    const auto block = [&](IVec2 tile) {
      const auto at = index_.find(packed(tile));
      return at == index_.end() ? LayerCells::kNoBlock : at->second;
    };
    for (LayerSheet& s : sheets_) {
      const IVec2 t = s.tile;
      cells.blocks.push_back(
          {t * kTileEdge, block(t + kBeside[0]), block(t + kBeside[1]), block(t + kBeside[2]), block(t + kBeside[3])});
      for (std::size_t c = 0; c < kSheetColumns; ++c) {
        const bool theirs = s.before[c] == kFree || has_joined(s.before[c]);
        s.divided[c] = theirs;
        cells.open.push_back(theirs && s.open[c]);
      }
    }
    const LayerResult result = propagate(fronts, cells);
    for (std::size_t n = 0; n < sheets_.size(); ++n) {
      LayerSheet& s = sheets_[n];
      for (std::size_t c = 0; c < kSheetColumns; ++c) {
        const std::int32_t f = result.front[n * kSheetColumns + c];
        if (s.divided[c]) s.now[c] = f == LayerResult::kUnclaimed ? kFree : fronts[static_cast<std::size_t>(f)].owner;
      }
      if (edit_.options.keep_ticks)
        s.ticks.assign(result.ticks.begin() + static_cast<std::ptrdiff_t>(n * kSheetColumns),
                       result.ticks.begin() + static_cast<std::ptrdiff_t>((n + 1) * kSheetColumns));
    }
  }

  // Joins the held trees that touch what changed, and loads tiles that a changed tree can go on into. False when there
  // are none.
  bool widen() {
    std::vector<std::uint8_t> changed(joined_.size(), 0);
    for (std::int32_t slot : edit_.edited) changed[static_cast<std::size_t>(slot)] = 1;
    for (const LayerSheet& s : sheets_)
      for (std::size_t c = 0; c < kSheetColumns; ++c) {
        if (s.before[c] == s.now[c]) continue;
        if (s.before[c] >= 0) changed[static_cast<std::size_t>(s.before[c])] = 1;
        if (s.now[c] >= 0) changed[static_cast<std::size_t>(s.now[c])] = 1;
      }
    const std::size_t joined = set_.size(), sheets = sheets_.size();
    bool wider = false;
    for (std::size_t n = 0; n < sheets; ++n)
      for (std::int32_t j = 0; j < kTileEdge; ++j)
        for (std::int32_t i = 0; i < kTileEdge; ++i) {
          const auto c = static_cast<std::size_t>(j * kTileEdge + i);
          const std::int32_t was = sheets_[n].before[c], is = sheets_[n].now[c];
          const bool grows = is >= 0 && changed[static_cast<std::size_t>(is)];
          if (!grows && !(was >= 0 && changed[static_cast<std::size_t>(was)])) continue;
          const bool inner = i > 0 && j > 0 && i < kTileEdge - 1 && j < kTileEdge - 1;
          if (inner) {
            for (std::int32_t step : {-1, 1, -kTileEdge, kTileEdge})
              join(sheets_[n].before[static_cast<std::size_t>(static_cast<std::int32_t>(c) + step)]);
            continue;
          }
          for (IVec2 step : kBeside) {
            const IVec2 column = sheets_[n].tile * kTileEdge + IVec2{i, j} + step;
            if (edit_.before.find_tile(tile_of(column))) join(before_if_held(column));
            if (!grows || !reaches(*edit_.new_place(is), column)) continue;
            const auto at = static_cast<std::size_t>(sheet_at(tile_of(column)));
            if (at < sheets) continue;  // took part in the division
            const LayerSheet& beside = sheets_[at];
            wider = wider || (beside.open[inside(column)] && beside.before[inside(column)] == kFree);
          }
        }
    return wider || set_.size() > joined;
  }
  bool reaches(const Placed& p, IVec2 column) const {
    const double x = column.x + 0.5 - p.east, y = column.y + 0.5 - p.north;
    return edit_.layout.domain.contains(column) && p.reach >= 0 && x * x + y * y <= p.reach * p.reach;
  }

  SpaceEdit& edit_;
  std::int32_t layer_;
  std::vector<std::uint8_t> joined_;
  std::vector<std::int32_t> set_;
  std::size_t ringed_ = 0;
  std::vector<LayerSheet> sheets_;
  std::unordered_map<std::uint64_t, std::int32_t> index_;
  std::int32_t last_ = 0;
};

}  // namespace

std::vector<LayerSheet> update_layer(SpaceEdit& edit, std::int32_t layer) {
  LayerUpdate update(edit, layer);
  update.run();
  return std::move(update.sheets());
}

}  // namespace bosquet::crowns
