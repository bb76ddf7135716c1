#include "crowns/clipped_form.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bosquet::crowns {
namespace {

const ClippedForm kForms[] = {{FormKind::box, 2.0f, 1.0f, 3.0f},      {FormKind::ball, 2.4f, 2.4f, 4.4f},
                              {FormKind::cone, 2.0f, 2.0f, 4.0f},     {FormKind::panel, 3.0f, 0.5f, 4.6f, 30.0f},
                              {FormKind::umbrella, 5.0f, 4.0f, 4.5f}, {FormKind::box, 0.75f, 0.9f, 1.8f, 0, {0, 0.2f}}};

/// A column of room from the ground up, 8 m wide.
CrownRegion wide_region() {
  CrownRegion region;
  region.low = {-4.0f, 0.0f, -4.0f};
  region.voxel_m = 0.5f, region.layer_m = 1.0f;
  region.cells = {16, 12, 16};
  region.bits.assign((16 * 12 * 16 + 63) / 64, ~std::uint64_t{0});
  return region;
}

template <class Each>
void for_each_voxel(const CrownRegion& region, Each each) {
  for (int y = 0; y < region.cells.y; ++y)
    for (int z = 0; z < region.cells.z; ++z)
      for (int x = 0; x < region.cells.x; ++x)
        if (region.voxel({x, y, z}))
          each(region.low + Vec3{region.voxel_m, region.layer_m, region.voxel_m} *
                                (Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} + 0.5f));
}

TEST(ClippedForm, ACutRegionIsTheBodyAndTheStemBelowIt) {
  for (const ClippedForm& form : kForms)
    for (const float clear : {0.0f, 1.5f}) {
      if (form.height_m < clear + 0.5f) continue;
      const CrownRegion cut = clip(nullptr, form, clear);
      const float voxel3 = cut.voxel_m * cut.voxel_m * cut.voxel_m;
      float body = 0;
      for_each_voxel(cut, [&](const Vec3& p) {
        if (inside(form, clear, p))
          body += voxel3;
        else
          EXPECT_LE(std::hypot(p.x, p.z), 0.16f) << "a voxel outside the body is of the stem";
      });
      // The volume of a digitised body is off by some share of its surface voxels: a few per cent at 32 voxels across.
      EXPECT_NEAR(body, volume_m3(form, clear), 0.05f * volume_m3(form, clear)) << static_cast<int>(form.kind);
    }
}

TEST(ClippedForm, AStemLeadsFromTheGroundIntoTheBody) {
  for (const ClippedForm& form : kForms) {
    const CrownRegion cut = clip(nullptr, form, 1.2f);
    for (float y = 0.5f * cut.layer_m; y < 1.5f; y += cut.layer_m) EXPECT_TRUE(cut.contains({0, y, 0})) << y;
  }
}

TEST(ClippedForm, OnlyWhatTheRegionHasIsLeft) {
  CrownRegion half = wide_region();
  for (int y = 0; y < half.cells.y; ++y)
    for (int z = 0; z < half.cells.z; ++z)
      for (int x = 0; x < 8; ++x) {
        const std::size_t bit = half.index({x, y, z});
        half.bits[bit >> 6] &= ~(std::uint64_t{1} << (bit & 63));
      }
  const CrownRegion cut = clip(&half, kForms[1], 2.0f);
  std::size_t voxels = 0;
  for_each_voxel(cut, [&](const Vec3& p) {
    EXPECT_GE(p.x, 0.0f);
    ++voxels;
  });
  EXPECT_GT(voxels, 1000u);
  const CrownRegion whole = wide_region();
  EXPECT_EQ(clip(&whole, kForms[1], 2.0f).bits, clip(nullptr, kForms[1], 2.0f).bits);
}

TEST(ClippedForm, TurnsCounterClockwiseSeenFromAbove) {
  const ClippedForm panel{FormKind::panel, 4.0f, 0.4f, 3.0f, 30.0f};
  // 30 degrees north of east; north is -z.
  const float c = std::sqrt(3.0f) / 2.0f, s = 0.5f;
  EXPECT_TRUE(inside(panel, 0.0f, {1.9f * c, 1.0f, -1.9f * s}));
  EXPECT_FALSE(inside(panel, 0.0f, {1.9f * c, 1.0f, 1.9f * s}));
  EXPECT_FALSE(inside(panel, 0.0f, {2.1f * c, 1.0f, -2.1f * s}));
}

TEST(ClippedForm, AnInsetKeepsWoodOffTheSides) {
  const ClippedForm box = kForms[0];
  const CrownRegion cut = clip(nullptr, box, 0.0f, 0.1f);
  for_each_voxel(cut, [&](const Vec3& p) {
    EXPECT_LE(std::fabs(p.x), 0.91f);
    EXPECT_LE(std::fabs(p.z), 0.41f);
    EXPECT_LE(p.y, 2.91f);
  });
}

TEST(ClippedForm, NothingOfABodyLiesFartherThanItsFarthestCorner) {
  for (const ClippedForm& form : kForms)
    for_each_voxel(clip(nullptr, form, 1.0f),
                   [&](const Vec3& p) { EXPECT_LE(std::hypot(p.x, p.z), farthest_m(form) + 1e-4f); });
}

}  // namespace
}  // namespace bosquet::crowns
