// Materials: how wood and leaves of the species, ground, water and obstacles look, as textures made by the program.
//
// Model     kOfSpecies materials for each species in the document's order, then those of the site
// Holds     a species looks the same in every document
// Cost      some tenths of a second a species, in parallel, hundredths where a cache has them; species without trees are
//           left empty
#pragma once

#include <vector>

#include "geometry/season.h"
#include "scene/document.h"
#include "scene/model.h"
#include "scene/painting_cache.h"

namespace bosquet::scene {

/// Parts of a species' trees: bark, single leaves and twigs, masses of foliage on cards.
enum SpeciesPart : std::size_t { kBarkPart, kLeafPart, kMassPart, kOfSpecies };

inline std::size_t material_of(std::size_t species, SpeciesPart part) { return kOfSpecies * species + part; }
inline std::size_t ground_material(const Document& document) { return kOfSpecies * document.species.size(); }
inline std::size_t water_material(const Document& document) { return ground_material(document) + 1; }
inline std::size_t obstacle_material(const Document& document) { return ground_material(document) + 2; }

/// All of them for a document. `paintings` (may be null) are found and added to.
std::vector<Material> make_materials(const Document& document, geometry::Season season,
                                     const PaintingCache* paintings = nullptr);

/// Those of one species, in the order of SpeciesPart.
std::vector<Material> species_materials(const Species& species, geometry::Season season,
                                        const PaintingCache* paintings = nullptr);

/// Ground, water, obstacles.
std::vector<Material> site_materials(const PaintingCache* paintings = nullptr);

}  // namespace bosquet::scene
