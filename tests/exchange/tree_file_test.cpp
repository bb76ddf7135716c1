#include "exchange/tree_file.h"

#include <gtest/gtest.h>

#include "crowns/crown_space.h"
#include "exchange/recipe.h"
#include "growth/digest.h"
#include "growth/grow.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

SavedTree small_tree() {
  growth::Parameters parameters;
  growth::GrowthInput input;
  input.parameters = &parameters;
  input.max_height_m = 6.0f;
  input.key = 0xfedcba9876543210u;
  return {"silver_birch", 18'000'000'000'000'000'001u, input.key, 0.3f, 0.4f, growth::grow(input)};
}

TEST(TreeFile, ATreeReadBackHasTheSameBits) {
  const ScratchFolder folder;
  const SavedTree tree = small_tree();
  ASSERT_TRUE(write_tree(tree, {}, folder / "a.tree.json"));
  const auto back = read_tree(folder / "a.tree.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(growth::digest(back->skeleton), growth::digest(tree.skeleton));
  EXPECT_EQ(back->skeleton.light, tree.skeleton.light);
  EXPECT_EQ(back->skeleton.vigor, tree.skeleton.vigor);
  EXPECT_EQ(back->skeleton.pipe_exponent, tree.skeleton.pipe_exponent);
  EXPECT_EQ(back->key, tree.key);
  EXPECT_EQ(back->seed, tree.seed);
  EXPECT_EQ(back->species, "silver_birch");
}

TEST(TreeFile, WhatIsNoTreeIsRefused) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_tree(small_tree(), {}, folder / "good.tree.json"));
  const std::string good = slurp(folder / "good.tree.json");
  const auto refusal = [&](const std::string& text) {
    spit(folder / "x.tree.json", text);
    const auto read = read_tree(folder / "x.tree.json");
    return read ? std::string("read") : read.error().message;
  };
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return refusal(text.replace(at, what.size(), by));
  };
  ASSERT_EQ(refusal(good), "read");
  EXPECT_NE(refusal("").find("no tree that bosquet saved"), std::string::npos);
  EXPECT_NE(refusal("{}").find("no tree that bosquet saved"), std::string::npos);
  EXPECT_NE(refusal(std::string(200'000, '[')).find("cannot read"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("cannot read"), std::string::npos);
  EXPECT_NE(with("\"bosquet_tree\":1", "\"bosquet_tree\":2").find("format"), std::string::npos);
  EXPECT_NE(with("\"parent\":[-1,0", "\"parent\":[-1,7").find("skeleton.parent"), std::string::npos);
  EXPECT_NE(with("\"radius\":[", "\"radius\":[null,").find("skeleton.radius"), std::string::npos);
  EXPECT_NE(with("\"distal\":[", "\"distal\":[1e30,0,0,").find("skeleton.distal"), std::string::npos);
  EXPECT_NE(with("\"order\":[0", "\"order\":[300").find("skeleton.order"), std::string::npos);
}

TEST(RecipeHero, AHeroStandsTurnedAndScaledAndClaimsVoxels) {
  const ScratchFolder folder;
  const SavedTree tree = small_tree();
  ASSERT_TRUE(write_tree(tree, {}, folder / "old.tree.json"));
  const std::string text =
      "[site]\nsize_m = [30, 30]\n"
      "[[obstacle]]\npolygon = [[1, 1], [5, 1], [5, 4]]\n"
      "[[hero]]\nname = 'old one'\nfile = 'old.tree.json'\nat = [12, 15]\nscale = 2\nrotation_deg = 90\n"
      "[[planting]]\nkind = 'single'\nspecies = { english_oak = 1 }\nat = [15, 15]\nscale = 0.3\n";
  const auto recipe = parse_recipe(text, folder / "test.toml");
  ASSERT_TRUE(recipe) << recipe.error().message;
  const auto built = build_document(*recipe);
  ASSERT_TRUE(built) << built.error().message;
  ASSERT_EQ(built->document.heroes.size(), 1u);
  const scene::HeroTree& hero = built->document.heroes[0];
  EXPECT_EQ(hero.id, -2);
  EXPECT_EQ(built->document.species[hero.species]->name, "silver_birch");
  for (std::size_t i = 0; i < tree.skeleton.size(); i += 7) {
    // Turned to the left, what pointed east points north.
    const Vec3 p = tree.skeleton.distal[i];
    EXPECT_LT(glm::distance(hero.skeleton->distal[i], 2.0f * Vec3(p.z, p.y, -p.x)), 1e-4f);
    EXPECT_EQ(hero.skeleton->radius[i], 2.0f * tree.skeleton.radius[i]);
  }
  const auto grown = scene::grow_scene(built->document, {}, nullptr);
  ASSERT_TRUE(grown) << grown.error().message;
  EXPECT_EQ(grown->space.id({48, 1, 60}), -2);
  EXPECT_EQ(grown->trees.size(), 1u);
}

}  // namespace
}  // namespace bosquet::exchange
