// Document: a site, its species and its trees as one value.
//
// Model     parts are shared and immutable: a copy costs a few pointers, an edit replaces the part that it touches
//           (edits.h). All that can be computed (regions, skeletons, meshes) is not in it.
// Identity  ids come from counters of the document and are never given twice. Undo takes the counters back with the rest,
//           so that what is done again is the same again
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
#include "distribution/kernels.h"
#include "distribution/sowing.h"
#include "scene/clearance.h"
#include "scene/ground_cover.h"
#include "scene/hero_tree.h"
#include "scene/model.h"
#include "scene/obstacle.h"
#include "scene/plan_settings.h"
#include "scene/shared_list.h"
#include "scene/species.h"
#include "scene/trees.h"
#include "terrain/terrain.h"

namespace bosquet::scene {

/// Where the site lies on earth.
struct Georeference {
  double latitude_deg = 50.0, longitude_deg = 10.0;  ///< for the sun
  DVec2 south_west{0.0};                             ///< projected coordinates of the site's corner
  std::string crs_wkt;                               ///< empty when unknown

  bool operator==(const Georeference&) const = default;
};

/// A person for scale, drawn in pictures alone.
struct Figure {
  Vec2 at{0.0f};
  float heading_deg = 122.0f;  ///< where it walks to, from north clockwise

  bool operator==(const Figure&) const = default;
};

struct Document {
  std::uint64_t seed = 1;
  Georeference place;
  std::shared_ptr<const terrain::Terrain> terrain;
  SharedList<std::shared_ptr<const Species>> species;
  SharedList<distribution::Interaction> interactions;
  SharedList<distribution::MixEntry> species_bar;  ///< what brushes plant; empty: all species alike
  std::shared_ptr<const Trees> trees;
  SharedList<Obstacle> obstacles;
  SharedList<HeroTree> heroes;
  crowns::SpaceOptions space;
  crowns::AsymmetryOptions asymmetry;
  crowns::LightOptions light;
  SharedList<Camera> cameras;
  SharedList<Figure> figures;
  Sun sun;
  ClearanceRules clearance;
  PlanSettings plan;
  Underlay underlay;
  GroundCover ground_cover;
  std::size_t max_triangles = 3'000'000;  ///< of an export; 0 is no limit
  std::int32_t next_tree_id = 1;
  std::int32_t next_standing_id = -1;  ///< of obstacles and hero trees, downward
  std::uint64_t next_block = 1;        ///< number of the next planting by hand: its trees' keys come from it

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

/// Brings the counters past everything that is in the document.
void settle_counters(Document& document);

/// Scales and trunk of a tree from what was measured of it. With a trunk diameter, missing height and crown follow the
/// species' open-grown allometry; without one, height and crown stand for each other. Sizes beyond twice the mature
/// species' are cut to that.
void set_measured_size(Tree& tree, const Species& species, std::optional<float> height_m,
                       std::optional<float> trunk_diameter_m, std::optional<float> crown_diameter_m);

}  // namespace bosquet::scene
