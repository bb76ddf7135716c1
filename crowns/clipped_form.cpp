#include "crowns/clipped_form.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::crowns {
namespace {

// The body's least width in voxels, and its greatest at most: an edge is true to 3 cm on a hedge of 1 m.
constexpr float kFinest = 32.0f, kMost = 96.0f;
// The stem may wander so far from the base, as a share of the height up to the body.
constexpr float kStemShare = 0.04f;

/// The body about its own axes: `along` and `across` from the middle, `up` 0 at the underside and 1 at the top.
bool in_body(FormKind kind, float along, float across, float up) {
  if (!(up >= 0.0f && up <= 1.0f)) return false;
  const float disc = along * along + across * across;
  switch (kind) {
    case FormKind::natural:
      return true;
    case FormKind::box:
    case FormKind::panel:
      return std::fabs(along) <= 1.0f && std::fabs(across) <= 1.0f;
    case FormKind::ball:
      return disc + (2.0f * up - 1.0f) * (2.0f * up - 1.0f) <= 1.0f;
    case FormKind::cone:
      return disc <= (1.0f - up) * (1.0f - up);
    case FormKind::umbrella:
      return disc + up * up <= 1.0f;
  }
  return false;
}

/// A form with all that a place must be asked, worked out once.
class Body {
 public:
  Body(const ClippedForm& form, float clear_stem_m, float inset_m)
      : kind_(form.kind), centre_(form.centre), turn_(sin_cos(radians(form.rotation_deg))) {
    half_along_ = 0.5f * form.width_m - inset_m;
    half_across_ = 0.5f * form.depth_m - inset_m;
    low_ = clear_stem_m > 0.0f ? clear_stem_m + inset_m : 0.0f;
    high_ = form.height_m - inset_m;
  }
  bool operator()(const Vec3& p) const {
    const float east = p.x - centre_.x, north = -p.z - centre_.y;
    return in_body(kind_, (east * turn_.cos + north * turn_.sin) / half_along_,
                   (north * turn_.cos - east * turn_.sin) / half_across_, (p.y - low_) / (high_ - low_));
  }
  /// Half the extent of the body east and north.
  Vec2 half_extent() const {
    return {std::fabs(turn_.cos) * half_along_ + std::fabs(turn_.sin) * half_across_,
            std::fabs(turn_.sin) * half_along_ + std::fabs(turn_.cos) * half_across_};
  }
  float least_width() const { return 2.0f * std::min(half_along_, half_across_); }
  float low() const { return low_; }
  float high() const { return high_; }

 private:
  FormKind kind_;
  Vec2 centre_;
  SinCos turn_;
  float half_along_, half_across_, low_, high_;
};

}  // namespace

bool inside(const ClippedForm& form, float clear_stem_m, const Vec3& p) { return Body(form, clear_stem_m, 0.0f)(p); }

float volume_m3(const ClippedForm& form, float clear_stem_m) {
  const float box = form.width_m * form.depth_m * (form.height_m - clear_stem_m);
  switch (form.kind) {
    case FormKind::ball:
      return box * (kPi / 6.0f);
    case FormKind::cone:
      return box * (kPi / 12.0f);
    case FormKind::umbrella:
      return box * (kPi / 6.0f);
    default:
      return box;
  }
}

float farthest_m(const ClippedForm& form) {
  const auto length = [](float x, float y) { return std::sqrt(x * x + y * y); };
  return length(form.centre.x, form.centre.y) + 0.5f * length(form.width_m, form.depth_m);
}

CrownRegion clip(const CrownRegion* region, const ClippedForm& form, float clear_stem_m, float inset_m) {
  assert(form.clipped() && form.width_m > 0.0f && form.depth_m > 0.0f && form.height_m > clear_stem_m);
  const float least = std::min({form.width_m, form.depth_m, form.height_m - clear_stem_m});
  const Body body(form, clear_stem_m, std::clamp(inset_m, 0.0f, 0.25f * least));
  const float stem_m = std::max(0.1f, kStemShare * body.low());
  const float stem_top_m = 0.5f * (body.low() + body.high());

  // The box around body and stem, in voxels of one size.
  const Vec2 half = body.half_extent();
  const Vec2 low = glm::min(form.centre - half, Vec2(-stem_m)), high = glm::max(form.centre + half, Vec2(stem_m));
  const Vec3 size{high.x - low.x, body.high(), high.y - low.y};
  CrownRegion cut;
  cut.voxel_m = cut.layer_m = std::max(least / kFinest, std::max({size.x, size.y, size.z}) / kMost);
  cut.low = {low.x, 0.0f, -high.y};
  for (int axis = 0; axis < 3; ++axis) cut.cells[axis] = static_cast<int>(size[axis] / cut.voxel_m) + 1;
  cut.bits.resize((cut.index({0, cut.cells.y, 0}) + 63) / 64);

  const float stem2 = std::max(stem_m * stem_m, cut.voxel_m * cut.voxel_m);
  for (int y = 0; y < cut.cells.y; ++y)
    for (int z = 0; z < cut.cells.z; ++z)
      for (int x = 0; x < cut.cells.x; ++x) {
        const Vec3 p =
            cut.low +
            cut.voxel_m * (Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + Vec3(0.5f));
        const bool on_stem = p.y < stem_top_m && p.x * p.x + p.z * p.z <= stem2;
        if ((on_stem || body(p)) && (!region || region->contains(p))) cut.claim({x, y, z});
      }
  return cut;
}

}  // namespace bosquet::crowns
