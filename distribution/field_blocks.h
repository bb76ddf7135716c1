// Field blocks: the cells of a probability field in blocks of 4 x 4, and the loop that puts a kernel on them.
//
// Model     a cell's weight is 2^(up - down) with up and down the sums of log2 K of clustering and inhibition over the
//           standing trees, 0 when a tree covers it; probability_field.h says why
// Layout    block (x, y) holds cells 4x .. 4x + 3 east and 4y .. 4y + 3 north, cell k of it at (k % 4, k / 4); blocks
//           row by row from the south. A block's logarithms are two cache lines, its covers half of one
// Holds     sums are integers and distances are rounded alike on every processor: the wider instructions that are used
//           where a processor has them give the same bits (a test compares both ways)
// Cost      about 1.2 ns a cell with AVX2, 3 ns without
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "distribution/kernels.h"

namespace bosquet::distribution {

inline constexpr int kBlock = 4;  ///< cells along a block's side
inline constexpr int kBlockCells = kBlock * kBlock;

/// Weights lie from 2^-20 to 2^20 and count in steps of 2^-20.
inline constexpr std::uint32_t kLogRange = 20u << kLogBits;

/// Sums of weights: as if all cells were suitable, and as they are.
struct WeightPair {
  std::uint64_t open = 0, suited = 0;
  WeightPair& operator+=(const WeightPair& p) { return open += p.open, suited += p.suited, *this; }
  bool operator==(const WeightPair&) const = default;
};

/// Sums of the kernels' tables in the cells of a block.
struct alignas(64) BlockLogs {
  std::array<std::uint32_t, kBlockCells> up{}, down{};
  bool operator==(const BlockLogs&) const = default;
};

/// How many trees leave a cell no room (counted to 2^16; beyond, the exact rule of distances still holds).
using BlockCover = std::array<std::uint16_t, kBlockCells>;

/// Suitability of cells, 255 fully.
using BlockSuits = std::array<std::uint8_t, kBlockCells>;

struct FieldBlocks {
  IVec2 count{0};
  std::uint32_t most_steps = 0;  ///< log2 of the largest factor that clustering makes, below kLogRange
  std::vector<BlockLogs> logs;
  std::vector<BlockCover> cover;
  std::vector<BlockSuits> suits;     ///< empty: 255 everywhere
  std::vector<std::uint8_t> partly;  ///< of each block, unless `suits` is empty: not 255 in all its cells
  std::vector<WeightPair> sums;      ///< of each block
  bool operator==(const FieldBlocks&) const = default;
};

/// What one standing tree does to a field, in cells.
struct BlockStamp {
  Vec2 at{0.0f};
  float trunk = 0.0f, active = -1.0f;  ///< radii; no kernel when active is below 0
  float covered = 0.0f;                ///< cells wholly within are closed
  const KernelTable* log2_kernel = nullptr;
};

/// Weight of a cell on open, suitable ground with these sums.
std::uint64_t open_weight(std::uint32_t up, std::uint32_t down, std::uint32_t most_steps);

/// The part of a weight that a suitability leaves.
inline std::uint64_t suited_weight(std::uint64_t weight, std::uint8_t suitability) {
  // 255 is exactly 1: its share in steps of 2^-16 is 255 * 257 + 1.
  return (weight * (suitability * std::uint64_t{257} + (suitability == 255 ? 1 : 0))) >> 16;
}

/// The sums of a block from its cells.
WeightPair block_sum(const FieldBlocks& field, std::size_t block);

/// Asks memory for the blocks low..high, both included: on a large field most of a stamp's time is waiting for them.
void fetch_blocks(const FieldBlocks& field, IVec2 low, IVec2 high);

/// Adds (sign 1) or takes away (-1) a stamp on blocks low..high, both included, and sums them anew.
void stamp_blocks(FieldBlocks& field, const BlockStamp& stamp, int sign, IVec2 low, IVec2 high);

/// The same without the wider instructions, for comparison.
void stamp_blocks_plainly(FieldBlocks& field, const BlockStamp& stamp, int sign, IVec2 low, IVec2 high);

}  // namespace bosquet::distribution
