#include "scene/species.h"

#include <fmt/format.h>

#include "scene/builtin_species.h"
#include "scene/species_names.h"

namespace bosquet::scene {
namespace {

Result<Species> finish_species(const TomlFile& file, Species species, const std::string& source) {
  if (auto read = file.check(); !read) return read.error();
  if (species.name.empty()) return Error{fmt::format("{}: the key 'name' is missing", source)};
  if (auto fine = growth::check(species.growth, fmt::format("{}: [growth]", source)); !fine) return fine.error();
  return species;
}

Result<Species> species_from(const TomlFile& file, const std::string& source) {
  Species species;
  TomlTable root = file.root();
  species.name = root.text("name").value_or("");
  species.botanical_name = root.text("botanical_name").value_or("");
  species.common_names = root.texts("common_names").value_or(std::vector<std::string>{});
  species.genus_words = root.texts("genus_words").value_or(std::vector<std::string>{});
  read_species_tables(root, species);
  root.finish();
  return finish_species(file, std::move(species), source);
}

// A row must be whole: a size that is left out has no default.
std::vector<OpenGrownSize> read_sizes(std::vector<TomlTable> tables) {
  std::vector<OpenGrownSize> sizes;
  for (TomlTable& t : tables) {
    OpenGrownSize size;
    describe(size, t);
    t.finish();
    for (const char* key : {"age_years", "height_m", "crown_m", "trunk_cm"})
      if (!t.has(key)) t.error("", fmt::format("this [[size]] lacks '{}'", key));
    if (!sizes.empty() && !(size.age_years > sizes.back().age_years))
      t.error("age_years", fmt::format("age_years = {:g} must be above that of the [[size]] before it, {:g}",
                                       size.age_years, sizes.back().age_years));
    sizes.push_back(size);
  }
  return sizes;
}

// What the numbers of [growth] promise each other is told at the table and key that broke it.
void check_growth(TomlTable& table, const growth::Parameters& parameters) {
  const auto mistake = growth::find_mistake(parameters, "[growth]");
  if (!mistake) return;
  if (!mistake->table.empty()) {
    std::vector<TomlTable> rows = table.tables(mistake->table);
    if (mistake->index < rows.size()) return rows[mistake->index].error(mistake->key, mistake->message);
  }
  table.error(mistake->key, mistake->message);
}

// "oak" is no misspelling of any name, but an inventory that says so means a species.
std::string meant_species(std::string_view name, const std::vector<std::string>& known) {
  std::vector<std::shared_ptr<const Species>> species;
  for (const std::string& each : known)
    if (auto read = builtin_species(each)) species.push_back(std::make_shared<const Species>(std::move(*read)));
  const SpeciesMatch meant = match_species(name, species, 0);
  return meant.how == NameMatch::fallback || meant.how == NameMatch::leaf_type ? nearest_name(name, known)
                                                                               : species[meant.species]->name;
}

}  // namespace

void read_species_tables(TomlTable& table, Species& species) {
  if (auto t = table.table("shape")) {
    describe(species.shape, *t), t->finish();
    if (species.shape.trunk_height_m >= species.shape.mature_height_m)
      t->error("trunk_height_m", fmt::format("trunk_height_m = {:g} must be below mature_height_m = {:g}",
                                             species.shape.trunk_height_m, species.shape.mature_height_m));
  }
  if (auto t = table.table("planting")) describe(species.planting, *t), t->finish();
  if (auto t = table.table("growth")) describe(species.growth, *t), t->finish(), check_growth(*t, species.growth);
  if (auto t = table.table("look")) {
    describe(species.look, *t), geometry::describe_foliage(species.foliage, *t), t->finish();
    const geometry::LeafLook& leaf = species.look.leaf;
    if (geometry::is_needle(leaf.outline) != geometry::bears_needles(leaf.cluster))
      t->error(t->has("twig_form") ? "twig_form" : "leaf_outline",
               "leaf_outline = \"needle_spray\" or \"scale_cord\" and twig_form = \"spray\" or \"brush\" go only "
               "together");
  }
  if (auto t = table.table("allometry")) describe(species.allometry, *t), t->finish();
  if (auto sizes = read_sizes(table.tables("size")); !sizes.empty()) species.sizes = std::move(sizes);
}

Result<Species> read_species_file(const std::filesystem::path& path) {
  auto file = TomlFile::read(path);
  if (!file) return file.error();
  return species_from(*file, path.string());
}

std::vector<std::string> builtin_species_names() {
  std::vector<std::string> names;
  for (const BuiltinFile& file : kBuiltinSpecies) names.emplace_back(file.name);
  return names;
}

std::string_view builtin_species_text(std::string_view name) {
  for (const BuiltinFile& file : kBuiltinSpecies)
    if (file.name == name) return file.text;
  return {};
}

Result<Species> builtin_species(std::string_view name) {
  const std::string_view text = builtin_species_text(name);
  if (text.empty()) {
    const std::vector<std::string> known = builtin_species_names();
    const std::string near = meant_species(name, known);
    return Error{fmt::format("unknown species '{}'; {}built in are: {}", name,
                             near.empty() ? "" : fmt::format("did you mean '{}'? ", near), fmt::join(known, ", "))};
  }
  auto file = TomlFile::parse(text, fmt::format("species {}", name));
  if (!file) return file.error();
  return species_from(*file, fmt::format("species {}", name));
}

}  // namespace bosquet::scene
