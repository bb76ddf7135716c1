// Representative shape: what a tree claims space with before it is grown, a trunk cylinder under a crown ellipsoid.
//
// Source    Longay 2014, 6.2. Erratum: the projected crown area is pi * (C_w / 2)^2, the source prints pi * C_w^2 / 2
// Model     trunk T_w wide and T_h high, then a crown C_w wide and C_h high; mature_height_m = T_h + C_h
// Units     metres at scale 1; an instance multiplies heights by its S_h and widths (the trunk's too) by its S_w
#pragma once

#include <concepts>
#include <type_traits>

#include "core/parameter.h"
#include "core/scalar.h"

namespace bosquet::crowns {

struct RepresentativeShape {
  float trunk_width_m = 0.5f;      ///< T_w
  float trunk_height_m = 3.0f;     ///< T_h, height of the crown base
  float crown_width_m = 10.0f;     ///< C_w
  float mature_height_m = 20.0f;   ///< T_h + C_h
  float leaf_area_density = 0.5f;  ///< m2 of leaves in a m3 of crown

  float crown_height_m() const { return mature_height_m - trunk_height_m; }
  float projected_area_m2(float scale_width) const {
    const float radius = 0.5f * scale_width * crown_width_m;
    return kPi * radius * radius;
  }
  bool operator==(const RepresentativeShape&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, RepresentativeShape>
void describe(P& p, Visitor& visit) {
  visit(Real{"trunk_width_m", "m", 0.01, 5, "Trunk diameter of a mature free-standing tree"}, p.trunk_width_m);
  visit(Real{"trunk_height_m", "m", 0, 60, "Height of the crown base of a free-standing tree"}, p.trunk_height_m);
  visit(Real{"crown_width_m", "m", 0.2, 60, "Crown diameter of a mature free-standing tree"}, p.crown_width_m);
  visit(Real{"mature_height_m", "m", 0.5, 120, "Height at which a tree of scale 1 stops growing"}, p.mature_height_m);
  visit(Real{"leaf_area_density", "m2/m3", 0.1, 3, "Leaf area in a cubic metre of crown"}, p.leaf_area_density);
}

}  // namespace bosquet::crowns
