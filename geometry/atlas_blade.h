// Atlas blade: the outline, veins and relief of one leaf blade, as functions of a point.
//
// Model     most families are half widths along the leaf, left and right a little unlike; the line of equal station is
//           swept forward from the midrib, less toward the tip, so that lobes and teeth point to the tip; lobed leaves
//           have a vein into every lobe; heart-shaped ones a notch at the base, where the stalk begins. Palmate blades
//           are radii over the angle round the stalk's end. Compound ones are leaflets, themselves of the first kind,
//           in pairs along a stalk
// Frame     lengths of the blade: base (0, 0), tip (0, 1), v along the midrib, u to the right
// Holds     distance is exact to first order near the edge, which is what antialiasing needs
#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"
#include "core/vec.h"
#include "geometry/look.h"
#include "geometry/noise.h"

namespace bosquet::geometry {

struct BladePoint {
  float distance;  ///< to the edge, positive inside, in blade lengths
  float vein;      ///< 0 between veins, 1 on one
  Vec2 slope;      ///< of the relief in (u, v): pillows between veins, folded along the midrib
};

class LeafBlade {
 public:
  /// `variant` makes leaves of one tree differ.
  LeafBlade(const LeafLook& look, std::uint64_t seed, std::uint64_t variant);

  /// `pixel` is the size of a pixel in blade lengths: thin veins are drawn as wide and as faint as it asks.
  BladePoint at(float u, float v, float pixel) const;

  /// Distance alone, for shadows.
  float distance(float u, float v) const;

  /// No point of the blade is farther than this from the midrib's line, nor below v = -overhang().
  float half_width() const { return half_width_; }
  float overhang() const { return overhang_; }

  /// Where on the midrib the stalk ends: in the notch of a heart.
  float foot() const { return foot_; }

 private:
  static constexpr int kStations = 256;
  struct Profile {
    std::array<float, kStations + 1> width, slant;  ///< half width, 1 / sqrt(1 + slope^2)
  };

  enum class Build { simple, palmate, compound };

  /// A point in the frame of the leaflet that it belongs to, or beside it; `lengths` is the leaflet's.
  struct InLeaflet {
    float u, v, length, distance;
  };

  void make_profiles(const LeafLook& look, RandomStream& stream, float aspect);
  void make_palmate(const LeafLook& look, RandomStream& stream);
  void make_compound(const LeafLook& look, RandomStream& stream);
  float profile_distance(float u, float v) const;
  float palmate_distance(float u, float v) const;
  InLeaflet leaflet_at(float u, float v) const;
  float rachis_distance(float u, float v) const;
  BladePoint simple_at(float u, float v, float pixel) const;
  BladePoint palmate_at(float u, float v, float pixel) const;

  Build build_;
  float sweep_ = 0.0f;       ///< of the outline's stations
  float vein_sweep_ = 0.8f;  ///< of the side veins
  float vein_strength_ = 0.7f;
  float vein_first_ = 0.06f, vein_spacing_ = 0.1f;
  float half_width_ = 0.3f, overhang_ = 0.0f, foot_ = 0.0f;
  float notch_[2] = {0.0f, 0.0f};  ///< depth of a heart's notch, left and right
  float lobe_angle_ = 1.0f;        ///< between a palmate blade's main veins
  int lobes_each_ = 2;             ///< of them on each side of the middle one
  int veins_ = 7;
  int pairs_ = 0;         ///< of leaflets
  float leaflet_ = 0.3f;  ///< their length
  float pair_spacing_ = 0.1f, first_pair_ = 0.1f;
  std::array<Profile, 2> sides_{};  ///< left, right; palmate: radius over angle
};

}  // namespace bosquet::geometry
