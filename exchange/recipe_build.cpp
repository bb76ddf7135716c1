#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/hash.h"
#include "core/stopwatch.h"
#include "distribution/planting.h"
#include "exchange/footprints.h"
#include "exchange/mesh_file.h"
#include "exchange/recipe.h"
#include "exchange/recipe_write.h"
#include "exchange/shapes.h"
#include "scene/clipped_tree.h"
#include "scene/planting_edits.h"
#include "scene/site_edits.h"
#include "scene/species_names.h"

namespace bosquet::exchange {
namespace {

using distribution::Planting;
using distribution::StandingTree;

// What a hedge or panel is like when nothing is said: how far a plant's body goes into its neighbours', the width of a
// hedge of one row, and the depth of a pleached tree.
constexpr float kHedgeOverlap = 1.5f, kHedge_m = 0.5f, kPanel_m = 0.5f;

// A list this long says as much as a longer one.
constexpr std::size_t kListedPlaces = 5;

// A mesh of somebody else's, scaled, turned and set on the ground.
TriangleMesh placed(TriangleMesh mesh, const ObstacleRecipe& at, const terrain::Terrain& ground) {
  const SinCos turn = sin_cos(radians(at.rotation_deg));
  const auto turned = [&](const Vec3& v) {
    return Vec3{turn.cos * v.x + turn.sin * v.z, v.y, turn.cos * v.z - turn.sin * v.x};
  };
  const Vec3 foot = to_world(at.at, at.on_ground ? ground.ground(at.at) : 0.0f);
  for (Vec3& p : mesh.positions) p = foot + turned(at.scale * p);
  for (Vec3& n : mesh.normals) n = turned(n);
  return mesh;
}

// Ids below 0, from -1 down, that no obstacle or hero tree of the recipe asks for.
class StandingIds {
 public:
  explicit StandingIds(const Recipe& recipe) {
    for (const ObstacleRecipe& o : recipe.obstacles) taken_.insert(o.id);
    for (const HeroRecipe& h : recipe.heroes) taken_.insert(h.id);
  }
  void take(std::int32_t id) { taken_.insert(id); }
  std::int32_t next() {
    while (taken_.contains(next_)) --next_;
    return next_--;
  }

 private:
  std::set<std::int32_t> taken_;
  std::int32_t next_ = -1;
};

Result<void> make_obstacles(const Recipe& recipe, scene::Document& document, std::vector<std::string>& warnings) {
  const terrain::Terrain& ground = *document.terrain;
  std::vector<scene::Obstacle> all;
  std::set<std::string> names;
  for (const ObstacleRecipe& o : recipe.obstacles) {
    const std::string ending = o.file.extension().string();
    if (!names.insert(o.name).second)
      warnings.push_back(fmt::format("two obstacles are named '{}'; files and lists will not tell them apart", o.name));
    if (o.file.empty()) {
      std::vector<Polygon> parts = untangled({o.outline, o.holes});
      if (parts.empty()) return Error{fmt::format("obstacle '{}': its outline has no area", o.name)};
      if (parts.size() > 1)
        warnings.push_back(
            fmt::format("obstacle '{}': its outline crosses itself and makes {} parts; what is inside "
                        "goes by the even-odd rule",
                        o.name, parts.size()));
      for (Polygon& part : parts) {
        all.push_back(o.low_m ? scene::extruded_between(o.name, std::move(part), *o.low_m, *o.high_m)
                              : scene::extruded(o.name, std::move(part), o.height_m, ground));
        all.back().id = 0;
      }
    } else if (ending == ".glb" || ending == ".gltf" || ending == ".obj") {
      auto mesh = read_mesh(o.file);
      if (!mesh) return Error{fmt::format("obstacle '{}': {}", o.name, mesh.error().message)};
      scene::Obstacle obstacle;
      obstacle.id = 0;  // the next one
      obstacle.name = o.name;
      obstacle.mesh = std::make_shared<const TriangleMesh>(placed(std::move(*mesh), o, ground));
      all.push_back(std::move(obstacle));
    } else {
      auto outlines = read_footprints(o.file, document.place, DVec2(recipe.size_m));
      if (!outlines) return Error{fmt::format("obstacle '{}': {}", o.name, outlines.error().message)};
      if (outlines->place) document.place = *outlines->place;
      for (const std::string& note : outlines->notes) warnings.push_back(fmt::format("{}: {}", o.file.string(), note));
      for (Footprint& f : outlines->all) {
        all.push_back(
            scene::extruded(std::move(f.name), std::move(f.outline), f.height_m.value_or(o.height_m), ground));
        all.back().id = 0;
      }
    }
    // A file of outlines, or one that crosses itself, makes several: their ids are the next ones.
    all.back().id = o.id;
    if (all.back().mesh->empty()) return Error{fmt::format("obstacle '{}': its outline has no area", all.back().name)};
  }
  StandingIds ids(recipe);
  for (scene::Obstacle& o : all)
    if (o.id >= 0) o.id = ids.next();
  document.obstacles = std::move(all);
  return {};
}

void place_heroes(const Recipe& recipe, scene::Document& document) {
  StandingIds ids(recipe);
  for (const scene::Obstacle& o : document.obstacles) ids.take(o.id);
  for (const HeroRecipe& h : recipe.heroes) {
    const std::int32_t id = h.id < 0 ? h.id : ids.next();
    document.heroes.push_back(
        {id, h.name, h.species, h.tree->key, h.at,
         std::make_shared<const growth::Skeleton>(scene::placed(h.tree->skeleton, h.scale, h.rotation_deg))});
  }
}

// Nothing is sown into buildings, nor under meshes.
distribution::Barriers barriers(const scene::Document& document) {
  distribution::Barriers out(document.terrain->size_m());
  for (const scene::Obstacle& o : document.obstacles) {
    if (o.outline) {
      out.add(*o.outline);
      continue;
    }
    const TriangleMesh& mesh = *o.mesh;
    const auto corner = [&](std::size_t i) { return to_plan(mesh.positions[mesh.indices[i]]); };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      out.add_triangle({corner(i), corner(i + 1), corner(i + 2)});
  }
  return out;
}

// A hero tree acts on what is planted as any tree of its species.
StandingTree standing(const scene::HeroTree& hero, const Planting& planting) {
  const auto species = static_cast<std::uint32_t>(hero.species);
  const std::uint64_t key = distribution::tree_key(hash_text("hero"), static_cast<std::uint64_t>(-hero.id));
  StandingTree tree = distribution::standing_tree(key, species, planting.species()[species], hero.at, 1.0f);
  if (hero.skeleton->size() > 0) tree.trunk_radius_m = hero.skeleton->radius[0];
  return tree;
}

class Planter {
 public:
  Planter(const Recipe& recipe, scene::Georeference& site, Planting& planting, std::vector<std::string>& warnings,
          Progress* progress)
      : recipe_(recipe), place_(site), planting_(planting), warnings_(warnings), progress_(progress) {}

  Result<void> plant(const PlantingRecipe& block) {
    const std::size_t first = trees.size();
    if (auto done = place(block); !done) return done;
    give_orders(block, first);
    return {};
  }

  std::vector<scene::Tree> trees;

 private:
  Result<void> place(const PlantingRecipe& block) {
    distribution::Sowing what{recipe_.document.seed, hash_text(block.name), 0, sized_mix(block)};
    const distribution::Region whole = Box2{Vec2(0.0f), recipe_.size_m};
    const distribution::Region& area = block.area ? *block.area : whole;
    switch (block.kind) {
      case PlantingKind::fill: {
        const std::size_t count =
            block.count ? *block.count : distribution::count_to_density(planting_, what, area, *block.per_hectare);
        take(block, distribution::sow(planting_, what, area, count, progress_));
        break;
      }
      case PlantingKind::thinning:
        take(block, distribution::fill_by_thinning(planting_, what, area, block.thinning, statures(), progress_));
        break;
      case PlantingKind::brush:
        take(block, distribution::sow_stroke(planting_, what, block.brush,
                                             distribution::steady_stroke(block.line, block.seconds), progress_));
        break;
      case PlantingKind::row:
      case PlantingKind::hedge:
        return plant_places(block, what, distribution::row_places(block.line, block.row), block.row.jitter_m);
      case PlantingKind::grid:
        return plant_places(block, what, distribution::grid_places(area, block.grid), block.grid.jitter_m);
      case PlantingKind::single:
        plant_single(block);
        break;
      case PlantingKind::inventory:
        return plant_inventory(block);
      case PlantingKind::trees:
        return plant_exact(block);
    }
    return {};
  }

  // Trees as a document had them, ids and keys too.
  Result<void> plant_exact(const PlantingRecipe& block) {
    auto exact = read_exact_trees(block.file, recipe_.document.species);
    if (!exact) return exact.error();
    std::set<std::int32_t> ids;
    std::set<std::uint64_t> keys;
    for (const scene::Tree& tree : trees) ids.insert(tree.id), keys.insert(tree.key);
    for (scene::Tree& tree : *exact) {
      if (!ids.insert(tree.id).second || !keys.insert(tree.key).second)
        return Error{
            fmt::format("{}: the id or key of tree {} is that of a tree planted before; put this planting first",
                        block.file.string(), tree.id)};
      StandingTree stands = distribution::standing_tree(tree.key, static_cast<std::uint32_t>(tree.species),
                                                        planting_.species()[tree.species], tree.at, tree.scale_width);
      if (tree.trunk_diameter_m) stands.trunk_radius_m = 0.5f * *tree.trunk_diameter_m;
      planting_.add(stands);
      next_id_ = std::max(next_id_, tree.id + 1);
      trees.push_back(std::move(tree));
    }
    return {};
  }

  // A clipped tree is planted at its form's size, so that hedges may stand as close as they do.
  std::vector<distribution::MixEntry> sized_mix(const PlantingRecipe& block) const {
    std::vector<distribution::MixEntry> mix = block.mix;
    if (block.order.form.clipped())
      for (distribution::MixEntry& entry : mix)
        entry.scale_min = entry.scale_max =
            scene::clipped_scale(*recipe_.document.species[entry.species], block.order.form);
    return mix;
  }

  // Status, clear stem and form of the trees from `first` on. What is to be removed makes room at once.
  void give_orders(const PlantingRecipe& block, std::size_t first) {
    const TreeOrder& order = block.order;
    for (std::size_t i = first; i < trees.size(); ++i) {
      scene::Tree& tree = trees[i];
      if (block.kind == PlantingKind::trees) break;
      if (block.kind != PlantingKind::inventory) tree.status = order.status;
      if (tree.clear_stem_m == 0.0f) tree.clear_stem_m = order.clear_stem_m;
      if (order.form.clipped())
        scene::set_form(tree, *recipe_.document.species[tree.species], form_at(block, tree.at), tree.clear_stem_m);
      if (tree.status == scene::TreeStatus::to_remove) planting_.remove(tree.key);
    }
  }

  // A block's form as it stands at a place: turned with its row, and in a hedge about the line that it follows.
  static crowns::ClippedForm form_at(const PlantingRecipe& block, Vec2 at) {
    crowns::ClippedForm form = block.order.form;
    const bool hedge = block.kind == PlantingKind::hedge && block.row.sides == distribution::RowSides::on_line;
    const bool in_row = block.kind == PlantingKind::row || block.kind == PlantingKind::hedge;
    if (form.width_m == 0.0f)
      form.width_m = in_row ? (hedge ? kHedgeOverlap : 1.0f) * block.row.spacing_m : block.grid.spacing_m;
    if (form.depth_m == 0.0f) {
      form.depth_m = form.kind == crowns::FormKind::panel ? kPanel_m : form.width_m;
      if (hedge) form.depth_m = static_cast<float>(block.row.rows - 1) * block.row.row_gap_m + kHedge_m;
    }
    if (block.kind == PlantingKind::grid) form.rotation_deg += block.grid.rotation_deg;
    if (in_row) {
      const auto [foot, along] = nearest_on_line(block.line, at);
      form.rotation_deg += degrees(atan2(along.y, along.x));
      if (hedge) form.centre = foot - at;
    }
    return form;
  }

  // The point of a polyline nearest to `p`, and the direction of the piece it lies on.
  static std::pair<Vec2, Vec2> nearest_on_line(const std::vector<Vec2>& line, Vec2 p) {
    std::pair<Vec2, Vec2> best{line.front(), {1.0f, 0.0f}};
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 piece = line[i] - line[i - 1];
      const float length2 = glm::dot(piece, piece);
      if (length2 == 0.0f) continue;
      const Vec2 foot = line[i - 1] + std::clamp(glm::dot(p - line[i - 1], piece) / length2, 0.0f, 1.0f) * piece;
      const float distance2 = glm::dot(p - foot, p - foot);
      if (distance2 < least) least = distance2, best = {foot, piece};
    }
    return best;
  }

  scene::Tree& add(const StandingTree& standing) {
    scene::Tree& tree = trees.emplace_back();
    tree.id = next_id_++;
    tree.key = standing.key;
    tree.species = standing.species;
    tree.at = standing.at;
    tree.scale_height = tree.scale_width = standing.scale;
    return tree;
  }

  void take(const PlantingRecipe& block, const distribution::Sown& sown) {
    for (const StandingTree& tree : sown.trees) add(tree);
    if (sown.no_room)
      warnings_.push_back(fmt::format("planting '{}': room for only {} of {} trees; the rest was left out", block.name,
                                      sown.trees.size(), sown.asked));
  }

  void take(const PlantingRecipe& block, const distribution::Thinned& thinned) {
    for (const StandingTree& tree : thinned.trees) add(tree);
    if (thinned.trees.empty() && thinned.seedlings == 0)
      warnings_.push_back(fmt::format("planting '{}': no seedling found ground to grow on", block.name));
    else if (thinned.trees.empty())
      warnings_.push_back(fmt::format("planting '{}': none of {} seedlings reached least_scale = {:g} in {} years",
                                      block.name, thinned.seedlings, block.thinning.least_scale, block.thinning.years));
  }

  // How self-thinning sees the species: with their crowns in the open, growing as their heights do.
  std::vector<distribution::Stature> statures() const {
    std::vector<distribution::Stature> out;
    for (const auto& s : recipe_.document.species)
      out.push_back({0.5f * s->shape.crown_width_m, s->growth.age_rate_per_year, s->growth.age_shape});
    return out;
  }

  void take(const PlantingRecipe& block, const distribution::Planted& planted) {
    for (const StandingTree& tree : planted.trees) add(tree);
    if (planted.left_out.empty()) return;
    std::string places;
    for (std::size_t i = 0; i < std::min(kListedPlaces, planted.left_out.size()); ++i) {
      const distribution::LeftOut& out = planted.left_out[i];
      places += fmt::format("{}({:.1f}, {:.1f}) {}", i ? ", " : "", out.at.x, out.at.y, distribution::words(out.why));
    }
    if (planted.left_out.size() > kListedPlaces)
      places += fmt::format(" and {} more", planted.left_out.size() - kListedPlaces);
    warnings_.push_back(fmt::format("planting '{}': {} of {} places left out: {}", block.name, planted.left_out.size(),
                                    planted.left_out.size() + planted.trees.size(), places));
  }

  Result<void> plant_places(const PlantingRecipe& block, const distribution::Sowing& what,
                            const Result<std::vector<Vec2>>& places, float jitter_m) {
    if (!places)
      return Error{fmt::format("{}: planting '{}': {}", recipe_.file.string(), block.name, places.error().message)};
    take(block, distribution::plant_at(planting_, what, *places, jitter_m));
    return {};
  }

  void plant_single(const PlantingRecipe& block) {
    const std::uint64_t key = distribution::tree_key(hash_text(block.name), 0);
    const std::uint32_t species = block.mix.front().species;
    const float scale = block.order.form.clipped()
                            ? scene::clipped_scale(*recipe_.document.species[species], block.order.form)
                            : block.scale;
    const auto refusal = distribution::plant_one(planting_, key, species, block.at, scale);
    // A tree that is set into a building by hand stays, and is warned about when the space is divided.
    // So does one that stands there already, on what is a lawn or will be a path.
    const bool in_building =
        refusal == distribution::Refusal::built_over ||
        (block.order.status != scene::TreeStatus::proposed && refusal == distribution::Refusal::excluded);
    if (in_building)
      planting_.add(distribution::standing_tree(key, species, planting_.species()[species], block.at, scale));
    if (refusal == distribution::Refusal::none || in_building)
      add(*planting_.find(key));
    else
      warnings_.push_back(fmt::format("planting '{}': left out at ({:.1f}, {:.1f}): {}", block.name, block.at.x,
                                      block.at.y, distribution::words(refusal)));
  }

  Result<void> plant_inventory(const PlantingRecipe& block) {
    TreeImport import = block.import;
    import.reading.site = place_;
    import.reading.size_m = DVec2(recipe_.size_m);
    import.status = block.order.status;
    auto read = read_trees(block.file, import, recipe_.document.seed, recipe_.document.species, block.default_species);
    if (!read) return read.error();
    warnings_.insert(warnings_.end(), read->warnings.begin(), read->warnings.end());
    if (read->place) adopt(*read->place);
    for (std::size_t i = 0; i < read->trees.size(); ++i) {
      planting_.add(read->standing[i]);
      read->trees[i].id = next_id_++;
      trees.push_back(std::move(read->trees[i]));
    }
    return {};
  }

  // A file that knows where it is tells the site, but for the sun's place where the recipe gives one.
  void adopt(const scene::Georeference& place) {
    const scene::Georeference nowhere;
    const bool said = place_.latitude_deg != nowhere.latitude_deg || place_.longitude_deg != nowhere.longitude_deg;
    place_.south_west = place.south_west;
    place_.crs_wkt = place.crs_wkt;
    if (!said) place_.latitude_deg = place.latitude_deg, place_.longitude_deg = place.longitude_deg;
  }

  const Recipe& recipe_;
  scene::Georeference& place_;  // of the document
  Planting& planting_;
  std::vector<std::string>& warnings_;
  std::int32_t next_id_ = 1;
  Progress* progress_;
};

}  // namespace

Result<BuiltRecipe> build_document(const Recipe& written, Progress* progress) {
  Recipe recipe = written;
  BuiltRecipe built;
  built.document = recipe.document;
  scene::Document& document = built.document;

  Stopwatch watch;
  auto ground = make_ground(recipe.ground, recipe.size_m, document.place, document.seed);
  if (!ground) return ground.error();
  built.warnings = std::move(ground->warnings);
  recipe.size_m = ground->terrain.size_m();
  document.place = ground->place;
  document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground->terrain));
  if (auto done = make_obstacles(recipe, document, built.warnings); !done)
    return Error{fmt::format("{}: {}", recipe.file.string(), done.error().message)};
  place_heroes(recipe, document);
  built.seconds["terrain"] = watch.restart();

  if (progress) progress->begin("planting", 0);
  auto planting = Planting::make(*document.terrain, scene::planting_species(document), recipe.interactions, 0.0f,
                                 barriers(document));
  if (!planting) return Error{fmt::format("{}: {}", recipe.file.string(), planting.error().message)};
  for (const scene::HeroTree& hero : document.heroes) planting->add(standing(hero, *planting));
  Planter planter(recipe, document.place, *planting, built.warnings, progress);
  for (const PlantingRecipe& block : recipe.plantings) {
    if (auto done = planter.plant(block); !done) return done.error();
    if (progress && progress->cancelled()) return cannot_finish("cancelled; nothing was written");
  }
  document.trees = std::make_shared<const scene::Trees>(std::move(planter.trees));
  if (document.trees->empty() && !recipe.plantings.empty())
    return Error{fmt::format("{}: no tree could be planted{}{}", recipe.file.string(),
                             built.warnings.empty() ? "" : ": ", built.warnings.empty() ? "" : built.warnings.back())};
  built.seconds["distribution"] = watch.restart();

  if (recipe.layers > 0) {
    float tallest = 0;
    for (const scene::Tree& tree : *document.trees) tallest = std::max(tallest, document.mature_height_m(tree));
    document.space.layer_m = std::max(0.05f, tallest / static_cast<float>(recipe.layers));
  }
  for (const CameraRecipe& camera : recipe.cameras) {
    auto place = [&](const Vec3& p) {
      const Vec2 plan{p.x, p.y};
      if (!camera.on_ground) return to_world(plan, p.z);
      float ground_y = document.terrain->ground(plan);
      if (const auto water = document.terrain->water_level(plan)) ground_y = std::max(ground_y, *water);
      return to_world(plan, ground_y + p.z);
    };
    document.cameras.push_back({camera.name, place(camera.eye), place(camera.target), camera.vertical_fov_deg});
  }
  if (const FromWorldFile wanted = recipe.underlay_from_world_file; wanted.width) {
    const DVec2 size(document.terrain->size_m());
    if (auto laid = lay_by_world_file(document.underlay, wanted, document.place, size, built.warnings); !laid)
      return Error{fmt::format("{}: [underlay] {}", recipe.file.string(), laid.error().message)};
  }
  // Only plan sheets need it, and those refuse to be drawn without.
  if (std::error_code ec; !document.underlay.file.empty() && !std::filesystem::exists(document.underlay.file, ec))
    built.warnings.push_back(fmt::format("{}: [underlay] there is no file {}; no plan sheet can be drawn without it",
                                         recipe.file.string(), document.underlay.file));
  const Vec2 size = document.terrain->size_m();
  for (const scene::Figure& figure : recipe.figures)
    if (!terrain::on_site(*document.terrain, figure.at))
      return Error{
          fmt::format("{}: [[figure]] at [{:g}, {:g}] lies outside the site, which is {:g} m east by {:g} m north",
                      recipe.file.string(), figure.at.x, figure.at.y, size.x, size.y)};
  document.figures = recipe.figures;
  document.interactions = recipe.interactions;
  scene::settle_counters(document);
  // What was given once stays given, though it be gone.
  document.next_tree_id = std::max(document.next_tree_id, recipe.counters.tree);
  document.next_standing_id = std::min(document.next_standing_id, recipe.counters.standing);
  document.next_block = std::max(document.next_block, recipe.counters.block);
  return built;
}

}  // namespace bosquet::exchange
