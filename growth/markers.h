// Markers: samples of free space, and the buds that compete for them.
//
// Source    Runions et al. 2007; Longay 2014, 4.2.1 and fig. 4.4
// Model     a bud perceives what lies between r and r + d from it, inside the cone of half-angle zeta / 2 about its
//           direction; a marker goes to the nearest bud that perceives it, the older one of two equally near
// Decision  markers are drawn from 1024 fixed points of the perception volume, turned to the bud. The points are even in
//           volume (the additive recurrence of Roberts 2018), and so are neighbours among them: a bud takes as many as it
//           drops from a random one on, which spreads them better than if each were drawn for itself
// Cost      a marker: a few nanoseconds when refused; a search over near buds else
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"
#include "growth/lanes.h"

namespace bosquet::growth {

/// Points of a perception volume about +z with r = 1.
class PerceptionSamples {
 public:
  static constexpr std::uint32_t kCount = 1024;
  static constexpr std::uint32_t kMost = 20;  ///< that can be taken from any one on: after the last the first follow

  /// `depth` is d / r. The points of the last volumes asked for are kept.
  void reset(float depth, float cos_half_angle, bool planar);

  struct Reader {
    const float *xs, *ys, *zs;
    /// Samples n .. n + 3, n < kCount + kMost - 4.
    Float4 x(std::uint32_t n) const { return load4(xs + n); }
    Float4 y(std::uint32_t n) const { return load4(ys + n); }
    Float4 z(std::uint32_t n) const { return load4(zs + n); }
  };
  Reader reader() const { return {x_, y_, z_}; }

 private:
  struct Points {
    float depth, cos_half_angle;
    bool planar;
    std::vector<float> x, y, z;
  };
  void make(Points& points);

  static constexpr std::size_t kKept = 16;  ///< volumes, for the trees of a stand are of few species
  std::vector<Points> kept_;
  std::size_t oldest_ = 0;
  const float *x_ = nullptr, *y_ = nullptr, *z_ = nullptr;
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
  std::int32_t nearest(const Vec3& p, float within_m, std::int32_t fallback) const {
    return wide_ ? nearest_wide(p, within_m, fallback) : nearest_plainly(p, within_m, fallback);
  }
  /// The same as on any processor.
  std::int32_t nearest_plainly(const Vec3& p, float within_m, std::int32_t fallback) const;

 private:
  std::int32_t nearest_wide(const Vec3& p, float within_m, std::int32_t fallback) const;

  bool wide_ = false;
  float cos_ = 0.0f;
  Vec3 inverse_{1.0f};  ///< of the size of a cell
  Vec3 low_{0.0f};
  IVec3 cells_{0};
  std::vector<std::int32_t> start_;  ///< by cell, and one past the last
  std::vector<std::int32_t> cell_of_;
  std::vector<float> x_, y_, z_;                    ///< by cell, and eight far away at the end
  std::vector<float> along_x_, along_y_, along_z_;  ///< directions
  std::vector<std::int32_t> bud_;
};

}  // namespace bosquet::growth
