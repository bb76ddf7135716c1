#include "crowns/propagation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/scalar.h"
#include "crowns/bucket_queue.h"

namespace bosquet::crowns {
namespace {

constexpr std::uint32_t kEdge = 64, kBlock = kEdge * kEdge;
constexpr double kTicksPerMetre = 0x1p40;  // of a front of 1 m2
// Fine enough to measure a voxel with, and such that 2^17 columns fit 63 bits.
constexpr double kLeastSlowness = 0x1p10, kMostSlowness = 0x1p46;
// Units of the queue in the time that the fastest front takes for a column: a few entries each.
constexpr int kUnitBits = 8;

// Entries of the queue whose cells are fetched before their turn.
constexpr std::size_t kAhead = 6;

// Delay in columns from which a cell is said to lie in a shadow.
constexpr double kShadow = 1.0;

// A cell's state: settled by front f (f >= 0), closed, free, or taken for now by front f (encoded -2 - f).
constexpr std::int32_t kClosed = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kOpen = -1;

struct Cell {
  std::uint64_t tick = 0;
  float delay = 0;
  std::int32_t state = kClosed;
};

class Layer {
 public:
  Layer(std::span<const Front> fronts, const LayerCells& cells)
      : fronts_(fronts), blocks_(cells.blocks), queue_(unit_shift(fronts)) {
    // One closed cell more, beyond every edge.
    cells_.resize(cells.open.size() + 1);
    beyond_ = static_cast<std::uint32_t>(cells.open.size());
    for (std::size_t c = 0; c < cells.open.size(); ++c)
      if (cells.open[c]) cells_[c].state = kOpen;
    for (std::size_t f = 0; f < fronts.size(); ++f) start(static_cast<std::int32_t>(f));
  }

  void run() {
    while (!queue_.empty()) {
      const BucketQueue::Entry next = queue_.pop();
      if (const BucketQueue::Entry* soon = queue_.ahead(kAhead)) fetch_ahead(soon->cell);
      Cell& cell = cells_[next.cell];
      if (cell.state <= -2) {
        if (cell.tick != next.tick) continue;  // bettered since
        cell.state = -2 - cell.state;
      } else if (fronts_[static_cast<std::size_t>(cell.state)].root != next.cell) {
        continue;  // settled already
      }
      spread(next.cell, cell);
    }
  }

  LayerResult result() const {
    LayerResult out;
    out.front.resize(beyond_, LayerResult::kUnclaimed);
    out.ticks.resize(beyond_, 0);
    for (std::size_t c = 0; c < beyond_; ++c) {
      if (cells_[c].state < 0 || cells_[c].state == kClosed) continue;
      out.front[c] = cells_[c].state;
      out.ticks[c] = cells_[c].tick;
    }
    return out;
  }

 private:
  static int unit_shift(std::span<const Front> fronts) {
    double least = kMostSlowness;
    for (const Front& f : fronts) least = std::min(least, f.slowness);
    return std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(least))) - 1 - kUnitBits);
  }

  // A root is settled from the outset, at the time of the straight way to its centre.
  void start(std::int32_t f) {
    const Front& front = fronts_[static_cast<std::size_t>(f)];
    const IVec2 column = column_of(front.root);
    const double x = column.x + 0.5 - front.east, y = column.y + 0.5 - front.north;
    const double straight = std::max(0.0, std::sqrt(x * x + y * y) - front.trunk) * front.slowness;
    Cell& cell = cells_[front.root];
    assert(cell.state < 0 || cell.state == kClosed);  // one root a cell
    cell.tick = whole(straight);
    cell.delay = 0.0f;
    cell.state = f;
    queue_.push(cell.tick, front.root);
  }

  // On a large layer fronts advance everywhere at once, so a cell is seldom in the cache when its time comes.
  void fetch_ahead(std::uint32_t cell) const {
    const Cell* at = cells_.data() + cell;
    __builtin_prefetch(at, 1);
    if (cell >= kEdge) __builtin_prefetch(at - kEdge, 1);
    if (cell + kEdge < beyond_) __builtin_prefetch(at + kEdge, 1);
  }

  void spread(std::uint32_t from, const Cell& settled) {
    const IVec2 c = column_of(from);
    const std::uint32_t west = west_of(from), east = east_of(from), south = south_of(from), north = north_of(from);
    const Cell &w = cells_[west], &e = cells_[east], &s = cells_[south], &n = cells_[north];
    if (w.state < 0) offer(settled, west, {c.x - 1, c.y}, {-1, 0}, s, n);
    if (e.state < 0) offer(settled, east, {c.x + 1, c.y}, {1, 0}, s, n);
    if (s.state < 0) offer(settled, south, {c.x, c.y - 1}, {0, -1}, w, e);
    if (n.state < 0) offer(settled, north, {c.x, c.y + 1}, {0, 1}, w, e);
  }

  // Offers cell `to`, one step from a settled cell, to that cell's front. `low` and `high` lie beside the settled cell,
  // across the step, so diagonal to `to`.
  void offer(const Cell& settled, std::uint32_t to, IVec2 column, IVec2 step, const Cell& low, const Cell& high) {
    const std::int32_t f = settled.state;
    const Front& front = fronts_[static_cast<std::size_t>(f)];
    const double x = column.x + 0.5 - front.east, y = column.y + 0.5 - front.north;
    const double distance_squared = x * x + y * y;
    if (distance_squared > front.reach_squared) return;
    const double distance = std::sqrt(distance_squared), slowness = front.slowness;
    const double straight = std::max(0.0, distance - front.trunk) * slowness;

    // Nothing is earlier than the straight way.
    Cell& cell = cells_[to];
    if (cell.state == -2 - f && cell.tick <= whole(straight)) return;

    double t = static_cast<double>(settled.tick);
    if (distance > front.trunk) {
      const double delay = static_cast<double>(settled.delay);
      const double ahead = step.x != 0 ? step.x * x : step.y * y, aside = step.x != 0 ? y : x;
      const Cell& homeward = aside > 0.0 ? low : high;
      const bool between = ahead >= std::fabs(aside) && earlier(homeward, settled);  // the ray runs between them
      t += slowness;
      if (ahead > 0.5 && std::fabs(aside) < 1.0) {
        // In the base's own row or column no cell lies on the other side of the ray: it goes on.
        t = straight + delay;
      } else if (between && settled.delay == 0.0f && homeward.delay == 0.0f) {
        t = straight;  // what the equation below gives
      } else {
        const Sector sector{slowness, straight + delay - ahead * (slowness / distance)};
        const double slope_aside = aside * (slowness / distance);
        if (earlier(low, settled))
          t = std::min(t, sector.time(slope_aside + delay - static_cast<double>(low.delay), low.tick));
        if (earlier(high, settled))
          t = std::min(t, sector.time(-slope_aside + delay - static_cast<double>(high.delay), high.tick));
        // At a border the ray may be free though not both cells beside it are the tree's.
        if (ahead > 0.0 && !between && whole(t) > whole(straight) && sees_base(front, settled, to, column, x, y))
          t = straight;
      }
    }

    const std::uint64_t tick = std::max(settled.tick + 1, whole(std::max(t, straight)));
    const float new_delay = delay_of(tick, straight);
    if (cell.state != kOpen) {
      if (tick > cell.tick) return;
      if (tick == cell.tick) {
        if (front.rank >= fronts_[static_cast<std::size_t>(-2 - cell.state)].rank) return;
        cell.state = -2 - f;
        cell.delay = new_delay;
        return;  // the entry in the queue stands
      }
    }
    cell = {tick, new_delay, -2 - f};
    queue_.push(tick, to);
  }

  // Free ways and the trunk have none, so that rounding does not travel outward.
  static float delay_of(std::uint64_t tick, double straight) {
    return straight == 0.0 || tick == whole(straight) ? 0.0f : static_cast<float>(static_cast<double>(tick) - straight);
  }
  static std::uint64_t whole(double t) { return static_cast<std::uint64_t>(t + 0.5); }
  static bool earlier(const Cell& cell, const Cell& settled) {
    return cell.state == settled.state && cell.tick < settled.tick;
  }

  // Walks the ray from a cell to its base, a row (or column) of cells at a time: in each, one of the two cells that the
  // ray passes between must be the tree's and settled before, or `settled` itself.
  bool sees_base(const Front& front, const Cell& settled, std::uint32_t from, IVec2 column, double x, double y) const {
    const bool by_columns = std::fabs(x) >= std::fabs(y);
    const double across = by_columns ? x : y;
    const double slope = (by_columns ? y : x) / across;  // of the ray, aside a step ahead
    const double base_aside = by_columns ? front.north : front.east;
    const std::int32_t back = across > 0.0 ? -1 : 1;
    std::int32_t row = by_columns ? column.y : column.x;
    std::uint32_t cell = from;
    for (double left = across + back; left * across > 0.0; left += back) {
      const auto lower = static_cast<std::int32_t>(std::floor(base_aside + slope * left - 0.5));
      cell = by_columns ? (back < 0 ? west_of(cell) : east_of(cell)) : (back < 0 ? south_of(cell) : north_of(cell));
      // The nearer one of the two rows first.
      const std::int32_t near = row <= lower ? lower : lower + 1, far = near == lower ? lower + 1 : lower;
      std::uint32_t beside = aside_of(cell, near - row, by_columns);
      row = near;
      if (!seen(beside, settled, front.slowness)) {
        beside = aside_of(beside, far - near, by_columns);
        row = far;
        if (!seen(beside, settled, front.slowness)) return false;
      }
      cell = beside;
    }
    return true;
  }
  bool seen(std::uint32_t index, const Cell& settled, double slowness) const {
    const Cell& cell = cells_[index];
    const bool before = &cell == &settled || earlier(cell, settled);
    // A cell that is itself in a shadow ends the walk early.
    return before && static_cast<double>(cell.delay) < kShadow * slowness;
  }
  // The cell that many rows north (or columns east).
  std::uint32_t aside_of(std::uint32_t cell, std::int32_t steps, bool north_south) const {
    for (; steps > 0 && cell != beyond_; --steps) cell = north_south ? north_of(cell) : east_of(cell);
    for (; steps < 0 && cell != beyond_; ++steps) cell = north_south ? south_of(cell) : west_of(cell);
    return cell;
  }

  // The eighth of the directions between the step from the settled cell and the diagonal from the cell beside it.
  struct Sector {
    double slowness;
    double still;  // time if the front did not advance along the step

    // `across` is the time's slope along the side, known from the two settled cells. What the slowness leaves is the
    // slope along the step; when the way is more oblique than the diagonal, the diagonal is the best of the sector.
    double time(double across, std::uint64_t diagonal_tick) const {
      if (across < 0.0) return std::numeric_limits<double>::infinity();
      if (2.0 * across * across > slowness * slowness)
        return static_cast<double>(diagonal_tick) + std::numbers::sqrt2 * slowness;
      return still + std::sqrt(slowness * slowness - across * across);
    }
  };

  IVec2 column_of(std::uint32_t cell) const {
    const IVec2 low = blocks_[cell / kBlock].low;
    return {low.x + static_cast<int>(cell % kEdge), low.y + static_cast<int>(cell / kEdge % kEdge)};
  }
  std::uint32_t in_block(std::int32_t block, std::uint32_t inside) const {
    return block == LayerCells::kNoBlock ? beyond_ : static_cast<std::uint32_t>(block) * kBlock + inside;
  }
  std::uint32_t west_of(std::uint32_t c) const {
    if (c % kEdge != 0) return c - 1;
    return in_block(blocks_[c / kBlock].west, c % kBlock + (kEdge - 1));
  }
  std::uint32_t east_of(std::uint32_t c) const {
    if (c % kEdge != kEdge - 1) return c + 1;
    return in_block(blocks_[c / kBlock].east, c % kBlock - (kEdge - 1));
  }
  std::uint32_t south_of(std::uint32_t c) const {
    if (c % kBlock >= kEdge) return c - kEdge;
    return in_block(blocks_[c / kBlock].south, c % kBlock + (kBlock - kEdge));
  }
  std::uint32_t north_of(std::uint32_t c) const {
    if (c % kBlock < kBlock - kEdge) return c + kEdge;
    return in_block(blocks_[c / kBlock].north, c % kBlock - (kBlock - kEdge));
  }

  std::span<const Front> fronts_;
  std::span<const LayerCells::Block> blocks_;
  std::vector<Cell> cells_;
  std::uint32_t beyond_ = 0;
  BucketQueue queue_;
};

}  // namespace

double front_slowness(float projected_area_m2, float speed_exponent, float voxel_m) {
  const float speed = speed_exponent == 1.0f ? projected_area_m2 : pow(projected_area_m2, speed_exponent);
  return std::clamp(kTicksPerMetre * static_cast<double>(voxel_m) / static_cast<double>(speed), kLeastSlowness,
                    kMostSlowness);
}

LayerResult propagate(std::span<const Front> fronts, const LayerCells& cells) {
  assert(cells.open.size() == cells.blocks.size() * kBlock);
  Layer layer(fronts, cells);
  layer.run();
  return layer.result();
}

}  // namespace bosquet::crowns
