// Sowing: trees placed at random by the fields: a number in a region, a density, or along a brush stroke.
//
// Source    Longay 2014, 6.4.2 (species bar, brush)
// Model     for tree n of a block, key = tree_key(block, n): draw its type by the relative probabilities, its scale
//           uniformly in the type's range, then its place by the type's field inside the region
// Decision  a type without room in the region is left out of the draw; when no type has room, placing stops. A place
//           that the exact rule refuses is drawn again; after 64 refusals a cell counts as full until the call ends
// Rate      a brush of radius R and strength q plants rate * q * R^2 trees a second (rate in trees per m2 and s)
//           and one when it touches the ground, in steps of 1/60 s of recorded time, never by the display's clock
// Errors    a mix that plants nothing, by check(); planting with it plants nothing
// Holds     the same seed, block and planting give the same trees; each tree's numbers hang on its key alone
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/progress.h"
#include "core/result.h"
#include "distribution/planting.h"
#include "distribution/region.h"

namespace bosquet::distribution {

inline constexpr int kRefusalsOfACell = 64;
inline constexpr int kTicksPerSecond = 60;

/// One type of the species bar.
struct MixEntry {
  std::uint32_t species = 0;
  float probability = 1.0f;                  ///< relative to the other entries, >= 0
  float scale_min = 0.0f, scale_max = 0.0f;  ///< both 0: the species' own range

  bool operator==(const MixEntry&) const = default;
};

/// What is sown.
struct Sowing {
  std::uint64_t seed = 0;         ///< the document's
  std::uint64_t block = 0;        ///< hash_text of the planting block's name
  std::uint64_t first_index = 0;  ///< of its first tree
  std::vector<MixEntry> mix;
};

/// Whether anything can be sown: types, at least one of them likelier than never, and scales in order.
Result<void> check(const Planting& planting, const Sowing& what);

/// What came of it.
struct Sown {
  std::vector<StandingTree> trees;  ///< planted, in order; they stand in the planting now
  std::size_t asked = 0;
  bool no_room = false;    ///< fewer than asked because nothing was left in the region
  bool cancelled = false;  ///< fewer than asked because somebody wanted it so
};

/// The type (entry of the mix) of the tree with a key, drawn among those not marked in `full` (none when it is empty).
std::optional<std::size_t> draw_type(const Planting& planting, const Sowing& what, std::uint64_t key,
                                     const std::vector<bool>& full);

/// The scale of the tree with a key if it is of that type.
float draw_scale(const Planting& planting, const Sowing& what, std::uint64_t key, std::size_t type);

/// Plants `count` trees inside a region.
Sown sow(Planting& planting, const Sowing& what, const Region& where, std::size_t count, Progress* progress = nullptr);

/// Number of trees to sow so that the region comes to hold `per_hectare` of the mixed types, those standing counted in.
std::size_t count_to_density(Planting& planting, const Sowing& what, const Region& where, float per_hectare);

struct BrushEvent {
  Vec2 at{0.0f};
  int tick = 0;  ///< in 1/60 s from the stroke's begin, never falling
};

struct PlantBrush {
  float radius_m = 5.0f;
  float strength = 0.5f;
  float rate = 0.2f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, PlantBrush>
void describe(P& p, Visitor& visit) {
  visit(Real{"radius_m", "m", 0.1, 1000, "Radius of the planting brush"}, p.radius_m);
  visit(Real{"strength", "", 0, 1, "Share of the brush's full rate"}, p.strength);
  visit(Real{"rate", "trees/m2/s", 0.0001, 100, "Trees a second at full strength, for each square metre of radius^2"},
        p.rate);
}

/// A stroke while it is drawn. However its events come, the trees are those that sow_stroke plants of all of them.
class StrokeSower {
 public:
  /// Nothing else may change the planting until the sower goes.
  StrokeSower(Planting& planting, Sowing what, const PlantBrush& brush);
  ~StrokeSower();
  StrokeSower(const StrokeSower&) = delete;
  StrokeSower& operator=(const StrokeSower&) = delete;

  /// Plants what is due before the time of the last event. Events follow those of earlier calls.
  void extend(std::span<const BrushEvent> events, Progress* progress = nullptr);
  /// Plants what is due at the time of the last event: the stroke has ended.
  void finish(Progress* progress = nullptr);

  const Sown& sown() const;  ///< so far

 private:
  class Stroke;
  std::unique_ptr<Stroke> stroke_;
};

/// Plants along a recorded stroke. Where there is no room trees are left out, and the stroke goes on.
Sown sow_stroke(Planting& planting, const Sowing& what, const PlantBrush& brush, std::span<const BrushEvent> events,
                Progress* progress = nullptr);

/// Events of a brush drawn along a polyline at constant speed within `seconds`.
std::vector<BrushEvent> steady_stroke(std::span<const Vec2> points, float seconds);

}  // namespace bosquet::distribution
