// Tree: the state of one tree while it grows.
//
// Frame     tree frame: origin at the tree's base, x east, y up, z south; metres
// Holds     arrays of internodes and buds in birth order, linked by index; living buds are listed in birth order
// Who       grow.cpp steps it through the seasons; light and space, vigor, shoots and shedding are its parts. One per
//           thread, reset for each tree, so that nothing is allocated once the arrays are as long as they ever get
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/scalar.h"
#include "core/vec.h"
#include "growth/grow.h"
#include "growth/habit.h"
#include "growth/lanes.h"
#include "growth/markers.h"
#include "growth/occupancy.h"
#include "growth/shadow.h"
#include "growth/skeleton.h"
#include "growth/written_ahead.h"

namespace bosquet::growth {

inline constexpr std::int32_t kNone = -1;

/// Ways on from an internode's upper end.
enum Way : std::uint8_t { kMain, kLateral };

/// Lanes of what is gathered at an internode's upper end: Q by way, and how many internodes stand on it, itself included.
enum Gathered : std::uint8_t { kMainSignal = kMain, kLateralSignal = kLateral, kStanding };

/// What a season reads and writes of each standing internode, side by side: half a cache line. One whose lateral buds and
/// branches are gone is bare: signal and vigor pass it unchanged, so the next one above takes its place.
struct alignas(32) Internode {
  Float4 gathered{0.0f, 0.0f, 1.0f, 0.0f};  ///< Q 0 and number `span` once vigor is shared; numbers exact to 2^24
  std::array<float, 2> rate{};              ///< v of the main way; v per Q of the lateral ways
  std::int32_t parent = kNone;              ///< the next one below that is not bare
  std::uint16_t span = 1;                   ///< itself and the bare ones just below; 0 when bare
  std::uint8_t order = 0;
  std::uint8_t way = kLateral;  ///< in which it goes on from its parent
};

/// What is asked of an internode when something beside it changes.
struct InternodeParts {
  Vec3 heading{0.0f};
  std::int32_t next = kNone;   ///< continuation of the axis
  std::int32_t above = kNone;  ///< the same, past bare ones
  std::int32_t first_bud = 0;  ///< lateral buds at the base: first_bud .. first_bud + buds
  std::uint8_t buds = 0;
  std::uint8_t laterals = 0;  ///< living buds and standing branches at the upper end
};

/// Working data of internodes, beside the skeleton's.
struct Internodes {
  std::vector<Internode> each;
  std::vector<InternodeParts> parts;

  Internode& operator[](std::size_t i) { return each[i]; }
  const Internode& operator[](std::size_t i) const { return each[i]; }
  void clear() { each.clear(), parts.clear(); }
  void push_back(const Vec3& heading, std::int32_t parent, std::uint8_t order, Way way) {
    Internode& i = each.emplace_back();
    i.parent = parent, i.order = order, i.way = way;
    parts.emplace_back().heading = heading;
  }
};

enum class BudState : std::uint8_t { lateral, terminal, dead };

/// What a season reads and writes of each living bud, side by side: a cache line.
struct alignas(64) Bud {
  Vec3 at{0.0f}, direction{0.0f};
  std::int32_t node = kNone;  ///< internode at whose upper end it stands, kNone at the base
  float factor = 1.0f;        ///< gravimorphism and acrotony, 1 for terminal buds
  float sky = 1.0f;           ///< transmittance of other trees at the bud
  std::uint16_t idle = 0;     ///< seasons without space or light
  std::uint8_t order = 0;     ///< of the axis that it makes or continues
  BudState state = BudState::lateral;
  std::int32_t place = 0;            ///< its cell in the shadow
  std::int32_t claims = 0;           ///< how many markers it got this season
  float signal = 0.0f, flow = 0.0f;  ///< Q, v as last shared
};

/// Where a bud comes from.
struct BudOrigin {
  Vec3 side{0.0f};               ///< terminal bud: across the axis, azimuth of the next lateral bud
  std::int32_t carrier = kNone;  ///< lateral bud: the internode at whose base it stands
  std::uint32_t axis = 0;        ///< terminal bud: its axis
};

struct Buds {
  std::vector<Bud> each;
  std::vector<BudOrigin> origin;
  std::vector<Vec3> claimed;  ///< this season: sum of directions to markers; valid where there are claims

  Bud& operator[](std::size_t b) { return each[b]; }
  const Bud& operator[](std::size_t b) const { return each[b]; }
  std::size_t size() const { return each.size(); }
  void clear() { each.clear(), origin.clear(), claimed.clear(); }
  /// Written in place, number by number: whole vectors just written to memory would be waited for.
  std::int32_t push_back(Vec3 at, Vec3 direction, std::int32_t node, std::uint8_t order, BudState state) {
    Bud& b = each.emplace_back();
    b.at = at, b.direction = direction, b.node = node, b.order = order, b.state = state;
    origin.emplace_back(), claimed.emplace_back(0.0f);
    return static_cast<std::int32_t>(each.size() - 1);
  }
};

/// A bud that grows this season.
struct GrowingBud {
  std::int32_t bud;
  int planned;  ///< n
  int made;
  bool continues;  ///< the axis was there before this season
};

/// A marker, and the bud that dropped it.
struct Marker {
  Vec3 at;
  std::int32_t bud;
  float from_m;
};

/// Markers of some buds, one bud after another.
struct DroppedMarkers {
  std::vector<float> x, y, z;
  std::vector<std::int32_t> cell;  ///< of the occupancy
  std::vector<std::int32_t> bud;   ///< that dropped it
  std::vector<std::int32_t> free;  ///< markers whose cells are
  struct OfBud {
    std::int32_t bud;
    std::size_t first, end;
  };
  std::vector<OfBud> of_trunks;   ///< those that tips of trunks dropped
  WrittenAhead<Marker> standing;  ///< of all buds of this round
  void make_room(std::size_t count) {
    if (count <= x.size()) return;
    x.resize(count), y.resize(count), z.resize(count), cell.resize(count), bud.resize(count), free.resize(count);
  }
};

/// v / v_max.
inline float share_of(float v, float greatest) { return greatest > 0.0f ? smaller(v / greatest, 1.0f) : 0.0f; }

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
  SinCos phyllotactic{};             ///< of phi
  std::vector<SinCos> between_buds;  ///< by n: of a full turn over n
  int phase = -2;
  RandomStream random{0, 0, Purpose::growth};

  // How far it is.
  int season = 0;
  int idle_seasons = 0;  ///< in a row, without a new internode
  bool finished = false;
  float height_m = 0;
  float press = 0, pressed_at_m = -1;  ///< of the neighbours at that height, 1 at the ground
  std::uint32_t axes = 0;
  Skeleton wood;  ///< while it grows vigor is v as last shared, of this season's wood its bud's v / v_max
  Internodes internodes;
  Buds buds;
  std::vector<std::int32_t> living;    ///< buds, in birth order; those that die leave it when light is sensed next
  std::vector<std::int32_t> tip_of;    ///< terminal bud by axis
  std::vector<std::int32_t> standing;  ///< living internodes before this season's, in birth order, without bare ones
  std::vector<std::int32_t> thinned;   ///< internodes that may have become bare
  std::size_t listed = 0;              ///< internodes born before this season
  WrittenAhead<std::int32_t> failing;  ///< of these, where branches begin that have too little vigor
  WrittenAhead<std::int32_t> enabled;  ///< buds with space this season
  std::vector<GrowingBud> growing;
  std::vector<std::int32_t> extending;  ///< buds of these
  float greatest_vigor = 0;             ///< v_max

  // Where it stands.
  ShadowGrid shadow;
  int placed_in = 0;  ///< layout of the shadow that the places of buds are of
  Occupancy occupancy;
  PerceptionSamples samples;
  CompetitorIndex competitors;
  WrittenAhead<Competitor> competing;
  DroppedMarkers dropped;
  std::vector<Vec3> markers;               ///< painted ones, not yet consumed
  float highest_marker_m = 0;              ///< of those painted
  bool found_marker = false;               ///< some bud perceived a painted one
  std::vector<float> light_response;       ///< L^kappa for L = i / kLightSteps, for each of the kappas met so far
  std::vector<float> light_kappas;         ///< these
  std::array<int, kOrders> light_table{};  ///< by order: where its own begins in light_response
  GrowthWork work;

  /// v / v_max of the season that v was last shared in.
  float vigor_of(const Bud& b) const { return share_of(b.flow, greatest_vigor); }
  /// From v to v / v_max of this season, for an internode that was there before.
  void scale_vigor(std::size_t i) { wood.vigor[i] = greatest_vigor > 0.0f ? wood.vigor[i] / greatest_vigor : 0.0f; }
  const Habit& habit(std::uint8_t order) const {
    return habits[order < kOrders ? order : static_cast<std::size_t>(kOrders - 1)];
  }
};

/// Starts a tree: one terminal bud for each stem.
void plant(Tree& tree, const GrowthInput& input);

/// One season, as below in this order. Not after the tree is finished.
void grow_season(Tree& tree);

/// Reads the numbers in force at the tree's height.
void update_habits(Tree& tree);

/// Buds that died or fell leave the living ones; the others' light and the signal Q = b * L^kappa that each tells its node
/// (Longay 2014, eq. 4.7), the markers they drop, and who gets them (space.cpp).
void sense(Tree& tree);
/// Markers dropped by the buds that still grow, and who gets them.
void compete_again(Tree& tree);
/// The same with painted markers (painted.cpp).
void claim_painted(Tree& tree, std::span<const std::int32_t> buds);
/// One more marker, this way, for a bud.
inline void claim(Tree& tree, std::int32_t bud, const Vec3& way) {
  const auto b = static_cast<std::size_t>(bud);
  Vec3& claimed = tree.buds.claimed[b];
  const bool more = tree.buds[b].claims++ != 0;
  claimed = Vec3{where(more, claimed.x), where(more, claimed.y), where(more, claimed.z)} + way;
}

/// Signal down, vigor up (vigor.cpp): finds the branches that fail.
void share_vigor(Tree& tree);

/// Fate, deflection and extension (shoots.cpp): who grows, by its share of v_max, the greatest v of a bud with space; buds
/// that waited too long die. Returns true when some grow.
bool choose_growing(Tree& tree);
void deflect(Tree& tree);
/// Returns true when an internode passed the final height.
bool extend(Tree& tree);

/// A lateral bud or branch of an internode is no more.
inline void lose_lateral(Tree& tree, std::int32_t node) {
  if (--tree.internodes.parts[static_cast<std::size_t>(node)].laterals == 0) tree.thinned.push_back(node);
}

/// Gives bare internodes the vigor that passes them, as last shared.
void fill_in_vigor(Tree& tree);

/// True for a branch of the trunk that leaves it below the rising foot of the crown (shedding.cpp).
bool outgrown(const Tree& tree, std::int32_t node);

/// Takes off branches whose vigor per internode is too small, and their buds (shedding.cpp).
void shed(Tree& tree);

}  // namespace bosquet::growth
