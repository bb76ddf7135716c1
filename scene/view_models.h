// View models: what stands behind a grown scene, as meshes to look at.
//
// Views     shapes    the representative shapes that trees claim space with, on the ground
//           regions   one layer of the crown space from above, a colour for each tree
//           plan      crowns as grown, as discs coloured by species, with their trunks, over areas and water
//           arrows    the plan with the neighbourhood asymmetry of each tree as an arrow
// Frame     world; views from above are flat, at the height of the highest ground
// Errors    regions and arrows need a scene that was grown with crown regions
#pragma once

#include <optional>

#include "core/result.h"
#include "core/triangle_mesh.h"
#include "scene/grown_scene.h"
#include "scene/model.h"

namespace bosquet::scene {

/// Quads around, rings of the ellipsoid from its lowest to its highest point, linear tints.
struct ShapeLook {
  int sides = 32, rings = 12;
  Rgba8 trunk, crown;
};
/// Adds what a tree claims space with, its trunk and an ellipsoid, as surfaces of revolution about the vertical through `foot`.
void add_shape(TriangleMesh& mesh, const Vec3& foot, const crowns::RepresentativeShape& shape, float scale_height,
               float scale_width, const ShapeLook& look);

Result<Model> shapes_model(const GrownScene& scene);

/// `height_m` above the lowest ground; missing: a third of the tallest tree.
Result<Model> regions_model(const GrownScene& scene, std::optional<float> height_m);

Result<Model> plan_model(const GrownScene& scene);
Result<Model> arrows_model(const GrownScene& scene);

}  // namespace bosquet::scene
