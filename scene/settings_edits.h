// Settings edits: species and what they do to each other, the species bar, sun, cameras, crown space and light.
//
// Decision  a changed species reaches all its trees; one that no longer fits what was changed for a single tree is
//           refused, naming the tree
// Errors    numbers out of range and names that are not unique, as one message; then nothing is changed
#pragma once

#include <string_view>
#include <vector>

#include "scene/edits.h"

namespace bosquet::scene {

Result<Edited> add_species(const Document& document, Species species);
Result<Edited> change_species(const Document& document, std::size_t index, Species species);
/// Only a species that no tree, hero tree or interaction is of.
Result<Edited> remove_species(const Document& document, std::size_t index);

Result<Edited> set_interactions(const Document& document, SharedList<distribution::Interaction> interactions);
Result<Edited> set_species_bar(const Document& document, SharedList<distribution::MixEntry> bar);

Edited set_sun(const Document& document, const Sun& sun);
Edited set_cameras(const Document& document, SharedList<Camera> cameras);
Edited set_place(const Document& document, const Georeference& place);
Edited set_max_triangles(const Document& document, std::size_t max_triangles);
Edited set_underlay(const Document& document, const Underlay& underlay);
Result<Edited> set_ground_cover(const Document& document, const GroundCover& cover);
Edited set_seed(const Document& document, std::uint64_t seed);

Result<Edited> set_space(const Document& document, const crowns::SpaceOptions& space);
Result<Edited> set_asymmetry(const Document& document, const crowns::AsymmetryOptions& asymmetry);
Result<Edited> set_light(const Document& document, const crowns::LightOptions& light);

}  // namespace bosquet::scene
