// Markers: samples of free space, and the buds that compete for them.
//
// Source    Runions et al. 2007; Longay 2014, 4.2.1 and fig. 4.4
// Model     a bud perceives what lies between r and r + d from it, inside the cone of half-angle zeta / 2 about its
//           direction; a marker goes to the nearest bud that perceives it, the older one of two equally near
// Decision  markers are drawn from 1024 fixed points of the perception volume, turned to the bud. The points are even in
//           volume (the additive recurrence of Roberts 2018), more so than 4096 random ones, and stay in the cache
// Cost      a marker: a few nanoseconds when refused by the occupied cell it falls in; a search over near buds else
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/vec.h"
#include "growth/directions.h"
#include "growth/lanes.h"

namespace bosquet::growth {

/// Points of a perception volume about +z with r = 1.
class PerceptionSamples {
 public:
  static constexpr std::uint32_t kCount = 1024;

  /// `depth` is d / r. Keeps what it has when nothing changed.
  void reset(float depth, float cos_half_angle, bool planar);

  /// Sample n in the volume of a bud; `basis` is around its direction.
  Vec3 at(std::uint32_t n, const Vec3& direction, const Basis& basis) const {
    return vec3(at(n, lanes(basis.x), lanes(basis.y), lanes(direction)));
  }
  Float4 at(std::uint32_t n, Float4 x, Float4 y, Float4 direction) const {
    const Vec3& s = points_[n & (kCount - 1)];
    return x * all4(s.x) + y * all4(s.y) + direction * all4(s.z);
  }

 private:
  float depth_ = -1.0f, cos_ = 2.0f;
  bool planar_ = false;
  std::vector<Vec3> points_;
};

/// A bud that competes.
struct Competitor {
  Vec3 at;
  std::int32_t bud;
  Vec3 direction;
};

/// Competing buds by cell, for "who is nearest and perceives this point?".
class CompetitorIndex {
 public:
  /// `reach_m` is r + d.
  void build(std::span<const Competitor> competitors, float reach_m, float cos_half_angle);

  /// The nearest bud that perceives p within `within_m`, ties by bud; `fallback` when there is none nearer.
  std::int32_t nearest(const Vec3& p, float within_m, std::int32_t fallback) const;

 private:
  float cos_ = 0.0f, cell_m_ = 1.0f, inverse_ = 1.0f;
  Vec3 low_{0.0f};
  IVec3 cells_{0};
  std::vector<std::int32_t> start_;  ///< by cell, and one past the last
  std::vector<std::int32_t> cell_of_;
  std::vector<float> x_, y_, z_;  ///< by cell, and four far away at the end
  std::vector<Competitor> sorted_;
};

}  // namespace bosquet::growth
