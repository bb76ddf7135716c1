#include "crowns/update_space.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/parallel.h"
#include "crowns/layer_update.h"
#include "crowns/space_layout.h"
#include "terrain/terrain.h"

namespace bosquet::crowns {

class SpaceUpdater {
 public:
  SpaceUpdater(const CrownSpace& previous, std::span<const Claimant> trees, const Standing& standing,
               const terrain::Terrain& terrain, const SpaceOptions& options, const Reshaped& reshaped)
      : previous_(previous),
        trees_(trees),
        standing_(standing),
        terrain_(terrain),
        options_(options),
        reshaped_(reshaped) {}

  Result<SpaceUpdate> run() {
    if (auto checked = check_input(trees_, standing_, options_); !checked) return checked.error();
    if (!previous_.layout_ || options_ != previous_.options_) return whole();
    auto layout = lay_out(trees_, standing_, terrain_.size_m(), options_);
    if (!layout) return layout.error();
    if (layout->domain != previous_.layout_->domain) return whole();
    layout_ = std::make_shared<const SpaceLayout>(std::move(*layout));

    SpaceEdit edit{previous_,
                   *previous_.layout_,
                   *layout_,
                   standing_,
                   terrain_,
                   options_,
                   previous_.claimant_of_,
                   {},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {}};
    if (!match(edit)) return whole();
    find_obstacle_edits(edit);
    find_ground_edits(edit);
    find_hidden(edit);
    divide(edit);
    rebuild_tiles(edit);
    finish(edit);
    if (static_cast<double>(update_.space.bytes()) > static_cast<double>(options_.memory_gb) * 1e9) return whole();
    return std::move(update_);
  }

 private:
  Result<SpaceUpdate> whole() const {
    auto space = divide_space(trees_, standing_, terrain_, options_);
    if (!space) return space.error();
    SpaceUpdate update;
    update.space = std::move(*space);
    update.changed.resize(trees_.size());
    std::iota(update.changed.begin(), update.changed.end(), std::size_t{0});
    update.whole = true;
    return update;
  }

  // Slots of the trees after the edit, and which of them have other fronts. False when ids are not unique.
  bool match(SpaceEdit& edit) {
    const auto old = previous_.claimants();
    const auto n = trees_.size();
    std::vector<std::int32_t> was(n, kGone);
    const auto same_ids = [&] {
      if (old.size() != n) return false;
      for (std::size_t i = 0; i < n; ++i)
        if (old[i].id != trees_[i].id) return false;
      return true;
    };
    if (same_ids()) {
      std::iota(was.begin(), was.end(), 0);
    } else {
      std::unordered_map<std::int32_t, std::int32_t> by_id(2 * old.size());
      for (std::size_t i = 0; i < old.size(); ++i)
        if (!by_id.emplace(old[i].id, static_cast<std::int32_t>(i)).second) return false;
      for (std::size_t i = 0; i < n; ++i)
        if (const auto at = by_id.find(trees_[i].id); at != by_id.end()) {
          if (at->second == kGone) return false;
          was[i] = std::exchange(at->second, kGone);
        }
    }

    edit.claimant.assign(edit.old_claimant.size(), kGone);
    slot_of_.assign(n, kGone);
    for (std::size_t i = 0; i < n; ++i) {
      if (was[i] == kGone) continue;
      const std::int32_t slot = slot_of_[i] = previous_.slot_of_[static_cast<std::size_t>(was[i])];
      edit.claimant[static_cast<std::size_t>(slot)] = static_cast<std::int32_t>(i);
      const Claimant &before = old[static_cast<std::size_t>(was[i])], &now = trees_[i];
      if (before != now) {
        edited_.push_back(slot);
        Claimant level = now;
        level.ground_y = before.ground_y;
        if (before != level) update_.edits.insert(update_.edits.end(), {before, now});
      }
      if (before.key != now.key || layout_->placed[i] != previous_.layout_->placed[static_cast<std::size_t>(was[i])])
        edit.edited.push_back(slot);
    }
    for (std::size_t s = 0; s < edit.old_claimant.size(); ++s)
      if (edit.old_claimant[s] != kGone && edit.claimant[s] == kGone) {
        edit.edited.push_back(static_cast<std::int32_t>(s));
        update_.edits.push_back(old[static_cast<std::size_t>(edit.old_claimant[s])]);
      }
    // A new tree takes a slot that was empty before, else a new one.
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (slot_of_[i] != kGone) continue;
      const auto taken = [&](std::size_t slot) {
        return edit.claimant[slot] != kGone || (slot < edit.old_claimant.size() && edit.old_claimant[slot] != kGone);
      };
      while (next < edit.claimant.size() && taken(next)) ++next;
      if (next >= edit.claimant.size()) edit.claimant.push_back(kGone);
      slot_of_[i] = static_cast<std::int32_t>(next);
      edit.claimant[next] = static_cast<std::int32_t>(i);
      edit.edited.push_back(slot_of_[i]);
      edited_.push_back(slot_of_[i]);
      update_.edits.push_back(trees_[i]);
    }
    return true;
  }

  void find_obstacle_edits(SpaceEdit& edit) {
    const auto missing_in = [](const Obstacle& o, const Standing& in) {
      return std::none_of(in.obstacles.begin(), in.obstacles.end(),
                          [&](const Obstacle& other) { return other.id == o.id && other.volume == o.volume; });
    };
    const auto note = [&](const Obstacle& o, std::vector<const Obstacle*>& list) {
      list.push_back(&o);
      if (o.volume->spans.empty()) return;
      update_.obstacle_edits.push_back(
          {Vec2(o.volume->low) * options_.voxel_m, (Vec2(o.volume->high) + 1.0f) * options_.voxel_m});
    };
    for (const Obstacle& o : previous_.standing_.obstacles)
      if (missing_in(o, standing_)) note(o, edit.gone_obstacles);
    for (const Obstacle& o : standing_.obstacles)
      if (missing_in(o, previous_.standing_)) note(o, edit.new_obstacles);
  }

  // Columns that begin at another layer, in tiles that are held and in those beside them, into which a tree may go on.
  void find_ground_edits(SpaceEdit& edit) {
    if (!reshaped_.before) return;
    update_.reshaped = reshaped_.where;
    std::set<std::pair<std::int32_t, std::int32_t>> tiles;
    const auto within = [&](IVec2 tile) {
      const Box2 box{Vec2(tile * kTileEdge) * options_.voxel_m, Vec2((tile + 1) * kTileEdge) * options_.voxel_m};
      return std::any_of(reshaped_.where.begin(), reshaped_.where.end(), [&](const Box2& b) {
        return b.low.x <= box.high.x && b.low.y <= box.high.y && b.high.x >= box.low.x && b.high.y >= box.low.y;
      });
    };
    for (const auto& held : previous_.tiles_) {
      if (within(held->tile)) tiles.insert({held->tile.y, held->tile.x});
      for (IVec2 step : kBeside)
        if (const IVec2 tile = held->tile + step; within(tile)) tiles.insert({tile.y, tile.x});
    }
    std::vector<IVec2> asked;
    for (const auto& [n, e] : tiles) asked.push_back({e, n});
    std::vector<std::shared_ptr<const std::vector<std::int32_t>>> was(asked.size()), is(asked.size());
    parallel_for(asked.size(), [&](std::size_t t) {
      const SpaceTile* held = previous_.find_tile(asked[t]);
      was[t] = held ? held->ground : ground_layers(asked[t], *reshaped_.before, layout_->domain, options_);
      is[t] = ground_layers(asked[t], terrain_, layout_->domain, options_);
    });
    for (std::size_t t = 0; t < asked.size(); ++t) {
      if (*was[t] == *is[t]) continue;
      edit.ground[packed(asked[t])] = is[t];
      if (previous_.find_tile(asked[t])) reshaped_tiles_.push_back(asked[t]);
      for (std::int32_t c = 0; c < kTileColumns; ++c) {
        const std::int32_t a = (*was[t])[static_cast<std::size_t>(c)], b = (*is[t])[static_cast<std::size_t>(c)];
        if (a != b)
          edit.ground_edits.push_back(
              {asked[t] * kTileEdge + IVec2{c % kTileEdge, c / kTileEdge}, std::min(a, b), std::max(a, b), b < a});
      }
    }
  }

  void find_hidden(SpaceEdit& edit) {
    for (const auto& tile : previous_.tiles_)
      for (const SpaceTile::Under& u : tile->under_heroes) {
        if (u.owner < 0) continue;
        const auto c = static_cast<std::int32_t>(u.place % kSheetColumns);
        edit.hidden.push_back({u.owner, tile->first_layer + static_cast<std::int32_t>(u.place / kSheetColumns),
                               tile->tile * kTileEdge + IVec2{c % kTileEdge, c / kTileEdge}});
      }
    std::sort(edit.hidden.begin(), edit.hidden.end(), [](const HiddenVoxel& a, const HiddenVoxel& b) {
      return std::tie(a.slot, a.layer, a.column.y, a.column.x) < std::tie(b.slot, b.layer, b.column.y, b.column.x);
    });
  }

  // Layers in which something that was edited takes part.
  void divide(SpaceEdit& edit) {
    std::int32_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::lowest();
    const auto note = [&](const Placed* p) {
      if (p) low = std::min(low, p->base), high = std::max(high, p->top);
    };
    // Beyond the layers that any tree takes part in, obstacles and ground change no front.
    const bool obstacles = !edit.gone_obstacles.empty() || !edit.new_obstacles.empty();
    if (obstacles || !edit.ground_edits.empty()) {
      for (const Placed& p : edit.old_layout.placed) note(&p);
      for (const Placed& p : edit.layout.placed) note(&p);
    }
    if (!obstacles) {
      const std::int32_t least = low, most = high;
      low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::lowest();
      for (std::int32_t slot : edit.edited) note(edit.old_place(slot)), note(edit.new_place(slot));
      for (const GroundEdit& g : edit.ground_edits)
        low = std::min(low, std::max(g.low, least)), high = std::max(high, std::min(g.high, most));
    }
    layers_.resize(low < high ? static_cast<std::size_t>(high - low) : 0);
    parallel_for(layers_.size(),
                 [&](std::size_t n) { layers_[n] = update_layer(edit, low + static_cast<std::int32_t>(n)); });
    first_layer_ = low;
  }

  struct Part {
    std::int32_t layer;
    const LayerSheet* sheet;
  };
  struct Touched {
    IVec2 tile{0};
    std::vector<Part> parts;
    std::int32_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::lowest();
    std::shared_ptr<const SpaceTile> tile_now;       ///< null when nothing is other
    std::unordered_map<std::int32_t, Domain> moved;  ///< slot -> columns where it won or lost a voxel
    void need(std::int32_t from, std::int32_t to) { low = std::min(low, from), high = std::max(high, to); }
  };
  Touched& touch(IVec2 tile) {
    const auto [at, added] = touched_at_.emplace(packed(tile), touched_.size());
    if (added) touched_.emplace_back().tile = tile;
    return touched_[at->second];
  }

  void rebuild_tiles(SpaceEdit& edit) {
    for (std::size_t n = 0; n < layers_.size(); ++n)
      for (const LayerSheet& s : layers_[n]) {
        if (s.before == s.now && (!options_.keep_ticks || s.ticks.empty())) continue;
        const std::int32_t layer = first_layer_ + static_cast<std::int32_t>(n);
        Touched& t = touch(s.tile);
        t.parts.push_back({layer, &s});
        t.need(layer, layer + 1);
      }
    // Where an edited tree stood or stands, voxels may hang below its base.
    for (std::int32_t slot : edit.edited) {
      const std::int32_t c = static_cast<std::size_t>(slot) < edit.old_claimant.size()
                                 ? edit.old_claimant[static_cast<std::size_t>(slot)]
                                 : kGone;
      if (c == kGone) continue;
      for (const LayerShare& s : previous_.shares(static_cast<std::size_t>(c)))
        for (std::int32_t n = tile_of(s.low).y; n <= tile_of(s.high).y; ++n)
          for (std::int32_t e = tile_of(s.low).x; e <= tile_of(s.high).x; ++e) touch({e, n});
    }
    for (const Obstacle* o : edit.gone_obstacles)
      for (const ColumnSpan& s : o->volume->spans)
        if (previous_.find_tile(tile_of(s.column))) touch(tile_of(s.column));
    for (const Obstacle* o : edit.new_obstacles)
      for (const ColumnSpan& s : o->volume->spans)
        if (layout_->domain.contains(s.column)) touch(tile_of(s.column)).need(s.high - 1, s.high);
    for (IVec2 tile : reshaped_tiles_) touch(tile);
    const auto same = [](const std::vector<HeroVoxel>& a, const std::vector<HeroVoxel>& b) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HeroVoxel& x, const HeroVoxel& y) {
        return x.layer == y.layer && x.column == y.column && x.owner == y.owner;
      });
    };
    const auto differ = [&](const SpaceLayout& a, const SpaceLayout& b) {
      for (const auto& [tile, voxels] : a.heroes) {
        const auto other = b.heroes.find(tile);
        if (other != b.heroes.end() && same(voxels, other->second)) continue;
        touch({static_cast<std::int32_t>(tile & 0xffffffffu), static_cast<std::int32_t>(tile >> 32)});
      }
    };
    differ(edit.old_layout, edit.layout);
    differ(edit.layout, edit.old_layout);
    // Hero trees take voxels above the crowns too.
    for (Touched& t : touched_)
      if (const auto at = edit.layout.heroes.find(packed(t.tile)); at != edit.layout.heroes.end())
        for (const HeroVoxel& v : at->second) t.need(v.layer, v.layer + 1);

    std::int32_t highest = std::numeric_limits<std::int32_t>::lowest();
    for (std::int32_t slot : edit.edited)
      if (const Placed* p = edit.new_place(slot)) highest = std::max(highest, p->base);
    for (const Touched& t : touched_) edit.ground_of(t.tile);
    parallel_for(touched_.size(), [&](std::size_t n) { rebuild(edit, touched_[n], highest); });
  }

  void rebuild(SpaceEdit& edit, Touched& t, std::int32_t highest_base) const {
    const SpaceTile* held = previous_.find_tile(t.tile);
    if (!held && t.low >= t.high) return;
    auto tile = std::make_shared<SpaceTile>();
    tile->tile = t.tile;
    tile->ground = edit.ground_of(t.tile);
    std::int32_t low = t.low, high = t.high;
    if (held) {
      low = std::min(low, held->first_layer), high = std::max(high, held->first_layer + held->layers);
      if (held->ground != tile->ground)
        low = std::min(low, *std::min_element(tile->ground->begin(), tile->ground->end()));
    } else
      low = std::min(low, *std::min_element(tile->ground->begin(), tile->ground->end()));
    tile->first_layer = low;
    tile->layers = high - low;
    // A tree that was not edited may come in from a tile beside: its base counts from now on.
    tile->highest_base = std::max(highest_base, held ? held->highest_base : highest_base);
    std::int32_t last = kFree;
    for (const Part& part : t.parts)
      for (const std::int32_t slot : part.sheet->now) {
        if (slot == last || slot < 0) continue;
        last = slot;
        tile->highest_base = std::max(tile->highest_base, edit.new_place(slot)->base);
      }
    const std::size_t voxels = static_cast<std::size_t>(tile->layers) * kSheetColumns;
    tile->owner.assign(voxels, kFree);
    if (options_.keep_ticks) tile->ticks.assign(voxels, 0);

    // What was there, without hero trees, what hung, and obstacles.
    if (held) {
      const auto shift = static_cast<std::ptrdiff_t>(tile->offset(held->first_layer));
      std::copy(held->owner.begin(), held->owner.end(), tile->owner.begin() + shift);
      if (options_.keep_ticks) std::copy(held->ticks.begin(), held->ticks.end(), tile->ticks.begin() + shift);
      for (const SpaceTile::Under& u : held->under_heroes)
        tile->owner[static_cast<std::size_t>(shift) + u.place] = u.owner;
      const bool standing = !previous_.standing_.obstacles.empty();
      for (std::int32_t k = held->first_layer; k < held->first_layer + held->layers; ++k) {
        const bool hangs = k < held->highest_base;
        if (!hangs && !standing) break;
        const std::size_t from = tile->offset(k);
        for (std::size_t c = from; c < from + kSheetColumns; ++c) {
          std::int32_t& owner = tile->owner[c];
          if (owner < kFree) owner = kFree;
          if (!hangs || owner < 0 || edit.old_place(owner)->base <= k) continue;
          owner = kFree;
          if (options_.keep_ticks) tile->ticks[c] = 0;
        }
      }
    }
    for (const Part& part : t.parts) {
      const std::size_t from = tile->offset(part.layer);
      for (std::size_t c = 0; c < kSheetColumns; ++c) {
        if (!part.sheet->divided[c]) continue;
        tile->owner[from + c] = part.sheet->now[c];
        if (options_.keep_ticks) tile->ticks[from + c] = part.sheet->ticks[c];
      }
    }
    claim_for_obstacles(*tile, standing_);
    hang_below_bases(*tile, [&](std::int32_t slot) { return edit.new_place(slot)->base; });
    claim_for_heroes(*tile, *layout_);
    compare(held, *tile, t.moved);
    t.tile_now = std::move(tile);
  }

  // Which trees won or lost a voxel, and where.
  static void compare(const SpaceTile* held, const SpaceTile& tile, std::unordered_map<std::int32_t, Domain>& moved) {
    const auto note = [&](std::int32_t slot, IVec2 column) {
      if (slot < 0) return;
      const auto [at, added] = moved.emplace(slot, Domain{column, column});
      at->second.low = glm::min(at->second.low, column), at->second.high = glm::max(at->second.high, column);
    };
    for (std::int32_t k = tile.first_layer; k < tile.first_layer + tile.layers; ++k) {
      const std::int32_t* now = tile.owner.data() + tile.offset(k);
      const std::int32_t* was = held && held->has(k) ? held->owner.data() + held->offset(k) : nullptr;
      if (was && std::equal(now, now + kSheetColumns, was)) continue;
      for (std::int32_t c = 0; c < kTileColumns; ++c) {
        const std::int32_t old = was ? was[c] : kFree;
        if (now[c] == old) continue;
        const IVec2 column = tile.tile * kTileEdge + IVec2{c % kTileEdge, c / kTileEdge};
        note(old, column), note(now[c], column);
      }
    }
  }

  void finish(SpaceEdit& edit) {
    CrownSpace& space = update_.space;
    space.options_ = options_;
    space.claimants_.assign(trees_.begin(), trees_.end());
    space.standing_ = standing_;
    space.layout_ = layout_;
    space.slot_of_ = std::move(slot_of_);
    space.claimant_of_ = std::move(edit.claimant);
    replace_tiles();

    // Trees whose voxels are others, and the columns that their shares may lie in.
    std::unordered_map<std::int32_t, Domain> moved;
    const auto grow = [&](std::int32_t slot, const Domain& by) {
      const auto [at, added] = moved.emplace(slot, by);
      at->second.low = glm::min(at->second.low, by.low), at->second.high = glm::max(at->second.high, by.high);
    };
    for (const Touched& t : touched_)
      for (const auto& [slot, columns] : t.moved) grow(slot, columns);
    std::vector<std::int32_t> slots;
    for (const auto& [slot, columns] : moved) slots.push_back(slot);
    std::sort(slots.begin(), slots.end());

    space.shares_.resize(trees_.size());
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      const std::int32_t was = old_of(edit, space.slot_of_[i]);
      if (was != kGone) space.shares_[i] = previous_.shares_[static_cast<std::size_t>(was)];
    }
    const auto count = [](std::span<const LayerShare> shares) {
      std::int64_t sum = 0;
      for (const LayerShare& s : shares) sum += s.voxels;
      return static_cast<std::size_t>(sum);
    };
    space.claimed_ = previous_.claimed_;
    for (std::int32_t slot : slots)
      if (const std::int32_t was = old_of(edit, slot); was != kGone) {
        for (const LayerShare& s : previous_.shares(static_cast<std::size_t>(was))) grow(slot, {s.low, s.high});
        space.claimed_ -= count(previous_.shares(static_cast<std::size_t>(was)));
      }
    parallel_for(slots.size(), [&](std::size_t n) {
      const std::int32_t c = space.claimant_of_[static_cast<std::size_t>(slots[n])];
      if (c != kGone) space.shares_[static_cast<std::size_t>(c)] = shares_in(space, slots[n], moved.at(slots[n]));
    });
    // A new tree all of whose voxels a hero tree took has none.
    for (auto& shares : space.shares_)
      if (!shares) shares = std::make_shared<const std::vector<LayerShare>>();
    for (std::int32_t slot : slots)
      if (const std::int32_t c = space.claimant_of_[static_cast<std::size_t>(slot)]; c != kGone)
        space.claimed_ += count(space.shares(static_cast<std::size_t>(c)));

    slots.insert(slots.end(), edited_.begin(), edited_.end());
    for (std::int32_t slot : slots)
      if (const std::int32_t c = space.claimant_of_[static_cast<std::size_t>(slot)]; c != kGone)
        update_.changed.push_back(static_cast<std::size_t>(c));
    std::sort(update_.changed.begin(), update_.changed.end());
    update_.changed.erase(std::unique(update_.changed.begin(), update_.changed.end()), update_.changed.end());
  }

  static std::int32_t old_of(const SpaceEdit& edit, std::int32_t slot) {
    return static_cast<std::size_t>(slot) < edit.old_claimant.size() ? edit.old_claimant[static_cast<std::size_t>(slot)]
                                                                     : kGone;
  }

  void replace_tiles() {
    auto& tiles = update_.space.tiles_;
    tiles = previous_.tiles_;
    const auto before = [](const auto& a, const auto& b) {
      return a->tile.y < b->tile.y || (a->tile.y == b->tile.y && a->tile.x < b->tile.x);
    };
    std::vector<std::shared_ptr<const SpaceTile>> fresh;
    for (Touched& t : touched_) {
      if (!t.tile_now) continue;
      const auto at = std::lower_bound(tiles.begin(), tiles.end(), t.tile_now, before);
      if (at != tiles.end() && (*at)->tile == t.tile)
        *at = std::move(t.tile_now);
      else
        fresh.push_back(std::move(t.tile_now));
    }
    tiles.insert(tiles.end(), fresh.begin(), fresh.end());
    if (!fresh.empty()) std::sort(tiles.begin(), tiles.end(), before);
  }

  // A tree's shares, all of whose voxels lie within `columns`.
  static std::shared_ptr<const std::vector<LayerShare>> shares_in(const CrownSpace& space, std::int32_t slot,
                                                                  const Domain& columns) {
    std::vector<const SpaceTile*> tiles;
    std::int32_t low = std::numeric_limits<std::int32_t>::max(), high = std::numeric_limits<std::int32_t>::lowest();
    for (std::int32_t n = tile_of(columns.low).y; n <= tile_of(columns.high).y; ++n)
      for (std::int32_t e = tile_of(columns.low).x; e <= tile_of(columns.high).x; ++e)
        if (const SpaceTile* tile = space.find_tile({e, n})) {
          tiles.push_back(tile);
          low = std::min(low, tile->first_layer), high = std::max(high, tile->first_layer + tile->layers);
        }
    auto out = std::make_shared<std::vector<LayerShare>>();
    for (std::int32_t k = low; k < high; ++k) {
      LayerShare share;
      share.layer = k;
      for (const SpaceTile* tile : tiles) {
        if (!tile->has(k)) continue;
        const IVec2 corner = tile->tile * kTileEdge;
        const IVec2 from = glm::max(columns.low, corner), to = glm::min(columns.high, corner + (kTileEdge - 1));
        for (std::int32_t j = from.y; j <= to.y; ++j) {
          const std::int32_t* row = tile->owner.data() + tile->offset(k) + (j - corner.y) * kTileEdge - corner.x;
          for (std::int32_t i = from.x; i <= to.x;) {
            if (row[i] != slot) {
              ++i;
              continue;
            }
            const std::int32_t first = i;
            while (i <= to.x && row[i] == slot) ++i;
            add_run(share, {first, j}, i - first);
          }
        }
      }
      if (share.voxels > 0) out->push_back(share);
    }
    return out;
  }

  const CrownSpace& previous_;
  std::span<const Claimant> trees_;
  const Standing& standing_;
  const terrain::Terrain& terrain_;
  const SpaceOptions& options_;
  const Reshaped& reshaped_;
  std::shared_ptr<const SpaceLayout> layout_;
  std::vector<std::int32_t> slot_of_, edited_;
  std::vector<std::vector<LayerSheet>> layers_;  ///< from first_layer_ on
  std::int32_t first_layer_ = 0;
  std::vector<IVec2> reshaped_tiles_;  ///< held ones with columns that begin at another layer
  std::vector<Touched> touched_;
  std::unordered_map<std::uint64_t, std::size_t> touched_at_;
  SpaceUpdate update_;
};

Result<SpaceUpdate> update_space(const CrownSpace& previous, std::span<const Claimant> trees, const Standing& standing,
                                 const terrain::Terrain& terrain, const SpaceOptions& options,
                                 const Reshaped& reshaped) {
  return SpaceUpdater(previous, trees, sorted(standing), terrain, options, reshaped).run();
}

}  // namespace bosquet::crowns
