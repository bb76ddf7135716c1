// Document: a site, its species and its trees as one value.
//
// Model     parts are shared and immutable: a copy costs a few pointers, an edit replaces the part that it touches. All
//           that can be computed (regions, skeletons, meshes) is not in it.
// Frame     plan (east, north) metres from the site's south-west corner
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"
#include "crowns/asymmetry.h"
#include "crowns/canopy_light.h"
#include "crowns/crown_space.h"
#include "scene/hero_tree.h"
#include "scene/model.h"
#include "scene/obstacle.h"
#include "scene/species.h"
#include "scene/trees.h"
#include "terrain/terrain.h"

namespace bosquet::scene {

/// Where the site lies on earth.
struct Georeference {
  double latitude_deg = 50.0, longitude_deg = 10.0;  ///< for the sun
  DVec2 south_west{0.0};                             ///< projected coordinates of the site's corner
  std::string crs_wkt;                               ///< empty when unknown
};

struct Document {
  std::uint64_t seed = 1;
  Georeference place;
  std::shared_ptr<const terrain::Terrain> terrain;
  std::vector<std::shared_ptr<const Species>> species;
  std::shared_ptr<const Trees> trees;
  std::vector<Obstacle> obstacles;
  std::vector<HeroTree> heroes;
  crowns::SpaceOptions space;
  crowns::AsymmetryOptions asymmetry;
  crowns::LightOptions light;
  std::vector<Camera> cameras;
  Sun sun;
  std::size_t max_triangles = 3'000'000;  ///< of an export; 0 is no limit

  const Species& species_of(const Tree& tree) const { return *species[tree.species]; }
  /// Height at which the tree stops growing.
  float mature_height_m(const Tree& tree) const { return tree.scale_height * species_of(tree).shape.mature_height_m; }
  /// Where the tree's height curve ends (growth/age.h): a measured tree, or one below the sizes that are planted, is on
  /// its way to a grown one.
  float full_height_m(const Tree& tree) const {
    const Species& kind = species_of(tree);
    const float grown = tree.measured ? 1.0f : kind.planting.scale_min;
    return std::max(tree.scale_height, grown) * kind.shape.mature_height_m;
  }
};

/// Scales and trunk of a tree from what was measured of it. With a trunk diameter, missing height and crown follow the
/// species' open-grown allometry; without one, height and crown stand for each other. Sizes beyond twice the mature
/// species' are cut to that.
void set_measured_size(Tree& tree, const Species& species, std::optional<float> height_m,
                       std::optional<float> trunk_diameter_m, std::optional<float> crown_diameter_m);

}  // namespace bosquet::scene
