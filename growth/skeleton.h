// Skeleton: a grown tree as internodes in birth order.
//
// Frame     tree frame: origin at the tree's base, x east, y up, z south; metres
// Holds     a parent precedes its children, so a pass from root to tips is a forward loop and back a backward one;
//           birth and shedding are kept, so the tree of any earlier season can be drawn from the same skeleton
// Who       growth/ writes it; geometry/, scene/ and exchange/ read it
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace bosquet::growth {

inline constexpr std::uint16_t kNever = 0xffff;  ///< season of shedding of an internode that was never shed

struct Skeleton {
  // One entry for each internode.
  std::vector<std::int32_t> parent;   ///< internode below, -1 at the foot of a stem
  std::vector<std::uint32_t> axis;    ///< which axis (run of one apical meristem) it belongs to
  std::vector<std::uint8_t> order;    ///< 0 for the trunk, +1 at each branching
  std::vector<Vec3> distal;           ///< upper end
  std::vector<float> radius;          ///< of the finished tree, metres (radii.h solves other seasons)
  std::vector<std::uint16_t> born;    ///< season, the first is 0
  std::vector<std::uint16_t> shed;    ///< season in which it fell, or kNever
  std::vector<float> light;           ///< exposure L in [0, 1] at its upper end, last season alive
  std::vector<float> vigor;           ///< v / v_max that reached it, last season alive
  std::vector<std::uint8_t> pipes;    ///< internodes as grown that it stands for; empty: each for itself (detail.h)
  std::vector<std::uint32_t> number;  ///< its place when fallen wood was there too (fallen.h); empty: that here

  int seasons = 0;                ///< seasons grown
  float internode_length_m = 0;   ///< l of this tree, over detail
  float detail = 1;               ///< how finely its wood is told
  float tip_diameter_m = 0.006f;  ///< d_e
  float pipe_exponent = 2.0f;     ///< n, that the radii were solved with

  std::size_t size() const { return parent.size(); }
  /// Pipes that internode i adds to those of its children (radii.h).
  int own_pipes(std::size_t i) const { return pipes.empty() ? 1 : pipes[i]; }
  /// What is drawn at random for internode i is drawn by this.
  std::uint32_t number_of(std::uint32_t i) const { return number.empty() ? i : number[i]; }
  bool alive(std::size_t i) const { return shed[i] == kNever; }
  /// Standing at the end of `season`.
  bool alive_at(std::size_t i, int season) const { return born[i] <= season && shed[i] > season; }
  Vec3 proximal(std::size_t i) const {
    return parent[i] < 0 ? Vec3{0.0f} : distal[static_cast<std::size_t>(parent[i])];
  }
};

}  // namespace bosquet::growth
