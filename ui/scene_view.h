// Scene view: the session's scene as a picture that is drawn again only when something in it changed.
//
// Model     trees stand as their representative shapes at once and are replaced as the pipeline finishes them; ground,
//           water, buildings and hero trees follow the document. While a hand moves or trees still grow, drafts are
//           drawn, smaller ones where drawing is slow; then the full picture, where that takes no longer than a moment
// Cost      a frame takes at most kUpload_s of uploads; materials are made in the background
// Context   an OpenGL context current, the same for all calls
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "core/stopwatch.h"
#include "render/picture_target.h"
#include "render/renderer.h"
#include "scene/grass.h"
#include "scene/model.h"
#include "scene/pipeline.h"
#include "ui/hero_meshes.h"
#include "ui/session.h"
#include "ui/underlay.h"

namespace bosquet::ui {

/// What of the scene is shown.
enum class Show { trees, shapes, regions, arrows, plan };
/// Whether it is seen from above, in plain colours.
inline bool is_flat(Show show) { return show == Show::regions || show == Show::arrows || show == Show::plan; }
inline constexpr std::array<std::string_view, 5> kShowNames{"Trees", "Shapes", "Regions", "Arrows", "Plan"};

class SceneView {
 public:
  static constexpr double kUpload_s = 0.004;

  static Result<SceneView> create();

  /// Brings the scene up to date with the session, as far as a frame has time.
  void update(Session& session);

  /// Draws the picture anew if it is due; `moving`: a hand is on the camera or a tool now.
  void draw(const Session& session, IVec2 size, bool moving, double time_s);

  unsigned texture() const { return target_.texture(); }
  Image picture() const { return target_.read(); }
  /// Whether nothing is left to be shown or drawn.
  bool settled() const;

  Show show = Show::trees;
  std::optional<float> slice_m;  ///< height of the regions shown
  render::Look look;
  bool show_underlay = true;  ///< the picture to draw on, where the document has one
  std::string problem;        ///< of reading it; cleared by who shows it

  std::size_t grown_trees() const { return grown_.size(); }
  std::size_t triangles() const { return triangles_; }
  /// The grown trees as finished so far, by id.
  const std::unordered_map<std::int32_t, scene::FinishedTree>& grown() const { return grown_; }

 private:
  SceneView() = default;
  void put(std::uint64_t key, scene::Node node);
  void remove(std::uint64_t key);
  void follow_site(const scene::Document& document);
  void follow_heroes(const scene::Document& document);
  void follow_underlay(const scene::Document& document);
  void follow_trees(const scene::Document& document);
  void show_grown(const scene::Document& document, const scene::FinishedTree& tree);
  void show_shape(const scene::Document& document, const scene::Tree& tree);
  void follow_view_model(const Session& session);
  void follow_overhead(bool growing);
  static float grass_reach();
  void follow_grass(const scene::Document& document, const Vec3& eye, double until_s, const Stopwatch& watch);
  std::optional<std::size_t> materials_of(const scene::Document& document, std::size_t species);

  std::optional<render::Renderer> renderer_;
  render::PictureTarget target_;
  std::map<std::uint64_t, scene::Node> nodes_;  ///< what the renderer was given, sharing meshes
  std::shared_ptr<const scene::Document> shown_;
  std::unordered_map<std::int32_t, scene::FinishedTree> grown_;
  std::vector<std::int32_t> waiting_;  ///< grown, but their species' materials are not there yet
  std::size_t triangles_ = 0;

  // Materials of a species by its name: index of the first, or made now.
  std::map<std::string, std::size_t> species_materials_;
  std::map<std::string, std::future<render::MaterialLevels>> species_made_;

  HeroMeshes hero_meshes_;
  std::shared_ptr<const scene::Document> heroes_of_;  ///< the document whose hero trees are shown
  bool heroes_wait_ = false;                          ///< some stand as shapes until mesh or materials are there

  scene::Underlay underlay_;  ///< that is shown or read
  std::future<Result<UnderlayPicture>> underlay_read_;
  std::optional<std::size_t> underlay_material_;
  float underlay_shape_ = 0;  ///< height per width; 0: none was read
  std::shared_ptr<const terrain::Terrain> underlay_on_;
  bool underlay_shown_ = false;

  // Grass around the eye, tile by tile, and what it was made for.
  std::shared_ptr<const scene::GrassSite> grass_site_;
  std::shared_ptr<const scene::Document> grass_of_;
  std::map<std::pair<int, int>, float> grass_tiles_;  ///< the rank up to which a tile is there
  bool grass_due_ = false;                            ///< tiles are missing

  std::vector<scene::Material> site_materials_;
  std::future<render::Overhead> overhead_;
  std::uint64_t changed_ = 1, overhead_for_ = 0, drawn_for_ = 0;
  Show shown_as_ = Show::trees;
  std::optional<float> shown_slice_;
  std::uint64_t view_model_for_ = 0;

  // Of the picture drawn last.
  scene::Camera drawn_camera_;
  float drawn_plan_ = -1;
  IVec2 drawn_size_{0};
  bool drawn_full_ = false;
  double draft_s_ = 0, still_since_s_ = 0;
  scene::Sun drawn_sun_;
};

/// A tree's representative shape as a mesh in tree frame.
TriangleMesh shape_mesh(const crowns::RepresentativeShape& shape, float scale_height, float scale_width);

}  // namespace bosquet::ui
