#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>

#include "terrain/brush.h"
#include "terrain/difference.h"
#include "terrain/perlin.h"

namespace bosquet::terrain {
namespace {

Terrain rough(Vec2 size_m) {
  Terrain site = make_terrain(with_noise(Heightfield(*make_lattice(size_m)), PerlinNoise{2.0f, 6.0f, 4}, 5));
  return exclude(site, {{{5, 5}, {40, 9}, {22, 30}}, {}}, {"lawn", AreaKind::lawn, Cover::grass});
}

bool same_bits(const Terrain& a, const Terrain& b) {
  const IVec2 n = a.height.cells();
  for (int j = 0; j <= n.y; ++j)
    for (int i = 0; i <= n.x; ++i) {
      const float p = a.height.sample(i, j), q = b.height.sample(i, j);
      if (std::memcmp(&p, &q, sizeof p) != 0) return false;
    }
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i)
      if (a.exclusion.grid().at(i, j) != b.exclusion.grid().at(i, j) ||
          a.density.grid().at(i, j) != b.density.grid().at(i, j) || a.areas.cell(i, j) != b.areas.cell(i, j))
        return false;
  return a.areas.all() == b.areas.all();
}

// A window feeds a stroke event by event; a recipe has it whole.
RC_GTEST_PROP(LiveStroke, IsTheWholeStrokeToTheBitHoweverItsPointsCame, ()) {
  const Terrain before = rough({48, 40});
  Stroke stroke;
  stroke.kind = static_cast<BrushKind>(*rc::gen::inRange(0, 8));
  stroke.radius_m = static_cast<float>(*rc::gen::inRange(5, 90)) * 0.1f;
  stroke.strength = 0.7f;
  stroke.hardness = static_cast<float>(*rc::gen::inRange(0, 10)) * 0.1f;
  stroke.area = {"walk", AreaKind::path, Cover::gravel};
  const int count = *rc::gen::inRange(1, 9);
  for (int n = 0; n < count; ++n)
    stroke.points.push_back(0.1f * Vec2{*rc::gen::inRange(-60, 540), *rc::gen::inRange(-60, 460)});
  const Terrain whole = apply(before, stroke);

  Stroke brush = stroke;
  brush.points.clear();
  LiveStroke live(before, brush);
  Box2 touched;
  for (std::size_t n = 0; n < stroke.points.size();) {
    const std::size_t some =
        std::min<std::size_t>(stroke.points.size() - n, static_cast<std::size_t>(*rc::gen::inRange(1, 4)));
    const Terrain shown = live.terrain();  // a window keeps what it draws
    touched.add(live.extend(std::span(stroke.points).subspan(n, some)));
    n += some;
    Stroke so_far = brush;
    so_far.points.assign(stroke.points.begin(), stroke.points.begin() + static_cast<std::ptrdiff_t>(n));
    RC_ASSERT(same_bits(live.terrain(), apply(before, so_far)));
  }
  RC_ASSERT(same_bits(live.terrain(), whole));
  RC_ASSERT(same_bits(live.before(), before));
  RC_ASSERT(live.stroke().points == stroke.points);
}

// The last piece comes nearer to two samples at the rim, where it weighs a rounding less than the one before it.
TEST(LiveStroke, APieceThatOnlyBrushesTheRimLeavesTheSamplesOfTheWholeStroke) {
  const Terrain before = rough({48, 40});
  Stroke stroke;
  stroke.kind = BrushKind::raise;
  stroke.radius_m = 7.3f, stroke.strength = 0.7f, stroke.hardness = 0.0f;
  stroke.points = {0.1f * Vec2{-60, 160}};
  LiveStroke live(before, stroke);
  for (const Vec2 point : {0.1f * Vec2{261, 70}, 0.1f * Vec2{-60, -60}}) {
    live.extend({&point, 1});
    stroke.points.push_back(point);
    EXPECT_TRUE(same_bits(live.terrain(), apply(before, stroke)));
  }
}

// Whoever redraws or replants only the rectangle misses nothing.
RC_GTEST_PROP(Edit, BeyondTheTouchedRectangleEveryAnswerIsAsBefore, ()) {
  const Terrain before = rough({40, 40});
  Stroke stroke;
  stroke.kind = static_cast<BrushKind>(*rc::gen::inRange(0, 8));
  stroke.radius_m = static_cast<float>(*rc::gen::inRange(2, 60)) * 0.1f;
  stroke.hardness = 0.9f;
  for (int n = *rc::gen::inRange(1, 4); n > 0; --n)
    stroke.points.push_back(0.1f * Vec2{*rc::gen::inRange(-100, 500), *rc::gen::inRange(-100, 500)});
  const Edit done = edit(before, stroke);
  for (float y = 0.05f; y < 40; y += 0.43f)
    for (float x = 0.05f; x < 40; x += 0.43f) {
      const Vec2 p{x, y};
      if (done.touched.contains(p)) continue;
      RC_ASSERT(done.terrain.ground(p) == before.ground(p));
      RC_ASSERT(done.terrain.height.gradient(p) == before.height.gradient(p));
      RC_ASSERT(done.terrain.exclusion.at(p) == before.exclusion.at(p));
      RC_ASSERT(done.terrain.density.at(p) == before.density.at(p));
      const Area *now = done.terrain.area_at(p), *was = before.area_at(p);
      const bool same_area = now && was ? *now == *was : !now && !was;
      RC_ASSERT(same_area);
    }
}

TEST(Edit, AStrokeBesideTheSiteTouchesNothing) {
  const Terrain before = rough({40, 40});
  const Edit done = edit(before, {.points = {{-50, -50}}});
  EXPECT_TRUE(done.touched.empty());
  EXPECT_TRUE(difference(before, done.terrain).none());
  EXPECT_TRUE(edit(before, {.points = {}}).touched.empty());
}

// What undo has to keep of a step is what the step wrote: the tiles around the stroke, whatever the site's size.
TEST(Edit, AStepKeepsTheTilesAroundItsStrokeWhateverTheSitesSize) {
  for (const float side : {300.0f, 1000.0f}) {
    const Terrain before = make_terrain(Heightfield(*make_lattice({side, side}), [](Vec2 p) { return 0.01f * p.x; }));
    for (const BrushKind kind : {BrushKind::raise, BrushKind::smooth, BrushKind::exclude, BrushKind::density}) {
      const Stroke stroke{.kind = kind, .points = {{200, 200}, {212, 216}}, .radius_m = 5};  // 20 m
      const Difference d = difference(before, edit(before, stroke).terrain);
      EXPECT_GE(d.tiles(), 1u);
      EXPECT_LE(d.tiles(), 4u) << side << ' ' << static_cast<int>(kind);  // 22 x 26 m of tiles of 32 m
    }
  }
}

TEST(Difference, ListsTheTilesThatWereWrittenAndNoOthers) {
  const Terrain before = make_terrain(Heightfield(*make_lattice({320, 320})));  // 10 x 10 tiles and a sample
  EXPECT_TRUE(difference(before, before).none());
  Terrain after = apply(before, {.kind = BrushKind::raise, .points = {{48, 80}}, .radius_m = 5});
  Difference d = difference(before, after);
  EXPECT_EQ(d.height, (std::vector<IVec2>{{1, 2}}));
  EXPECT_TRUE(d.exclusion.empty() && d.density.empty() && d.areas.empty() && !d.area_table);
  EXPECT_TRUE(d.where.contains({43, 75}) && d.where.contains({53, 85}));
  EXPECT_LT(d.where.size().x, 40.0f);

  after = apply(after, {.kind = BrushKind::exclude, .points = {{170, 80}}, .radius_m = 5, .area = {.name = "walk"}});
  d = difference(before, after);
  EXPECT_EQ(d.exclusion, (std::vector<IVec2>{{5, 2}}));
  EXPECT_TRUE(d.area_table);
  // The way back lists the same tiles.
  EXPECT_EQ(difference(after, before).height, d.height);
  EXPECT_EQ(difference(after, before).exclusion, d.exclusion);
  // Another extent is another site.
  EXPECT_EQ(difference(make_terrain(Heightfield(*make_lattice({32, 32}))), before).height.size(), 11u * 11u);
}

}  // namespace
}  // namespace bosquet::terrain
