#include "scene/settings_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scene/tree_parameters.h"

namespace bosquet::scene {
namespace {

template <class Change>
Edited changed(const Document& document, std::string name, const Change& change) {
  Edited edited;
  edited.document = document;
  change(edited.document);
  edited.name = std::move(name);
  return edited;
}

/// The first number out of its range, in words.
struct Ranges {
  std::string wrong{};
  void operator()(const Real& info, double v) {
    if (!wrong.empty() || (v >= static_cast<float>(info.low) && v <= static_cast<float>(info.high))) return;
    wrong = fmt::format("{} = {} is out of range, allowed is {} to {}{}{}", info.name, v, info.low, info.high,
                        info.unit.empty() ? "" : " ", info.unit);
  }
  void operator()(const Switch&, bool) {}
};

template <class Options>
Result<void> in_range(const Options& options) {
  Ranges ranges;
  describe(options, ranges);
  if (!ranges.wrong.empty()) return Error{std::move(ranges.wrong)};
  return {};
}

Result<void> check_species(const Document& document, const Species& species, std::size_t index) {
  if (species.name.empty()) return Error{"a species needs a name"};
  for (std::size_t s = 0; s < document.species.size(); ++s)
    if (s != index && document.species[s]->name == species.name)
      return Error{fmt::format("there is a species '{}' already", species.name)};
  return growth::check(species.growth, fmt::format("species {}", species.name));
}

Result<void> check_index(const Document& document, std::size_t index) {
  if (index < document.species.size()) return {};
  return Error{fmt::format("there is no species number {}; the document has {}", index, document.species.size())};
}

}  // namespace

Result<Edited> add_species(const Document& document, Species species) {
  if (auto done = check_species(document, species, document.species.size()); !done) return done.error();
  return changed(document, fmt::format("Add species {}", species.name),
                 [&](Document& d) { d.species.push_back(std::make_shared<const Species>(std::move(species))); });
}

Result<Edited> change_species(const Document& document, std::size_t index, Species species) {
  if (auto done = check_index(document, index); !done) return done.error();
  if (auto done = check_species(document, species, index); !done) return done.error();
  for (const Tree& tree : *document.trees)
    if (tree.species == index && !tree.overrides.empty())
      if (auto fits = with_overrides(species.growth, tree.overrides, fmt::format("tree {}", tree.id)); !fits)
        return fits.error();
  const std::string was = document.species[index]->name;
  for (const distribution::Interaction& i : document.interactions)
    if (species.name != was && (i.of == was || i.on == was))
      return Error{fmt::format("species '{}' cannot be renamed while interactions name it", was)};
  return changed(document, fmt::format("Change species {}", species.name),
                 [&](Document& d) { d.species.replace(index, std::make_shared<const Species>(std::move(species))); });
}

Result<Edited> remove_species(const Document& document, std::size_t index) {
  if (auto done = check_index(document, index); !done) return done.error();
  const std::string& name = document.species[index]->name;
  std::size_t of_it = 0;
  for (const Tree& tree : *document.trees) of_it += tree.species == index;
  for (const HeroTree& hero : document.heroes) of_it += hero.species == index;
  if (of_it) return Error{fmt::format("{} of species '{}' stand on the site", trees_in_words(of_it), name)};
  for (const distribution::Interaction& i : document.interactions)
    if (i.of == name || i.on == name) return Error{fmt::format("an interaction names species '{}'", name)};
  return changed(document, fmt::format("Remove species {}", name), [&](Document& d) {
    d.species.erase(index);
    std::vector<Tree> trees;
    for (const Tree& tree : *document.trees)
      if (tree.species > index) trees.push_back(tree), --trees.back().species;
    if (!trees.empty()) d.trees = std::make_shared<const Trees>(document.trees->edited(std::move(trees)));
    std::vector<HeroTree> heroes = document.heroes;
    for (HeroTree& hero : heroes) hero.species -= hero.species > index;
    d.heroes = std::move(heroes);
    std::vector<distribution::MixEntry> bar = document.species_bar;
    std::erase_if(bar, [&](const auto& entry) { return entry.species == index; });
    for (auto& entry : bar) entry.species -= entry.species > index;
    d.species_bar = std::move(bar);
  });
}

Result<Edited> set_interactions(const Document& document, SharedList<distribution::Interaction> interactions) {
  for (const distribution::Interaction& i : interactions)
    for (const std::string& name : {i.of, i.on})
      if (std::none_of(document.species.begin(), document.species.end(),
                       [&](const auto& s) { return s->name == name; }))
        return Error{fmt::format("an interaction names species '{}', which the document does not have", name)};
  for (std::size_t a = 0; a < interactions.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (interactions[a].of == interactions[b].of && interactions[a].on == interactions[b].on)
        return Error{fmt::format("there are two interactions of '{}' on '{}'", interactions[a].of, interactions[a].on)};
  return changed(document, "Change interactions", [&](Document& d) { d.interactions = std::move(interactions); });
}

Result<Edited> set_species_bar(const Document& document, SharedList<distribution::MixEntry> bar) {
  for (const distribution::MixEntry& entry : bar) {
    if (auto done = check_index(document, entry.species); !done) return done.error();
    if (!(entry.probability >= 0.0f && entry.probability <= 1e6f))
      return Error{fmt::format("a probability of {} is not allowed, 0 to 1000000 is", entry.probability)};
  }
  return changed(document, "Change species bar", [&](Document& d) { d.species_bar = std::move(bar); });
}

Edited set_sun(const Document& document, const Sun& sun) {
  return changed(document, "Move sun", [&](Document& d) { d.sun = sun; });
}
Edited set_cameras(const Document& document, SharedList<Camera> cameras) {
  return changed(document, "Change cameras", [&](Document& d) { d.cameras = std::move(cameras); });
}
Edited set_place(const Document& document, const Georeference& place) {
  return changed(document, "Change place", [&](Document& d) { d.place = place; });
}
Edited set_underlay(const Document& document, const Underlay& underlay) {
  return changed(document, underlay.file.empty() ? "Remove plan picture" : "Place plan picture",
                 [&](Document& d) { d.underlay = underlay; });
}
Edited set_max_triangles(const Document& document, std::size_t max_triangles) {
  return changed(document, "Change triangle budget", [&](Document& d) { d.max_triangles = max_triangles; });
}
Result<Edited> set_ground_cover(const Document& document, const GroundCover& cover) {
  if (auto done = in_range(cover); !done) return done.error();
  return changed(document, "Change grass", [&](Document& d) { d.ground_cover = cover; });
}
Edited set_seed(const Document& document, std::uint64_t seed) {
  return changed(document, "Change seed", [&](Document& d) { d.seed = seed; });
}

Result<Edited> set_space(const Document& document, const crowns::SpaceOptions& space) {
  if (auto done = in_range(space); !done) return done.error();
  return changed(document, "Change crown space", [&](Document& d) { d.space = space; });
}
Result<Edited> set_asymmetry(const Document& document, const crowns::AsymmetryOptions& asymmetry) {
  if (auto done = in_range(asymmetry); !done) return done.error();
  return changed(document, "Change asymmetry", [&](Document& d) { d.asymmetry = asymmetry; });
}
Result<Edited> set_light(const Document& document, const crowns::LightOptions& light) {
  if (auto done = in_range(light); !done) return done.error();
  return changed(document, "Change canopy light", [&](Document& d) { d.light = light; });
}

}  // namespace bosquet::scene
