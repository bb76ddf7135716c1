// Clipped form: the body that a tree is kept cut to, and the part of its crown region inside that body.
//
// Model     a body stands on the clear stem, from its underside up to height_m above the ground: a box; a panel (a box
//           that is thin across, as pleached trees are); a ball (an ellipsoid); a cone, wide below; an umbrella, flat
//           below and domed above. In between leads the stem
// Decision  the division of space knows nothing of forms but a tree's size: what a neighbour may have depends on who
//           comes first, not on shears, so an edit of a form changes only its own tree. The form cuts the region when
//           growth gets it
// Decision  a crown region is much coarser than a clipped edge, so the cut region gets voxels of its own, small enough
//           for the form
// Frame     tree frame (x east, y up, z south, origin at the base); the centre and the turn are told in plan (east,
//           north; counter-clockwise from east)
// Units     metres; the turn in degrees
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "core/parameter.h"
#include "core/vec.h"
#include "crowns/crown_region.h"

namespace bosquet::crowns {

enum class FormKind { natural, box, ball, cone, panel, umbrella };
inline constexpr std::array<std::string_view, 6> kFormKindNames{"natural", "box", "ball", "cone", "panel", "umbrella"};

struct ClippedForm {
  FormKind kind = FormKind::natural;
  float width_m = 0.0f;   ///< along its own first axis
  float depth_m = 0.0f;   ///< across
  float height_m = 0.0f;  ///< of its top above the ground
  float rotation_deg = 0.0f;
  Vec2 centre{0.0f};  ///< plan, from the base

  bool clipped() const { return kind != FormKind::natural; }
  bool operator==(const ClippedForm&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, ClippedForm>
void describe(P& p, Visitor& visit) {
  visit(Choice{"form", kFormKindNames, "Body that the trees are kept clipped to"}, p.kind);
  visit(Real{"form_width_m", "m", 0, 100, "Width of the body along the row, or east; 0 is the spacing of the row"},
        p.width_m);
  visit(Real{"form_depth_m", "m", 0, 100, "Width across; 0 is as wide as along, and 0.5 m for a panel"}, p.depth_m);
  visit(Real{"form_height_m", "m", 0, 60, "Height of its top above the ground; its underside is clear_stem_m"},
        p.height_m);
  visit(Real{"form_rotation_deg", "deg", -360, 360,
             "Turn from the row's direction, or from east, counter-clockwise seen from above"},
        p.rotation_deg);
}

/// Where wood of a tree with this form may stand: within the body made smaller by `inset_m` (half of its least width at
/// most) or on the stem below it, and inside `region` unless that is null. The underside is `clear_stem_m` up.
CrownRegion clip(const CrownRegion* region, const ClippedForm& form, float clear_stem_m, float inset_m = 0.0f);

/// Whether a place lies in the body itself.
bool inside(const ClippedForm& form, float clear_stem_m, const Vec3& p);

/// Room in the body.
float volume_m3(const ClippedForm& form, float clear_stem_m);

/// From the base to the body's farthest corner in plan, at most.
float farthest_m(const ClippedForm& form);

}  // namespace bosquet::crowns
