#include "growth/habit.h"

#include "core/scalar.h"

namespace bosquet::growth {
namespace {

/// The overridable numbers as files give them.
struct Numbers {
  float straightness, tropism, space, set_point_deg, sag_deg, branching_deg, deflection_deg;
  int max_shoot;
  float lambda, kappa, acrotony, s_v, s_p, e_v, shedding;
};

template <class T>
void take(const std::optional<T>& given, T& value) {
  if (given) value = *given;
}

void apply(const Overrides& o, Numbers& n) {
  take(o.straightness, n.straightness), take(o.tropism, n.tropism), take(o.space, n.space);
  take(o.set_point_angle_deg, n.set_point_deg), take(o.sag_deg_per_m, n.sag_deg);
  take(o.branching_angle_deg, n.branching_deg);
  take(o.deflection_angle_deg, n.deflection_deg), take(o.max_shoot_length, n.max_shoot);
  take(o.apical_dominance, n.lambda), take(o.light_sensitivity, n.kappa), take(o.acrotony, n.acrotony);
  take(o.gravimorphism_vertical, n.s_v), take(o.gravimorphism_level, n.s_p), take(o.gravimorphism_offset, n.e_v);
  take(o.shedding_threshold, n.shedding);
}

Habit prepare(const Numbers& n) {
  Habit h{};
  h.alpha = n.straightness;
  const float rest = n.tropism + n.space;
  const float scale = rest > 0.0f ? (1.0f - h.alpha) / rest : 0.0f;
  h.beta = n.tropism * scale, h.gamma = n.space * scale;

  const SinCos set_point = sin_cos(radians(n.set_point_deg));
  h.set_point_cos = set_point.cos, h.set_point_sin = set_point.sin;
  h.set_point = radians(n.set_point_deg), h.sag = radians(n.sag_deg);
  const SinCos branching = sin_cos(radians(n.branching_deg));
  h.branching_cos = branching.cos, h.branching_sin = branching.sin;
  const SinCos deflection = sin_cos(radians(n.deflection_deg));
  h.deflection_cos = deflection.cos, h.deflection_sin = n.deflection_deg > 0.0f ? deflection.sin : 0.0f;

  h.max_shoot = n.max_shoot;
  h.lambda = n.lambda, h.kappa = n.kappa, h.acrotony = n.acrotony;
  h.s_v = n.s_v, h.s_p = n.s_p, h.e_v = n.e_v;
  h.neutral_ellipse = n.s_v == 1.0f && n.s_p == 1.0f && n.e_v == 0.0f;
  h.shedding = n.shedding;
  return h;
}

}  // namespace

Habits habits_at(const Parameters& p, float share) {
  Habits habits;
  for (int order = 0; order < kOrders; ++order) {
    Numbers n{p.straightness,
              p.tropism,
              p.space,
              order == 0 ? p.trunk_set_point_angle_deg : p.set_point_angle_deg,
              p.sag_deg_per_m,
              p.branching_angle_deg,
              p.deflection_angle_deg,
              p.max_shoot_length,
              p.apical_dominance,
              p.light_sensitivity,
              p.acrotony,
              p.gravimorphism_vertical,
              p.gravimorphism_level,
              p.gravimorphism_offset,
              p.shedding_threshold};
    for (const Order& o : p.orders) {
      if (order >= o.from) apply(o.change, n);
    }
    for (const Phase& phase : p.phases) {
      if (share >= phase.from && concerns(phase, order)) apply(phase.change, n);
    }
    habits[static_cast<std::size_t>(order)] = prepare(n);
  }
  return habits;
}

int phase_at(const Parameters& p, float share) {
  int reached = -1;
  for (std::size_t i = 0; i < p.phases.size(); ++i) {
    if (share >= p.phases[i].from) reached = static_cast<int>(i);
  }
  return reached;
}

}  // namespace bosquet::growth
