// Species: everything the stages need to know of one kind of tree, from one readable file.
//
// Files     scene/species/NAME.toml, one table a stage: [shape] [planting] [growth] [look] [allometry], and [[size]] rows
//           that the grown trees are held to; built into the program. A recipe may override any key or bring files of
//           its own.
// Units     as each stage describes its table
// Source    sizes, ages, leaves and bark: the botanical figures cited in each file
// Errors    file, line, key and what is allowed
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "crowns/representative_shape.h"
#include "distribution/species.h"
#include "geometry/foliage.h"
#include "geometry/look.h"
#include "growth/parameters.h"
#include "scene/toml_table.h"

namespace bosquet::scene {

/// Open-grown size from trunk diameter D (cm at 1.3 m): H = height_factor * D^height_power, C = crown_factor *
/// D^crown_power.
struct Allometry {
  float height_factor = 1.2f, height_power = 0.65f;
  float crown_factor = 0.7f, crown_power = 0.7f;

  float height_m(float trunk_diameter_m) const { return height_factor * pow(100.0f * trunk_diameter_m, height_power); }
  float crown_m(float trunk_diameter_m) const { return crown_factor * pow(100.0f * trunk_diameter_m, crown_power); }
};

template <class Parameters, class Visitor>
requires std::same_as<std::remove_const_t<Parameters>, Allometry>
void describe(Parameters& p, Visitor& visit) {
  visit(Real{"height_factor", "m", 0.1, 10, "Height of a tree with a trunk of 1 cm in H = a D^b"}, p.height_factor);
  visit(Real{"height_power", "", 0.1, 1.5, "Power b in H = a D^b"}, p.height_power);
  visit(Real{"crown_factor", "m", 0.05, 10, "Crown diameter of a tree with a trunk of 1 cm in C = A D^B"},
        p.crown_factor);
  visit(Real{"crown_power", "", 0.1, 1.5, "Power B in C = A D^B"}, p.crown_power);
}

/// What an open-grown tree measures at an age: a row of the tables that growth is tuned to (scene/calibration.h).
struct OpenGrownSize {
  float age_years = 100.0f;
  float height_m = 20.0f;
  float crown_m = 10.0f;
  float trunk_cm = 50.0f;
  float widest_point = 0.0f;  ///< 0: not told
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, OpenGrownSize>
void describe(P& p, Visitor& visit) {
  visit(Real{"age_years", "years", 1, 1000, "Age from seed"}, p.age_years);
  visit(Real{"height_m", "m", 0.1, 120, "Height of an open-grown tree at this age"}, p.height_m);
  visit(Real{"crown_m", "m", 0.05, 60, "Its crown diameter"}, p.crown_m);
  visit(Real{"trunk_cm", "cm", 0.1, 500, "Its trunk diameter at 1.3 m"}, p.trunk_cm);
  visit(Real{"widest_point", "", 0, 1,
             "Where its crown is widest, as a share of the crown's length from below; 0: not told"},
        p.widest_point);
}

struct Species {
  std::string name;  ///< lower case with underscores; the name in recipes
  std::string botanical_name;
  std::vector<std::string> common_names;
  std::vector<std::string> genus_words;  ///< an unknown name with a word that ends in one of these means this species
  bool derived = false;                  ///< made from another in a recipe: an inventory means it only by its own name
  crowns::RepresentativeShape shape;
  distribution::PlantingRules planting;
  growth::Parameters growth;
  geometry::Look look;
  geometry::FoliageLook foliage;
  Allometry allometry;
  std::vector<OpenGrownSize> sizes;  ///< in order of age; may be empty
};

/// Reads the keys that `table` gives over what `species` already says: a species file, or overrides in a recipe.
void read_species_tables(TomlTable& table, Species& species);

/// A species from a file of its own, checked.
Result<Species> read_species_file(const std::filesystem::path& path);

/// Names of the species built into the program, in alphabetical order.
std::vector<std::string> builtin_species_names();

/// The text of a built-in species' file; empty when there is none of that name.
std::string_view builtin_species_text(std::string_view name);

/// A built-in species by name; an unknown name is an error that lists the known ones.
Result<Species> builtin_species(std::string_view name);

}  // namespace bosquet::scene
