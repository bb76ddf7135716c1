// Shadow pyramid: what wood in one cell takes from the layers below it, added to a grid in rows.
//
// Model     layer q below the cell, q = 0 .. last, loses times * amount[q] in the (2q + 1)^2 cells under it
// Layout    the grid's rows run along x; eight numbers past the end of the last row are read and written back
// Cost      (last + 1) (2 last + 1) (2 last + 3) / 3 additions, eight at once with AVX2, else four; the same bits
#pragma once

#include <cstddef>
#include <cstdint>

namespace bosquet::growth {

inline constexpr int kMostShadowDepth = 10;
inline constexpr std::size_t kPastPyramid = 8;  ///< numbers

struct ShadowPyramid {
  int last;                    ///< layer, at most kMostShadowDepth
  std::size_t stride, layer;   ///< numbers from one row to the next, and from one layer to that above
  const std::int32_t* amount;  ///< by layer
};

/// `cell` is that of the wood.
void add_pyramid(const ShadowPyramid& pyramid, std::int32_t* cell, int times);
/// The same as on any processor.
void add_pyramid_plainly(const ShadowPyramid& pyramid, std::int32_t* cell, int times);

}  // namespace bosquet::growth
