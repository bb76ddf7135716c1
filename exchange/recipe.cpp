#include "exchange/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "exchange/reference_system.h"
#include "exchange/site_frame.h"
#include "scene/species_names.h"
#include "scene/toml_table.h"

namespace bosquet::exchange {
namespace {

using scene::TomlTable;

// What decides a site's extent: less than a tree's footing, or more than a country's width, is a mistake.
constexpr double kLeastSite_m = 1.0, kMostSite_m = 200'000.0;
constexpr std::int64_t kMostTrees = 10'000'000;

class Reader {
 public:
  Reader(const std::filesystem::path& file, Recipe& recipe) : folder_(file.parent_path()), recipe_(recipe) {}

  Result<void> read(TomlTable& root, std::optional<std::uint64_t> seed) {
    read_site(root);
    if (seed) recipe_.document.seed = *seed;
    if (auto table = root.table("terrain")) read_ground(*table, folder_, recipe_.ground);
    if (recipe_.size_m == Vec2(0.0f) && !recipe_.ground.has_extent())
      root.error("site", "size_m = [east, north] in metres is missing in [site]");
    if (auto read = read_species(root); !read) return read;
    for (TomlTable& table : root.tables("interaction")) read_interaction(table);
    for (TomlTable& table : root.tables("planting")) read_planting(table);
    if (auto table = root.table("space")) read_space(*table);
    if (auto table = root.table("asymmetry")) describe(recipe_.document.asymmetry, *table), table->finish();
    if (auto table = root.table("light")) describe(recipe_.document.light, *table), table->finish();
    for (TomlTable& table : root.tables("obstacle")) read_obstacle(table);
    for (TomlTable& table : root.tables("hero"))
      if (auto read = read_hero(table); !read) return read;
    for (TomlTable& table : root.tables("camera")) read_camera(table);
    for (TomlTable& table : root.tables("figure")) read_figure(table);
    if (auto table = root.table("sun")) read_sun(*table);
    if (auto table = root.table("clearance")) describe(recipe_.document.clearance, *table), table->finish();
    if (auto table = root.table("plan")) describe(recipe_.document.plan, *table), table->finish();
    if (auto table = root.table("ground_cover")) describe(recipe_.document.ground_cover, *table), table->finish();
    if (auto table = root.table("underlay")) read_underlay(*table);
    for (TomlTable& table : root.tables("species_bar")) read_species_bar(table);
    if (auto table = root.table("counters")) read_counters(*table);
    if (auto table = root.table("export")) {
      if (auto n = table->integer("max_triangles", 0, 1'000'000'000))
        recipe_.document.max_triangles = static_cast<std::size_t>(*n);
      table->finish();
    }
    root.finish();
    return {};
  }

 private:
  void read_site(TomlTable& root) {
    auto site = root.table("site");
    if (!site) return root.error("site", "the table [site] with size_m = [east, north] is missing");
    if (auto size = site->numbers("size_m", 2)) {
      for (double side : *size)
        if (!(side >= kLeastSite_m && side <= kMostSite_m))
          site->error("size_m", fmt::format("size_m = [{:g}, {:g}] is no site; each side must be {:g} to {:g} m",
                                            (*size)[0], (*size)[1], kLeastSite_m, kMostSite_m));
      recipe_.size_m = {static_cast<float>((*size)[0]), static_cast<float>((*size)[1])};
    }
    read_site_ground(*site, folder_, recipe_.ground);
    if (auto seed = site->natural("seed")) recipe_.document.seed = *seed;
    scene::Georeference& place = recipe_.document.place;
    place.latitude_deg = site->number("latitude_deg", -90, 90).value_or(place.latitude_deg);
    place.longitude_deg = site->number("longitude_deg", -180, 180).value_or(place.longitude_deg);
    if (auto corner = site->numbers("south_west", 2)) place.south_west = {(*corner)[0], (*corner)[1]};
    if (auto crs = site->text("crs")) {
      auto wkt = reference_system(*crs);
      if (!wkt)
        site->error("crs", wkt.error().message);
      else if (const SystemFacts facts = system_facts(*wkt);
               facts.geographic || std::abs(facts.metres_per_unit - 1) > 1e-9)
        site->error("crs",
                    fmt::format("{} is no plane in metres; give one of your region, like EPSG:25832", facts.name));
      else
        place.crs_wkt = std::move(*wkt);
    }
    site->finish();
  }

  // Species named by the recipe, with overrides, come first; built-in ones join when a planting names them.
  Result<void> read_species(TomlTable& root) {
    for (TomlTable& table : root.tables("species")) {
      scene::Species species;
      const auto name = table.text("name");
      if (auto file = table.text("file")) {
        auto read = scene::read_species_file(folder_ / *file);
        if (!read) return read.error();
        species = std::move(*read);
        species.derived = table.boolean("derived").value_or(false);
        if (name) species.name = *name;
      } else {
        if (!name) table.error("", "a [[species]] needs a name, or a file");
        // `like` names the species to start from; a name of its own makes a new one.
        const std::string base = table.text("like").value_or(name.value_or(""));
        auto builtin = scene::builtin_species(base);
        if (!builtin) {
          table.error(table.has("like") ? "like" : "name", builtin.error().message);
          continue;
        }
        species = std::move(*builtin);
        species.derived = table.has("like");
        species.name = name.value_or(species.name);
      }
      scene::read_species_tables(table, species);
      table.finish();
      if (auto fine = growth::check(species.growth, fmt::format("species {}", species.name)); !fine)
        table.error("growth", fine.error().message);
      if (species.shape.trunk_height_m >= species.shape.mature_height_m)
        table.error("shape", fmt::format("species {}: trunk_height_m = {:g} must be below mature_height_m = {:g}",
                                         species.name, species.shape.trunk_height_m, species.shape.mature_height_m));
      if (find_species(species.name)) table.error("name", fmt::format("species '{}' is given twice", species.name));
      recipe_.document.species.push_back(std::make_shared<const scene::Species>(std::move(species)));
    }
    return {};
  }

  std::optional<std::size_t> find_species(std::string_view name) const {
    const auto& all = recipe_.document.species;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i]->name == name) return i;
    return {};
  }

  // A species by name: the recipe's own, else a built-in one.
  std::optional<std::size_t> species(TomlTable& table, std::string_view key, const std::string& name) {
    if (auto found = find_species(name)) return found;
    auto builtin = scene::builtin_species(name);
    if (!builtin) {
      table.error(key, builtin.error().message);
      return {};
    }
    recipe_.document.species.push_back(std::make_shared<const scene::Species>(std::move(*builtin)));
    return recipe_.document.species.size() - 1;
  }

  void read_interaction(TomlTable& table) {
    distribution::Interaction interaction;
    describe(interaction, table);
    for (const char* key : {"of", "on"}) {
      if (!table.has(key))
        table.error("", fmt::format("[[interaction]] needs '{}', a species' name", key));
      else
        species(table, key, std::string(key) == "of" ? interaction.of : interaction.on);
    }
    table.finish();
    recipe_.interactions.push_back(std::move(interaction));
  }

  void read_planting(TomlTable& table) {
    PlantingRecipe planting;
    table(Choice{"kind", kPlantingKindNames, "How the trees are placed"}, planting.kind);
    planting.name = table.text("name").value_or(fmt::format("planting {}", recipe_.plantings.size() + 1));
    if (!names_.insert(planting.name).second)
      table.error("name", fmt::format("two plantings are named '{}'; each needs a name of its own, for its trees' keys",
                                      planting.name));

    const auto scale =
        table.has("scale") && planting.kind != PlantingKind::single ? table.numbers("scale", 2) : std::nullopt;
    if (scale && !((*scale)[0] >= 0.02 && (*scale)[0] <= (*scale)[1] && (*scale)[1] <= 4))
      table.error("scale",
                  fmt::format("scale = [{:g}, {:g}] must be [smallest, largest], 0.02 to 4", (*scale)[0], (*scale)[1]));
    double total = 0;
    if (auto weights = table.weights("species")) {
      for (const auto& [name, weight] : *weights) {
        const auto index = species(table, "species", name);
        if (!index) continue;
        total += weight;
        planting.mix.push_back({static_cast<std::uint32_t>(*index), static_cast<float>(weight),
                                scale ? static_cast<float>((*scale)[0]) : 0.0f,
                                scale ? static_cast<float>((*scale)[1]) : 0.0f});
      }
      if (total == 0) table.error("species", "the shares of the species are all zero");
    } else if (planting.kind != PlantingKind::inventory && planting.kind != PlantingKind::trees &&
               !table.has("species")) {
      table.error("", "species = { english_oak = 1 } is missing in [[planting]]");
    }

    switch (planting.kind) {
      case PlantingKind::fill: {
        read_area(table, planting);
        if (auto count = table.integer("count", 0, kMostTrees)) planting.count = static_cast<std::size_t>(*count);
        if (auto density = table.number("density_per_ha", 0, 1e6)) planting.per_hectare = static_cast<float>(*density);
        if (table.has("count") == table.has("density_per_ha"))
          table.error("", "a fill needs either count or density_per_ha");
        break;
      }
      case PlantingKind::thinning:
        describe(planting.thinning, table);
        read_area(table, planting);
        if (const double seedlings =
                seedlings_in_all(planting.area.value_or(Box2{Vec2(0.0f), recipe_.size_m}), planting.thinning);
            seedlings > distribution::kMostSeedlings)
          table.error("seedlings_per_ha", fmt::format("the area would get {:.0f} seedlings in all; {:.0f} are allowed",
                                                      seedlings, distribution::kMostSeedlings));
        break;
      case PlantingKind::brush:
        describe(planting.brush, table);
        planting.line = required_points(table, "points");
        planting.seconds = static_cast<float>(table.number("seconds", 0.02, 3600).value_or(2.0));
        if (const distribution::PlantBrush& b = planting.brush;
            static_cast<double>(b.rate * b.strength * b.radius_m * b.radius_m * planting.seconds) > kMostTrees)
          table.error("points", fmt::format("the brush would plant more than {} trees; lower rate, radius_m or seconds",
                                            kMostTrees));
        break;
      case PlantingKind::hedge:
        planting.row = distribution::hedge_rules();
        [[fallthrough]];
      case PlantingKind::row:
        describe(planting.row, table);
        planting.line = required_points(table, "points");
        if (planting.line.size() < 2) table.error("points", "a row needs at least two points");
        break;
      case PlantingKind::grid:
        describe(planting.grid, table);
        read_area(table, planting);
        break;
      case PlantingKind::single: {
        if (auto at = table.numbers("at", 2))
          planting.at = {static_cast<float>((*at)[0]), static_cast<float>((*at)[1])};
        else if (!table.has("at"))
          table.error("", "a single tree needs at = [east, north]");
        planting.scale = static_cast<float>(table.number("scale", 0.02, 4).value_or(1.0));
        if (planting.mix.size() > 1) table.error("species", "a single tree is of one species");
        break;
      }
      case PlantingKind::inventory:
        read_inventory_block(table, planting, scale);
        break;
      case PlantingKind::trees:
        if (auto file = table.text("file"))
          planting.file = folder_ / *file;
        else if (!table.has("file"))
          table.error("", "trees need file = \"trees.csv\", a table that bosquet wrote");
        break;
    }
    read_order(table, planting);
    table.finish();
    recipe_.plantings.push_back(std::move(planting));
  }

  // Status, clear stem and clipped form.
  void read_order(TomlTable& table, PlantingRecipe& planting) {
    TreeOrder& order = planting.order;
    if (planting.kind == PlantingKind::inventory) order.status = scene::TreeStatus::existing;
    describe(order, table);
    crowns::ClippedForm& form = order.form;
    if (!form.clipped()) {
      for (const char* key : {"form_width_m", "form_depth_m", "form_height_m", "form_rotation_deg"})
        if (table.has(key)) table.error(key, fmt::format("{} needs form = \"box\" or another body beside it", key));
      return;
    }
    constexpr float kLeastBody_m = 0.1f;
    if (table.has("scale")) table.error("scale", "a clipped tree is as large as its form; leave scale out");
    if (!(form.height_m >= order.clear_stem_m + kLeastBody_m))
      table.error(table.has("form_height_m") ? "form_height_m" : "form",
                  fmt::format("a clipped form needs form_height_m, at least {:g} m above its underside, clear_stem_m = "
                              "{:g}",
                              kLeastBody_m, order.clear_stem_m));
    const bool in_rows = planting.kind == PlantingKind::row || planting.kind == PlantingKind::hedge ||
                         planting.kind == PlantingKind::grid;
    if (form.width_m < kLeastBody_m && (!in_rows || table.has("form_width_m")))
      table.error(table.has("form_width_m") ? "form_width_m" : "form",
                  fmt::format("a clipped form needs form_width_m, {:g} m or more", kLeastBody_m));
    if (table.has("form_depth_m") && form.depth_m < kLeastBody_m)
      table.error("form_depth_m", fmt::format("a clipped form is {:g} m or more across", kLeastBody_m));
  }

  void read_area(TomlTable& table, PlantingRecipe& planting) {
    if (auto ring = table.points("polygon")) {
      if (ring->size() < 3) table.error("polygon", "a polygon needs at least three points");
      planting.area = Polygon{std::move(*ring), {}};
    } else if (auto centre = table.numbers("centre", 2)) {
      const auto radius = table.number("radius_m", 0.1, kMostSite_m);
      if (!table.has("radius_m")) table.error("centre", "centre needs radius_m beside it");
      planting.area = distribution::Disc{{static_cast<float>((*centre)[0]), static_cast<float>((*centre)[1])},
                                         static_cast<float>(radius.value_or(1.0))};
    }
  }

  void read_inventory_block(TomlTable& table, PlantingRecipe& planting,
                            const std::optional<std::vector<double>>& scale) {
    if (auto file = table.text("file"))
      planting.file = folder_ / *file;
    else if (!table.has("file"))
      table.error("", "an inventory needs file = \"trees.csv\", or .geojson .gpkg .shp .dxf");
    TreeImport& import = planting.import;
    import.block = planting.name;
    if (auto columns = table.table("columns")) {
      for (std::size_t f = 0; f < kInventoryFields; ++f)
        if (auto text = columns->text(kInventoryFieldNames[f]))
          import.reading.columns[static_cast<InventoryField>(f)] = *text;
      columns->finish();
    }
    if (auto units = table.table("units")) {
      InventoryUnits& u = import.reading.units;
      for (auto [key, value] : {std::pair{"position", &u.position},
                                {"height", &u.height},
                                {"trunk_diameter", &u.trunk_diameter},
                                {"crown_diameter", &u.crown_diameter},
                                {"clear_stem", &u.clear_stem}})
        if (auto text = units->text(key)) {
          if (!metres_of_unit(*text))
            units->error(key, fmt::format("{} = \"{}\" must be one of m, cm, mm, in, ft", key, *text));
          *value = *text;
        }
      units->finish();
    }
    if (auto crs = table.text("crs")) {
      import.reading.crs = *crs;
      if (auto known = reference_system(*crs); !known) table.error("crs", known.error().message);
    }
    if (auto layer = table.text("layer")) import.reading.layer = *layer;
    if (auto synonyms = table.text("synonyms")) import.synonyms = folder_ / *synonyms;
    if (auto corner = table.numbers("south_west", 2)) import.reading.south_west = DVec2((*corner)[0], (*corner)[1]);
    if (scale) import.scale = Vec2{static_cast<float>((*scale)[0]), static_cast<float>((*scale)[1])};
    const std::string fallback = table.text("default_species").value_or("english_oak");
    if (auto index = species(table, "default_species", fallback)) planting.default_species = *index;
    // An inventory may name any built-in species, so all of them are known from here on.
    for (const std::string& name : scene::builtin_species_names()) species(table, "default_species", name);
  }

  void read_space(TomlTable& table) {
    describe(recipe_.document.space, table);
    if (auto layers = table.integer("layers", 1, 10000)) {
      recipe_.layers = static_cast<int>(*layers);
      if (table.has("layer_m")) table.error("layers", "give either layers or layer_m");
    }
    table.finish();
  }

  void read_obstacle(TomlTable& table) {
    ObstacleRecipe obstacle;
    obstacle.name = table.text("name").value_or(fmt::format("obstacle {}", recipe_.obstacles.size() + 1));
    if (auto file = table.text("file")) {
      if (file->empty()) table.error("file", "needs the name of a .glb, .gltf, .obj or outline file");
      obstacle.file = folder_ / *file;
    }
    if (auto ring = table.points("polygon")) {
      if (ring->size() < 3) table.error("polygon", "a polygon needs at least three points");
      for (const Vec2& p : *ring)
        if (std::fabs(p.x) > kFarthest_m || std::fabs(p.y) > kFarthest_m)
          table.error("polygon", "a point lies more than 1000 km away");
      obstacle.outline = std::move(*ring);
    }
    if (table.has("file") == table.has("polygon"))
      table.error("", "an [[obstacle]] needs either file = \"house.glb\" or polygon = [[east, north], ...]");
    if (auto at = table.numbers("at", 2)) obstacle.at = {static_cast<float>((*at)[0]), static_cast<float>((*at)[1])};
    obstacle.rotation_deg = static_cast<float>(table.number("rotation_deg", -360, 360).value_or(0.0));
    obstacle.scale = static_cast<float>(table.number("scale", 1e-4, 1e4).value_or(1.0));
    obstacle.height_m = static_cast<float>(table.number("height_m", 0.1, 1000).value_or(8.0));
    for (TomlTable& hole : table.tables("hole")) {
      obstacle.holes.push_back(required_points(hole, "polygon"));
      hole.finish();
    }
    if (auto low = table.number("low_m", -11'000, 10'000)) obstacle.low_m = static_cast<float>(*low);
    if (auto high = table.number("high_m", -11'000, 10'000)) obstacle.high_m = static_cast<float>(*high);
    if (table.has("low_m") != table.has("high_m") || (table.has("low_m") && table.has("height_m")))
      table.error(table.has("low_m") ? "low_m" : "high_m", "low_m and high_m stand together, in place of height_m");
    else if (obstacle.low_m && !(*obstacle.low_m < *obstacle.high_m))
      table.error("high_m", "high_m must be above low_m");
    obstacle.on_ground = table.boolean("on_ground").value_or(true);
    obstacle.id = read_standing_id(table);
    const std::string ending = obstacle.file.extension().string();
    const bool mesh = ending == ".glb" || ending == ".gltf" || ending == ".obj";
    for (const char* key : {"low_m", "high_m", "hole"})
      if (table.has(key) && obstacle.outline.empty()) table.error(key, fmt::format("{} is for a polygon", key));
    for (const char* key : {"at", "rotation_deg", "scale", "on_ground"})
      if (table.has(key) && !mesh) table.error(key, fmt::format("{} is for meshes (.glb, .gltf, .obj)", key));
    if (mesh && table.has("height_m")) table.error("height_m", "a mesh has its own height; use scale");
    table.finish();
    recipe_.obstacles.push_back(std::move(obstacle));
  }

  // Ids of obstacles and hero trees, below 0 and each given once; 0 when none is told.
  std::int32_t read_standing_id(TomlTable& table) {
    const auto id = table.integer("id", std::numeric_limits<std::int32_t>::min() + 1, -1);
    if (!id) return 0;
    if (!standing_ids_.insert(*id).second) table.error("id", fmt::format("the id {} is given twice", *id));
    return static_cast<std::int32_t>(*id);
  }

  Result<void> read_hero(TomlTable& table) {
    HeroRecipe hero;
    hero.name = table.text("name").value_or(fmt::format("hero {}", recipe_.heroes.size() + 1));
    if (auto at = table.numbers("at", 2))
      hero.at = {static_cast<float>((*at)[0]), static_cast<float>((*at)[1])};
    else if (!table.has("at"))
      table.error("", "a [[hero]] needs at = [east, north]");
    hero.rotation_deg = static_cast<float>(table.number("rotation_deg", -360, 360).value_or(0.0));
    hero.scale = static_cast<float>(table.number("scale", 0.02, 10).value_or(1.0));
    hero.id = read_standing_id(table);
    if (auto file = table.text("file")) {
      hero.file = folder_ / *file;
      auto tree = read_tree(hero.file);
      if (!tree) return table.error("file", tree.error().message), Result<void>();
      if (auto index = species(table, "file", tree->species)) hero.species = *index;
      hero.tree = std::make_shared<const SavedTree>(std::move(*tree));
    } else if (!table.has("file")) {
      table.error("", "a [[hero]] needs file = \"NAME.tree.json\"");
    }
    table.finish();
    recipe_.heroes.push_back(std::move(hero));
    return {};
  }

  void read_camera(TomlTable& table) {
    CameraRecipe camera;
    camera.name = table.text("name").value_or(fmt::format("camera {}", recipe_.cameras.size() + 1));
    for (auto [key, value] : {std::pair{"eye", &camera.eye}, {"target", &camera.target}}) {
      if (auto p = table.numbers(key, 3))
        *value = {static_cast<float>((*p)[0]), static_cast<float>((*p)[1]), static_cast<float>((*p)[2])};
      else if (!table.has(key))
        table.error("", fmt::format("a [[camera]] needs {} = [east, north, metres above the ground]", key));
    }
    if (camera.eye == camera.target && table.has("eye") && table.has("target"))
      table.error("target", "eye and target are the same point; the camera has no direction");
    camera.vertical_fov_deg = static_cast<float>(table.number("fov_deg", 5, 120).value_or(40.0));
    camera.on_ground = table.boolean("on_ground").value_or(true);
    table.finish();
    recipe_.cameras.push_back(std::move(camera));
  }

  void read_figure(TomlTable& table) {
    scene::Figure figure;
    if (auto at = table.numbers("at", 2))
      figure.at = {static_cast<float>((*at)[0]), static_cast<float>((*at)[1])};
    else if (!table.has("at"))
      table.error("", "a [[figure]] needs at = [east, north]");
    figure.heading_deg = static_cast<float>(table.number("heading_deg", -360, 360).value_or(figure.heading_deg));
    table.finish();
    recipe_.figures.push_back(figure);
  }

  void read_sun(TomlTable& table) {
    scene::Sun& sun = recipe_.document.sun;
    sun.azimuth_deg = static_cast<float>(table.number("azimuth_deg", -360, 360).value_or(sun.azimuth_deg));
    sun.elevation_deg = static_cast<float>(table.number("elevation_deg", 0, 90).value_or(sun.elevation_deg));
    table.finish();
  }

  void read_species_bar(TomlTable& table) {
    distribution::MixEntry entry{};
    if (auto name = table.text("species")) {
      if (const auto index = species(table, "species", *name)) entry.species = static_cast<std::uint32_t>(*index);
    } else if (!table.has("species")) {
      table.error("", "a [[species_bar]] needs species, a name");
    }
    entry.probability = static_cast<float>(table.number("share", 0, 1e6).value_or(1.0));
    if (auto scale = table.numbers("scale", 2)) {
      if (!((*scale)[0] >= 0.02 && (*scale)[0] <= (*scale)[1] && (*scale)[1] <= 4))
        table.error("scale", fmt::format("scale = [{:g}, {:g}] must be [smallest, largest], 0.02 to 4", (*scale)[0],
                                         (*scale)[1]));
      entry.scale_min = static_cast<float>((*scale)[0]), entry.scale_max = static_cast<float>((*scale)[1]);
    }
    table.finish();
    recipe_.document.species_bar.push_back(entry);
  }

  void read_counters(TomlTable& table) {
    CounterRecipe& counters = recipe_.counters;
    constexpr auto kLast = std::numeric_limits<std::int32_t>::max();
    counters.tree = static_cast<std::int32_t>(table.integer("next_tree", 1, kLast).value_or(1));
    counters.standing = static_cast<std::int32_t>(table.integer("next_standing", -kLast, -1).value_or(-1));
    counters.block = table.natural("next_block").value_or(1);
    table.finish();
  }

  void read_underlay(TomlTable& table) {
    scene::Underlay& underlay = recipe_.document.underlay;
    if (auto file = table.text("file"); file && !file->empty())
      underlay.file = std::filesystem::absolute(folder_ / *file).lexically_normal().string();
    else
      table.error(table.has("file") ? "file" : "", "[underlay] needs file = \"plan.png\", a .png or .jpg");
    if (auto corner = table.numbers("south_west", 2)) underlay.south_west = {(*corner)[0], (*corner)[1]};
    describe(underlay, table);
    const bool lacks_width = !table.has("width_m");
    recipe_.underlay_from_world_file = {lacks_width, lacks_width && !table.has("south_west")};
    if (lacks_width && !underlay.file.empty() && !world_file_of(underlay.file))
      table.error(
          "", "[underlay] needs width_m, the picture's width on the ground, or a world file beside it (.pgw, .jgw)");
    table.finish();
  }

  static std::vector<Vec2> required_points(TomlTable& table, std::string_view key) {
    auto points = table.points(key);
    if (!points && !table.has(key)) table.error("", fmt::format("{} = [[east, north], ...] is missing", key));
    return points.value_or(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}});
  }

  std::filesystem::path folder_;
  Recipe& recipe_;
  std::set<std::string> names_;
  std::set<std::int64_t> standing_ids_;
};

Result<Recipe> read(Result<scene::TomlFile> file, const std::filesystem::path& path,
                    std::optional<std::uint64_t> seed) {
  if (!file) return file.error();
  Recipe recipe;
  recipe.file = path;
  TomlTable root = file->root();
  if (auto done = Reader(path, recipe).read(root, seed); !done) return done.error();
  if (auto fine = file->check(); !fine) return fine.error();
  return recipe;
}

}  // namespace

Result<Recipe> read_recipe(const std::filesystem::path& file, std::optional<std::uint64_t> seed) {
  return read(scene::TomlFile::read(file), file, seed);
}

Result<Recipe> parse_recipe(std::string_view text, const std::filesystem::path& file,
                            std::optional<std::uint64_t> seed) {
  return read(scene::TomlFile::parse(text, file.string()), file, seed);
}

}  // namespace bosquet::exchange
