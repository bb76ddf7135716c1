// Materials: how wood and leaves of the species, ground, water and obstacles look, as textures made by the program.
//
// Model     kOfSpecies materials for each species in the document's order, then those of the site
// Holds     a species looks the same in every document
// Cost      some tenths of a second a species, in parallel, hundredths where a cache has them; species without trees are
//           and covers that nothing shows are left empty
#pragma once

#include <functional>
#include <vector>

#include "geometry/season.h"
#include "scene/document.h"
#include "scene/model.h"
#include "scene/painting_cache.h"
#include "terrain/area.h"

namespace bosquet::scene {

/// Parts of a species' trees: bark, single leaves and twigs, masses of foliage on cards.
enum SpeciesPart : std::size_t { kBarkPart, kLeafPart, kMassPart, kOfSpecies };

inline std::size_t material_of(std::size_t species, SpeciesPart part) { return kOfSpecies * species + part; }

/// Parts of a site, behind those of the species: water, obstacles, and what covers the ground, meadow first.
enum SitePart : std::size_t {
  kGroundPart,
  kWaterPart,
  kObstaclePart,
  kGravelPart,
  kPavingPart,
  kLawnPart,
  kSoilPart,
  kOfSite
};

SitePart ground_part(terrain::Cover cover);
inline std::size_t site_material(const Document& document, SitePart part) {
  return kOfSpecies * document.species.size() + part;
}

/// All of them for a document. `paintings` (may be null) are found and added to.
std::vector<Material> make_materials(const Document& document, geometry::Season season,
                                     const PaintingCache* paintings = nullptr);

/// Those of one species, in the order of SpeciesPart.
std::vector<Material> species_materials(const Species& species, geometry::Season season,
                                        const PaintingCache* paintings = nullptr);

/// Those of a site, in the order of SitePart; covers that `shown` does not tell are left without pictures.
std::vector<Material> site_materials(const PaintingCache* paintings = nullptr,
                                     const std::function<bool(terrain::Cover)>& shown = {});

}  // namespace bosquet::scene
