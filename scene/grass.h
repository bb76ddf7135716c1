// Grass: the tufts of a document's lawns and meadows, for whoever draws or writes them.
//
// Model     geometry/grass_field.h says where tufts stand and geometry/grass_tuft.h what they are like; here trunks, buildings
//           and other obstacles keep their ground free. A picture takes tiles around the eye; a file takes the tufts that
//           its cameras see best, baked into meshes of tiles, as copies that exchange/gltf_instances.h finds again
// Decision  tufts are no part of a model that is drawn: a renderer draws them instanced (render/gpu_grass.h), each fading on its own
// Units     metres; `reach` is how much farther than with a usual lens and screen tufts can be told
// Holds     the same bits for any number of threads
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geometry/grass_field.h"
#include "geometry/ground_grid.h"
#include "scene/document.h"
#include "scene/grown_scene.h"
#include "scene/model.h"

namespace bosquet::scene {

/// A trunk, in plan.
struct TrunkFoot {
  Vec2 at{0.0f};
  float radius_m = 0.0f;
};

/// The tufts of one tile.
struct GrassPatch {
  IVec2 tile{0};
  std::vector<geometry::Tuft> tufts;
};

struct GrassSiteOptions {
  geometry::Season season = geometry::Season::summer;
  std::size_t ground_triangles = 200'000;  ///< GroundOptions::max_triangles of the ground that they stand on
  std::function<float(Vec2)> shade{};      ///< as GroundOptions'
  std::vector<TrunkFoot> trunks{};
};

/// Where the grass of a document stands; made once, asked often.
class GrassSite {
 public:
  GrassSite(const Document& document, GrassSiteOptions options);

  /// The tufts of a tile (geometry::kGrassTileM) with ranks below `rank`.
  GrassPatch patch(IVec2 tile, float rank) const;
  /// Tiles from 0 to this.
  IVec2 tiles() const;
  geometry::Season season() const { return options_.season; }
  bool empty() const { return options_.density <= 0.0f; }
  /// Height of the highest ground.
  float highest_m() const { return highest_m_; }

 private:
  struct Taken;
  std::shared_ptr<const terrain::Terrain> terrain_;
  geometry::GroundGrid grid_;
  std::shared_ptr<const Taken> taken_;
  geometry::GrassOptions options_;
  float highest_m_ = 0.0f;
};

/// Those of a grown scene: in the shade of its crowns, and off its trunks.
GrassSiteOptions grass_options(const GrownScene& scene, geometry::Season season, std::size_t ground_triangles);

/// How far tufts can be told in a picture, as a share of the usual.
float grass_reach(const Camera& camera, int picture_height);

struct GrassTile {
  IVec2 tile{0};
  float distance_m = 0;  ///< from the eye, as near as the site's ground may come
};
/// The tiles nearer to an eye than so many metres.
std::vector<GrassTile> grass_tiles(const GrassSite& site, const Vec3& eye, float within_m);

/// The patches before a camera that have tufts worth drawing.
std::vector<GrassPatch> grass_before(const GrassSite& site, const Camera& camera, float reach);

struct BakedGrass {
  std::vector<Node> nodes;  ///< their material's index is `material`
  std::size_t triangles = 0;
};

/// The tufts that the cameras see best, at most `max_triangles` of them (0: no limit); without cameras evenly over the site.
BakedGrass bake_grass(const GrassSite& site, std::span<const Camera> cameras, std::size_t material,
                      std::size_t max_triangles);
/// The triangles that it would have.
std::size_t grass_triangles(const GrassSite& site, std::span<const Camera> cameras, std::size_t max_triangles);
Material grass_material(geometry::Season season);

}  // namespace bosquet::scene
