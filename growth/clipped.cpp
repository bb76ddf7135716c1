#include "growth/clipped.h"

#include <algorithm>

#include "core/scalar.h"

namespace bosquet::growth {
namespace {

// Nodes that would fill a form if each had a cube of the occupancy radius.
constexpr float kNodes = 1500.0f;
constexpr float kShortest_m = 0.045f;

}  // namespace

Parameters clipped(const Parameters& natural, float room_m3) {
  Parameters p = natural;
  const float radius = pow(room_m3 / kNodes, 1.0f / 3.0f);
  p.internode_length_m = std::min(natural.internode_length_m, std::max(kShortest_m, radius / natural.occupancy_radius));
  p.tip_diameter_m *= p.internode_length_m / natural.internode_length_m;
  p.phases.clear(), p.orders.clear();
  p.stems = 1;
  p.bole = 0.0f, p.crown_lift = 0.0f, p.youth = 0.0f, p.planar = false;
  p.bud_life_seasons = 40;
  p.shedding_threshold = 0.0f;
  p.light_sensitivity = std::min(p.light_sensitivity, 0.5f);
  p.apical_dominance = std::min(p.apical_dominance, 0.48f);
  p.buds_at = BudsAt::every_node;
  p.acrotony = 0.0f;
  p.set_point_angle_deg = 75.0f, p.trunk_set_point_angle_deg = 0.0f, p.sag_deg_per_m = 0.0f;
  p.deflection_angle_deg = 0.0f;
  return p;
}

}  // namespace bosquet::growth
