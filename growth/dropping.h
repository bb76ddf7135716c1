// Dropping: the markers that buds drop around themselves.
//
// Source    Longay 2014, 4.2.1 and 4.3.1, fig. 4.4
// Frame     tree frame, metres
// Decision  a bud drops 1 + floor(marker_rate * v / v_max) markers, v of the last season
// Holds     the same markers from eight lanes as from four: two buds are done at once where the processor can
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "growth/tree.h"

namespace bosquet::growth {

class Dropping {
 public:
  static constexpr std::size_t kAtOnce = 64;  ///< buds whose markers stay in the first-level cache

  /// Begins a round; the tree's random stream goes on where the last one ended.
  explicit Dropping(Tree& tree);

  /// Makes the markers of at most kAtOnce buds, in place of those of before; these buds have claimed none yet.
  void drop(std::span<const std::int32_t> buds);
  /// The same as on any processor.
  void drop_plainly(std::span<const std::int32_t> buds);

  /// How many there are in tree.dropped, bud by bud.
  std::size_t count() const { return count_; }

 private:
  struct Frame;
  Frame frame(std::int32_t bud, RandomStream& random) const;
  /// Done with a bud whose markers are numbers first to end.
  void list(std::int32_t bud, std::size_t first, std::size_t end);
  void drop_wide(std::span<const std::int32_t> buds);

  Bud* buds_;
  DroppedMarkers& dropped_;
  RandomStream& random_;
  PerceptionSamples::Reader samples_;
  Occupancy::CellFinder cell_of_;
  float occupied_m_, rate_, greatest_;
  bool planar_, wide_;
  std::size_t count_ = 0;
};

}  // namespace bosquet::growth
