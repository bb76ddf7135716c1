// Light: what reaches a place in a tree, and what a bud makes of it.
//
// Source    Longay 2014, 4.2.2 and eq. 4.7: Q = b * L^kappa
// Units     light in 0..1; none is darker than kLeastLight, so that no bud's signal is zero
#pragma once

#include "growth/lanes.h"
#include "growth/tree.h"

namespace bosquet::growth {

inline constexpr float kLeastLight = 1.0f / 256.0f;

/// Light that reaches p: what the tree's own wood leaves of it (as of this season's start) and other trees let through.
inline float light_at(const Tree& tree, const Vec3& p) {
  const float sky = tree.input->light ? tree.input->light->at(p) : 1.0f;
  return larger(sky * tree.shadow.exposure(p), kLeastLight);
}

/// Tables of L^kappa for the distinct kappas in force.
void tabulate_light_response(Tree& tree);

/// Places of buds are made anew where the shadow's grid grew.
void place_buds(Tree& tree);
/// Light at these buds and their signal Q, told to their nodes.
void sense_light(Tree& tree, std::span<const std::int32_t> of);

}  // namespace bosquet::growth
