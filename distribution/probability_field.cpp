#include "distribution/probability_field.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr int kBlock = 4;  // cells a side
constexpr int kBlockCells = kBlock * kBlock;
constexpr int kBlockLevel = 2;  // 2^2 cells a side

// Weights lie from 2^-20 to 2^20 and count in steps of 2^-20.
constexpr std::uint32_t kRange = 20u << kLogBits;

// 2^(n / 1024) in steps of 2^-24: exact to the last of the 24 bits of a float.
const std::array<std::uint32_t, 1 << kLogBits>& fractions() {
  static const auto table = [] {
    std::array<std::uint32_t, 1 << kLogBits> t{};
    for (std::size_t n = 0; n < t.size(); ++n)
      t[n] = static_cast<std::uint32_t>(exp2(static_cast<float>(n) / (1 << kLogBits)) * 0x1p24f);
    return t;
  }();
  return table;
}

// Weight of a cell with these sums of logarithms, clustering in the upper half.
std::uint64_t fixed_exp2(const std::uint32_t* fraction, std::uint64_t sums, std::uint32_t most) {
  const std::uint32_t up = std::min(static_cast<std::uint32_t>(sums >> 32), most);
  const std::uint32_t down = std::min(static_cast<std::uint32_t>(sums), kRange);
  const std::uint32_t x = kRange + up - down;
  return (static_cast<std::uint64_t>(fraction[x & ((1u << kLogBits) - 1)]) << (x >> kLogBits)) >> 24;
}

std::uint64_t suited(std::uint64_t weight, std::uint8_t suitability) {
  // 255 is exactly 1: its share in steps of 2^-16 is 255 * 257 + 1.
  return (weight * (suitability * std::uint64_t{257} + (suitability == 255 ? 1 : 0))) >> 16;
}

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
    : cells_(cells), cell_m_(cell_m), blocks_((cells + kBlock - 1) / kBlock) {
  assert(cells.x > 0 && cells.y > 0 && cells.x <= kMostFieldCells && cells.y <= kMostFieldCells && cell_m > 0.0f);
  const std::size_t blocks = static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y);
  assert(suitability.empty() ||
         suitability.size() == static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y));
  assert(most >= 1.0f);
  // One step less than 2^20, so that the sum of all cells of the largest field fits 64 bits.
  most_steps_ =
      std::min(static_cast<std::uint32_t>(log2(std::min(most, 0x1p20f)) * (1 << kLogBits) + 0.5f), kRange - 1);
  log2_.assign(blocks * kBlockCells, 0);
  cover_.assign(blocks * kBlockCells, 0);
  suitability_.assign(blocks * kBlockCells, 255);
  for (int j = 0; j < kBlock * blocks_.y; ++j)  // cells that only fill up the last blocks
    for (int i = j < cells.y ? cells.x : 0; i < kBlock * blocks_.x; ++i) cover_[place({i, j})] = 1;
  if (!suitability.empty())
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i)
        suitability_[place({i, j})] =
            suitability[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.x) + static_cast<std::size_t>(i)];
  suits_wholly_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b)
    suits_wholly_[b] = std::all_of(suitability_.begin() + static_cast<std::ptrdiff_t>(b * kBlockCells),
                                   suitability_.begin() + static_cast<std::ptrdiff_t>((b + 1) * kBlockCells),
                                   [](std::uint8_t suits) { return suits == 255; });
  for (IVec2 nodes = blocks_;; nodes = (nodes + 1) / 2) {
    levels_.push_back(
        {nodes, std::vector<Pair>(static_cast<std::size_t>(nodes.x) * static_cast<std::size_t>(nodes.y))});
    if (nodes.x == 1 && nodes.y == 1) break;
  }
  top_ = kBlockLevel + static_cast<int>(levels_.size()) - 1;
  constexpr std::uint64_t kFresh = std::uint64_t{kBlockCells} << 20;  // of a block where nothing acts
  for (int y = 0; y < blocks_.y; ++y)
    for (int x = 0; x < blocks_.x; ++x) {
      const std::size_t b =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_.x) + static_cast<std::size_t>(x);
      const bool inner = kBlock * (x + 1) <= cells.x && kBlock * (y + 1) <= cells.y;
      levels_[0].sums[b] = inner && suits_wholly_[b] ? Pair{kFresh, kFresh} : block_sum(b);
    }
  sum_above({0, 0}, blocks_ - 1);
}

std::size_t ProbabilityField::place(IVec2 cell) const {
  const auto block = static_cast<std::size_t>(cell.y / kBlock) * static_cast<std::size_t>(blocks_.x) +
                     static_cast<std::size_t>(cell.x / kBlock);
  return block * kBlockCells + static_cast<std::size_t>(cell.y % kBlock) * kBlock +
         static_cast<std::size_t>(cell.x % kBlock);
}

std::uint64_t ProbabilityField::open_weight(std::size_t n) const {
  return cover_[n] == 0 ? fixed_exp2(fractions().data(), log2_[n], most_steps_) : 0;
}

ProbabilityField::Pair ProbabilityField::cell_weight(std::size_t n) const {
  const std::uint64_t open = open_weight(n);
  return {open, suited(open, suitability_[n])};
}

std::uint64_t ProbabilityField::weight(IVec2 cell) const { return cell_weight(place(cell)).suited; }
std::uint8_t ProbabilityField::suitability(IVec2 cell) const { return suitability_[place(cell)]; }

ProbabilityField::Pair ProbabilityField::block_sum(std::size_t block) const {
  const std::uint32_t* fraction = fractions().data();
  const std::uint64_t* logs = log2_.data() + block * kBlockCells;
  const std::uint32_t* covers = cover_.data() + block * kBlockCells;
  const std::uint8_t* suits = suitability_.data() + block * kBlockCells;
  const std::uint32_t most = most_steps_;
  std::array<std::uint64_t, kBlockCells> open;
  for (int k = 0; k < kBlockCells; ++k) open[static_cast<std::size_t>(k)] = fixed_exp2(fraction, logs[k], most);
  Pair sum;
  for (int k = 0; k < kBlockCells; ++k) sum.open += covers[k] == 0 ? open[static_cast<std::size_t>(k)] : 0;
  sum.suited = sum.open;
  if (!suits_wholly_[block]) {
    sum.suited = 0;
    for (int k = 0; k < kBlockCells; ++k)
      if (covers[k] == 0) sum.suited += suited(open[static_cast<std::size_t>(k)], suits[k]);
  }
  return sum;
}

void ProbabilityField::sum_above(IVec2 low, IVec2 high) {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    low /= 2, high /= 2;
    const Level& below = levels_[l - 1];
    Level& level = levels_[l];
    const auto width = static_cast<std::size_t>(below.nodes.x);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const bool right = 2 * x + 1 < below.nodes.x, upper = 2 * y + 1 < below.nodes.y;
        const std::size_t n = static_cast<std::size_t>(2 * y) * width + static_cast<std::size_t>(2 * x);
        Pair sum = below.sums[n];
        if (right) sum += below.sums[n + 1];
        if (upper) sum += below.sums[n + width];
        if (right && upper) sum += below.sums[n + width + 1];
        level
            .sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.nodes.x) + static_cast<std::size_t>(x)] =
            sum;
      }
  }
}

void ProbabilityField::change_cover(IVec2 cell, int by) {
  const std::size_t n = place(cell);
  assert(by > 0 || cover_[n] > 0);
  cover_[n] += static_cast<std::uint32_t>(by);
  levels_[0].sums[n / kBlockCells] = block_sum(n / kBlockCells);
  sum_above(cell / kBlock, cell / kBlock);
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
  const IVec2 low{block_of(at.x - reach, blocks_.x), block_of(at.y - reach, blocks_.y)};
  const IVec2 high{block_of(at.x + reach, blocks_.x), block_of(at.y + reach, blocks_.y)};

  const float trunk = stamp.trunk_radius_m / cell_m_;
  const float to_steps = acts ? kKernelSteps / (stamp.active_radius_m / cell_m_ - trunk) : 0.0f;
  const float active2 = acts ? stamp.active_radius_m / cell_m_ * (stamp.active_radius_m / cell_m_) : -1.0f;
  const float covered = stamp.covered_radius_m / cell_m_, covered2 = covered * covered;
  constexpr auto kLast = static_cast<float>(kKernelSteps);
  for (int by = low.y; by <= high.y; ++by) {
    for (int bx = low.x; bx <= high.x; ++bx) {
      // Distances of the cells' centres, in cells.
      const float x0 = static_cast<float>(bx * kBlock) + 0.5f - at.x;
      const float y0 = static_cast<float>(by * kBlock) + 0.5f - at.y;
      const float nearest_x = std::max({x0, -x0 - (kBlock - 1), 0.0f});
      const float nearest_y = std::max({y0, -y0 - (kBlock - 1), 0.0f});
      const float nearest2 = nearest_x * nearest_x + nearest_y * nearest_y;
      const bool touched = nearest2 <= active2, closes = nearest2 <= covered2;
      if (!touched && !closes) continue;
      const std::size_t block =
          static_cast<std::size_t>(by) * static_cast<std::size_t>(blocks_.x) + static_cast<std::size_t>(bx);
      std::uint64_t* logs = log2_.data() + block * kBlockCells;
      std::uint32_t* covers = cover_.data() + block * kBlockCells;

      if (closes) {  // cells that lie within the covered radius with all their corners
        for (int k = 0; k < kBlockCells; ++k) {
          const float x = std::abs(x0 + static_cast<float>(k % kBlock)) + 0.5f;
          const float y = std::abs(y0 + static_cast<float>(k / kBlock)) + 0.5f;
          if (x * x + y * y <= covered2) covers[k] += static_cast<std::uint32_t>(sign);
        }
      }
      if (touched) {
        std::array<int, kBlockCells> step;
        for (int k = 0; k < kBlockCells; ++k) {
          const float x = x0 + static_cast<float>(k % kBlock), y = y0 + static_cast<float>(k / kBlock);
          float s = (std::sqrt(x * x + y * y) - trunk) * to_steps;
          s = s > 0.0f ? s : 0.0f;
          step[static_cast<std::size_t>(k)] = static_cast<int>(s < kLast ? s : kLast);
        }
        const std::uint64_t* table = stamp.log2_kernel->data();
        if (sign > 0)
          for (int k = 0; k < kBlockCells; ++k) logs[k] += table[step[static_cast<std::size_t>(k)]];
        else
          for (int k = 0; k < kBlockCells; ++k) logs[k] -= table[step[static_cast<std::size_t>(k)]];
      }

      levels_[0].sums[block] = block_sum(block);
    }
  }
  sum_above(low, high);
}

std::uint64_t ProbabilityField::node_sum(Sums which, int level, int x, int y) const {
  Pair sum;
  if (level >= kBlockLevel) {
    const Level& l = levels_[static_cast<std::size_t>(level - kBlockLevel)];
    if (x >= l.nodes.x || y >= l.nodes.y) return 0;
    sum = l.sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(l.nodes.x) + static_cast<std::size_t>(x)];
  } else if (level == 0) {
    if (x >= cells_.x || y >= cells_.y) return 0;
    sum = cell_weight(place({x, y}));
  } else {
    for (int c = 0; c < 4; ++c) {
      const IVec2 cell{2 * x + c % 2, 2 * y + c / 2};
      if (cell.x < cells_.x && cell.y < cells_.y) sum += cell_weight(place(cell));
    }
  }
  return which == Sums::open ? sum.open : sum.suited;
}

void ProbabilityField::sums_under(const RegionMask& mask, Sums which, std::vector<std::uint64_t>& sums) const {
  const auto nodes = mask.nodes();
  sums.resize(nodes.size());
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children stand behind their parent
    const RegionMask::Node& node = nodes[n];
    switch (node.cover) {
      case RegionMask::Cover::empty:
        sums[n] = 0;
        break;
      case RegionMask::Cover::full:
        sums[n] = node_sum(which, node.level, node.x, node.y);
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
          full ? node_sum(which, level, x + c % 2, y + c / 2) : sums[at.first_child + static_cast<std::uint32_t>(c)];
    const int chosen = choose(four, level, x, y);
    x += chosen % 2, y += chosen / 2;
    if (!full) node = at.first_child + static_cast<std::uint32_t>(chosen);
  }
  return IVec2{x, y};
}

}  // namespace bosquet::distribution
