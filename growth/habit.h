// Habit: the growth numbers in force for the axes of one order at the tree's present height, ready for use.
//
// Model     base table, then [[order]] tables, then [[phase]] tables (parameters.h)
// Units     radians only as sines and cosines; metamers, not metres
#pragma once

#include <array>

#include "growth/parameters.h"

namespace bosquet::growth {

inline constexpr int kOrders = 16;  ///< higher orders grow like the last

struct Habit {
  float alpha, beta, gamma;
  float set_point_cos, set_point_sin;
  float set_point, sag;  ///< radians; radians gained per metre of reach
  float branching_cos, branching_sin;
  float deflection_sin, deflection_cos;
  int max_shoot;  ///< n_max
  float lambda;
  float kappa;
  float acrotony;
  float s_v, s_p, e_v;  ///< gravimorphic ellipse
  bool neutral_ellipse;
  float shedding;  ///< Th
};
using Habits = std::array<Habit, kOrders>;

/// `share` is the tree's height over its final height.
Habits habits_at(const Parameters& parameters, float share);

/// Index of the last phase reached; the habits change only when it does.
int phase_at(const Parameters& parameters, float share);

}  // namespace bosquet::growth
