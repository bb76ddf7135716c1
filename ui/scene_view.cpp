#include "ui/scene_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/hash.h"
#include "core/stopwatch.h"
#include "exchange/texture_cache.h"
#include "geometry/ground_mesh.h"
#include "geometry/human_figure.h"
#include "geometry/water_mesh.h"
#include "scene/materials.h"
#include "scene/view_models.h"

namespace bosquet::ui {
namespace {

// Nodes of the renderer by what they are; a tree's key is its id.
enum Kind : std::uint64_t { kTree = 0, kShape, kGround, kWater, kObstacle, kHero, kViewModel, kUnderlay, kFigure };
std::uint64_t key_of(Kind kind, std::uint64_t number) { return kind << 40 | number; }

// Materials that are there from the beginning, behind those of the site.
enum : std::size_t { kShapeMaterial = scene::kOfSite, kFlatMaterial };

constexpr std::size_t kGroundTriangles = 60'000;
// How far grass is drawn, as a share of what a picture shows: less where every blade costs the processor.
constexpr float kGrassReach = 0.8f, kSoftwareGrassReach = 0.4f;
constexpr Rgba8 kFigureColour(12, 12, 14, 255);
constexpr float kUnderlayLift_m = 0.06f;
// A full picture that takes longer would hold up the hand.
constexpr double kMoment_s = 0.25;
constexpr double kStill_s = 0.35;
constexpr double kSlowDraft_s = 0.12;

float height_m(const growth::Skeleton& skeleton) {
  float top = 0.1f;
  for (std::size_t i = 0; i < skeleton.size(); ++i)
    if (skeleton.alive(i)) top = std::max(top, skeleton.distal[i].y);
  return top;
}

/// A tree that grew some time ago, in this document or another one, is still there as it was.
bool stands_as(const scene::Document& document, const scene::Tree& grown) {
  const scene::Tree* now = document.trees->find(grown.id);
  return now && now->at == grown.at && now->species == grown.species;
}

bool ready(const auto& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

TriangleMesh shape_mesh(const crowns::RepresentativeShape& shape, float scale_height, float scale_width) {
  TriangleMesh mesh;
  scene::add_shape(mesh, Vec3(0.0f), shape, scale_height, scale_width,
                   {.sides = 14, .rings = 7, .trunk = Rgba8(27, 17, 9, 255), .crown = Rgba8(34, 62, 20, 255)});
  return mesh;
}

Result<SceneView> SceneView::create() {
  SceneView view;
  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();
  view.renderer_ = std::move(*renderer);
  scene::Model base;
  const scene::PaintingCache paintings(exchange::TextureCache::of_user().folder());
  base.materials = scene::site_materials(&paintings);
  scene::Material shape;
  shape.name = "shape";
  shape.surface = scene::Surface::obstacle;
  shape.double_sided = true;
  base.materials.push_back(shape);
  base.materials.push_back(shape);
  view.site_materials_ = base.materials;
  if (auto uploaded = view.renderer_->upload(base); !uploaded) return uploaded.error();
  view.renderer_->set_grass_season(geometry::Season::summer);
  return view;
}

void SceneView::put(std::uint64_t key, scene::Node node) {
  const auto old = nodes_.find(key);
  if (old != nodes_.end())
    for (const scene::Part& part : old->second.parts) triangles_ -= part.mesh->triangles();
  for (const scene::Part& part : node.parts) triangles_ += part.mesh->triangles();
  // Memory that the graphics card does not have shows as a missing tree, not as an end of work.
  static_cast<void>(renderer_->put(key, node));
  nodes_[key] = std::move(node);
  ++changed_;
}

void SceneView::remove(std::uint64_t key) {
  const auto found = nodes_.find(key);
  if (found == nodes_.end()) return;
  for (const scene::Part& part : found->second.parts) triangles_ -= part.mesh->triangles();
  nodes_.erase(found);
  renderer_->remove(key);
  ++changed_;
}

std::optional<std::size_t> SceneView::materials_of(const scene::Document& document, std::size_t species) {
  const std::shared_ptr<const scene::Species> kind = document.species[species];
  if (const auto there = species_materials_.find(kind->name); there != species_materials_.end()) return there->second;
  auto& made = species_made_[kind->name];
  if (!made.valid())
    made = std::async(std::launch::async, [kind] {
      const scene::PaintingCache paintings(exchange::TextureCache::of_user().folder());
      return render::make_levels(scene::species_materials(*kind, geometry::Season::summer, &paintings));
    });
  if (!ready(made)) return {};
  auto first = renderer_->add_materials(made.get());
  species_made_.erase(kind->name);
  const std::size_t index = first ? *first : kShapeMaterial;
  species_materials_[kind->name] = index;
  return index;
}

void SceneView::follow_site(const scene::Document& document) {
  if (!shown_ || shown_->terrain != document.terrain) {
    geometry::GroundOptions options;
    options.max_triangles = kGroundTriangles;
    std::vector<geometry::GroundPiece> pieces = geometry::mesh_ground(*document.terrain, options);
    for (std::uint64_t c = 0;; ++c) {
      if (c < pieces.size()) {
        scene::Node node;
        node.parts.push_back(
            {std::make_shared<const TriangleMesh>(std::move(pieces[c].mesh)), scene::ground_part(pieces[c].cover)});
        put(key_of(kGround, c), std::move(node));
      } else if (nodes_.contains(key_of(kGround, c))) {
        remove(key_of(kGround, c));
      } else {
        break;
      }
    }
    TriangleMesh water = geometry::mesh_water(*document.terrain, options.max_triangles);
    remove(key_of(kWater, 0));
    if (!water.empty()) {
      scene::Node node;
      node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(water)), scene::kWaterPart});
      put(key_of(kWater, 0), std::move(node));
    }
  }
  if (!shown_ || shown_->terrain != document.terrain || !shown_->figures.shares(document.figures)) {
    for (std::uint64_t f = 0; nodes_.contains(key_of(kFigure, f)); ++f) remove(key_of(kFigure, f));
    std::uint64_t number = 0;
    for (const scene::Figure& figure : document.figures) {
      TriangleMesh mesh = geometry::human_figure(figure.heading_deg);
      mesh.colours.assign(mesh.positions.size(), kFigureColour);
      scene::Node node;
      node.translation = to_world(figure.at, document.terrain->ground(figure.at));
      node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), kShapeMaterial});
      put(key_of(kFigure, number++), std::move(node));
    }
  }
  if (!shown_ || !shown_->obstacles.shares(document.obstacles)) {
    if (shown_)
      for (const scene::Obstacle& obstacle : shown_->obstacles)
        remove(key_of(kObstacle, static_cast<std::uint64_t>(-obstacle.id)));
    for (const scene::Obstacle& obstacle : document.obstacles) {
      scene::Node node;
      node.parts.push_back({obstacle.mesh, scene::kObstaclePart});
      put(key_of(kObstacle, static_cast<std::uint64_t>(-obstacle.id)), std::move(node));
    }
  }
}

// Hero trees stand as shapes until their meshes and materials are there.
void SceneView::follow_heroes(const scene::Document& document) {
  if (!heroes_wait_ && heroes_of_ == shown_) return;
  const bool same = heroes_of_ && heroes_of_->heroes.shares(document.heroes) &&
                    heroes_of_->terrain == document.terrain && heroes_of_->species.shares(document.species);
  if (same && !heroes_wait_) {
    heroes_of_ = shown_;
    return;
  }
  if (heroes_of_ && heroes_of_ != shown_)
    for (const scene::HeroTree& hero : heroes_of_->heroes)
      if (std::none_of(document.heroes.begin(), document.heroes.end(),
                       [&](const scene::HeroTree& h) { return h.id == hero.id; }))
        remove(key_of(kHero, static_cast<std::uint64_t>(-hero.id)));
  heroes_wait_ = false;
  for (const scene::HeroTree& hero : document.heroes) {
    const auto materials = materials_of(document, hero.species);
    const auto meshes = hero_meshes_.of(document, hero);
    scene::Node node;
    node.translation = to_world(hero.at, document.terrain->ground(hero.at));
    if (materials && meshes) {
      if (!meshes->branches.empty())
        node.parts.push_back(
            {std::shared_ptr<const TriangleMesh>(meshes, &meshes->branches), *materials + scene::kBarkPart});
      if (!meshes->leaves.empty()) {
        const bool mass = meshes->foliage == geometry::FoliageLevel::cards;
        node.parts.push_back({std::shared_ptr<const TriangleMesh>(meshes, &meshes->leaves),
                              *materials + (mass ? scene::kMassPart : scene::kLeafPart)});
      }
    } else {
      heroes_wait_ = true;
      const crowns::RepresentativeShape& shape = document.species[hero.species]->shape;
      const float scale = height_m(*hero.skeleton) / shape.mature_height_m;
      node.parts.push_back({std::make_shared<const TriangleMesh>(shape_mesh(shape, scale, scale)), kShapeMaterial});
    }
    const std::uint64_t key = key_of(kHero, static_cast<std::uint64_t>(-hero.id));
    const auto there = nodes_.find(key);
    const bool shape_again = !(materials && meshes) && there != nodes_.end() && there->second.parts.size() == 1 &&
                             there->second.translation == node.translation &&
                             there->second.parts[0].material == kShapeMaterial;
    const bool tree_again = there != nodes_.end() && there->second.translation == node.translation &&
                            there->second.parts.size() == node.parts.size() && !node.parts.empty() &&
                            there->second.parts[0].mesh == node.parts[0].mesh;
    if (!shape_again && !tree_again) put(key, std::move(node));
  }
  hero_meshes_.keep(document);
  heroes_of_ = shown_;
}

// The picture to draw on follows the ground and its place; it is read in the background.
void SceneView::follow_underlay(const scene::Document& document) {
  const scene::Underlay& wanted = document.underlay;
  if ((wanted.file != underlay_.file || wanted.opacity != underlay_.opacity) && !underlay_read_.valid()) {
    if (wanted.file != underlay_.file) underlay_shape_ = 0;
    underlay_ = wanted;
    underlay_on_.reset();
    if (!wanted.file.empty())
      underlay_read_ = std::async(std::launch::async, [wanted] { return read_underlay(wanted); });
  }
  if (ready(underlay_read_)) {
    auto read = underlay_read_.get();
    if (!read) {
      problem = read.error().message;
    } else {
      underlay_shape_ = read->height_per_width;
      if (underlay_material_) {
        static_cast<void>(renderer_->replace_colour(*underlay_material_, read->material));
      } else if (auto added = renderer_->add_materials(read->material)) {
        underlay_material_ = *added;
      }
      ++changed_;
    }
    underlay_on_.reset();
  }
  const bool seen = show_underlay && underlay_shape_ > 0 && underlay_material_ && !wanted.file.empty();
  const bool placed = wanted.south_west == underlay_.south_west && wanted.width_m == underlay_.width_m;
  if (seen == underlay_shown_ && (!seen || (placed && underlay_on_ == document.terrain))) return;
  underlay_shown_ = seen;
  underlay_.south_west = wanted.south_west, underlay_.width_m = wanted.width_m;
  underlay_on_ = document.terrain;
  remove(key_of(kUnderlay, 0));
  if (!seen) return;
  std::vector<std::shared_ptr<const TriangleMesh>> ground;
  for (std::uint64_t c = 0;; ++c) {
    const auto chunk = nodes_.find(key_of(kGround, c));
    if (chunk == nodes_.end()) break;
    ground.push_back(chunk->second.parts.front().mesh);
  }
  TriangleMesh mesh = drape(ground, rectangle_of(wanted, underlay_shape_), kUnderlayLift_m);
  if (mesh.empty()) return;
  scene::Node node;
  node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), *underlay_material_});
  put(key_of(kUnderlay, 0), std::move(node));
}

void SceneView::show_shape(const scene::Document& document, const scene::Tree& tree) {
  scene::Node node;
  node.translation = to_world(tree.at, document.terrain->ground(tree.at));
  node.parts.push_back({std::make_shared<const TriangleMesh>(
                            shape_mesh(document.species_of(tree).shape, tree.scale_height, tree.scale_width)),
                        kShapeMaterial});
  put(key_of(kShape, static_cast<std::uint64_t>(tree.id)), std::move(node));
}

void SceneView::show_grown(const scene::Document& document, const scene::FinishedTree& tree) {
  const auto materials = materials_of(document, tree.tree.species);
  if (!materials) {
    waiting_.push_back(tree.id);
    return;
  }
  scene::Node node;
  node.translation = tree.base;
  if (const auto& m = tree.meshes) {
    // The meshes live as long as what holds them.
    if (!m->branches.empty())
      node.parts.push_back({std::shared_ptr<const TriangleMesh>(m, &m->branches), *materials + scene::kBarkPart});
    if (!m->leaves.empty()) {
      const bool mass = m->foliage == geometry::FoliageLevel::cards;
      node.parts.push_back({std::shared_ptr<const TriangleMesh>(m, &m->leaves),
                            *materials + (mass ? scene::kMassPart : scene::kLeafPart)});
    }
  }
  const auto id = static_cast<std::uint64_t>(tree.id);
  put(key_of(kTree, id), std::move(node));
  remove(key_of(kShape, id));
}

// Trees that are new or not what has been grown stand as shapes; those that went, go.
void SceneView::follow_trees(const scene::Document& document) {
  if (shown_ && shown_->trees == document.trees && shown_->species.shares(document.species) &&
      shown_->terrain == document.terrain)
    return;
  if (shown_)
    for (const scene::Tree& tree : *shown_->trees)
      if (const scene::Tree* now = document.trees->find(tree.id); !now || now->status == scene::TreeStatus::to_remove) {
        remove(key_of(kTree, static_cast<std::uint64_t>(tree.id)));
        remove(key_of(kShape, static_cast<std::uint64_t>(tree.id)));
        grown_.erase(tree.id);
      }
  for (const scene::Tree& tree : *document.trees) {
    if (tree.status == scene::TreeStatus::to_remove) continue;
    const scene::Tree* before = shown_ ? shown_->trees->find(tree.id) : nullptr;
    const bool same = before && before->at == tree.at && before->species == tree.species &&
                      before->scale_height == tree.scale_height && before->scale_width == tree.scale_width;
    const auto id = static_cast<std::uint64_t>(tree.id);
    const bool level = shown_ && shown_->terrain == document.terrain;
    if (same && level) continue;
    const auto there = nodes_.find(key_of(kTree, id));
    if (same && there != nodes_.end()) {
      // Only the ground moved.
      const Vec3 base = to_world(tree.at, document.terrain->ground(tree.at));
      if (there->second.translation != base) {
        scene::Node node = there->second;
        node.translation = base;
        put(key_of(kTree, id), std::move(node));
      }
      continue;
    }
    // One that is dragged keeps its own crown until it has a new one.
    if (before && there != nodes_.end() && before->species == tree.species &&
        before->scale_height == tree.scale_height && before->scale_width == tree.scale_width) {
      scene::Node node = there->second;
      node.translation = to_world(tree.at, document.terrain->ground(tree.at));
      put(key_of(kTree, id), std::move(node));
      continue;
    }
    remove(key_of(kTree, id));
    show_shape(document, tree);
  }
}

// The ground needs what lies over it to be seen as it is, at once; then as the trees stand at last, not after each of them.
void SceneView::follow_overhead(bool growing) {
  if (ready(overhead_)) {
    static_cast<void>(renderer_->set_overhead(overhead_.get()));
    drawn_full_ = false;
    drawn_for_ = 0;
  }
  if (overhead_.valid() || overhead_for_ == changed_ || (growing && overhead_for_ != 0)) return;
  overhead_for_ = changed_;
  scene::Model model;
  model.materials = site_materials_;
  for (const auto& [key, node] : nodes_) {
    scene::Node copy = node;
    // What counts overhead is ground, water or something that stands on it.
    for (scene::Part& part : copy.parts)
      if (part.material >= scene::kOfSite) part.material = scene::kObstaclePart;
    model.nodes.push_back(std::move(copy));
  }
  const Box3 bounds = renderer_->bounds();
  overhead_ = std::async(std::launch::async,
                         [model = std::move(model), bounds] { return render::make_overhead(model, bounds); });
}

// Regions, arrows and plan are pictures of the whole, made anew when the trees are finished.
void SceneView::follow_view_model(const Session& session) {
  const bool flat = is_flat(show);
  const std::uint64_t wanted = flat ? session.revision() * 2 + (session.growth().year ? 1 : 0) : 0;
  if (wanted == view_model_for_ && shown_as_ == show && shown_slice_ == slice_m) return;
  auto& pipeline = const_cast<Session&>(session).pipeline();
  const std::shared_ptr<const scene::Surroundings> around = pipeline.surroundings();
  if (flat && (!pipeline.idle() || !around)) return;
  view_model_for_ = wanted;
  shown_as_ = show;
  shown_slice_ = slice_m;
  for (std::uint64_t i = 0; nodes_.contains(key_of(kViewModel, i)); ++i) remove(key_of(kViewModel, i));
  ++changed_;
  if (!flat) return;
  scene::GrownScene grown;
  grown.document = *session.document();
  grown.space = around->space;
  for (const scene::Tree& tree : *grown.document.trees) {
    const auto found = grown_.find(tree.id);
    scene::GrownTree one;
    if (found != grown_.end()) one = found->second.grown;
    grown.trees.push_back(one);
  }
  auto model = show == Show::regions  ? scene::regions_model(grown, slice_m)
               : show == Show::arrows ? scene::arrows_model(grown)
                                      : scene::plan_model(grown);
  if (!model) return;
  std::uint64_t number = 0;
  for (scene::Node& node : model->nodes) {
    for (scene::Part& part : node.parts) part.material = kFlatMaterial;
    put(key_of(kViewModel, number++), std::move(node));
  }
}

void SceneView::update(Session& session) {
  const std::shared_ptr<const scene::Document> document = session.document();
  const Stopwatch watch;
  if (document != shown_) {
    follow_site(*document);
    follow_trees(*document);
    shown_ = document;
  }
  follow_heroes(*document);
  follow_underlay(*document);
  // Materials that came in the meantime.
  std::vector<std::int32_t> waiting = std::exchange(waiting_, {});
  for (const std::int32_t id : waiting)
    if (const auto found = grown_.find(id); found != grown_.end() && stands_as(*document, found->second.tree))
      show_grown(*document, found->second);

  do {
    std::vector<scene::FinishedTree> finished = session.pipeline().take_finished(4);
    if (finished.empty()) break;
    for (scene::FinishedTree& tree : finished) {
      const scene::Tree* now = document->trees->find(tree.id);
      if (tree.gone || !now) {
        if (!now) {
          remove(key_of(kTree, static_cast<std::uint64_t>(tree.id)));
          grown_.erase(tree.id);
        }
        continue;
      }
      // One that was changed again since waits for its next growth.
      if (!stands_as(*document, tree.tree)) continue;
      const scene::FinishedTree& kept = grown_[tree.id] = std::move(tree);
      show_grown(*document, kept);
    }
  } while (watch.seconds() < kUpload_s);
  follow_view_model(session);
  follow_grass(*document, session.rig.camera().eye, kUpload_s, watch);
  follow_overhead(!session.pipeline().idle());
}

// Tiles come as the eye nears them and go as it leaves, the nearest first, as far as a frame has time. Each comes with more
// tufts than it shows, so that a small step needs no other.
void SceneView::follow_grass(const scene::Document& document, const Vec3& eye, double until_s, const Stopwatch& watch) {
  const auto number = [](IVec2 tile) {
    return static_cast<std::uint64_t>(tile.y) << 32 | static_cast<std::uint32_t>(tile.x);
  };
  const auto drop = [&](std::pair<int, int> at) {
    renderer_->put_grass(number({at.first, at.second}), {{at.first, at.second}, {}});
  };
  const bool same = grass_of_ && grass_of_->terrain == document.terrain &&
                    grass_of_->ground_cover == document.ground_cover && grass_of_->seed == document.seed &&
                    grass_of_->obstacles.shares(document.obstacles);
  if (!same) {
    for (const auto& [at, rank] : grass_tiles_) drop(at);
    if (!grass_tiles_.empty()) ++changed_;
    grass_tiles_.clear();
    grass_site_ = std::make_shared<const scene::GrassSite>(
        document, scene::GrassSiteOptions{.ground_triangles = kGroundTriangles});
  }
  grass_of_ = shown_;
  grass_due_ = false;
  if (show != Show::trees || grass_site_->empty()) return;

  const float reach = grass_reach();
  std::vector<std::pair<float, IVec2>> wanted;
  for (const scene::GrassTile& near : scene::grass_tiles(*grass_site_, eye, reach * geometry::kFarthestGrassM))
    wanted.emplace_back(near.distance_m, near.tile);
  std::sort(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.first, a.second.y, a.second.x) < std::tuple(b.first, b.second.y, b.second.x);
  });
  for (auto at = grass_tiles_.begin(); at != grass_tiles_.end();)
    if (const IVec2 tile(at->first.first, at->first.second);
        std::none_of(wanted.begin(), wanted.end(), [&](const auto& w) { return w.second == tile; })) {
      drop(at->first);
      at = grass_tiles_.erase(at);
    } else {
      ++at;
    }
  for (const auto& [distance, tile] : wanted) {
    const auto known = grass_tiles_.find({tile.x, tile.y});
    if (known != grass_tiles_.end() && known->second >= geometry::full_rank(distance / reach)) continue;
    if (watch.seconds() > until_s) {
      grass_due_ = true;
      break;
    }
    const float rank = geometry::full_rank(std::max(0.0f, distance - 0.5f * geometry::kGrassTileM) / reach);
    renderer_->put_grass(number(tile), grass_site_->patch(tile, rank));
    grass_tiles_[{tile.x, tile.y}] = rank;
    ++changed_;
  }
}

float SceneView::grass_reach() { return render::draws_by_software() ? kSoftwareGrassReach : kGrassReach; }

bool SceneView::settled() const {
  return waiting_.empty() && !grass_due_ && !heroes_wait_ && !underlay_read_.valid() && species_made_.empty() &&
         !overhead_.valid() && overhead_for_ == changed_ && drawn_for_ == changed_;
}

void SceneView::draw(const Session& session, IVec2 size, bool moving, double time_s) {
  const scene::Camera camera = session.rig.camera();
  const float plan = session.rig.plan_height_m();
  const scene::Sun& sun = session.document()->sun;
  const bool same_camera = camera.eye == drawn_camera_.eye && camera.target == drawn_camera_.target &&
                           camera.vertical_fov_deg == drawn_camera_.vertical_fov_deg && plan == drawn_plan_;
  const bool same = same_camera && size == drawn_size_ && drawn_for_ == changed_ &&
                    sun.azimuth_deg == drawn_sun_.azimuth_deg && sun.elevation_deg == drawn_sun_.elevation_deg;
  if (!same || moving) still_since_s_ = time_s;
  // A full picture costs three to five times a draft.
  const bool full = !moving && same && time_s - still_since_s_ > kStill_s && 5.0 * draft_s_ < kMoment_s;
  if (same && (drawn_full_ || !full)) return;

  render::View view;
  view.camera = camera;
  view.orthographic_height_m = plan;
  view.sun = sun;
  view.look = look;
  view.quality = full ? render::Quality::full : render::Quality::draft;
  view.supersample = 1;
  view.samples = render::draws_by_software() ? 1 : 4;
  view.grass_reach = show == Show::trees ? grass_reach() : 0.0f;
  if (is_flat(show)) {
    view.shading = render::Shading::flat;
    view.sky = false;
  }
  // Where even a draft is slow, it has half the pixels while a hand moves.
  const int shrink = moving && draft_s_ > kSlowDraft_s ? 2 : 1;
  view.width = std::max(1, size.x / shrink), view.height = std::max(1, size.y / shrink);
  if (!target_.fit({view.width, view.height})) return;
  const Stopwatch watch;
  static_cast<void>(renderer_->draw_into(target_.framebuffer(), view));
  render::finish_drawing();
  if (!full) draft_s_ = watch.seconds() * shrink * shrink;
  drawn_camera_ = camera;
  drawn_plan_ = plan;
  drawn_size_ = size;
  drawn_for_ = changed_;
  drawn_sun_ = sun;
  drawn_full_ = full || shrink == 1;
  if (!full && 5.0 * draft_s_ < kMoment_s) drawn_full_ = false;
  if (shrink > 1) drawn_for_ = 0;  // the whole one follows when the hand rests
}

}  // namespace bosquet::ui
