// Probability field: how likely each place of a site is for the next tree of one species.
//
// Source    Longay 2014, 6.4.1 (fields multiplied by kernels; drawn by summing rows and columns)
// Model     weight of a cell = suitability * 2^(sum of log2 K over the standing trees), 0 where a tree leaves no room
// Decision  logarithms instead of products, and integers instead of floats: a cell holds a sum of log2 K for
//           clustering and one for inhibition, in steps of 2^-10, and a count of the trees that cover it; its weight is
//           a 64-bit fixed-point number. So adding and taking away are exact and in any order, a field is a function of
//           the trees standing, and 400,000 kernels of the strongest effect may overlap
// Decision  overlapping clusters multiply up to `most` only. The source multiplies without end: from some ten trees a
//           cluster outweighs the whole site and takes all that are planted. Inhibition ends at 2^-20
// Drawing   instead of the source's rows and columns a quadtree of sums is descended. Every node has a random number
//           u(key, attempt, node) of its own and at each node the child with the smallest -log2(u) / sum is taken,
//           which happens with probability proportional to the sum. When a part of the site loses its weight only the
//           draws whose way led near change
// Decision  the first draws for a tree are made as if the whole site were suitable (Sums::open) and refused where it is
//           not, only later ones from the suitable cells alone. Both ways have the same distribution, and a new path or
//           pond moves hardly any tree that did not stand on it
// Layout    cells in blocks of 4 x 4 (field_blocks.h); sums are kept for blocks and above
// Frame     cell (i, j) spans (i, j) * cell_m to the next, i east, j north; (0, 0) at the site's south-west corner
// Cost      a kernel: its blocks; a draw: the mask's rim and four numbers a level
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/vec.h"
#include "distribution/field_blocks.h"
#include "distribution/kernels.h"
#include "distribution/region_mask.h"

namespace bosquet::distribution {

inline constexpr int kMostFieldCells = 4096;  ///< along a side

/// Which weights are summed and drawn by: as if all cells were suitable, or as they are.
enum class Sums { open, suited };

/// What one standing tree does to a field.
struct Stamp {
  Vec2 at{0.0f};
  float trunk_radius_m = 0.0f;               ///< r
  float active_radius_m = 0.0f;              ///< a; no kernel when not above r
  const KernelTable* log2_kernel = nullptr;  ///< none when null
  float covered_radius_m = 0.0f;             ///< cells wholly within are closed
};

class ProbabilityField {
 public:
  /// `suitability` of each cell (0 never, 255 fully), row by row from the south; empty: 255 everywhere. `most`: largest
  /// factor that clustering makes, 1 to 2^20.
  ProbabilityField(IVec2 cells, float cell_m, std::span<const std::uint8_t> suitability = {}, float most = 0x1p20f);

  void add(const Stamp& stamp) { apply(stamp, 1); }
  void remove(const Stamp& stamp) { apply(stamp, -1); }

  /// Closes a cell, or opens it once for each time it was closed.
  void close(IVec2 cell) { change_cover(cell, 1); }
  void open(IVec2 cell) { change_cover(cell, -1); }

  /// Sum of the weights of each node of the mask, the whole mask's in front; to be asked again after a change.
  void sums_under(const RegionMask& mask, Sums which, std::vector<std::uint64_t>& sums) const;

  /// A cell inside the mask, drawn by weight, or nothing when no weight is left there. `sums` as asked just before.
  std::optional<IVec2> draw(const RegionMask& mask, Sums which, std::span<const std::uint64_t> sums,
                            const RandomStream& stream, std::uint32_t attempt) const;

  /// 2^20 where nothing acts.
  std::uint64_t weight(IVec2 cell) const;
  std::uint8_t suitability(IVec2 cell) const;

  IVec2 cells() const { return cells_; }
  float cell_m() const { return cell_m_; }
  int top() const { return top_; }  ///< level of the root
  RegionMask mask(const Region& region) const { return {region, cells_, cell_m_, top_}; }

  /// The same state, bit for bit.
  bool operator==(const ProbabilityField&) const = default;

 private:
  struct Level {
    IVec2 nodes{0};
    std::vector<WeightPair> sums;
    bool operator==(const Level&) const = default;
  };
  struct Place {
    std::size_t block, cell;
  };

  void apply(const Stamp& stamp, int sign);
  void change_cover(IVec2 cell, int by);
  void sum_above(IVec2 low, IVec2 high);
  Place place(IVec2 cell) const;
  WeightPair cell_weight(IVec2 cell) const;
  WeightPair node_sum(int level, int x, int y) const;

  IVec2 cells_;
  float cell_m_;
  int top_ = 0;
  FieldBlocks blocks_;         // cells that only fill up a block are covered
  std::vector<Level> levels_;  // above the blocks: levels_[n] holds level n + 3
};

}  // namespace bosquet::distribution
