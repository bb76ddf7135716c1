// Inventory: surveyed trees before they are planted as they stand.
//
// Decision  two records at one place (nearer than kSamePlace_m) are two trees: the later one is moved by the sum of the
//           trunk radii in a direction that hangs on both keys, and reported. No other record is moved, however close
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "distribution/species.h"

namespace bosquet::distribution {

inline constexpr float kSamePlace_m = 0.001f;

struct MovedApart {
  std::size_t index = 0;  ///< of the tree that was moved
  std::size_t twin = 0;   ///< of the tree whose place it shared
  Vec2 from{0.0f}, to{0.0f};
};

/// Moves duplicates, in the order of the records; `size_m` is the site, which no tree is moved out of.
std::vector<MovedApart> move_duplicates_apart(std::span<StandingTree> trees, Vec2 size_m);

}  // namespace bosquet::distribution
