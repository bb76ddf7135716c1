#include "scene/species.h"

#include <gtest/gtest.h>

#include "growth/parameters.h"
#include "scene/document.h"
#include "scene/species_names.h"

namespace bosquet::scene {
namespace {

std::vector<std::shared_ptr<const Species>> builtins() {
  std::vector<std::shared_ptr<const Species>> all;
  for (const std::string& name : builtin_species_names()) {
    auto species = builtin_species(name);
    EXPECT_TRUE(species) << species.error().message;
    all.push_back(std::make_shared<const Species>(*species));
  }
  return all;
}

std::string matched(std::string_view name, NameMatch* how = nullptr) {
  const auto all = builtins();
  const SpeciesMatch match = match_species(name, all, 0);
  if (how) *how = match.how;
  return all[match.species]->name;
}

TEST(Species, EveryBuiltInFileIsReadAndChecked) {
  const auto all = builtins();
  ASSERT_GE(all.size(), 4u);
  for (const auto& s : all) {
    EXPECT_FALSE(s->botanical_name.empty()) << s->name;
    EXPECT_FALSE(s->common_names.empty()) << s->name;
    EXPECT_FALSE(s->genus_words.empty()) << s->name;
    EXPECT_TRUE(growth::check(s->growth, s->name));
    EXPECT_LT(s->shape.trunk_height_m, s->shape.mature_height_m);
    EXPECT_LT(s->shape.trunk_width_m, s->shape.crown_width_m);
  }
}

TEST(Species, AnUnknownNameListsTheKnownOnes) {
  auto species = builtin_species("english_oka");
  ASSERT_FALSE(species);
  EXPECT_NE(species.error().message.find("did you mean 'english_oak'?"), std::string::npos);
  EXPECT_NE(species.error().message.find("weeping_willow"), std::string::npos);
}

TEST(Species, MeasuredSizesSetTheScalesAndMissingOnesFollowAllometry) {
  const Species oak = *builtin_species("english_oak");
  Tree tree;
  set_measured_size(tree, oak, 0.5f * oak.shape.mature_height_m, {}, {});
  EXPECT_FLOAT_EQ(tree.scale_height, 0.5f);
  EXPECT_FLOAT_EQ(tree.scale_width, 0.5f);
  set_measured_size(tree, oak, {}, {}, 0.6f * oak.shape.crown_width_m);
  EXPECT_FLOAT_EQ(tree.scale_height, 0.6f);
  set_measured_size(tree, oak, {}, 0.40f, {});
  // D = 40 cm: H = 1.23 * 40^.623, C = .672 * 40^.733
  EXPECT_NEAR(tree.scale_height * oak.shape.mature_height_m, 12.25f, 0.05f);
  EXPECT_NEAR(tree.scale_width * oak.shape.crown_width_m, 10.04f, 0.05f);
  EXPECT_EQ(tree.trunk_diameter_m, 0.40f);
  set_measured_size(tree, oak, 1000.0f, {}, {});
  EXPECT_FLOAT_EQ(tree.scale_height, 2.0f);
}

TEST(SpeciesNames, AnExactNameIsFoundInAnyCaseAndPunctuation) {
  NameMatch how{};
  for (const char* name : {"english_oak", "English Oak", "Quercus robur", "QUERCUS_ROBUR", "pedunculate-oak"}) {
    EXPECT_EQ(matched(name, &how), "english_oak") << name;
    EXPECT_EQ(how, NameMatch::exact) << name;
  }
}

TEST(SpeciesNames, AnUnknownSpeciesFallsBackToGenusThenLeafTypeThenDefault) {
  NameMatch how{};
  EXPECT_EQ(matched("blackoak", &how), "english_oak");
  EXPECT_EQ(how, NameMatch::genus);
  EXPECT_EQ(matched("Betula papyrifera", &how), "silver_birch");
  EXPECT_EQ(how, NameMatch::genus);
  EXPECT_EQ(matched("Douglas fir", &how), "norway_spruce");
  EXPECT_EQ(how, NameMatch::leaf_type);
  EXPECT_EQ(matched("Alpine currant", &how), builtin_species_names().front());
  EXPECT_EQ(how, NameMatch::fallback);
  EXPECT_EQ(matched("hickory", &how), builtin_species_names().front());
  EXPECT_EQ(how, NameMatch::fallback);
  matched("", &how);
  EXPECT_EQ(how, NameMatch::fallback);
}

TEST(SpeciesNames, ASpeciesMadeFromAnotherIsMeantOnlyByItsOwnName) {
  auto all = builtins();
  auto street = *builtin_species("english_oak");
  street.name = "street_oak", street.derived = true;
  all.insert(all.begin(), std::make_shared<const Species>(street));
  EXPECT_EQ(all[match_species("Quercus robur", all, 0).species]->name, "english_oak");
  EXPECT_EQ(all[match_species("blackoak", all, 0).species]->name, "english_oak");
  EXPECT_EQ(all[match_species("street oak", all, 1).species]->name, "street_oak");
}

}  // namespace
}  // namespace bosquet::scene
