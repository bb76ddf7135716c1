#include "distribution/sowing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/scalar.h"
#include "distribution/draws.h"

namespace bosquet::distribution {
namespace {

// Numbers of a tree's planting stream; the quadtree's nodes use (attempt << 32) | node with node < 2^28.
constexpr std::uint64_t kTypeNumbers = std::uint64_t{1} << 63;
constexpr std::uint64_t kOffsetEast = 1u << 30, kOffsetNorth = 1u << 31, kSuits = 3u << 30;

// So many places are proposed as if the whole site were suitable: with a fifth of it barred one tree in 600 finds none.
constexpr std::uint32_t kOpenAttempts = 4;

// Brush centres are rounded to this, so that the rounding of interpolation does not reach the draw.
constexpr float kBrushStep_m = 1.0f / 1024.0f;

// Draws trees one by one and remembers, until it goes, which cells have refused too often.
class Sower {
 public:
  Sower(Planting& planting, const Sowing& what) : planting_(planting), what_(what) { full_.resize(what.mix.size()); }
  Sower(const Sower&) = delete;
  ~Sower() {
    for (const auto& [species, cell] : closed_) planting_.field(species).open(cell);
  }

  /// Types without room are overlooked until this is called for the next region.
  void new_region() { std::fill(full_.begin(), full_.end(), false); }

  std::optional<StandingTree> plant(std::uint64_t index, const Region& where, const RegionMask& mask) {
    const std::uint64_t key = tree_key(what_.block, index);
    const RandomStream stream(what_.seed, key, Purpose::planting);
    std::uint32_t attempt = 0;
    for (;;) {
      const std::optional<std::size_t> type = draw_type(planting_, what_, key, full_);
      if (!type) return std::nullopt;
      const MixEntry& entry = what_.mix[*type];
      const Species& species = planting_.species()[entry.species];
      const float scale = draw_scale(planting_, what_, key, *type);
      if (const auto at = draw_place(key, entry.species, scale, where, mask, stream, attempt)) {
        const StandingTree tree = standing_tree(key, entry.species, species, *at, scale);
        planting_.add(tree);
        return tree;
      }
      full_[*type] = true;
    }
  }

 private:
  std::optional<Vec2> draw_place(std::uint64_t key, std::uint32_t species, float scale, const Region& where,
                                 const RegionMask& mask, const RandomStream& stream, std::uint32_t& attempt) {
    ProbabilityField& field = planting_.field(species);
    Sums which = attempt < kOpenAttempts ? Sums::open : Sums::suited;
    field.sums_under(mask, which, sums_);
    for (;;) {
      if (which == Sums::open && attempt >= kOpenAttempts) {
        which = Sums::suited;
        field.sums_under(mask, which, sums_);
      }
      const std::uint64_t numbers = static_cast<std::uint64_t>(attempt) << 32;
      const auto cell = field.draw(mask, which, sums_, stream, attempt);
      if (!cell) return std::nullopt;
      ++attempt;
      // What the suited sums would not have proposed, or only so often.
      if (which == Sums::open &&
          unit_interval(stream.at(numbers | kSuits)) * 255.0f >= static_cast<float>(field.suitability(*cell)))
        continue;
      const Vec2 offset{unit_interval(stream.at(numbers | kOffsetEast)),
                        unit_interval(stream.at(numbers | kOffsetNorth))};
      const Vec2 at = (Vec2(*cell) + offset) * field.cell_m();
      const StandingTree tree = standing_tree(key, species, planting_.species()[species], at, scale);
      if (contains(where, at) && planting_.refusal(tree) == Refusal::none) return at;

      // After some refusals a cell counts as full until the sower goes.
      const std::uint64_t id =
          (static_cast<std::uint64_t>(species) << 32) | static_cast<std::uint64_t>(cell->y * kMostFieldCells + cell->x);
      if (++refusals_[id] == kRefusalsOfACell) {
        field.close(*cell);
        closed_.push_back({species, *cell});
        field.sums_under(mask, which, sums_);
      }
    }
  }

  struct Closed {
    std::uint32_t species;
    IVec2 cell;
  };
  Planting& planting_;
  const Sowing& what_;
  std::vector<bool> full_;  // of the mixed types: no room in this region
  std::unordered_map<std::uint64_t, int> refusals_;
  std::vector<Closed> closed_;
  std::vector<std::uint64_t> sums_;
};

// All fields of a planting share one lattice, so any of them makes the mask.
std::optional<RegionMask> mask_of(Planting& planting, const Sowing& what, const Region& where) {
  if (what.mix.empty() || bounds(where).empty()) return std::nullopt;
  return planting.field(what.mix.front().species).mask(where);
}

}  // namespace

Result<void> check(const Planting& planting, const Sowing& what) {
  if (what.mix.empty()) return Error{"no species is chosen"};
  bool any = false;
  for (const MixEntry& entry : what.mix) {
    if (entry.species >= planting.species().size())
      return Error{fmt::format("species number {} of the mix: there are {}", entry.species, planting.species().size())};
    const std::string& name = planting.species()[entry.species].name;
    if (!(entry.probability >= 0.0f) || std::isinf(entry.probability))
      return Error{fmt::format("the share of {} is {}; 0 or more is allowed", name, entry.probability)};
    if (!(entry.scale_min >= 0.0f && entry.scale_min <= entry.scale_max) || std::isinf(entry.scale_max))
      return Error{fmt::format("the scales of {} are {} to {}; smallest and largest are needed, in this order", name,
                               entry.scale_min, entry.scale_max)};
    any = any || entry.probability > 0.0f;
  }
  if (!any) return Error{"the shares of all species are 0; one must be larger"};
  return {};
}

std::optional<std::size_t> draw_type(const Planting& planting, const Sowing& what, std::uint64_t key,
                                     const std::vector<bool>& full) {
  // By a race: each type's time is exponential with its probability as rate, and the first wins. One more type in the
  // mix takes its trees from the others and changes none of the rest.
  const RandomStream stream(what.seed, key, Purpose::planting);
  std::optional<std::size_t> first;
  float first_time = 0.0f;
  for (std::size_t n = 0; n < what.mix.size(); ++n) {
    const MixEntry& entry = what.mix[n];
    assert(entry.species < planting.species().size());
    if (!(entry.probability > 0.0f) || (!full.empty() && full[n])) continue;
    std::uint64_t same = 0;  // earlier entries of this species, told apart by their scales
    for (std::size_t m = 0; m < n; ++m) same += what.mix[m].species == entry.species ? 1 : 0;
    const std::uint64_t number = planting.name_hash(entry.species) + same;
    const float time = -log2(unit_interval(stream.at(kTypeNumbers | number)) + 0x1p-25f) / entry.probability;
    if (!first || time < first_time) first = n, first_time = time;
  }
  return first;
}

float draw_scale(const Planting& planting, const Sowing& what, std::uint64_t key, std::size_t type) {
  const MixEntry& entry = what.mix[type];
  const PlantingRules& rules = planting.species()[entry.species].rules;
  const bool own = entry.scale_min == 0.0f && entry.scale_max == 0.0f;
  RandomStream stream(what.seed, key, Purpose::scale);
  return own ? stream.uniform(rules.scale_min, rules.scale_max) : stream.uniform(entry.scale_min, entry.scale_max);
}

Sown sow(Planting& planting, const Sowing& what, const Region& where, std::size_t count, Progress* progress) {
  Sown sown;
  sown.asked = count;
  const auto mask = mask_of(planting, what, where);
  if (!mask) {
    sown.no_room = count > 0;
    return sown;
  }
  Sower sower(planting, what);
  for (std::size_t n = 0; n < count; ++n) {
    if (progress && progress->cancelled()) {
      sown.cancelled = true;
      break;
    }
    const auto tree = sower.plant(what.first_index + n, where, *mask);
    if (!tree) {
      sown.no_room = true;
      break;
    }
    sown.trees.push_back(*tree);
    if (progress) progress->advance();
  }
  return sown;
}

std::size_t count_to_density(Planting& planting, const Sowing& what, const Region& where, float per_hectare) {
  const auto mask = mask_of(planting, what, where);
  if (!mask) return 0;
  // The share of the region's cells where any of the types may stand, thinned by the density mask.
  std::uint64_t cells = 0, suited = 0;
  const auto& first = planting.field(what.mix.front().species);
  for (const RegionMask::Node& node : mask->nodes()) {
    if (node.cover != RegionMask::Cover::full) continue;
    const IVec2 low{node.x << node.level, node.y << node.level};
    const IVec2 high = glm::min(low + (1 << node.level), first.cells());
    for (int j = low.y; j < high.y; ++j)
      for (int i = low.x; i < high.x; ++i) {
        std::uint8_t best = 0;
        for (const MixEntry& entry : what.mix) best = std::max(best, planting.field(entry.species).suitability({i, j}));
        suited += best;
        ++cells;
      }
  }
  if (cells == 0) return 0;

  // The region's own area is exact; where it hangs over the site's edge only its cells count.
  const Box2 box = bounds(where);
  const Box2 site{Vec2{0.0f}, planting.terrain().size_m()};
  const double cell_area = static_cast<double>(first.cell_m()) * first.cell_m();
  const double area =
      site.contains(box.low) && site.contains(box.high) ? area_m2(where) : static_cast<double>(cells) * cell_area;
  const double wanted =
      per_hectare * 1e-4 * area * (static_cast<double>(suited) / (255.0 * static_cast<double>(cells)));
  std::size_t standing = 0;
  for (const StandingTree& tree : planting.trees()) {
    const bool mixed = std::any_of(what.mix.begin(), what.mix.end(),
                                   [&](const MixEntry& entry) { return entry.species == tree.species; });
    if (mixed && contains(where, tree.at)) ++standing;
  }
  const auto whole = static_cast<std::size_t>(wanted + 0.5);
  return whole > standing ? whole - standing : 0;
}

class StrokeSower::Stroke {
 public:
  Stroke(Planting& planting, Sowing what, const PlantBrush& brush)
      : planting_(planting), what_(std::move(what)), brush_(brush), sower_(planting, what_) {
    const double a_second = static_cast<double>(brush.rate) * brush.strength * brush.radius_m * brush.radius_m;
    a_tick_ = static_cast<std::uint64_t>(a_second / kTicksPerSecond * static_cast<double>(kOneTree));
    due_ = brush.strength > 0.0f ? kOneTree : 0;
  }

  void add(std::span<const BrushEvent> events) {
    if (events_.empty() && !events.empty()) tick_ = events.front().tick;
    events_.insert(events_.end(), events.begin(), events.end());
  }

  /// Up to the last event's time, and that too when the stroke has ended: more events of that time may come.
  void plant(bool ended, Progress* progress) {
    if (events_.empty()) return;
    const int end = events_.back().tick + (ended ? 1 : 0);
    for (; tick_ < end; ++tick_, due_ += a_tick_) {
      if (due_ < kOneTree) continue;
      const Region where = Disc{centre(), brush_.radius_m};
      const auto mask = mask_of(planting_, what_, where);
      sower_.new_region();
      for (; due_ >= kOneTree; due_ -= kOneTree) {
        if (progress && progress->cancelled()) {
          sown.cancelled = true;
          return;
        }
        const std::uint64_t index = what_.first_index + sown.asked++;
        const auto tree = mask ? sower_.plant(index, where, *mask) : std::nullopt;
        if (tree) {
          sown.trees.push_back(*tree);
        } else {
          sown.no_room = true;
        }
        if (progress) progress->advance();
      }
    }
  }

  Sown sown;

 private:
  // Trees due are counted in 2^-32; the first is due when the brush touches the ground.
  static constexpr std::uint64_t kOneTree = std::uint64_t{1} << 32;

  Vec2 centre() {
    while (piece_ + 1 < events_.size() && events_[piece_ + 1].tick <= tick_) ++piece_;
    Vec2 at = events_[piece_].at;
    if (piece_ + 1 < events_.size() && events_[piece_].tick < tick_) {
      const BrushEvent &from = events_[piece_], &to = events_[piece_ + 1];
      const float share = static_cast<float>(tick_ - from.tick) / static_cast<float>(to.tick - from.tick);
      at = from.at + (to.at - from.at) * share;
    }
    return {std::floor(at.x / kBrushStep_m + 0.5f) * kBrushStep_m,
            std::floor(at.y / kBrushStep_m + 0.5f) * kBrushStep_m};
  }

  Planting& planting_;
  const Sowing what_;
  const PlantBrush brush_;
  Sower sower_;
  std::uint64_t a_tick_ = 0, due_ = 0;
  std::vector<BrushEvent> events_;
  std::size_t piece_ = 0;
  int tick_ = 0;
};

StrokeSower::StrokeSower(Planting& planting, Sowing what, const PlantBrush& brush)
    : stroke_(std::make_unique<Stroke>(planting, std::move(what), brush)) {}
StrokeSower::~StrokeSower() = default;

void StrokeSower::extend(std::span<const BrushEvent> events, Progress* progress) {
  stroke_->add(events);
  stroke_->plant(false, progress);
}
void StrokeSower::finish(Progress* progress) { stroke_->plant(true, progress); }
const Sown& StrokeSower::sown() const { return stroke_->sown; }

Sown sow_stroke(Planting& planting, const Sowing& what, const PlantBrush& brush, std::span<const BrushEvent> events,
                Progress* progress) {
  StrokeSower sower(planting, what, brush);
  sower.extend(events, progress);
  if (!sower.sown().cancelled) sower.finish(progress);
  return sower.sown();
}

std::vector<BrushEvent> steady_stroke(std::span<const Vec2> points, float seconds) {
  std::vector<BrushEvent> events;
  double length = 0.0;
  for (std::size_t n = 1; n < points.size(); ++n) length += glm::distance(points[n - 1], points[n]);
  double so_far = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (n > 0) so_far += glm::distance(points[n - 1], points[n]);
    const double share = length > 0.0 ? so_far / length : 0.0;
    events.push_back({points[n], static_cast<int>(share * seconds * kTicksPerSecond + 0.5)});
  }
  // A stroke that does not move still takes its time.
  if (!events.empty() && !(length > 0.0))
    events.push_back({events.back().at, static_cast<int>(seconds * kTicksPerSecond + 0.5f)});
  return events;
}

}  // namespace bosquet::distribution
