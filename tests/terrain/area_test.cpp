#include "terrain/area.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "terrain/brush.h"
#include "terrain/curve.h"

namespace bosquet::terrain {
namespace {

TEST(Curve, PassesThroughItsPointsInSmallStepsThatNeverTurnSharply) {
  const std::vector<Vec2> corners{{0, 4}, {10, 0}, {22, 6}, {20, 20}, {2, 18}};
  for (const bool closed : {false, true}) {
    const std::vector<Vec2> curve = curve_through(corners, closed);
    for (const Vec2& corner : corners) EXPECT_NE(std::find(curve.begin(), curve.end(), corner), curve.end());
    const std::size_t n = curve.size();
    for (std::size_t i = 0; i + (closed ? 0 : 2) < n; ++i) {
      const Vec2 a = curve[(i + 1) % n] - curve[i], b = curve[(i + 2) % n] - curve[(i + 1) % n];
      EXPECT_LT(glm::length(a), 0.75f);
      EXPECT_GT(glm::dot(glm::normalize(a), glm::normalize(b)), 0.85f) << i;  // 32 degrees
    }
  }
}

TEST(Curve, ALineThatEndsWhereItBeganIsRoundThereToo) {
  const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
  const std::vector<Vec2> curve = curve_through(square, false);
  EXPECT_EQ(curve.front(), curve.back());
  const Vec2 leaving = curve[1] - curve[0], arriving = curve.back() - curve[curve.size() - 2];
  EXPECT_GT(glm::dot(glm::normalize(leaving), glm::normalize(arriving)), 0.98f);
  EXPECT_EQ(curve_through({{0, 0}, {3, 4}}, false).size(), 2u);
  EXPECT_EQ(curve_through({{1, 1}, {1, 1}, {1, 1}}, true).size(), 3u);
}

const Area kLawn{"great lawn", AreaKind::lawn, Cover::grass};
const Area kPath{"lime walk", AreaKind::path, Cover::gravel};
const Area kSquare{"square", AreaKind::other, Cover::paving};

Terrain flat_site(Vec2 size_m) { return make_terrain(Heightfield(*make_lattice(size_m))); }

Polygon rectangle(Vec2 low, Vec2 high) { return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}}; }

float share(const Terrain& site, Vec2 plan, Cover cover) { return site.covers(plan)[static_cast<std::size_t>(cover)]; }

std::string name_at(const Terrain& site, Vec2 plan) {
  const Area* area = site.area_at(plan);
  return area ? area->name : "-";
}

TEST(Areas, EachPlaceBelongsToTheAreaThatBarsIt) {
  Terrain site = exclude(flat_site({60, 40}), rectangle({10, 5}, {50, 35}), kLawn);
  site = exclude_path(site, std::vector<Vec2>{{0, 20}, {60, 20}}, 4.0f, kPath);
  site = exclude(site, rectangle({25, 25}, {30, 30}), kSquare);
  EXPECT_EQ(name_at(site, {5, 30}), "-");
  EXPECT_EQ(name_at(site, {15, 30}), "great lawn");
  EXPECT_EQ(name_at(site, {15, 20}), "lime walk");
  EXPECT_EQ(name_at(site, {5, 20}), "lime walk");
  EXPECT_EQ(name_at(site, {27, 27}), "square");
  EXPECT_EQ(site.area_at({15, 30})->kind, AreaKind::lawn);
  EXPECT_EQ(site.areas.count(), 4u);
}

TEST(Areas, AnExclusionOfWhichNobodySaidWhatItIsHasNoName) {
  Terrain site = exclude(flat_site({40, 40}), rectangle({10, 10}, {30, 30}));
  ASSERT_TRUE(site.area_at({20, 20}));
  EXPECT_EQ(site.area_at({20, 20})->name, "");
  EXPECT_TRUE(site.areas.empty());
  EXPECT_EQ(share(site, {20, 20}, Cover::gravel), 1.0f);
  // Nor does it take the name of what it lies on.
  site = exclude(exclude(flat_site({40, 40}), rectangle({0, 0}, {40, 40}), kLawn), rectangle({10, 10}, {30, 30}));
  EXPECT_EQ(name_at(site, {20, 20}), "");
  EXPECT_EQ(name_at(site, {5, 5}), "great lawn");
}

TEST(Areas, CoversTogetherAreTheExclusion) {
  Terrain site = exclude(flat_site({40, 40}), rectangle({4.3f, 5.1f}, {30.2f, 33.7f}), kLawn);
  site = exclude_path(site, std::vector<Vec2>{{0, 3}, {20, 22}, {40, 18}}, 2.6f, kPath);
  site = apply(site, {.kind = BrushKind::exclude, .points = {{25, 10}}, .radius_m = 6, .area = kSquare});
  site = apply(site, {.kind = BrushKind::include, .points = {{12, 28}, {18, 20}}, .radius_m = 3});
  for (float y = 0.13f; y < 40; y += 0.29f)
    for (float x = 0.13f; x < 40; x += 0.29f) {
      float sum = 0;
      for (float s : site.covers({x, y})) sum += s;
      ASSERT_NEAR(sum, site.exclusion.at({x, y}), 1e-5f) << x << ' ' << y;
      ASSERT_EQ(site.area_at({x, y}) != nullptr, site.excluded({x, y}));
    }
}

TEST(Areas, APathAcrossALawnIsAsWideAsItIsSaidAndHasAFineEdge) {
  const Vec2 from{5, 8}, to{55, 32};
  Terrain site = exclude(flat_site({60, 40}), rectangle({0, 0}, {60, 40}), kLawn);
  site = exclude_path(site, std::vector<Vec2>{from, to}, 3.0f, kPath);
  const Vec2 along = glm::normalize(to - from), across{-along.y, along.x};
  double gravel = 0, cut = 0, area_width = 0;
  int lines = 0;
  for (float t = 10; t < 40; t += 0.37f, ++lines)
    for (float s = -5; s < 5; s += 0.02f) {
      const Vec2 p = from + t * along + s * across;
      const float g = share(site, p, Cover::gravel), l = share(site, p, Cover::grass);
      EXPECT_NEAR(g + l, 1.0f, 1e-5f);
      gravel += 0.02 * static_cast<double>(g);
      area_width += name_at(site, p) == "lime walk" ? 0.02 : 0.0;
      if (std::abs(std::abs(s) - 1.5f) > 0.75f) cut += (g >= 0.5f) != (std::abs(s) < 1.5f);
    }
  EXPECT_NEAR(gravel / lines, 3.0, 0.05);
  EXPECT_NEAR(area_width / lines, 3.0, 0.05);
  EXPECT_EQ(cut, 0);
}

TEST(Areas, IncludingFreesAPlaceOfItsArea) {
  Terrain site = exclude(flat_site({40, 40}), rectangle({0, 0}, {40, 40}), kLawn);
  site = apply(site, {.kind = BrushKind::include, .points = {{20, 20}}, .radius_m = 6});
  EXPECT_EQ(name_at(site, {20, 20}), "-");
  EXPECT_EQ(name_at(site, {30, 30}), "great lawn");
  // What is barred there next belongs to the new area alone.
  site = apply(site, {.kind = BrushKind::exclude, .points = {{20, 20}}, .radius_m = 4, .area = kSquare});
  EXPECT_EQ(name_at(site, {20, 20}), "square");
  EXPECT_EQ(share(site, {20, 20}, Cover::grass), 0.0f);
}

TEST(Areas, PaintingAnAreaTwiceIsPaintingItOnce) {
  const Terrain lawn = exclude(flat_site({40, 40}), rectangle({3, 3}, {37, 30}), kLawn);
  const Stroke stroke{.kind = BrushKind::exclude, .points = {{5, 8}, {35, 33}}, .radius_m = 2.3f, .area = kPath};
  const Terrain once = apply(lawn, stroke), twice = apply(once, stroke);
  EXPECT_EQ(once.areas.count(), twice.areas.count());
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i) {
      ASSERT_EQ(once.areas.cell(i, j), twice.areas.cell(i, j));
      ASSERT_EQ(once.exclusion.cell(i, j), twice.exclusion.cell(i, j));
    }
}

// Turning the site by a quarter turns every answer with it.
RC_GTEST_PROP(Areas, DoNotDependOnTheSitesDirection, ()) {
  const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-20, 340)) * 0.1f; };
  Terrain a = flat_site({32, 32}), b = a;
  const Area kinds[3] = {kLawn, kPath, kSquare};
  for (int n = 0; n < 4; ++n) {
    const Vec2 p{coordinate(), coordinate()}, q{coordinate(), coordinate()};
    const Stroke stroke{.kind = BrushKind::exclude, .points = {p, q}, .radius_m = 2, .area = kinds[n % 3]};
    Stroke turned = stroke;
    for (Vec2& v : turned.points) v = {32 - v.y, v.x};
    a = apply(a, stroke), b = apply(b, turned);
  }
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      RC_ASSERT(std::abs(a.exclusion.cell(i, j) - b.exclusion.cell(63 - j, i)) < 1.01f / 255);
      const AreaCell u = a.areas.cell(i, j), v = b.areas.cell(63 - j, i);
      RC_ASSERT(std::abs(u.cover - v.cover) <= 1);
      if (a.exclusion.cell(i, j) > 0.02f) RC_ASSERT(u.top == v.top);
    }
}

TEST(Areas, OutsideABoundaryIsItsComplement) {
  const Polygon boundary{{{5, 5}, {35, 8}, {20, 36}}, {}};
  const Area outside{"outside", AreaKind::other, Cover::natural};
  const Terrain in = exclude(flat_site({40, 40}), boundary),
                out = exclude_outside(flat_site({40, 40}), boundary, outside);
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i) ASSERT_NEAR(in.exclusion.cell(i, j) + out.exclusion.cell(i, j), 1.0f, 0.003f);
  EXPECT_EQ(name_at(out, {2, 2}), "outside");
  EXPECT_EQ(share(out, {2, 2}, Cover::natural), 1.0f);
}

}  // namespace
}  // namespace bosquet::terrain
