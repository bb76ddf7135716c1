#include "exchange/recipe.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "growth/parameters.h"
#include "tests/exchange/parameter_rows.h"

namespace bosquet::exchange {
namespace {

constexpr const char* kSite = "[site]\nsize_m = [60, 40]\nseed = 3\n";

BuiltRecipe build(const std::string& text) {
  auto recipe = parse_recipe(kSite + text, "test.toml");
  EXPECT_TRUE(recipe) << recipe.error().message;
  auto built = build_document(*recipe);
  EXPECT_TRUE(built) << built.error().message;
  return std::move(*built);
}

std::string mistake_in(const std::string& text) {
  auto recipe = parse_recipe(kSite + text, "test.toml");
  return recipe ? "" : recipe.error().message;
}

TEST(Recipe, ARecipeGivesTheSameTreesEveryTimeAndOthersWithAnotherSeed) {
  const std::string text =
      "[[planting]]\nspecies = { english_oak = 1, silver_birch = 2 }\ncount = 40\nscale = [0.2, 0.4]\n";
  const auto places = [&](std::optional<std::uint64_t> seed) {
    std::vector<Vec2> at;
    auto built = build_document(*parse_recipe(kSite + text, "test.toml", seed));
    for (const scene::Tree& tree : *built->document.trees) at.push_back(tree.at);
    return at;
  };
  EXPECT_EQ(places({}), places({}));
  EXPECT_NE(places({}), places(4));
}

TEST(Recipe, ABlockThatIsAddedReshufflesNoOtherBlocksTrees) {
  const std::string row =
      "[[planting]]\nname = 'row'\nkind = 'row'\nspecies = { silver_birch = 1 }\npoints = [[5, 5], [55, 5]]\nspacing_m "
      "= 10\njitter_m = 1\n";
  const std::string more = "[[planting]]\nname = 'more'\nspecies = { english_oak = 1 }\ncount = 10\n";
  const BuiltRecipe alone = build(row), with = build(row + more);
  for (std::size_t i = 0; i < alone.document.trees->size(); ++i) {
    EXPECT_EQ((*alone.document.trees)[i].at, (*with.document.trees)[i].at);
    EXPECT_EQ((*alone.document.trees)[i].key, (*with.document.trees)[i].key);
  }
}

TEST(Recipe, EveryKindOfPlantingPlants) {
  EXPECT_EQ(
      build("[[planting]]\nspecies = { silver_birch = 1 }\ncount = 12\nscale = [0.2, 0.3]\n").document.trees->size(),
      12u);
  EXPECT_GT(
      build("[[planting]]\nkind = 'fill'\nspecies = { silver_birch = 1 }\ndensity_per_ha = 100\nscale = [0.2, 0.3]\n")
          .document.trees->size(),
      15u);
  EXPECT_GT(
      build(
          "[[planting]]\nkind = 'brush'\nspecies = { silver_birch = 1 }\npoints = [[10, 10], [50, 30]]\nradius_m = 5\n")
          .document.trees->size(),
      2u);
  EXPECT_EQ(
      build("[[planting]]\nkind = 'row'\nspecies = { english_oak = 1 }\npoints = [[5, 20], [55, 20]]\nspacing_m = 10\n")
          .document.trees->size(),
      6u);
  EXPECT_GT(build("[[planting]]\nkind = 'hedge'\nspecies = { silver_birch = 1 }\npoints = [[5, 20], [15, 20]]\nscale = "
                  "[0.05, 0.08]\n")
                .document.trees->size(),
            20u);
  EXPECT_GE(build("[[planting]]\nkind = 'grid'\nspecies = { silver_birch = 1 }\npolygon = [[0, 0], [40, 0], [40, 30], "
                  "[0, 30]]\nspacing_m = 10\nrow_gap_m = 10\n")
                .document.trees->size(),
            9u);
  const BuiltRecipe single =
      build("[[planting]]\nkind = 'single'\nspecies = { norway_spruce = 1 }\nat = [30, 20]\nscale = 0.7\n");
  ASSERT_EQ(single.document.trees->size(), 1u);
  EXPECT_EQ(single.document.trees->front().at, Vec2(30, 20));
  EXPECT_FLOAT_EQ(single.document.trees->front().scale_height, 0.7f);
}

TEST(Recipe, TreesStandOutsidePathsExclusionsAndWater) {
  const BuiltRecipe built = build(
      "[terrain]\nwater_level_m = -0.5\n[[terrain.stroke]]\nkind = 'lower'\nradius_m = 6\namount_m = 3\npoints = [[0, "
      "10], [60, 10]]\n"
      "[[terrain.path]]\npoints = [[0, 30], [60, 30]]\nwidth_m = 4\n[[terrain.exclusion]]\npolygon = [[40, 15], [60, "
      "15], [60, 25], [40, 25]]\n"
      "[[planting]]\nspecies = { silver_birch = 1 }\ncount = 150\nscale = [0.1, 0.2]\n");
  ASSERT_GT(built.document.trees->size(), 100u);
  for (const scene::Tree& tree : *built.document.trees) {
    EXPECT_FALSE(built.document.terrain->under_water(tree.at));
    EXPECT_GT(std::abs(tree.at.y - 30.0f), 1.8f);
    EXPECT_FALSE(tree.at.x > 40.3f && tree.at.y > 15.3f && tree.at.y < 24.7f);
  }
  EXPECT_LT(built.document.terrain->ground({30, 10}), -2.0f);
}

TEST(Recipe, ASpeciesCanBeChangedAndMadeFromAnother) {
  const BuiltRecipe built = build(
      "[[species]]\nname = 'street_oak'\nlike = 'english_oak'\n[species.shape]\ncrown_width_m = "
      "6\n[species.growth]\nmax_shoot_length = 3\n"
      "[[planting]]\nkind = 'single'\nspecies = { street_oak = 1 }\nat = [30, 20]\n");
  const scene::Species& species = built.document.species_of(built.document.trees->front());
  EXPECT_EQ(species.name, "street_oak");
  EXPECT_EQ(species.botanical_name, "Quercus robur");
  EXPECT_EQ(species.shape.crown_width_m, 6.0f);
  EXPECT_EQ(species.growth.max_shoot_length, 3);
}

TEST(Recipe, CamerasStandAboveTheGroundUnderThem) {
  const BuiltRecipe built = build(
      "[terrain]\nwater_level_m = 1.0\n[[terrain.stroke]]\nkind = 'raise'\nradius_m = 10\namount_m = 4\nhardness = "
      "0.9\npoints = [[30, 20]]\n"
      "[[camera]]\nname = 'hill'\neye = [30, 20, 2]\ntarget = [5, 5, 0]\n");
  const scene::Camera& camera = built.document.cameras.front();
  EXPECT_NEAR(camera.eye.y, 6.0f, 0.05f);
  EXPECT_NEAR(camera.eye.z, -20.0f, 1e-4f);
  EXPECT_NEAR(camera.target.y, 1.0f, 1e-4f);  // on the water
}

TEST(Recipe, FiguresStandOnTheSiteAndComeBackFromAWrittenRecipe) {
  const BuiltRecipe built = build("[[figure]]\nat = [12, 7.5]\n[[figure]]\nat = [3, 4]\nheading_deg = 270\n");
  ASSERT_EQ(built.document.figures.size(), 2u);
  EXPECT_EQ(built.document.figures[0], (scene::Figure{{12, 7.5f}}));
  EXPECT_EQ(built.document.figures[1], (scene::Figure{{3, 4}, 270}));
  EXPECT_NE(mistake_in("[[figure]]\nheading_deg = 3\n").find("needs at = [east, north]"), std::string::npos);
}

TEST(Recipe, LayersDivideTheHeightOfTheTallestTree) {
  const BuiltRecipe built =
      build("[space]\nlayers = 20\n[[planting]]\nkind = 'single'\nspecies = { norway_spruce = 1 }\nat = [30, 20]\n");
  EXPECT_NEAR(built.document.space.layer_m * 20.0f, built.document.mature_height_m(built.document.trees->front()),
              1e-3f);
}

TEST(Recipe, MistakesAreToldBeforeAnyWork) {
  EXPECT_EQ(mistake_in("[[planting]]\nkind = 'filll'\nspecies = { silver_birch = 1 }\ncount = 1\n")
                .rfind("test.toml:5: kind = \"filll\" is not known", 0),
            0u);
  EXPECT_NE(mistake_in("[[planting]]\nspecies = { silver_birch = 1 }\n").find("either count or density_per_ha"),
            std::string::npos);
  EXPECT_NE(mistake_in("[[planting]]\nspecies = { silver_birch = 0 }\ncount = 3\n").find("all zero"),
            std::string::npos);
  EXPECT_NE(mistake_in("[[planting]]\nkind = 'row'\nspecies = { silver_birch = 1 }\npoints = [[1, 1]]\n")
                .find("at least two points"),
            std::string::npos);
  EXPECT_NE(mistake_in("[[planting]]\nname = 'a'\nkind = 'single'\nspecies = { silver_birch = 1 }\nat = [1, "
                       "1]\n[[planting]]\nname = 'a'\nkind = 'single'\nspecies = { silver_birch = 1 }\nat = [9, 9]\n")
                .find("two plantings are named 'a'"),
            std::string::npos);
  EXPECT_NE(mistake_in("[[interaction]]\nof = 'silver_birch'\n").find("needs 'on'"), std::string::npos);
  EXPECT_NE(mistake_in("[[species]]\nname = 'new_oak'\n").find("unknown species 'new_oak'"), std::string::npos);
  EXPECT_NE(mistake_in("[[camera]]\neye = [1, 2]\n").find("eye must be a list of 3 numbers"), std::string::npos);
  EXPECT_NE(mistake_in("[[camera]]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n").find("eye and target are the same point"),
            std::string::npos);
  EXPECT_NE(mistake_in("[[camera]]\neye = [1,5, 2, 3]\n").find("not 4; decimals stand behind a point"),
            std::string::npos);
  EXPECT_NE(mistake_in("[terrain.noise]\namplitude_m = 0,6\n").find("decimals stand behind a point"),
            std::string::npos);
}

TEST(Recipe, AClippedHedgeIsOneBodyAboutItsLine) {
  const BuiltRecipe hedge = build(
      "[[planting]]\nkind = 'hedge'\nspecies = { european_beech = 1 }\npoints = [[10, 10], [20, 20]]\nform = 'box'\n"
      "form_height_m = 1.8\nclear_stem_m = 0.1\nstatus = 'existing'\n");
  ASSERT_GT(hedge.document.trees->size(), 40u);
  for (const scene::Tree& tree : *hedge.document.trees) {
    const Vec2 middle = tree.at + tree.form.centre;
    EXPECT_NEAR(middle.x, middle.y, 1e-3f) << "the body stands on the line";
    EXPECT_NEAR(tree.form.rotation_deg, 45.0f, 1e-3f);
    EXPECT_FLOAT_EQ(tree.form.depth_m, 0.9f);  // two rows 0.4 m apart and half a metre
    EXPECT_FLOAT_EQ(tree.clear_stem_m, 0.1f);
    EXPECT_EQ(tree.status, scene::TreeStatus::existing);
    EXPECT_FLOAT_EQ(hedge.document.mature_height_m(tree), 1.8f);
  }
}

TEST(Recipe, WhereATreeIsRemovedAnotherMayBePlanted) {
  const std::string old = "[[planting]]\nname = 'old'\nkind = 'single'\nspecies = { english_oak = 1 }\nat = [20, 20]\n";
  const std::string next =
      "[[planting]]\nname = 'new'\nkind = 'single'\nspecies = { silver_birch = 1 }\nat = [20, 20]\n";
  EXPECT_EQ(build(old + next).document.trees->size(), 1u);
  const BuiltRecipe cleared = build(old + "status = 'to_remove'\n" + next);
  ASSERT_EQ(cleared.document.trees->size(), 2u);
  EXPECT_EQ(cleared.document.trees->front().status, scene::TreeStatus::to_remove);
}

TEST(Recipe, MistakesInClippedFormsAreNamed) {
  const std::string single = "[[planting]]\nkind = 'single'\nspecies = { english_oak = 1 }\nat = [20, 20]\n";
  const auto says = [&](const std::string& keys, const char* words) {
    const std::string message = mistake_in(single + keys);
    EXPECT_NE(message.find(words), std::string::npos) << keys << ": " << message;
  };
  says("form = 'boxx'\n", "box");
  says("form_width_m = 2\n", "needs form");
  says("form = 'box'\nform_height_m = 2\n", "needs form_width_m");
  says("form = 'box'\nform_width_m = 2\n", "needs form_height_m");
  says("form = 'box'\nform_width_m = 2\nform_height_m = 2\nclear_stem_m = 2\n", "above its underside");
  says("form = 'ball'\nform_width_m = 2\nform_height_m = 2\nscale = 0.5\n", "leave scale out");
  says("form = 'ball'\nform_width_m = 2\nform_height_m = nan\n", "form_height_m");
  says("clear_stem_m = -1\n", "clear_stem_m");
}

TEST(Recipe, SelfThinningFillsAnAreaWithTreesOfManySizes) {
  const BuiltRecipe wood = build(
      "[[planting]]\nkind = 'thinning'\nspecies = { english_oak = 1, silver_birch = 2 }\nyears = 80\n"
      "regeneration_per_ha = 200\n");
  ASSERT_GT(wood.document.trees->size(), 10u);
  float least = 9, most = 0;
  for (const scene::Tree& tree : *wood.document.trees)
    least = std::min(least, tree.scale_height), most = std::max(most, tree.scale_height);
  EXPECT_LT(least, 0.5f * most);
  EXPECT_GE(least, 0.1f);
  const BuiltRecipe young = build(
      "[[planting]]\nkind = 'thinning'\nspecies = { english_oak = 1 }\nyears = 1\n"
      "[[planting]]\nkind = 'single'\nspecies = { english_oak = 1 }\nat = [20, 20]\n");
  ASSERT_FALSE(young.warnings.empty());
  EXPECT_NE(young.warnings[0].find("reached least_scale = 0.1 in 1 years"), std::string::npos) << young.warnings[0];
  EXPECT_NE(mistake_in("[[planting]]\nkind = 'thinning'\nspecies = { english_oak = 1 }\nseedlings_per_ha = -1\n")
                .find("seedlings_per_ha"),
            std::string::npos);
}

// docs/recipe.md shows every described key with its unit, range, default and meaning, word for word.
TEST(RecipeDocumentation, ListsEveryParameterAsTheCodeDeclaresIt) {
  std::ifstream in(std::string(BOSQUET_SOURCE_DIR) + "/docs/recipe.md");
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.insert(line);
  ParameterRows rows;
  const auto add = [&](const auto& defaults) { describe(defaults, rows); };
  add(terrain::PerlinNoise{});
  add(terrain::Stroke{});
  add(distribution::Interaction{});
  add(TreeOrder{});
  add(distribution::ThinningRules{});
  add(distribution::PlantBrush{});
  add(distribution::RowRules{});
  add(distribution::GridRules{});
  add(crowns::RepresentativeShape{});
  add(distribution::PlantingRules{});
  add(growth::Parameters{});
  add(geometry::Look{});
  add(geometry::FoliageLook{});
  add(scene::Allometry{});
  add(scene::OpenGrownSize{});
  add(crowns::SpaceOptions{});
  add(crowns::AsymmetryOptions{});
  add(crowns::LightOptions{});
  add(scene::ClearanceRules{});
  add(scene::PlanSettings{});
  add(scene::Underlay{});
  add(scene::GroundCover{});
  EXPECT_GT(rows.rows.size(), 100u);
  for (const std::string& row : rows.rows) EXPECT_TRUE(lines.count(row)) << "docs/recipe.md lacks: " << row;
}

}  // namespace
}  // namespace bosquet::exchange
