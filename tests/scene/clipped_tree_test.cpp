#include "scene/clipped_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "growth/clipped.h"
#include "growth/digest.h"
#include "scene/grown_scene.h"
#include "scene/species.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {
namespace {

using crowns::ClippedForm;
using crowns::FormKind;

GrownScene grow_clipped(const Document& document) {
  auto grown = grow_scene(document, {}, nullptr);
  EXPECT_TRUE(grown);
  return std::move(*grown);
}

/// The trees of a document with one changed.
template <class Change>
Document changed(Document document, std::size_t index, Change change) {
  std::vector<Tree> trees = document.trees->to_vector();
  change(trees[index]);
  document.trees = std::make_shared<const Trees>(std::move(trees));
  return document;
}

Document clipped_document(const std::string& species, const ClippedForm& form, float clear_stem_m) {
  return changed(sample_document(species, {{6, 6}}, {12, 12}), 0, [&](Tree& tree) {
    set_form(tree, *sample_document(species, {}, {12, 12}).species[0], form, clear_stem_m);
  });
}

struct Ordered {
  const char* species;
  ClippedForm form;
  float clear_stem_m;
};
const Ordered kOrdered[] = {
    {"european_beech", {FormKind::box, 1.0f, 0.8f, 1.8f}, 0.0f},
    {"european_beech", {FormKind::ball, 1.6f, 1.6f, 1.6f}, 0.0f},
    {"italian_cypress", {FormKind::cone, 2.0f, 2.0f, 4.0f}, 0.0f},
    {"small_leaved_lime", {FormKind::panel, 3.0f, 0.5f, 4.6f, 40.0f}, 2.2f},
    {"london_plane", {FormKind::umbrella, 5.0f, 5.0f, 4.5f}, 2.5f},
    {"norway_maple", {FormKind::ball, 2.4f, 2.4f, 4.4f}, 2.0f},
};

TEST(ClippedTree, KeepsToItsFormAndFillsIt) {
  for (const Ordered& order : kOrdered) {
    SCOPED_TRACE(order.species);
    const GrownScene scene = grow_clipped(clipped_document(order.species, order.form, order.clear_stem_m));
    const growth::Skeleton& wood = *scene.trees[0].skeleton;

    // The last internode of a twig may leave the body by its length.
    const float slack = wood.internode_length_m;
    ClippedForm wide = order.form;
    wide.width_m += 2 * slack, wide.depth_m += 2 * slack, wide.height_m += slack;
    std::size_t branches = 0, outside = 0;
    const float edge = 0.3f;
    std::set<std::tuple<int, int, int>> filled;
    for (std::size_t i = 0; i < wood.size(); ++i) {
      if (!wood.alive(i)) continue;
      const Vec3 p = wood.distal[i];
      filled.emplace(static_cast<int>(std::floor(p.x / edge)), static_cast<int>(std::floor(p.y / edge)),
                     static_cast<int>(std::floor(p.z / edge)));
      if (wood.order[i] == 0) continue;
      ++branches;
      EXPECT_GE(p.y, order.clear_stem_m);
      if (!crowns::inside(wide, std::max(0.0f, order.clear_stem_m - slack), p)) ++outside;
    }
    EXPECT_GT(branches, 300u);
    EXPECT_LE(outside, branches / 100);

    // A leafy body hides what is behind: of the cubes of 30 cm inside it, hardly any is without a twig in or beside it.
    std::size_t cubes = 0, leafy = 0;
    const int reach = static_cast<int>(6.0f / edge);
    for (int x = -reach; x < reach; ++x)
      for (int y = 0; y < reach; ++y)
        for (int z = -reach; z < reach; ++z) {
          const Vec3 middle = edge * (Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} + 0.5f);
          if (!crowns::inside(order.form, order.clear_stem_m, middle)) continue;
          ++cubes;
          bool near = false;
          for (int n = 0; n < 27 && !near; ++n)
            near = filled.count({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1}) > 0;
          leafy += near;
        }
    EXPECT_GT(cubes, 30u);
    EXPECT_GE(leafy, cubes * 95 / 100) << leafy << " of " << cubes;
  }
}

TEST(ClippedTree, IsAsHighAsItsForm) {
  for (const Ordered& order : kOrdered) {
    const Document document = clipped_document(order.species, order.form, order.clear_stem_m);
    const GrownScene scene = grow_clipped(document);
    EXPECT_FLOAT_EQ(document.mature_height_m(document.trees->front()), order.form.height_m);
    EXPECT_NEAR(scene.trees[0].measures.height_m, order.form.height_m, 0.2f + 0.1f * order.form.height_m)
        << order.species;
  }
}

TEST(ClippedTree, AnotherFormOfTheSameSizeChangesNoOtherTree) {
  std::vector<Vec2> row;
  for (int i = 0; i < 5; ++i) row.push_back({3.0f + 1.5f * static_cast<float>(i), 6.0f});
  Document ball = sample_document("european_beech", row, {12, 12}, 0.15f);
  const auto with = [&](FormKind kind) {
    return changed(ball, 2, [&](Tree& tree) { set_form(tree, *ball.species[0], {kind, 1.2f, 1.2f, 3.0f}, 0.0f); });
  };
  const GrownScene a = grow_clipped(with(FormKind::ball)), b = grow_clipped(with(FormKind::box));
  for (std::size_t i = 0; i < row.size(); ++i)
    EXPECT_EQ(growth::digest(*a.trees[i].skeleton) == growth::digest(*b.trees[i].skeleton), i != 2) << i;
}

TEST(ClippedTree, AHedgeBendsNoTreeBesideIt) {
  std::vector<Vec2> places{{10, 10}};
  for (int i = 0; i < 12; ++i) places.push_back({4.0f + static_cast<float>(i), 13.0f});
  Document document = sample_document("european_beech", places, {20, 20}, 0.25f);
  EXPECT_NE(grow_clipped(document).trees[0].asymmetry, Vec3(0.0f));
  std::vector<Tree> trees = document.trees->to_vector();
  for (std::size_t i = 1; i < trees.size(); ++i)
    set_form(trees[i], *document.species[0], {FormKind::box, 1.5f, 0.8f, 1.5f}, 0.0f);
  document.trees = std::make_shared<const Trees>(std::move(trees));
  EXPECT_EQ(grow_clipped(document).trees[0].asymmetry, Vec3(0.0f));
}

TEST(ClippedTree, ACachedSkeletonIsNotTakenForAnotherForm) {
  SkeletonCache cache;
  GrowOptions options;
  options.skeletons = &cache;
  const auto digest = [&](FormKind kind) {
    auto grown = grow_scene(clipped_document("european_beech", {kind, 1.2f, 1.2f, 2.0f}, 0.0f), options, nullptr);
    return growth::digest(*grown->trees[0].skeleton);
  };
  const std::uint64_t box = digest(FormKind::box), cone = digest(FormKind::cone);
  EXPECT_NE(box, cone);
  EXPECT_EQ(digest(FormKind::box), box);
  EXPECT_EQ(cache.size(), 2u);
}

TEST(ClippedTree, EverySpeciesCanBeClipped) {
  for (const std::string& name : builtin_species_names()) {
    const Species species = *builtin_species(name);
    for (const float room : {0.001f, 1.0f, 500.0f})
      EXPECT_TRUE(growth::check(growth::clipped(species.growth, room))) << name << " " << room;
  }
}

TEST(ClearStem, NoBranchIsLeftBelowItAndTheCrownBeginsAboveIt) {
  for (const char* species : {"small_leaved_lime", "norway_maple", "london_plane"}) {
    Document document = sample_document(species, {{15, 15}}, {30, 30}, 0.5f);
    const growth::Skeleton free = *grow_clipped(document).trees[0].skeleton;
    const growth::Skeleton wood =
        *grow_clipped(changed(document, 0, [](Tree& tree) { tree.clear_stem_m = 4.5f; })).trees[0].skeleton;
    std::size_t low = 0, branches = 0;
    for (std::size_t i = 0; i < free.size(); ++i) low += free.order[i] > 0 && free.alive(i) && free.distal[i].y < 4.5f;
    EXPECT_GT(low, 0u) << species << " has branches there when nothing is ordered";
    for (std::size_t i = 0; i < wood.size(); ++i) {
      if (wood.order[i] == 0) continue;
      ++branches;
      EXPECT_GE(wood.distal[i].y, 4.5f) << species;
      EXPECT_GE(wood.proximal(i).y, 4.5f) << species;
    }
    EXPECT_GT(branches, 200u) << species;
  }
}

TEST(TreeStatus, ATreeToBeRemovedIsNotGrownAndTakesNoRoom) {
  const std::vector<Vec2> places{{4, 6}, {6, 6}, {8, 6}};
  const Document three = changed(sample_document("silver_birch", places, {12, 12}), 1,
                                 [](Tree& tree) { tree.status = TreeStatus::to_remove; });
  Document two = three;
  std::vector<Tree> rest = three.trees->to_vector();
  rest.erase(rest.begin() + 1);
  two.trees = std::make_shared<const Trees>(rest);
  const GrownScene a = grow_clipped(three), b = grow_clipped(two);
  EXPECT_EQ(a.trees.size(), 2u);
  EXPECT_EQ(a.skeleton_digest, b.skeleton_digest);
  EXPECT_EQ(a.given.trees->size(), 3u);
  EXPECT_EQ(a.document.trees->size(), 2u);
}

}  // namespace
}  // namespace bosquet::scene
