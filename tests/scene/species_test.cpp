#include "scene/species.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "growth/parameters.h"
#include "scene/document.h"
#include "scene/species_names.h"

namespace bosquet::scene {
namespace {

std::vector<std::shared_ptr<const Species>> every_species() {
  std::vector<std::shared_ptr<const Species>> all;
  for (const std::string& name : builtin_species_names()) {
    auto species = builtin_species(name);
    EXPECT_TRUE(species) << species.error().message;
    all.push_back(std::make_shared<const Species>(*species));
  }
  return all;
}

std::string matched(std::string_view name, NameMatch* how = nullptr) {
  const auto all = every_species();
  const SpeciesMatch match = match_species(name, all, 0);
  if (how) *how = match.how;
  return all[match.species]->name;
}

TEST(Species, EveryBuiltInFileIsReadAndChecked) {
  const auto all = every_species();
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
  const auto meant = [](const char* name) {
    const std::string message = builtin_species(name).error().message;
    const std::size_t at = message.find("did you mean '");
    return at == std::string::npos ? "" : message.substr(at + 14, message.find("'?", at) - at - 14);
  };
  EXPECT_EQ(meant("oak"), "english_oak");
  EXPECT_EQ(meant("birch"), "silver_birch");
  EXPECT_EQ(meant("Fagus sylvatica"), "european_beech");
  EXPECT_EQ(meant("silver_brich"), "silver_birch");
  EXPECT_EQ(meant("concrete"), "");
  auto species = builtin_species("english_oka");
  ASSERT_FALSE(species);
  EXPECT_NE(species.error().message.find("did you mean 'english_oak'?"), std::string::npos);
  EXPECT_NE(species.error().message.find("weeping_willow"), std::string::npos);
}

/// What reading a species file of these lines (after `name = "x"`) says; the file's name is left out.
std::string refusal(const std::string& lines) {
  const auto path = std::filesystem::temp_directory_path() / ("bosquet_species_test_" + std::to_string(getpid()));
  std::ofstream(path) << "name = \"x\"\n" << lines;
  const Result<Species> read = read_species_file(path);
  std::filesystem::remove(path);
  if (read) return "accepted";
  const std::string& message = read.error().message;
  EXPECT_EQ(message.find(path.string()), 0u) << "the file is named first: " << message;
  return message.substr(std::min(message.size(), path.string().size() + 1));
}

TEST(Species, AMistakeInTheFileNamesLineKeyAndWhatIsAllowed) {
  EXPECT_EQ(refusal("[growth]\nbranching_angle_deg = 130\n"),
            "3: branching_angle_deg = 130 is out of range; allowed: 10 to 120 deg");
  EXPECT_EQ(refusal("[growth]\nstraightness = nan\n"), "3: straightness = nan is out of range; allowed: 0 to 1");
  EXPECT_EQ(refusal("[growth]\n\nspace = -inf\n"), "4: space = -inf is out of range; allowed: 0 to 1");
  EXPECT_EQ(refusal("[growth]\nmax_shoot_length = 3.5\n"),
            "3: max_shoot_length must be a whole number from 2 to 12, not 3.5");
  EXPECT_EQ(refusal("[growth]\nbole = \"high\"\n"), "3: bole must be a number from 0 to 0.5, not a text");
  EXPECT_EQ(refusal("[growth]\nstraightnes = 0.5\n"), "3: unknown key 'straightnes'; did you mean 'straightness'?");
  EXPECT_EQ(refusal("[growth]\nphyllotaxis = \"spirl\"\n"),
            "3: phyllotaxis = \"spirl\" is not known; allowed: spiral, distichous, decussate, whorled");
  EXPECT_EQ(refusal("[growht]\n"), "2: unknown key 'growht'; did you mean 'growth'?");
  EXPECT_EQ(refusal("[growth]\nstraightness =\n").substr(0, 2), "3:") << "a value that is missing";
  EXPECT_EQ(refusal("[shape]\nmature_height_m = 20\ntrunk_height_m = 30\n"),
            "4: trunk_height_m = 30 must be below mature_height_m = 20");
}

TEST(Species, AMistakeInAnOrderOrPhaseIsToldAtItsLine) {
  EXPECT_EQ(refusal("[[growth.order]]\nset_point_angle_deg = 200\n"),
            "3: set_point_angle_deg = 200 is out of range; allowed: 0 to 180 deg");
  EXPECT_EQ(refusal("[[growth.phase]]\nfrom = 0.5\nspace = nan\n"), "4: space = nan is out of range; allowed: 0 to 1");
  EXPECT_EQ(refusal("[[growth.phase]]\nfrom = 0.5\n[[growth.phase]]\nfrom = 0.2\n"),
            "5: [growth]: phase 2 begins at 0.2, before phase 1 at 0.5");
  EXPECT_EQ(refusal("[[growth.phase]]\nfrom_order = 5\nto_order = 2\n"),
            "3: [growth]: phase 1 changes no axes: from_order = 5 is above to_order = 2");
  EXPECT_EQ(refusal("[[growth.phase]]\n[[growth.phase]]\n[[growth.phase]]\n[[growth.phase]]\n[[growth.phase]]\n"),
            "6: [growth]: 5 phases, allowed are at most 4");
}

TEST(Species, NumbersThatDoNotFitTogetherAreToldAtTheTableThatBrokeThem) {
  EXPECT_EQ(refusal("[growth]\nbole = 0.1\nstraightness = 0.25\n"),
            "4: [growth], order 0: straightness 0.25 + tropism 0.2 + space 0.3 = 0.75, the sum must be 1");
  EXPECT_EQ(refusal("[growth]\n[[growth.order]]\nfrom = 2\nstraightness = 0.25\n"),
            "5: [growth], order 2: straightness 0.25 + tropism 0.2 + space 0.3 = 0.75, the sum must be 1");
  EXPECT_EQ(refusal("[growth]\ngravimorphism_vertical = 0.5\ngravimorphism_offset = 0.6\n"),
            "4: [growth], order 0: gravimorphism_offset = 0.6 puts the axis outside the bud ellipse, allowed is less "
            "than gravimorphism_vertical = 0.5 either way");
  for (const char* pair : {"leaf_outline = \"needle_spray\"\ntwig_form = \"tuft\"\n",
                           "leaf_outline = \"palmate\"\ntwig_form = \"spray\"\n",
                           "leaf_outline = \"scale_cord\"\ntwig_form = \"opposite\"\n",
                           "leaf_outline = \"cordate\"\ntwig_form = \"brush\"\n"})
    EXPECT_EQ(refusal(std::string("[look]\n") + pair),
              "4: leaf_outline = \"needle_spray\" or \"scale_cord\" and twig_form = \"spray\" or \"brush\" go only "
              "together");
  EXPECT_EQ(
      refusal("[growth]\n[[growth.phase]]\nfrom = 0.4\nfrom_order = 1\ngravimorphism_offset = -1\n"),
      "6: [growth], order 1, phase 1: gravimorphism_offset = -1 puts the axis outside the bud ellipse, allowed is "
      "less than gravimorphism_vertical = 1 either way");
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
  auto all = every_species();
  auto street = *builtin_species("english_oak");
  street.name = "street_oak", street.derived = true;
  all.insert(all.begin(), std::make_shared<const Species>(street));
  EXPECT_EQ(all[match_species("Quercus robur", all, 0).species]->name, "english_oak");
  EXPECT_EQ(all[match_species("blackoak", all, 0).species]->name, "english_oak");
  EXPECT_EQ(all[match_species("street oak", all, 1).species]->name, "street_oak");
}

}  // namespace
}  // namespace bosquet::scene
