#include "distribution/probability_field.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr int kBlockLevel = 2;  // 2^2 cells a side
static_assert(1 << kBlockLevel == kBlock);

// -log2 of a uniform number in (0, 1), from a table of log2 with linear interpolation (within 1e-7).
double race_time(std::uint64_t bits) {
  constexpr int kBits = 11;
  static const auto table = [] {
    std::array<double, (1 << kBits) + 1> t{};
    for (std::size_t n = 0; n < t.size(); ++n)
      t[n] = static_cast<double>(log2(1.0f + static_cast<float>(n) / (1 << kBits)));
    return t;
  }();
  const double u = (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
  const auto word = std::bit_cast<std::uint64_t>(u);
  const int exponent = static_cast<int>(word >> 52) - 1023;
  const std::uint64_t mantissa = word & ((std::uint64_t{1} << 52) - 1);
  const auto n = static_cast<std::size_t>(mantissa >> (52 - kBits));
  const double rest = static_cast<double>(mantissa & ((std::uint64_t{1} << (52 - kBits)) - 1)) * 0x1p-41;
  return -(static_cast<double>(exponent) + table[n] + (table[n + 1] - table[n]) * rest);
}
static_assert(52 - 11 == 41);

std::uint64_t node_number(std::uint32_t attempt, int level, int x, int y) {
  const auto node =
      (static_cast<std::uint64_t>(level) * kMostFieldCells + static_cast<std::uint64_t>(y)) * kMostFieldCells +
      static_cast<std::uint64_t>(x);
  return (static_cast<std::uint64_t>(attempt) << 32) | node;
}

}  // namespace

ProbabilityField::ProbabilityField(IVec2 cells, float cell_m, std::span<const std::uint8_t> suitability, float most)
    : cells_(cells), cell_m_(cell_m) {
  assert(cells.x > 0 && cells.y > 0 && cells.x <= kMostFieldCells && cells.y <= kMostFieldCells && cell_m > 0.0f);
  assert(suitability.empty() ||
         suitability.size() == static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y));
  assert(most >= 1.0f);
  FieldBlocks& b = blocks_;
  b.count = (cells + kBlock - 1) / kBlock;
  const std::size_t blocks = static_cast<std::size_t>(b.count.x) * static_cast<std::size_t>(b.count.y);
  // One step less than 2^20, so that the sum of all cells of the largest field fits 64 bits.
  b.most_steps =
      std::min(static_cast<std::uint32_t>(log2(std::min(most, 0x1p20f)) * (1 << kLogBits) + 0.5f), kLogRange - 1);
  b.logs.resize(blocks);
  b.cover.resize(blocks);
  constexpr std::uint64_t kFresh = std::uint64_t{kBlockCells} << 20;  // of a block where nothing acts
  b.sums.assign(blocks, {kFresh, kFresh});
  if (!suitability.empty()) {
    b.suits.resize(blocks);
    b.partly.resize(blocks);
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i) {
        const auto [block, cell] = place({i, j});
        const std::uint8_t suits =
            suitability[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.x) + static_cast<std::size_t>(i)];
        b.suits[block][cell] = suits;
        if (suits != 255) b.partly[block] = 1;
      }
    for (std::size_t n = 0; n < blocks; ++n)
      if (b.partly[n]) b.sums[n] = block_sum(b, n);
  }
  for (int j = 0; j < kBlock * b.count.y; ++j)
    for (int i = j < cells.y ? cells.x : 0; i < kBlock * b.count.x; ++i) {
      const auto [block, cell] = place({i, j});
      b.cover[block][cell] = 1;
      b.sums[block] = block_sum(b, block);
    }
  top_ = kBlockLevel;
  for (IVec2 nodes = b.count; nodes.x > 1 || nodes.y > 1; ++top_) {
    nodes = (nodes + 1) / 2;
    levels_.push_back(
        {nodes, std::vector<WeightPair>(static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y))});
  }
  sum_above({0, 0}, b.count - 1);
}

ProbabilityField::Place ProbabilityField::place(IVec2 cell) const {
  return {static_cast<std::size_t>(cell.y / kBlock) * static_cast<std::size_t>(blocks_.count.x) +
              static_cast<std::size_t>(cell.x / kBlock),
          static_cast<std::size_t>(cell.y % kBlock) * kBlock + static_cast<std::size_t>(cell.x % kBlock)};
}

WeightPair ProbabilityField::cell_weight(IVec2 at) const {
  const auto [block, cell] = place(at);
  if (blocks_.cover[block][cell] != 0) return {};
  const BlockLogs& logs = blocks_.logs[block];
  const std::uint64_t open = open_weight(logs.up[cell], logs.down[cell], blocks_.most_steps);
  return {open, blocks_.suits.empty() ? open : suited_weight(open, blocks_.suits[block][cell])};
}

std::uint64_t ProbabilityField::weight(IVec2 cell) const { return cell_weight(cell).suited; }

std::uint8_t ProbabilityField::suitability(IVec2 at) const {
  const auto [block, cell] = place(at);
  return blocks_.suits.empty() ? 255 : blocks_.suits[block][cell];
}

void ProbabilityField::sum_above(IVec2 low, IVec2 high) {
  const std::vector<WeightPair>* below = &blocks_.sums;
  IVec2 nodes = blocks_.count;
  for (Level& level : levels_) {
    low /= 2, high /= 2;
    const auto width = static_cast<std::size_t>(nodes.x);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const bool right = 2 * x + 1 < nodes.x, upper = 2 * y + 1 < nodes.y;
        const std::size_t n = static_cast<std::size_t>(2 * y) * width + static_cast<std::size_t>(2 * x);
        WeightPair sum = (*below)[n];
        if (right) sum += (*below)[n + 1];
        if (upper) sum += (*below)[n + width];
        if (right && upper) sum += (*below)[n + width + 1];
        level
            .sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.nodes.x) + static_cast<std::size_t>(x)] =
            sum;
      }
    below = &level.sums;
    nodes = level.nodes;
  }
}

void ProbabilityField::change_cover(IVec2 at, int by) {
  const auto [block, cell] = place(at);
  std::uint16_t& cover = blocks_.cover[block][cell];
  assert(by > 0 || cover > 0);
  cover = static_cast<std::uint16_t>(cover + by);
  blocks_.sums[block] = block_sum(blocks_, block);
  sum_above(at / kBlock, at / kBlock);
}

void ProbabilityField::apply(const Stamp& stamp, int sign) {
  const bool acts = stamp.log2_kernel && stamp.active_radius_m > stamp.trunk_radius_m;
  const float reach = std::max(acts ? stamp.active_radius_m : 0.0f, stamp.covered_radius_m) / cell_m_;
  const Vec2 at = stamp.at / cell_m_;  // in cells from here on
  const auto block_of = [&](float x, int blocks) {
    return static_cast<int>(std::clamp(x / kBlock, 0.0f, static_cast<float>(blocks - 1)));
  };
  if (!(reach > 0.0f) || at.x + reach < 0.0f || at.y + reach < 0.0f || at.x - reach > static_cast<float>(cells_.x) ||
      at.y - reach > static_cast<float>(cells_.y))
    return;
  const IVec2 low{block_of(at.x - reach, blocks_.count.x), block_of(at.y - reach, blocks_.count.y)};
  const IVec2 high{block_of(at.x + reach, blocks_.count.x), block_of(at.y + reach, blocks_.count.y)};
  fetch_blocks(blocks_, low, high);
  stamp_blocks(blocks_,
               {at, stamp.trunk_radius_m / cell_m_, acts ? stamp.active_radius_m / cell_m_ : -1.0f,
                stamp.covered_radius_m / cell_m_, stamp.log2_kernel},
               sign, low, high);
  sum_above(low, high);
}

WeightPair ProbabilityField::node_sum(int level, int x, int y) const {
  if (level >= kBlockLevel) {
    const bool blocks = level == kBlockLevel;
    const IVec2 nodes = blocks ? blocks_.count : levels_[static_cast<std::size_t>(level - kBlockLevel - 1)].nodes;
    if (x >= nodes.x || y >= nodes.y) return {};
    const auto& sums = blocks ? blocks_.sums : levels_[static_cast<std::size_t>(level - kBlockLevel - 1)].sums;
    return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes.x) + static_cast<std::size_t>(x)];
  }
  WeightPair sum;
  for (int j = y << level; j < std::min((y + 1) << level, cells_.y); ++j)
    for (int i = x << level; i < std::min((x + 1) << level, cells_.x); ++i) sum += cell_weight({i, j});
  return sum;
}

void ProbabilityField::sums_under(const RegionMask& mask, Sums which, std::vector<std::uint64_t>& sums) const {
  const auto of = which == Sums::open ? &WeightPair::open : &WeightPair::suited;
  const auto nodes = mask.nodes();
  sums.resize(nodes.size());
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children stand behind their parent
    const RegionMask::Node& node = nodes[n];
    switch (node.cover) {
      case RegionMask::Cover::empty:
        sums[n] = 0;
        break;
      case RegionMask::Cover::full:
        sums[n] = node_sum(node.level, node.x, node.y).*of;
        break;
      case RegionMask::Cover::partial:
        sums[n] = sums[node.first_child] + sums[node.first_child + 1] + sums[node.first_child + 2] +
                  sums[node.first_child + 3];
    }
  }
}

std::optional<IVec2> ProbabilityField::draw(const RegionMask& mask, Sums which, std::span<const std::uint64_t> sums,
                                            const RandomStream& stream, std::uint32_t attempt) const {
  assert(sums.size() == mask.nodes().size());
  const auto of = which == Sums::open ? &WeightPair::open : &WeightPair::suited;
  if (sums[0] == 0) return std::nullopt;
  int level = top_, x = 0, y = 0;
  std::size_t node = 0;
  bool full = false;  // the whole node lies in the mask, which has no nodes below it
  const auto choose = [&](const std::array<std::uint64_t, 4>& four, int at_level, int at_x, int at_y) {
    int chosen = -1;
    double chosen_time = 0.0, chosen_sum = 0.0;
    for (int c = 0; c < 4; ++c) {
      const std::uint64_t one = four[static_cast<std::size_t>(c)];
      if (one == 0) continue;
      const double time = race_time(stream.at(node_number(attempt, at_level, at_x + c % 2, at_y + c / 2)));
      const auto weight = static_cast<double>(one);
      if (chosen < 0 || time * chosen_sum < chosen_time * weight) chosen = c, chosen_time = time, chosen_sum = weight;
    }
    assert(chosen >= 0);
    return chosen;
  };
  while (level > 0) {
    const RegionMask::Node& at = mask.nodes()[node];
    full = full || at.cover == RegionMask::Cover::full;
    --level, x *= 2, y *= 2;
    std::array<std::uint64_t, 4> four{};
    for (int c = 0; c < 4; ++c)
      four[static_cast<std::size_t>(c)] =
          full ? node_sum(level, x + c % 2, y + c / 2).*of : sums[at.first_child + static_cast<std::uint32_t>(c)];
    const int chosen = choose(four, level, x, y);
    x += chosen % 2, y += chosen / 2;
    if (!full) node = at.first_child + static_cast<std::uint32_t>(chosen);
  }
  return IVec2{x, y};
}

}  // namespace bosquet::distribution
