#include "scene/species_names.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/letters.h"
#include "core/random.h"
#include "scene/common_names.h"

namespace bosquet::scene {
namespace {

const std::vector<std::shared_ptr<const Species>>& builtins() {
  static const auto all = [] {
    std::vector<std::shared_ptr<const Species>> species;
    for (const std::string& name : builtin_species_names())
      species.push_back(std::make_shared<const Species>(*builtin_species(name)));
    return species;
  }();
  return all;
}

struct Meant {
  std::string species;
  NameMatch how;
  float width;
};
Meant meant(std::string_view name) {
  const SpeciesMatch match = match_species(name, builtins(), 0);
  return {builtins()[match.species]->name, match.how, match.width};
}

TEST(CommonNames, EverySpeciesHasNamesInThreeLanguagesAndNoNameMeansTwo) {
  Synonyms all;
  for (const auto& species : builtins()) {
    const auto names = common_names();
    const auto own =
        std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.species == species->name; });
    ASSERT_NE(own, names.end()) << species->name;
    EXPECT_FALSE(own->compounds.empty() || own->words.empty()) << species->name;
    for (std::size_t at = 0; at < own->names.size();) {
      const std::size_t end = std::min(own->names.find(';', at), own->names.size());
      const auto name = own->names.substr(at, end - at);
      EXPECT_TRUE(all.add(name, species->name)) << name;
      EXPECT_EQ(folded_words(name), name) << "is not folded";
      EXPECT_EQ(meant(name).species, species->name) << name;
      at = end + 1;
    }
  }
}

TEST(SpeciesNames, CommonNamesInEnglishGermanAndFrenchMeanTheSpecies) {
  const std::pair<const char*, const char*> names[]{{"Stieleiche", "english_oak"},
                                                    {"Ch\xc3\xaane p\xc3\xa9"
                                                     "doncul\xc3\xa9",
                                                     "english_oak"},
                                                    {"H\xc3\xa4nge-Birke", "silver_birch"},
                                                    {"Bouleau verruqueux", "silver_birch"},
                                                    {"Rotfichte", "norway_spruce"},
                                                    {"\xc3\x89pic\xc3\xa9"
                                                     "a commun",
                                                     "norway_spruce"},
                                                    {"Waldkiefer", "scots_pine"},
                                                    {"Pin sylvestre", "scots_pine"},
                                                    {"Rotbuche", "european_beech"},
                                                    {"H\xc3\xaatre commun", "european_beech"},
                                                    {"Trauerweide", "weeping_willow"},
                                                    {"Saule pleureur", "weeping_willow"},
                                                    {"Pyramidenpappel", "lombardy_poplar"},
                                                    {"Peuplier d'Italie", "lombardy_poplar"},
                                                    {"Spitzahorn", "norway_maple"},
                                                    {"\xc3\x89rable plane", "norway_maple"},
                                                    {"Winterlinde", "small_leaved_lime"},
                                                    {"Tilleul \xc3\xa0 petites feuilles", "small_leaved_lime"},
                                                    {"Vogelkirsche", "wild_cherry"},
                                                    {"Merisier", "wild_cherry"},
                                                    {"Ahornbl\xc3\xa4ttrige Platane", "london_plane"},
                                                    {"Platane commun", "london_plane"},
                                                    {"Feldulme", "field_elm"},
                                                    {"Orme champ\xc3\xaatre", "field_elm"},
                                                    {"S\xc3\xa4ulenzypresse", "italian_cypress"},
                                                    {"Cypr\xc3\xa8s d'Italie", "italian_cypress"},
                                                    {"\xc3\x96lbaum", "olive"},
                                                    {"Olivier", "olive"},
                                                    {"Vogelbeere", "rowan"},
                                                    {"Sorbier des oiseleurs", "rowan"},
                                                    {"Haselnuss", "common_hazel"},
                                                    {"Noisetier", "common_hazel"},
                                                    {"Platanus \xc3\x97 acerifolia", "london_plane"},
                                                    {"Platanus acerifolia", "london_plane"},
                                                    {"Salix alba 'Tristis'", "weeping_willow"},
                                                    {"Populus nigra 'Italica'", "lombardy_poplar"}};
  for (const auto& [name, species] : names) {
    EXPECT_EQ(meant(name).species, species) << name;
    EXPECT_EQ(meant(name).how, NameMatch::exact) << name;
  }
}

TEST(SpeciesNames, ACultivarIsItsSpeciesAndNarrowOnesClaimLessWidth) {
  for (const char* name :
       {"Quercus robur 'Fastigiata'", "Quercus robur Fastigiate Koster", "Stieleiche 'Fastigiata'"}) {
    EXPECT_EQ(meant(name).species, "english_oak") << name;
    EXPECT_EQ(meant(name).how, NameMatch::species) << name;
    EXPECT_EQ(meant(name).width, kColumnarWidth) << name;
  }
  EXPECT_EQ(meant("Acer platanoides 'Columnare'").width, kColumnarWidth);
  EXPECT_EQ(meant("Fagus sylvatica 'Dawyck Purple'").width, kColumnarWidth);
  for (const char* name : {"Acer platanoides 'Globosum'", "Acer platanoides L.", "Acer platanoides cv. Crimson King",
                           "Spitz-Ahorn, Kugelform"}) {
    EXPECT_EQ(meant(name).species, "norway_maple") << name;
    EXPECT_EQ(meant(name).how, NameMatch::species) << name;
    EXPECT_EQ(meant(name).width, 1.0f) << name;
  }
  EXPECT_EQ(meant("Tilia cordata 'Greenspire'").species, "small_leaved_lime");
  // Columns by nature are as wide as they are.
  EXPECT_EQ(meant("Cupressus sempervirens 'Fastigiata'").species, "italian_cypress");
  EXPECT_EQ(meant("Cupressus sempervirens 'Fastigiata'").width, 1.0f);
}

TEST(SpeciesNames, AnotherSpeciesOfAGenusIsReportedAsSuch) {
  const std::pair<const char*, const char*> names[]{{"Quercus petraea", "english_oak"},
                                                    {"Traubeneiche", "english_oak"},
                                                    {"pin oak", "english_oak"},
                                                    {"Bergahorn", "norway_maple"},
                                                    {"\xc3\x89rable sycomore", "norway_maple"},
                                                    {"Sommerlinde", "small_leaved_lime"},
                                                    {"Pinus nigra", "scots_pine"},
                                                    {"Schwarzkiefer", "scots_pine"},
                                                    {"Pin noir", "scots_pine"},
                                                    {"Populus nigra", "lombardy_poplar"},
                                                    {"black poplar", "lombardy_poplar"},
                                                    {"Silber-Weide", "weeping_willow"},
                                                    {"Baumhasel", "common_hazel"},
                                                    {"Tilia x europaea", "small_leaved_lime"}};
  for (const auto& [name, species] : names) {
    EXPECT_EQ(meant(name).species, species) << name;
    EXPECT_EQ(meant(name).how, NameMatch::genus) << name;
  }
}

TEST(SpeciesNames, NamesThatOnlySoundLikeAGenusAreNot) {
  for (const char* name :
       {"Hainbuche",
        "Wei\xc3\x9f"
        "buche",
        "Carpinus betulus 'Fastigiata'", "Hornbeam", "Kornelkirsche", "\xc3\x96lweide", "tulip poplar", "Russian olive",
        "witch hazel", "Ginkgo", "Robinie", "Ro\xc3\x9fkastanie", "Eschen-?", "???"}) {
    EXPECT_EQ(meant(name).how, NameMatch::fallback) << name;
    EXPECT_EQ(meant(name).width, 1.0f) << name;
  }
  for (const char* name : {"Bald cypress", "Sumpfzypresse", "Taxodium distichum", "Wei\xc3\x9ftanne", "Abies alba",
                           "Sapin pectin\xc3\xa9", "Europ\xc3\xa4ische L\xc3\xa4rche"}) {
    EXPECT_EQ(meant(name).how, NameMatch::leaf_type) << name;
    EXPECT_EQ(meant(name).species, "norway_spruce") << name;
  }
}

TEST(SpeciesNames, OwnSynonymsComeFirstWhateverTheirSpelling) {
  Synonyms own;
  EXPECT_TRUE(
      own.add("Gro\xc3\x9f"
              "er Baum",
              "olive"));
  EXPECT_TRUE(own.add("oak", "rowan"));
  EXPECT_TRUE(own.add("OAK", "rowan"));
  EXPECT_FALSE(own.add("Oak!", "olive"));
  EXPECT_FALSE(own.add("--", "olive"));
  const auto match = [&](std::string_view name) {
    return builtins()[match_species(name, builtins(), 0, &own).species]->name;
  };
  EXPECT_EQ(match("GROSSER-BAUM"), "olive");
  EXPECT_EQ(match("Oak"), "rowan");
  EXPECT_EQ(match("Quercus robur"), "english_oak");
}

TEST(SpeciesNames, AnyBytesAreMatchedToSomething) {
  RandomStream stream(8, 9, Purpose::statistics);
  for (int i = 0; i < 500; ++i) {
    std::string text;
    for (std::uint32_t n = stream.below(30); n > 0; --n) text += static_cast<char>(stream.below(256));
    EXPECT_LT(match_species(text, builtins(), 3).species, builtins().size());
  }
}

}  // namespace
}  // namespace bosquet::scene
