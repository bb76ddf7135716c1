#include "crowns/update_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/parallel.h"
#include "stands.h"
#include "terrain/brush.h"
#include "terrain/difference.h"

namespace bosquet::crowns {
namespace {

// A place in a space, or what a space holds where it keeps nothing.
struct Reader {
  const CrownSpace& space;
  const SpaceTile* tile = nullptr;

  std::int32_t owner(std::int32_t layer, std::size_t c) const {
    if (!tile || !tile->has(layer)) return kFree;
    const std::int32_t held = tile->owner[tile->offset(layer) + c];
    return held < 0 ? held : space.claimants()[static_cast<std::size_t>(space.claimant_of(held))].id;
  }
  std::uint64_t tick(std::int32_t layer, std::size_t c) const {
    return tile && tile->has(layer) && !tile->ticks.empty() ? tile->ticks[tile->offset(layer) + c] : 0;
  }
};

// The first voxel in which two spaces differ, in words; empty when there is none.
std::string difference(const CrownSpace& a, const CrownSpace& b) {
  std::set<std::pair<int, int>> tiles;
  for (const CrownSpace* s : {&a, &b})
    for (const auto& t : s->tiles()) tiles.insert({t->tile.y, t->tile.x});
  for (const auto& [n, e] : tiles) {
    const Reader left{a, a.find_tile({e, n})}, right{b, b.find_tile({e, n})};
    std::int32_t low = 1 << 20, high = -(1 << 20);
    for (const SpaceTile* t : {left.tile, right.tile})
      if (t) low = std::min(low, t->first_layer), high = std::max(high, t->first_layer + t->layers);
    for (std::int32_t k = low; k < high; ++k)
      for (std::size_t c = 0; c < static_cast<std::size_t>(kTileColumns); ++c)
        if (left.owner(k, c) != right.owner(k, c) || left.tick(k, c) != right.tick(k, c))
          return "voxel (" + std::to_string(e * 64 + static_cast<int>(c % 64)) + ", " + std::to_string(k) + ", " +
                 std::to_string(n * 64 + static_cast<int>(c / 64)) + "): owner " + std::to_string(left.owner(k, c)) +
                 " at " + std::to_string(left.tick(k, c)) + ", in whole " + std::to_string(right.owner(k, c)) + " at " +
                 std::to_string(right.tick(k, c));
  }
  if (a.claimed_voxels() != b.claimed_voxels()) return "numbers of claimed voxels";
  for (std::size_t t = 0; t < a.claimants().size(); ++t)
    if (!std::ranges::equal(a.shares(t), b.shares(t))) return "shares of tree " + std::to_string(a.claimants()[t].id);
  return {};
}

// A stand that is edited at random: trees come, go, move, grow; buildings and hero trees come, go and move.
class Play {
 public:
  Play(std::uint64_t seed, bool hilly, bool standing, SpaceOptions options)
      : draw_(seed, 1, Purpose::statistics), may_stand_(standing), options_(options) {
    terrain_ =
        ground(kSide, [hilly](Vec2 p) { return hilly ? 0.3f * p.x + 0.02f * (p.y - 10.0f) * (p.y - 10.0f) : 0.0f; });
    for (int n = 0; n < 25; ++n) add_tree();
  }

  /// The ground is raised, lowered or smoothed somewhere; what stands on it goes along.
  void reshape() {
    terrain::Stroke stroke;
    constexpr terrain::BrushKind kKinds[] = {terrain::BrushKind::raise, terrain::BrushKind::lower,
                                             terrain::BrushKind::smooth};
    stroke.kind = kKinds[draw_.below(3)];
    stroke.points = {anywhere(), anywhere()};
    stroke.radius_m = draw_.uniform(0.5f, 6.0f);
    stroke.amount_m = draw_.uniform(0.1f, 4.0f);
    terrain_ = terrain::apply(terrain_, stroke);
    for (Claimant& t : trees_) t.ground_y = terrain_.ground(t.base);
  }

  void edit() {
    const std::uint32_t kind = draw_.below(may_stand_ ? 14 : 10);
    if (kind == 0 || trees_.size() < 3) return add_tree();
    const std::size_t which = draw_.below(static_cast<std::uint32_t>(trees_.size()));
    Claimant& t = trees_[which];
    if (kind == 1) {
      trees_.erase(trees_.begin() + static_cast<std::ptrdiff_t>(which));
    } else if (kind <= 4) {
      place(t, t.base + Vec2{draw_.uniform(-1.5f, 1.5f), draw_.uniform(-1.5f, 1.5f)});
    } else if (kind == 5) {
      place(t, anywhere());
    } else if (kind == 6) {
      place(t, trees_[draw_.below(static_cast<std::uint32_t>(trees_.size()))].base);  // two in one place
    } else if (kind <= 8) {
      t.scale_width = draw_.uniform(0.4f, 1.4f);
    } else if (kind == 9) {
      t.scale_height = draw_.uniform(0.4f, 1.4f);
    } else if (kind <= 11) {
      edit_building();
    } else {
      edit_hero();
    }
  }

  std::vector<Claimant> trees_;
  Standing standing_;
  terrain::Terrain terrain_;

 private:
  static constexpr float kSide = 20.0f;

  Vec2 anywhere() { return {draw_.uniform(0.0f, kSide), draw_.uniform(0.0f, kSide)}; }
  void place(Claimant& t, Vec2 at) {
    t.base = glm::clamp(at, Vec2{0.0f}, Vec2{kSide});
    t.ground_y = terrain_.ground(t.base);
  }
  void add_tree() {
    Claimant t = tree(++last_id_, {}, 5.0f, 8.0f);
    t.scale_width = draw_.uniform(0.4f, 1.4f), t.scale_height = draw_.uniform(0.4f, 1.4f);
    place(t, anywhere());
    trees_.insert(trees_.begin() + draw_.below(static_cast<std::uint32_t>(trees_.size() + 1)), t);
  }
  void edit_building() {
    if (standing_.obstacles.size() > 2) {
      standing_.obstacles.erase(standing_.obstacles.begin() + draw_.below(3));
      return;
    }
    const Vec2 low = anywhere() - 3.0f, size{draw_.uniform(0.5f, 6.0f), draw_.uniform(0.5f, 6.0f)};
    const float bottom = draw_.uniform(-1.0f, 4.0f), top = bottom + draw_.uniform(1.0f, 9.0f);
    standing_.obstacles.push_back(building(--last_standing_, low, low + size, bottom, top, options_.voxel()));
  }
  void edit_hero() {
    if (standing_.heroes.size() > 1) {
      standing_.heroes.erase(standing_.heroes.begin());
      return;
    }
    const Vec2 at = anywhere();
    std::vector<Segment> wood;
    for (int n = 0; n < 12; ++n) {
      const float y = terrain_.ground(at) + draw_.uniform(0.0f, 9.0f);
      const Vec2 tip = at + Vec2{draw_.uniform(-4.0f, 4.0f), draw_.uniform(-4.0f, 4.0f)};
      wood.push_back({to_world(at, y), to_world(tip, y + draw_.uniform(0.0f, 3.0f)), draw_.uniform(0.02f, 0.5f)});
    }
    standing_.heroes.push_back(
        {--last_standing_, "hero", std::make_shared<const std::vector<Segment>>(std::move(wood))});
  }

  RandomStream draw_;
  bool may_stand_;
  SpaceOptions options_;
  std::int32_t last_id_ = 0, last_standing_ = 0;
};

void play(std::uint64_t seed, bool hilly, bool standing, SpaceOptions options, int edits, int reshape_every = 0) {
  options.keep_ticks = true;
  Play play(seed, hilly, standing, options);
  CrownSpace space = *divide_space(play.trees_, play.standing_, play.terrain_, options);
  AsymmetryOptions lean;
  lean.slope_weight = reshape_every ? 1.0f : 0.0f;
  std::vector<Vec3> v = neighbourhood_asymmetry(space, lean, &play.terrain_);
  for (int n = 0; n < edits; ++n) {
    const terrain::Terrain ground = play.terrain_;
    Reshaped reshaped;
    if (reshape_every && n % reshape_every == 0) {
      play.reshape();
      reshaped = {&ground, terrain::reshaped(ground.height, play.terrain_.height)};
    }
    if (!reshape_every || n % 3) play.edit();
    auto update = update_space(space, play.trees_, play.standing_, play.terrain_, options, reshaped);
    ASSERT_TRUE(update) << update.error().message;
    ASSERT_FALSE(update->whole);
    const CrownSpace whole = *divide_space(play.trees_, play.standing_, play.terrain_, options);
    ASSERT_EQ(difference(update->space, whole), "") << "seed " << seed << ", edit " << n;

    // The trees named are those with other voxels, and whoever was edited.
    for (std::size_t t = 0; t < play.trees_.size(); ++t) {
      const auto old = std::find_if(space.claimants().begin(), space.claimants().end(),
                                    [&](const Claimant& c) { return c.id == play.trees_[t].id; });
      const bool named = std::binary_search(update->changed.begin(), update->changed.end(), t);
      if (old == space.claimants().end() || !(*old == play.trees_[t])) {
        ASSERT_TRUE(named);
        continue;
      }
      const CrownRegion was = region(space, static_cast<std::size_t>(old - space.claimants().begin())),
                        is = region(whole, t);
      ASSERT_EQ(named, was.low != is.low || was.cells != is.cells || was.bits != is.bits)
          << "seed " << seed << ", edit " << n << ", tree " << play.trees_[t].id;
    }
    std::vector<std::size_t> leaning;
    const auto updated = update_asymmetry(space, v, *update, lean, &play.terrain_, &leaning);
    ASSERT_EQ(updated, neighbourhood_asymmetry(whole, lean, &play.terrain_)) << "seed " << seed << ", edit " << n;
    v = updated;
    space = std::move(update->space);
  }
}

SpaceOptions coarse(float voxel_m = 0.5f) {
  SpaceOptions o;
  o.voxel_m = voxel_m;
  return o;
}

TEST(SpaceUpdate, AfterEachOfManyEditsEveryVoxelIsAsInAWholeDivision) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) play(seed, false, false, coarse(), 100);
}

TEST(SpaceUpdate, OnSlopesToo) {
  for (std::uint64_t seed = 11; seed <= 12; ++seed) play(seed, true, false, coarse(), 100);
}

TEST(SpaceUpdate, WithBuildingsAndHeroTreesThatComeAndGoToo) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) play(seed, false, true, coarse(), 80);
  for (std::uint64_t seed = 31; seed <= 32; ++seed) play(seed, true, true, coarse(), 80);
}

TEST(SpaceUpdate, WithoutLimitOfReachToo) {
  SpaceOptions o = unlimited(0.4f, 2.0f);
  play(41, true, true, o, 40);
  o.speed_exponent = 0.5f;
  o.overhang_m = 3;
  play(42, false, true, o, 40);
}

TEST(SpaceUpdate, WhereTheGroundIsReshapedToo) {
  for (std::uint64_t seed = 51; seed <= 52; ++seed) play(seed, seed % 2, seed > 51, coarse(), 30, 1);
  // Over four tiles and what overhangs them.
  play(61, true, true, coarse(0.25f), 6, 2);
  play(62, false, false, unlimited(0.4f, 2.0f), 8, 1);
}

TEST(SpaceUpdate, ReshapedGroundTouchesOnlyTheTilesAroundIt) {
  const auto trees = [](const terrain::Terrain& on) {
    auto all = clustered(5, 400, 100.0f, 10.0f, 10.0f, 4.0f);
    for (Claimant& t : all) t.ground_y = on.ground(t.base);
    return all;
  };
  const terrain::Terrain before = flat(100);
  const CrownSpace space = *divide_space(trees(before), before, SpaceOptions{});
  terrain::Stroke stroke;
  stroke.points = {{30, 30}}, stroke.radius_m = 4, stroke.amount_m = 1.5f;
  const terrain::Terrain after = terrain::apply(before, stroke);
  const auto update = *update_space(space, trees(after), {}, after, SpaceOptions{},
                                    {&before, terrain::reshaped(before.height, after.height)});
  EXPECT_FALSE(update.whole);
  EXPECT_EQ(difference(update.space, *divide_space(trees(after), after, SpaceOptions{})), "");
  EXPECT_GT(update.changed.size(), 1u);
  EXPECT_LT(update.changed.size(), 60u);
}

TEST(SpaceUpdate, ItIsTheSameForAnyNumberOfThreads) {
  auto trees = clustered(5, 60, 40.0f, 7.0f, 12.0f, 4.0f);
  const auto terrain = flat(40);
  const CrownSpace space = *divide_space(trees, terrain, SpaceOptions{});
  trees[10].base += 1.5f;
  const auto expected = *update_space(space, trees, {}, terrain, SpaceOptions{});
  for (int threads : {1, 2, 8})
    run_with_threads(threads, [&] {
      const auto got = *update_space(space, trees, {}, terrain, SpaceOptions{});
      EXPECT_EQ(difference(got.space, expected.space), "");
      EXPECT_EQ(got.changed, expected.changed);
    });
}

TEST(SpaceUpdate, TilesThatNothingChangedInAreShared) {
  auto trees = clustered(5, 400, 100.0f, 10.0f, 10.0f, 4.0f);
  const auto terrain = flat(100);
  const CrownSpace space = *divide_space(trees, terrain, SpaceOptions{});
  trees[7].base += 0.8f;
  const auto update = *update_space(space, trees, {}, terrain, SpaceOptions{});
  EXPECT_GT(update.changed.size(), 1u);
  EXPECT_LT(update.changed.size(), 60u);
  std::size_t copied = 0;
  for (const auto& tile : update.space.tiles()) copied += tile.get() != space.find_tile(tile->tile);
  EXPECT_GT(copied, 0u);
  EXPECT_LT(copied, 10u);
}

// On a steep slope a tree is added whose neighbour keeps it out of the tile below; then the neighbour goes, and what hangs
// below the tree's base in that tile is its own, though the tree itself was not edited any more.
TEST(SpaceUpdate, ATreeThatIsLetIntoALowerTileHangsThere) {
  SpaceOptions options;
  options.voxel_m = 0.5f;
  const terrain::Terrain slope = ground(64.0f, [](Vec2 p) { return p.x; });
  Claimant large = tree(1, {31.5f, 16.0f}, 5.0f, 8.0f), upper = tree(2, {33.0f, 16.0f}, 5.0f, 8.0f);
  large.scale_height = large.scale_width = 1.3f;
  for (Claimant* t : {&large, &upper}) t->ground_y = slope.ground(t->base);
  const auto first = divide_space(std::vector{large}, slope, options);
  ASSERT_TRUE(first);
  const auto both = update_space(*first, std::vector{large, upper}, {}, slope, options);
  ASSERT_TRUE(both);
  const auto alone = update_space(both->space, std::vector{upper}, {}, slope, options);
  ASSERT_TRUE(alone);
  ASSERT_FALSE(both->whole || alone->whole);
  const auto whole = divide_space(std::vector{upper}, slope, options);
  ASSERT_TRUE(whole);
  EXPECT_EQ(difference(alone->space, *whole), "");
}

TEST(SpaceUpdate, ManyTreesMayComeGoAndMoveAtOnce) {
  const auto all = clustered(9, 60, 30.0f, 6.0f, 9.0f, 4.0f);
  const auto terrain = flat(30);
  RandomStream random(9, 2, Purpose::statistics);
  std::vector<Claimant> trees(all.begin(), all.begin() + 20);
  CrownSpace space = *divide_space(trees, terrain, coarse());
  for (int edit = 0; edit < 30; ++edit) {
    trees.clear();
    for (Claimant t : all) {
      if (random.below(2)) continue;
      if (random.below(6) == 0) t.base += Vec2{random.uniform(-1, 1), random.uniform(-1, 1)};
      trees.push_back(t);
    }
    auto update = update_space(space, trees, {}, terrain, coarse());
    ASSERT_TRUE(update);
    EXPECT_FALSE(update->whole);
    ASSERT_EQ(difference(update->space, *divide_space(trees, terrain, coarse())), "") << edit;
    space = std::move(update->space);
  }
}

TEST(SpaceUpdate, WithoutAnEditNothingChanges) {
  const auto trees = clustered(5, 60, 40.0f, 7.0f, 12.0f, 4.0f);
  const auto terrain = flat(40);
  const CrownSpace space = *divide_space(trees, terrain, SpaceOptions{});
  const auto update = *update_space(space, trees, {}, terrain, SpaceOptions{});
  EXPECT_TRUE(update.changed.empty());
  for (const auto& tile : update.space.tiles()) EXPECT_EQ(tile.get(), space.find_tile(tile->tile));
}

TEST(SpaceUpdate, OtherOptionsDivideAllAnew) {
  const auto trees = clustered(5, 20, 30.0f, 7.0f, 12.0f, 4.0f);
  const auto terrain = flat(30);
  const CrownSpace space = *divide_space(trees, terrain, SpaceOptions{});
  const auto update = *update_space(space, trees, {}, terrain, coarse());
  EXPECT_TRUE(update.whole);
  EXPECT_EQ(update.changed.size(), trees.size());
  EXPECT_EQ(difference(update.space, *divide_space(trees, terrain, coarse())), "");
}

}  // namespace
}  // namespace bosquet::crowns
