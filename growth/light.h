// Light: what reaches a place in a tree, and what a bud makes of it.
//
// Source    Longay 2014, 4.2.2 and eq. 4.7: Q = b * L^kappa
// Units     light in 0..1; none is darker than kLeastLight, so that no bud's signal is zero
// Decision  L^kappa is read from a table by linear interpolation
#pragma once

#include <algorithm>
#include <cstddef>

#include "growth/lanes.h"
#include "growth/tree.h"

namespace bosquet::growth {

inline constexpr float kLeastLight = 1.0f / 256.0f;
inline constexpr int kLightSteps = 512;

/// Light that reaches p: what the tree's own wood leaves of it (as of this season's start) and other trees let through.
inline float light_at(const Tree& tree, const Vec3& p) {
  const float sky = tree.input->light ? tree.input->light->at(p) : 1.0f;
  return larger(sky * tree.shadow.exposure(p), kLeastLight);
}

/// Tables of L^kappa for the distinct kappas in force.
void tabulate_light_response(Tree& tree);

/// Q of a bud, told to its node.
inline void sense_light(Tree& tree, Bud& b) {
  const float light = larger(b.sky * tree.shadow.exposure(b.at), kLeastLight);
  const float step = light * kLightSteps;
  const int i = static_cast<int>(step);
  const float* at = tree.light_response.data() + tree.light_table[std::min<std::size_t>(b.order, kOrders - 1)] + i;
  b.signal = b.factor * (at[0] + (at[1] - at[0]) * (step - static_cast<float>(i)));
  if (b.node < 0) return;  // a stem's first bud: nothing stands below it
  Internode& node = tree.internodes[static_cast<std::size_t>(b.node)];
  node.gathered[b.state == BudState::terminal ? kMainSignal : kLateralSignal] += b.signal;
}

}  // namespace bosquet::growth
