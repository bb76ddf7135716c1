// Growth parameters: what makes one species grow unlike another.
//
// Source    Longay 2014, chapter 4 (light, space, vigor, tropism, gravimorphism, deflection), 5.4 (the widgets' parameters)
// Units     metres, degrees (as in files); r and d in internode lengths at detail 1
// Decision  a season is not a year: a season is one round of growth, ages come from the height curve (growth/age.h)
// Decision  for an axis of order o the numbers in force are: the base table, then the [[order]] tables with from <= o,
//           then the [[phase]] tables whose height has been reached and whose orders include o; the later one wins
// Errors    check() names the key, its value and what is allowed
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/result.h"

namespace bosquet::growth {

/// How lateral buds stand around their axis.
enum class Phyllotaxis {
  spiral,      ///< one bud a node, turned by phyllotactic_angle_deg from the last
  distichous,  ///< one bud a node, on alternating sides
  decussate,   ///< two opposite buds a node, each pair crosses the last
  whorled,     ///< `whorl` buds a node, each whorl stands in the gaps of the last
};
inline constexpr std::array<std::string_view, 4> kPhyllotaxisNames{"spiral", "distichous", "decussate", "whorled"};

/// Which nodes carry lateral buds.
enum class BudsAt {
  every_node,
  shoot_end,  ///< `whorl` buds where one season's shoot ends and the next begins; `scattered` of the nodes between
};
inline constexpr std::array<std::string_view, 2> kBudsAtNames{"every_node", "shoot_end"};

/// What a phase or an order may change; a key that is not given changes nothing.
struct Overrides {
  std::optional<float> straightness, tropism, space;
  std::optional<float> set_point_angle_deg;
  std::optional<float> sag_deg_per_m;
  std::optional<float> branching_angle_deg;
  std::optional<float> deflection_angle_deg;
  std::optional<int> max_shoot_length;
  std::optional<float> apical_dominance;
  std::optional<float> light_sensitivity;
  std::optional<float> acrotony;
  std::optional<float> gravimorphism_vertical, gravimorphism_level, gravimorphism_offset;
  std::optional<float> shedding_threshold;
};

/// From `from` of the final height on, other numbers hold for axes of these orders.
struct Phase {
  float from = 0.0f;
  int from_order = 0;
  int to_order = 12;
  Overrides change;
};

inline bool concerns(const Phase& phase, int order) {
  return order >= phase.from_order && (order <= phase.to_order || phase.to_order == 12);
}

/// For axes of order `from` and higher, other numbers hold.
struct Order {
  int from = 1;
  Overrides change;
};

struct Parameters {
  // Size of the steps.
  float internode_length_m = 0.2f;  ///< l
  // Space.
  float occupancy_radius = 2.5f;        ///< r, in l
  float perception_depth = 2.5f;        ///< d, in l
  float perception_angle_deg = 120.0f;  ///< zeta
  float marker_rate = 4.0f;
  int bud_life_seasons = 8;
  // Light and vigor.
  float shadow_strength = 0.05f;   ///< a
  float shadow_falloff = 1.6f;     ///< b of the shadow
  int shadow_depth = 6;            ///< q_max
  float light_sensitivity = 1.0f;  ///< kappa
  float apical_dominance = 0.5f;   ///< lambda
  int max_shoot_length = 4;        ///< n_max
  float youth = 0.0f;
  float acrotony = 0.0f;
  float shedding_threshold = 0.0f;  ///< Th
  // Direction.
  float straightness = 0.5f, tropism = 0.2f, space = 0.3f;  ///< alpha, beta, gamma
  float set_point_angle_deg = 45.0f;                        ///< theta
  float trunk_set_point_angle_deg = 0.0f;
  float sag_deg_per_m = 0.0f;
  float branching_angle_deg = 50.0f;  ///< psi
  float deflection_angle_deg = 0.0f;  ///< delta
  // Buds.
  Phyllotaxis phyllotaxis = Phyllotaxis::spiral;
  float phyllotactic_angle_deg = 137.5f;  ///< phi
  BudsAt buds_at = BudsAt::every_node;
  int whorl = 3;
  float scattered = 0.0f;
  float bole = 0.0f;
  float crown_lift = 0.0f;
  float gravimorphism_vertical = 1.0f, gravimorphism_level = 1.0f, gravimorphism_offset = 0.0f;  ///< s_v, s_p, e_v
  // Stems.
  int stems = 1;
  float stem_spread_deg = 20.0f;
  bool planar = false;
  // Wood.
  float tip_diameter_m = 0.006f;  ///< d_e
  float pipe_exponent = 2.0f;     ///< n of the pipes
  // Time.
  int max_seasons = 400;
  float age_rate_per_year = 0.03f;  ///< g
  float age_shape = 1.2f;           ///< p

  std::vector<Phase> phases;  ///< at most 4
  std::vector<Order> orders;
};

/// Visits a key that may be missing. A reader (the struct is not const) is handed an impossible number and changes it
/// when the key is there; whoever only looks (const) sees the keys that are given.
template <class Info, class Number, class Visitor>
void visit_if_given(Visitor& visit, const Info& info, std::optional<Number>& field) {
  constexpr Number missing = std::numeric_limits<Number>::lowest();
  Number value = field.value_or(missing);
  visit(info, value);
  if (value != missing) field = value;
}
template <class Info, class Number, class Visitor>
void visit_if_given(Visitor& visit, const Info& info, const std::optional<Number>& field) {
  if (field) visit(info, *field);
}

template <class Changes, class Visitor>
void describe_overrides(Changes& c, Visitor& visit) {
  visit_if_given(visit, Real{"straightness", "", 0, 1, "Weight of the shoot's own direction"}, c.straightness);
  visit_if_given(visit, Real{"tropism", "", 0, 1, "Weight of the set-point angle"}, c.tropism);
  visit_if_given(visit, Real{"space", "", 0, 1, "Weight of the direction of free space"}, c.space);
  visit_if_given(visit, Real{"set_point_angle_deg", "deg", 0, 180, "Angle from upright that axes turn to"},
                 c.set_point_angle_deg);
  visit_if_given(
      visit,
      Real{"sag_deg_per_m", "deg/m", -20, 20, "Set-point angle that an axis gains with each metre it reaches out"},
      c.sag_deg_per_m);
  visit_if_given(visit,
                 Real{"branching_angle_deg", "deg", 10, 120, "Angle between a lateral shoot and its parent axis"},
                 c.branching_angle_deg);
  visit_if_given(
      visit,
      Real{"deflection_angle_deg", "deg", 0, 45, "Angle by which a growing lateral bud turns its parent axis away"},
      c.deflection_angle_deg);
  visit_if_given(visit, Whole{"max_shoot_length", 2, 12, "Internodes of the best bud's shoot in a season"},
                 c.max_shoot_length);
  visit_if_given(visit, Real{"apical_dominance", "", 0.4, 0.6, "How the flow of vigor favours the main axis at a fork"},
                 c.apical_dominance);
  visit_if_given(visit, Real{"light_sensitivity", "", 0, 4, "How much more a bud in good light counts"},
                 c.light_sensitivity);
  visit_if_given(visit,
                 Real{"acrotony", "", -1, 1, "Favours buds near the tip of their shoot (1) or near its base (-1)"},
                 c.acrotony);
  visit_if_given(visit,
                 Real{"gravimorphism_vertical", "", 0.05, 4, "Half-axis of the bud ellipse across the axis, upward"},
                 c.gravimorphism_vertical);
  visit_if_given(visit, Real{"gravimorphism_level", "", 0.05, 4, "Half-axis of the bud ellipse across the axis, level"},
                 c.gravimorphism_level);
  visit_if_given(
      visit,
      Real{"gravimorphism_offset", "", -4, 4, "Shift of the bud ellipse upward; smaller than its vertical half-axis"},
      c.gravimorphism_offset);
  visit_if_given(visit,
                 Real{"shedding_threshold", "", 0, 1, "A branch with less vigor per internode is shed; 0 sheds none"},
                 c.shedding_threshold);
}

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Phase>
void describe(P& p, Visitor& visit) {
  visit(Real{"from", "", 0, 1, "Height, as a share of the final height, from which the phase holds"}, p.from);
  visit(Whole{"from_order", 0, 12, "Lowest order of axes that the phase changes"}, p.from_order);
  visit(Whole{"to_order", 0, 12, "Highest order of axes that the phase changes; 12 is all higher ones too"},
        p.to_order);
  describe_overrides(p.change, visit);
}

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Order>
void describe(P& p, Visitor& visit) {
  visit(Whole{"from", 0, 12, "Lowest order of axes that is changed; 0 is the trunk"}, p.from);
  describe_overrides(p.change, visit);
}

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Parameters>
void describe(P& p, Visitor& visit) {
  visit(Real{"internode_length_m", "m", 0.01, 1, "Length of an internode at detail 1"}, p.internode_length_m);
  visit(Real{"occupancy_radius", "internodes", 1, 30, "Radius around wood in which nothing new grows"},
        p.occupancy_radius);
  visit(Real{"perception_depth", "internodes", 1, 10, "How far past the occupied zone a bud looks for space"},
        p.perception_depth);
  visit(Real{"perception_angle_deg", "deg", 60, 180, "Opening of the cone in which a bud looks for space"},
        p.perception_angle_deg);
  visit(Real{"marker_rate", "", 0, 16, "Markers of free space that the most vigorous bud drops beyond the first"},
        p.marker_rate);
  visit(Whole{"bud_life_seasons", 1, 1000, "Seasons without space or light after which a bud is dead"},
        p.bud_life_seasons);
  visit(Real{"shadow_strength", "", 0, 1, "Shadow that an internode throws on the cell it stands in"},
        p.shadow_strength);
  visit(Real{"shadow_falloff", "", 1.1, 4, "Factor by which a shadow weakens with each cell below"}, p.shadow_falloff);
  visit(Whole{"shadow_depth", 1, 10, "Cells below an internode that it shades"}, p.shadow_depth);
  visit(Real{"light_sensitivity", "", 0, 4, "How much more a bud in good light counts"}, p.light_sensitivity);
  visit(Real{"apical_dominance", "", 0.4, 0.6, "How the flow of vigor favours the main axis at a fork"},
        p.apical_dominance);
  visit(Whole{"max_shoot_length", 2, 12, "Internodes of the best bud's shoot in a season"}, p.max_shoot_length);
  visit(
      Real{"youth", "", 0, 0.5, "Share of the final height up to which the trunk's shoots lengthen from 2 internodes"},
      p.youth);
  visit(Real{"acrotony", "", -1, 1, "Favours buds near the tip of their shoot (1) or near its base (-1)"}, p.acrotony);
  visit(Real{"shedding_threshold", "", 0, 1, "A branch with less vigor per internode is shed; 0 sheds none"},
        p.shedding_threshold);
  visit(Real{"straightness", "", 0, 1, "Weight of the shoot's own direction"}, p.straightness);
  visit(Real{"tropism", "", 0, 1, "Weight of the set-point angle"}, p.tropism);
  visit(Real{"space", "", 0, 1, "Weight of the direction of free space"}, p.space);
  visit(
      Real{"set_point_angle_deg", "deg", 0, 180, "Angle from upright that branches turn to: 0 up, 90 level, 180 down"},
      p.set_point_angle_deg);
  visit(Real{"trunk_set_point_angle_deg", "deg", 0, 180, "Angle from upright that the trunk turns to"},
        p.trunk_set_point_angle_deg);
  visit(Real{"sag_deg_per_m", "deg/m", -20, 20, "Set-point angle that an axis gains with each metre it reaches out"},
        p.sag_deg_per_m);
  visit(Real{"branching_angle_deg", "deg", 10, 120, "Angle between a lateral shoot and its parent axis"},
        p.branching_angle_deg);
  visit(Real{"deflection_angle_deg", "deg", 0, 45, "Angle by which a growing lateral bud turns its parent axis away"},
        p.deflection_angle_deg);
  visit(Choice{"phyllotaxis", kPhyllotaxisNames, "How lateral buds stand around their axis"}, p.phyllotaxis);
  visit(Real{"phyllotactic_angle_deg", "deg", 0, 360, "Turn from one bud of a spiral to the next"},
        p.phyllotactic_angle_deg);
  visit(Choice{"buds_at", kBudsAtNames, "Which nodes carry lateral buds"}, p.buds_at);
  visit(Whole{"whorl", 1, 12, "Buds in a whorl"}, p.whorl);
  visit(Real{"scattered", "", 0, 1, "Share of the nodes between whorls that carry a bud"}, p.scattered);
  visit(Real{"bole", "", 0, 0.5, "Share of the final height below which the trunk sets no buds"}, p.bole);
  visit(Real{"crown_lift", "", 0, 0.8,
             "Share of the final height below which the grown trunk has lost its first branches"},
        p.crown_lift);
  visit(Real{"gravimorphism_vertical", "", 0.05, 4, "Half-axis of the bud ellipse across the axis, upward"},
        p.gravimorphism_vertical);
  visit(Real{"gravimorphism_level", "", 0.05, 4, "Half-axis of the bud ellipse across the axis, level"},
        p.gravimorphism_level);
  visit(Real{"gravimorphism_offset", "", -4, 4, "Shift of the bud ellipse upward; smaller than its vertical half-axis"},
        p.gravimorphism_offset);
  visit(Whole{"stems", 1, 12, "Stems that rise from the base"}, p.stems);
  visit(Real{"stem_spread_deg", "deg", 0, 60, "Lean of the stems when there are several"}, p.stem_spread_deg);
  visit(Switch{"planar", "Grows in one vertical plane"}, p.planar);
  visit(Real{"tip_diameter_m", "m", 0.0005, 0.05, "Diameter of the thinnest twigs"}, p.tip_diameter_m);
  visit(Real{"pipe_exponent", "", 1.1, 4, "Exponent of the pipe equation: smaller makes a thicker trunk"},
        p.pipe_exponent);
  visit(Whole{"max_seasons", 10, 1000, "Seasons after which growth stops in any case"}, p.max_seasons);
  visit(Real{"age_rate_per_year", "1/year", 0.001, 1, "Rate at which the height nears its final value"},
        p.age_rate_per_year);
  visit(Real{"age_shape", "", 0.2, 4, "Above 1 the first years are slow"}, p.age_shape);
  visit(Tables{"phase", "Numbers that change when the tree reaches a share of its height"}, p.phases);
  visit(Tables{"order", "Numbers that differ for branches of an order and higher"}, p.orders);
}

/// What is wrong with some parameters, and where a reader of files finds it.
struct Mistake {
  std::string message;     ///< begins with the owner's name
  std::string_view key;    ///< of the number that is wrong
  std::string_view table;  ///< "order" or "phase" when it was given there; empty: in the base table
  std::size_t index = 0;   ///< of that table
};

/// The first mistake of check().
std::optional<Mistake> find_mistake(const Parameters& parameters, std::string_view what = "growth parameters");

/// Checks every range and what the keys promise each other: weights that sum to 1, the axis inside the bud ellipse, at
/// most four phases, in order, each for at least one order. `what` names the owner in messages ("species english_oak").
Result<void> check(const Parameters& parameters, std::string_view what = "growth parameters");

}  // namespace bosquet::growth
