// Tree: the state of one tree while it grows.
//
// Frame     tree frame: origin at the tree's base, x east, y up, z south; metres
// Holds     arrays of internodes and buds in birth order, linked by index; living buds are listed in birth order
// Who       grow.cpp steps it through the seasons; light and space, vigor, shoots and shedding are its parts. One per
//           thread, reset for each tree, so that nothing is allocated once the arrays are as long as they ever get
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/vec.h"
#include "growth/grow.h"
#include "growth/habit.h"
#include "growth/markers.h"
#include "growth/occupancy.h"
#include "growth/shadow.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

inline constexpr std::int32_t kNone = -1;
inline constexpr float kLeastLight = 1.0f / 256.0f;  ///< so that no bud's signal is zero

/// Working data of internodes, beside the skeleton's.
struct Internodes {
  std::vector<std::int32_t> next;       ///< continuation of the axis, or kNone
  std::vector<std::int32_t> first_bud;  ///< lateral buds at the base: first_bud .. first_bud + buds
  std::vector<std::uint8_t> buds;
  std::vector<Vec3> heading;
  // Signal of this season.
  std::vector<float> main_signal, lateral_signal;  ///< Q gathered at the upper end, by way
  std::vector<float> main_vigor, lateral_rate;     ///< v of the main way; v per Q of the lateral ways

  void clear();
  void push_back(const Vec3& heading);
};

enum class BudState : std::uint8_t { lateral, terminal, dead };

struct Buds {
  std::vector<Vec3> at, direction;
  std::vector<Vec3> side;             ///< across the axis: azimuth of the next lateral bud (of terminal buds)
  std::vector<std::int32_t> node;     ///< internode at whose upper end it stands, kNone at the base
  std::vector<std::int32_t> carrier;  ///< lateral bud: the internode at whose base it stands
  std::vector<std::uint32_t> axis;    ///< terminal bud: its axis
  std::vector<std::uint8_t> order;    ///< of the axis that it makes or continues
  std::vector<BudState> state;
  std::vector<float> factor;        ///< gravimorphism and acrotony, 1 for terminal buds
  std::vector<float> sky;           ///< transmittance of other trees at the bud
  std::vector<float> vigor;         ///< v / v_max of the last season
  std::vector<std::uint16_t> idle;  ///< seasons without space or light
  // This season.
  std::vector<float> signal, flow;   ///< Q, v
  std::vector<Vec3> claimed;         ///< sum of directions to markers
  std::vector<std::int32_t> claims;  ///< how many

  std::size_t size() const { return node.size(); }
  void clear();
  std::int32_t push_back(const Vec3& at, const Vec3& direction, std::int32_t node, std::uint8_t order, BudState state);
};

/// A bud that grows this season.
struct GrowingBud {
  std::int32_t bud;
  int planned;  ///< n
  int made;
  bool continues;  ///< the axis was there before this season
};

/// A marker that ground and region let stand; or, for the tip of a trunk, the direction in which it has room.
struct DroppedMarker {
  Float4 at;
  float distance2;  ///< to its bud
  std::int32_t bud;
  bool ahead;
};

struct Tree {
  // What is grown.
  const GrowthInput* input = nullptr;
  const Parameters* parameters = nullptr;
  float length_m = 0;        ///< l
  float occupied_m = 0;      ///< r
  float reach_m = 0;         ///< r + d
  float cos_perception = 0;  ///< of zeta / 2
  bool leans = false;        ///< V is not zero
  Habits habits{};
  int phase = -2;
  RandomStream random{0, 0, Purpose::growth};

  // How far it is.
  int season = 0;
  int idle_seasons = 0;  ///< in a row, without a new internode
  bool finished = false;
  float height_m = 0;
  std::uint32_t axes = 0;
  Skeleton wood;
  Internodes internodes;
  Buds buds;
  std::vector<std::int32_t> living;    ///< buds, in birth order
  std::vector<std::int32_t> tip_of;    ///< terminal bud by axis
  std::vector<std::int32_t> standing;  ///< living internodes before this season's, in birth order
  std::size_t listed = 0;              ///< internodes born before this season
  std::vector<std::int32_t> failing;   ///< of these, where branches begin that have too little vigor
  std::vector<GrowingBud> growing;
  float greatest_vigor = 0;  ///< v_max

  // Where it stands.
  ShadowGrid shadow;
  Occupancy occupancy;
  PerceptionSamples samples;
  CompetitorIndex competitors;
  std::vector<Competitor> competing;
  std::vector<DroppedMarker> dropped;
  std::vector<Vec3> markers;          ///< painted ones, not yet consumed
  float highest_marker_m = 0;         ///< of those painted
  bool found_marker = false;          ///< some bud perceived a painted one
  std::vector<float> light_response;  ///< L^kappa for L = i / kLightSteps, for each distinct kappa
  std::vector<std::int32_t> counts;   ///< by internode: how many stand on it, itself included, before this season's
  GrowthWork work;

  /// v / v_max that reached internode i this season.
  float vigor_share(std::size_t i) const {
    if (greatest_vigor <= 0.0f) return 0.0f;
    const float v = internodes.main_vigor[i] + internodes.lateral_rate[i] * internodes.lateral_signal[i];
    return v / greatest_vigor;
  }
  const Habit& habit(std::uint8_t order) const {
    return habits[order < kOrders ? order : static_cast<std::size_t>(kOrders - 1)];
  }
};

/// Light that reaches p: what the tree's own wood leaves of it (as of this season's start) and other trees let through.
inline float light_at(const Tree& tree, const Vec3& p) {
  const float sky = tree.input->light ? tree.input->light->at(p) : 1.0f;
  return std::max(kLeastLight, sky * tree.shadow.exposure(p));
}

/// May a marker stand here for all that the region says? It has no lid: above the tree's height its last layer counts,
/// for growth ends there anyway, and a tip that sees no room just below would only be late.
inline bool in_region(const Tree& tree, Vec3 p) {
  const crowns::CrownRegion* region = tree.input->region;
  if (!region) return true;
  p.y = std::min(p.y, tree.input->max_height_m - region->layer_m);
  return region->contains(p);
}

/// Starts a tree: one terminal bud for each stem.
void plant(Tree& tree, const GrowthInput& input);

/// One season, as below in this order. Not after the tree is finished.
void grow_season(Tree& tree);

/// Reads the numbers in force at the tree's height.
void update_habits(Tree& tree);

/// Light at every living bud and the signal Q = b * L^kappa that it sends down (Longay 2014, eq. 4.7).
void sense_light(Tree& tree);

/// Markers dropped by the living buds, and who got them (space.cpp). `rest` is only those still growing.
void compete_for_space(Tree& tree);
void compete_for_space_again(Tree& tree);
/// The same with painted markers: who of `competing` gets them (painted.cpp).
void claim_painted(Tree& tree);

/// Signal down, vigor up (vigor.cpp): fills flow of the living buds, finds v_max of the enabled ones and the branches
/// that fail.
void share_vigor(Tree& tree);

/// Fate, deflection and extension (shoots.cpp). Returns true when something grew.
bool choose_growing(Tree& tree);
void deflect(Tree& tree);
/// Returns true when an internode passed the final height.
bool extend(Tree& tree);

/// Takes off branches whose vigor per internode is too small (shedding.cpp), and buds that are dead.
void shed(Tree& tree);
void bury_dead_buds(Tree& tree);

}  // namespace bosquet::growth
