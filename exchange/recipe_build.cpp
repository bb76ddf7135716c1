#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/hash.h"
#include "core/stopwatch.h"
#include "distribution/inventory.h"
#include "distribution/planting.h"
#include "exchange/elevation.h"
#include "exchange/footprints.h"
#include "exchange/mesh_file.h"
#include "exchange/recipe.h"
#include "geometry/prism.h"
#include "scene/clipped_tree.h"
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

Result<terrain::Terrain> make_ground(const Recipe& recipe, scene::Georeference& place,
                                     std::vector<std::string>& warnings) {
  const GroundRecipe& ground = recipe.ground;
  auto lattice = terrain::make_lattice(recipe.size_m);
  if (!lattice) return lattice.error();

  terrain::Terrain site;
  site.height = terrain::Heightfield(*lattice);
  site.exclusion = terrain::Mask(*lattice, 0.0f);
  site.density = terrain::Mask(*lattice, 1.0f);
  if (!ground.dem.empty()) {
    auto raster = read_elevation(ground.dem);
    if (!raster) return raster.error();
    // Without a corner the site's middle is the raster's, so a site as large as the raster fits it whatever its origin.
    DVec2 corner = ground.dem_south_west;
    if (!ground.dem_corner_given)
      corner = 0.5 * (raster->low_corner() + raster->high_corner()) - 0.5 * DVec2(recipe.size_m);
    auto heights = heights_at_corners(*raster, corner, lattice->cells.x, lattice->cells.y,
                                      static_cast<double>(lattice->cell_m), DVec2(recipe.size_m));
    if (!heights) return heights.error();
    auto field = terrain::Heightfield::from_samples(*lattice, *heights);
    if (!field) return field.error();
    site.height = std::move(*field);
    place.south_west = corner;
    place.crs_wkt = raster->crs_wkt;
    if (raster->filled > 0)
      warnings.push_back(fmt::format("{}: {} cells without data were filled from their surroundings",
                                     ground.dem.string(), raster->filled));
    if (raster->reprojected) warnings.push_back(fmt::format("{}: reprojected to local metres", ground.dem.string()));
  }
  if (ground.noise.amplitude_m > 0.0f)
    site.height = terrain::with_noise(site.height, ground.noise, recipe.document.seed);
  for (terrain::Stroke stroke : ground.strokes) {
    stroke.seed += recipe.document.seed;
    site = terrain::apply(site, stroke);
  }
  site.water_level_m = ground.water_level_m;
  for (const auto& [name, area] : ground.exclusions) site = terrain::exclude(site, area);
  for (const PathArea& path : ground.paths) site = terrain::exclude_path(site, path.points, path.width_m);
  return site;
}

// Walls go down to the lowest ground at the outline, and so much farther; heights count from the mean of it.
constexpr float kFoundation_m = 0.3f;

scene::Obstacle extruded(std::string name, Polygon outline, float height_m, const terrain::Terrain& ground) {
  float lowest = ground.ground(outline.ring.front()), sum = 0;
  for (Vec2 p : outline.ring) lowest = std::min(lowest, ground.ground(p)), sum += ground.ground(p);
  scene::Obstacle out;
  out.name = std::move(name);
  out.low_y = lowest - kFoundation_m;
  out.high_y = sum / static_cast<float>(outline.ring.size()) + height_m;
  out.mesh = std::make_shared<const TriangleMesh>(geometry::prism(outline, out.low_y, out.high_y));
  out.outline = std::make_shared<const Polygon>(std::move(outline));
  return out;
}

// A mesh of somebody else's, scaled, turned and set on the ground.
TriangleMesh placed(TriangleMesh mesh, const ObstacleRecipe& at, const terrain::Terrain& ground) {
  const SinCos turn = sin_cos(radians(at.rotation_deg));
  const auto turned = [&](const Vec3& v) {
    return Vec3{turn.cos * v.x + turn.sin * v.z, v.y, turn.cos * v.z - turn.sin * v.x};
  };
  const Vec3 foot = to_world(at.at, ground.ground(at.at));
  for (Vec3& p : mesh.positions) p = foot + turned(at.scale * p);
  for (Vec3& n : mesh.normals) n = turned(n);
  return mesh;
}

Result<void> make_obstacles(const Recipe& recipe, scene::Document& document, std::vector<std::string>& warnings) {
  const terrain::Terrain& ground = *document.terrain;
  std::vector<scene::Obstacle> all;
  for (const ObstacleRecipe& o : recipe.obstacles) {
    const std::string ending = o.file.extension().string();
    if (o.file.empty()) {
      all.push_back(extruded(o.name, {o.outline, {}}, o.height_m, ground));
    } else if (ending == ".glb" || ending == ".gltf" || ending == ".obj") {
      auto mesh = read_mesh(o.file);
      if (!mesh) return Error{fmt::format("obstacle '{}': {}", o.name, mesh.error().message)};
      scene::Obstacle obstacle;
      obstacle.name = o.name;
      obstacle.mesh = std::make_shared<const TriangleMesh>(placed(std::move(*mesh), o, ground));
      all.push_back(std::move(obstacle));
    } else {
      auto outlines = read_footprints(o.file, document.place.south_west);
      if (!outlines) return Error{fmt::format("obstacle '{}': {}", o.name, outlines.error().message)};
      for (const std::string& note : outlines->notes) warnings.push_back(fmt::format("{}: {}", o.file.string(), note));
      for (Footprint& f : outlines->all)
        all.push_back(extruded(std::move(f.name), std::move(f.outline), f.height_m.value_or(o.height_m), ground));
    }
    if (all.back().mesh->empty()) return Error{fmt::format("obstacle '{}': its outline has no area", all.back().name)};
  }
  for (std::size_t n = 0; n < all.size(); ++n) all[n].id = -1 - static_cast<std::int32_t>(n);
  document.obstacles = std::move(all);
  return {};
}

void place_heroes(const Recipe& recipe, scene::Document& document) {
  for (const HeroRecipe& h : recipe.heroes) {
    const auto id = -1 - static_cast<std::int32_t>(document.obstacles.size() + document.heroes.size());
    document.heroes.push_back(
        {id, h.name, h.species, h.tree->key, h.at,
         std::make_shared<const growth::Skeleton>(scene::placed(h.tree->skeleton, h.scale, h.rotation_deg))});
  }
}

std::vector<distribution::Species> planting_species(const scene::Document& document) {
  std::vector<distribution::Species> species;
  for (const auto& s : document.species) species.push_back({s->name, s->shape.trunk_width_m, s->planting});
  return species;
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
  Planter(const Recipe& recipe, Planting& planting, std::vector<std::string>& warnings, Progress* progress)
      : recipe_(recipe), planting_(planting), warnings_(warnings), progress_(progress) {}

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
      if (tree.status == scene::TreeStatus::proposed) tree.status = order.status;
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
    tree.id = static_cast<std::int32_t>(trees.size());
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
    const bool in_building = refusal == distribution::Refusal::built_over;
    if (in_building)
      planting_.add(distribution::standing_tree(key, species, planting_.species()[species], block.at, scale));
    if (refusal == distribution::Refusal::none || in_building)
      add(*planting_.find(key));
    else
      warnings_.push_back(fmt::format("planting '{}': left out at ({:.1f}, {:.1f}): {}", block.name, block.at.x,
                                      block.at.y, distribution::words(refusal)));
  }

  Result<void> plant_inventory(const PlantingRecipe& block) {
    InventoryOptions options;
    options.columns = block.columns;
    options.south_west = block.south_west;
    options.size_m = DVec2(recipe_.size_m);
    auto inventory = read_inventory(block.file, options);
    if (!inventory) return inventory.error();
    const std::string file = block.file.string();
    for (const std::string& note : inventory->notes) warnings_.push_back(fmt::format("{}: {}", file, note));
    for (const std::string& line : problem_lines(inventory->problems, file)) warnings_.push_back(line);

    const scene::Document& document = recipe_.document;
    std::map<std::string, std::pair<std::size_t, std::size_t>> substitutions;  // name -> species, count
    std::vector<scene::Tree> sized;
    std::vector<StandingTree> standing;
    for (std::size_t i = 0; i < inventory->trees.size(); ++i) {
      const InventoryTree& row = inventory->trees[i];
      const scene::SpeciesMatch match = scene::match_species(row.species, document.species, block.default_species);
      const scene::Species& species = *document.species[match.species];
      if (match.how != scene::NameMatch::exact) {
        auto& [index, count] = substitutions[row.species];
        index = match.species, ++count;
      }
      scene::Tree tree;
      tree.key = distribution::tree_key(hash_text(block.name), i);
      tree.species = match.species;
      const Vec2 range = scale_range(block, match.species);
      RandomStream stream(document.seed, tree.key, Purpose::scale);
      tree.scale_height = tree.scale_width = stream.uniform(range.x, range.y);
      if (row.height_m || row.trunk_diameter_m || row.crown_diameter_m)
        scene::set_measured_size(tree, species, row.height_m, row.trunk_diameter_m, row.crown_diameter_m);
      tree.inventory_name = row.species;
      tree.inventory_id = row.id;
      StandingTree stands =
          distribution::standing_tree(tree.key, static_cast<std::uint32_t>(tree.species),
                                      planting_.species()[tree.species], Vec2(row.plan), tree.scale_width);
      if (tree.trunk_diameter_m) stands.trunk_radius_m = 0.5f * *tree.trunk_diameter_m;
      sized.push_back(std::move(tree));
      standing.push_back(stands);
    }

    for (const auto& moved : distribution::move_duplicates_apart(standing, recipe_.size_m))
      warnings_.push_back(fmt::format("{}:{}: same place as line {}; moved from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f})",
                                      file, inventory->trees[moved.index].line, inventory->trees[moved.twin].line,
                                      moved.from.x, moved.from.y, moved.to.x, moved.to.y));
    for (const auto& [name, use] : substitutions)
      warnings_.push_back(fmt::format("{}: '{}' is not a known species; {} trees are planted as {}", file,
                                      name.empty() ? "(no name)" : name, use.second,
                                      document.species[use.first]->name));
    for (std::size_t i = 0; i < sized.size(); ++i) {
      planting_.add(standing[i]);
      sized[i].at = standing[i].at;
      sized[i].id = static_cast<std::int32_t>(trees.size() + 1);
      trees.push_back(std::move(sized[i]));
    }
    return {};
  }

  Vec2 scale_range(const PlantingRecipe& block, std::size_t species) const {
    for (const distribution::MixEntry& entry : block.mix)
      if (entry.species == species && entry.scale_max > 0) return {entry.scale_min, entry.scale_max};
    const distribution::PlantingRules& rules = recipe_.document.species[species]->planting;
    return {rules.scale_min, rules.scale_max};
  }

  const Recipe& recipe_;
  Planting& planting_;
  std::vector<std::string>& warnings_;
  Progress* progress_;
};

}  // namespace

Result<BuiltRecipe> build_document(const Recipe& recipe, Progress* progress) {
  BuiltRecipe built;
  built.document = recipe.document;
  scene::Document& document = built.document;

  Stopwatch watch;
  auto ground = make_ground(recipe, document.place, built.warnings);
  if (!ground) return ground.error();
  document.terrain = std::make_shared<const terrain::Terrain>(std::move(*ground));
  if (auto done = make_obstacles(recipe, document, built.warnings); !done)
    return Error{fmt::format("{}: {}", recipe.file.string(), done.error().message)};
  place_heroes(recipe, document);
  built.seconds["terrain"] = watch.restart();

  if (progress) progress->begin("planting", 0);
  auto planting =
      Planting::make(*document.terrain, planting_species(document), recipe.interactions, 0.0f, barriers(document));
  if (!planting) return Error{fmt::format("{}: {}", recipe.file.string(), planting.error().message)};
  for (const scene::HeroTree& hero : document.heroes) planting->add(standing(hero, *planting));
  Planter planter(recipe, *planting, built.warnings, progress);
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
      float ground_y = document.terrain->ground(plan);
      if (document.terrain->water_level_m) ground_y = std::max(ground_y, *document.terrain->water_level_m);
      return to_world(plan, ground_y + p.z);
    };
    document.cameras.push_back({camera.name, place(camera.eye), place(camera.target), camera.vertical_fov_deg});
  }
  document.interactions = recipe.interactions;
  scene::settle_counters(document);
  return built;
}

}  // namespace bosquet::exchange
