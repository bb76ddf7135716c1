#include "geometry/tree_levels.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/foliage_mass.h"
#include "geometry/lod_shell.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

TriangleMesh square(float side, float depth) {
  TriangleMesh mesh;
  for (Vec2 c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    mesh.positions.push_back({0.5f * side * c.x, 0.5f * side * c.y, depth});
    mesh.uvs.push_back(0.5f * Vec2(c.x + 1, 1 - c.y));
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Image plain(int size, int channels, const std::array<std::uint8_t, 4>& colour) {
  Image image(size, size, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = colour[i % static_cast<std::size_t>(channels)];
  return image;
}

const Box3 kTwoMetres = [] {
  Box3 box;
  box.add(Vec3(-1)), box.add(Vec3(1));
  return box;
}();

TEST(LevelRaster, ASquareHasItsAreaAndColourFromEverySide) {
  const TriangleMesh mesh = square(1.0f, 0.0f);
  const RasterSkin white;
  const RasterSurface surface[] = {{&mesh, &white}};
  for (float azimuth : {0.0f, kPi}) {
    const Appearance a = appearance(surface, RasterView::level(azimuth), kTwoMetres, 400);
    EXPECT_NEAR(a.area, 1.0f, 0.02f);
    EXPECT_EQ(a.colour, Vec3(1.0f));
  }
  const Appearance turned = appearance(surface, RasterView::level(kPi / 3), kTwoMetres, 400);
  EXPECT_NEAR(turned.area, 0.5f, 0.02f);
  EXPECT_EQ(appearance(surface, RasterView::from_above(), kTwoMetres, 400).area, 0.0f);
}

TEST(LevelRaster, TheNearerSurfaceHidesTheOther) {
  TriangleMesh back = square(1.0f, -0.5f), front = square(0.5f, 0.5f);
  back.colours.assign(4, Rgba8(255, 0, 0, 255));
  front.colours.assign(4, Rgba8(0, 255, 0, 255));
  const RasterSkin white;
  for (const bool order : {false, true}) {
    const RasterSurface surfaces[] = {{order ? &back : &front, &white}, {order ? &front : &back, &white}};
    const Appearance seen = appearance(surfaces, RasterView::level(0.0f), kTwoMetres, 400);
    EXPECT_NEAR(seen.area, 1.0f, 0.02f);
    EXPECT_NEAR(seen.colour.g, 0.25f, 0.02f);
    EXPECT_EQ(appearance(surfaces, RasterView::level(kPi), kTwoMetres, 400).colour.g, 0.0f);
  }
}

TEST(LevelRaster, BackFacesOfOneSidedSurfacesAreNotDrawn) {
  const TriangleMesh mesh = square(1.0f, 0.0f);
  const RasterSkin white;
  const RasterSurface surface[] = {{&mesh, &white, true}};
  EXPECT_GT(appearance(surface, RasterView::level(0.0f), kTwoMetres, 64).area, 0.9f);
  EXPECT_EQ(appearance(surface, RasterView::level(kPi), kTwoMetres, 64).area, 0.0f);
}

TEST(LevelRaster, CoverageIsRightHoweverSmallTheTextureIsOnThePicture) {
  // A disc of radius 0.4 of the square covers half of it; ten thousand small ones too.
  Image disc(128, 128, 4);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const float dx = (static_cast<float>(x) + 0.5f) / 128 - 0.5f, dy = (static_cast<float>(y) + 0.5f) / 128 - 0.5f;
      disc.at(x, y)[3] = dx * dx + dy * dy < 0.16f ? 255 : 0;
    }
  const RasterSkin skin(disc, 0.5f);
  for (float repeats : {1.0f, 100.0f}) {
    TriangleMesh mesh = square(1.0f, 0.0f);
    for (Vec2& uv : mesh.uvs) uv *= repeats;
    const RasterSurface surface[] = {{&mesh, &skin}};
    EXPECT_NEAR(appearance(surface, RasterView::level(0.0f), kTwoMetres, 200).area, 0.5027f, 0.02f) << repeats;
  }
}

class Levels : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const LeafAtlas atlas = make_leaf_atlas({}, Season::summer, 1, 256);
    skins_ = {RasterSkin(plain(4, 3, {110, 95, 80, 255})), RasterSkin(atlas.base_colour, 0.35f),
              RasterSkin(make_foliage_mass(atlas, {}, 1).base_colour, 0.35f)};
  }
  static TreeInput input(const growth::Skeleton& s, std::size_t budget) {
    static const Look look;
    static const FoliageLook foliage;
    TreeInput tree{&s, s.radius, &look, &foliage, {}};
    tree.options.max_triangles = budget;
    return tree;
  }
  // Mean over eight level directions, and from above.
  static Appearance seen(std::span<const RasterSurface> surfaces, const Box3& box, bool above) {
    Appearance sum;
    for (int k = 0; k < (above ? 1 : 8); ++k) {
      const Appearance a = appearance(
          surfaces, above ? RasterView::from_above() : RasterView::level(0.25f * kPi * (static_cast<float>(k) + 0.3f)),
          box, 96);
      sum.area += a.area, sum.colour += a.area * a.colour;
    }
    if (sum.area > 0) sum.colour = sum.colour / sum.area;
    return sum;
  }
  static void alike(const Appearance& level, const Appearance& tree, double area, double colour) {
    EXPECT_NEAR(level.area / tree.area, 1.0, area);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(level.colour[c] / tree.colour[c], 1.0, colour) << "channel " << c;
  }
  static TreeSkins skins_;
};
TreeSkins Levels::skins_;

TEST_F(Levels, EveryBudgetHasAFormAndIsKept) {
  for (const growth::Skeleton& s : test_skeletons()) {
    const std::size_t n = stems(s, -1);
    for (std::size_t budget : {4u, 9u, 10u, 40u, 60u, 100u, 159u, 400u, 2000u}) {
      const TreeForm form = form_within(budget, n);
      const TreeInput tree = input(s, budget);
      std::size_t used = 0;
      if (form == TreeForm::shell) used = build_shell(tree, source_mesh(tree), skins_).triangles();
      if (form == TreeForm::mesh)
        used = build_tree_mesh(s, s.radius, *tree.look, *tree.foliage, tree.options).triangles();
      EXPECT_LE(used, budget) << n << " stems";
      EXPECT_EQ(form == TreeForm::two_cards, budget < kFourCardTriangles);
    }
  }
  EXPECT_EQ(form_within(0), TreeForm::mesh);
}

TEST_F(Levels, AShellKeepsAreaAndColour) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const growth::Skeleton s = test_skeleton({.seasons = 12}, seed);
    for (std::size_t budget : {60u, 120u}) {
      const TreeInput tree = input(s, budget);
      const TreeMesh source = source_mesh(tree), shell = build_shell(tree, source, skins_);
      const RasterSurface full[] = {{&source.branches, &skins_.bark}, {&source.leaves, &skins_.leaf}};
      const RasterSurface coarse[] = {{&shell.branches, &skins_.bark}, {&shell.leaves, &skins_.mass}};
      Box3 box = source.leaves.bounds();
      box.add(shell.leaves.bounds());
      for (const bool above : {false, true}) {
        SCOPED_TRACE(above ? "from above" : "level");
        alike(seen(coarse, box, above), seen(full, box, above), 0.09, 0.09);
      }
    }
  }
}

TEST_F(Levels, ImpostorsKeepAreaAndColourFromAllSidesAndFourCardsFromAbove) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const growth::Skeleton s = test_skeleton({.seasons = 12}, seed);
    const TreeMesh source = source_mesh(input(s, 10));
    Image atlas(256, 128, 4);
    const ImpostorBlock block{128, 0, 128};
    const ImpostorFrame frame = build_picture(source, skins_, {&atlas, block});
    const RasterSkin skin(atlas, kImpostorCutoff);
    const RasterSurface full[] = {{&source.branches, &skins_.bark}, {&source.leaves, &skins_.leaf}};
    Box3 box = source.leaves.bounds();
    for (std::size_t n : {kTwoCardTriangles, kFourCardTriangles}) {
      const TriangleMesh cards = impostor_cards(frame, block, 256, 128, n);
      EXPECT_EQ(cards.triangles(), n);
      const RasterSurface impostor[] = {{&cards, &skin, n == kFourCardTriangles}};
      alike(seen(impostor, box, false), seen(full, box, false), 0.12, 0.1);
      if (n == kFourCardTriangles) alike(seen(impostor, box, true), seen(full, box, true), 0.15, 0.1);
    }
  }
}

TEST_F(Levels, APictureKeepsToItsBlock) {
  const growth::Skeleton s = test_skeleton({.seasons = 6}, 1);
  Image atlas = plain(128, 4, {1, 2, 3, 4});
  build_picture(source_mesh(input(s, 10)), skins_, {&atlas, {64, 64, 64}});
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      if (x >= 64 && y >= 64) continue;
      ASSERT_EQ(atlas.at(x, y)[0], 1);
    }
}

TEST_F(Levels, ALoneTwigAndABareTreeHaveAllForms) {
  const growth::Skeleton s = test_skeleton({.seasons = 1, .shoot = 1, .branching = 0.0f}, 1);
  TreeInput tree = input(s, 60);
  for (const Season season : {Season::summer, Season::bare}) {
    tree.options.season = season;
    const TreeMesh source = source_mesh(tree);
    EXPECT_LE(build_shell(tree, source, skins_).triangles(), 60u);
    Image atlas(64, 64, 4);
    const ImpostorFrame frame = build_picture(source, skins_, {&atlas, {0, 0, 64}});
    const TriangleMesh cards = impostor_cards(frame, {0, 0, 64}, 64, 64, kFourCardTriangles);
    for (const Vec3& p : cards.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  }
  EXPECT_TRUE(crown_shell({}, skins_.leaf, skins_.mass, 20, 1).empty());
}

TEST_F(Levels, AStretchedPictureIsLargerInPlanAndHeight) {
  ImpostorFrame frame;
  frame.box.add(Vec3(-1, 0, -1)), frame.box.add(Vec3(1, 4, 1));
  const Box3 one = impostor_cards(frame, {}, 128, 128, kFourCardTriangles).bounds();
  const Box3 two = impostor_cards(frame, {}, 128, 128, kFourCardTriangles, {2.0f, 3.0f}).bounds();
  EXPECT_NEAR(two.size().x, 2 * one.size().x, 1e-5);
  EXPECT_NEAR(two.size().y, 3 * one.size().y, 1e-5);
}

}  // namespace
}  // namespace bosquet::geometry
