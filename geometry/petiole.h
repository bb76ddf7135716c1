// Petioles: the frame in which a leaf, or a leafed twig, stands on the wood that bears it; four at once.
//
// Source    Longay 2014, C.1.2: the petiole is a rod stepped from its base
// Model     H, L, U heading, left and up of the petiole, T the direction that the blade's upper side is drawn to; at
//           each of its steps the frame turns by
//             about H (twist)   Omega_H = -e_H L.T
//             about L (bend)    Omega_L =  e_L H.T
//             about U (turn)    Omega_U =  e_U L.(T x (H x T))
// Decision  these turns alone let no leaf hang (they turn the blade, not the stalk's foot), so first its weight bends
//           the stalk toward the direction that hangs so far below level, by bend / (1 + bend) of the way
// Holds     the same bits anywhere, in whichever lane; all vectors are of unit length
#pragma once

#include "core/scalar.h"
#include "geometry/vec_lanes.h"

namespace bosquet::geometry {

struct LeafFrame {
  Vec3 heading, left, up;
};
struct LeafFrames {
  Vec3x4 heading, left, up;

  LeafFrame lane(int k) const { return {heading.lane(k), left.lane(k), up.lane(k)}; }
};
inline LeafFrames all4(const LeafFrame& f) { return {all4(f.heading), all4(f.left), all4(f.up)}; }

/// Unit vectors across a twig: `side` level, so that two-ranked leaves make flat sprays, `over` at a right angle.
struct Across {
  Vec3 side, over;
  explicit Across(const Vec3& twig);
  Vec3 at(const SinCos& azimuth) const { return azimuth.cos * side + azimuth.sin * over; }
};

/// Frame of a stalk at its foot: at `angle` from the twig toward `radial`, its upper side toward the twig's tip.
LeafFrames stalk(const Vec3x4& twig, const Vec3x4& radial, const SinCos& angle);
LeafFrame stalk(const Vec3& twig, const Vec3& radial, const SinCos& angle);

/// Where a blade or twig that hangs `droop` below level, away from its foot, points, and the normal of its upper side.
/// `out` says which way is away for one that heads straight up or down.
struct Hanging {
  Vec3x4 heading, normal;
};
Hanging hanging(const Vec3x4& heading, const SinCos& droop, const Vec3x4& out);

/// The stalk sinks toward `heading` under its load, the more the softer it is.
LeafFrames sunk(const LeafFrames& frame, const Vec3x4& heading, Float4 softness);

/// The petiole's frame after it has been stepped from its base toward T. `fineness` 1: a step for each half of the largest
/// e, and four more.
LeafFrames turn_petiole(LeafFrames frame, const Vec3x4& toward, Float4 twist, Float4 bend, Float4 turn,
                        float fineness = 1.0f);
LeafFrame turn_petiole(const LeafFrame& frame, const Vec3& toward, float twist, float bend, float turn,
                       float fineness = 1.0f);

}  // namespace bosquet::geometry
