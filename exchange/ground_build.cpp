#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "exchange/elevation.h"
#include "exchange/ground_rasters.h"
#include "exchange/ground_recipe.h"
#include "exchange/reference_system.h"
#include "exchange/shapes.h"
#include "terrain/exclusion.h"

namespace bosquet::exchange {
namespace {

using terrain::AreaKind;

// What others call the kinds of areas (OpenStreetMap's words, German and French ones of plans).
constexpr std::pair<std::string_view, AreaKind> kKindWords[] = {
    {"footway", AreaKind::path},    {"footpath", AreaKind::path}, {"track", AreaKind::path},
    {"road", AreaKind::path},       {"street", AreaKind::path},   {"service", AreaKind::path},
    {"pedestrian", AreaKind::path}, {"cycleway", AreaKind::path}, {"weg", AreaKind::path},
    {"wege", AreaKind::path},       {"allee", AreaKind::path},    {"chemin", AreaKind::path},
    {"grass", AreaKind::lawn},      {"meadow", AreaKind::lawn},   {"rasen", AreaKind::lawn},
    {"wiese", AreaKind::lawn},      {"pelouse", AreaKind::lawn},  {"garden", AreaKind::bed},
    {"flowerbed", AreaKind::bed},   {"beet", AreaKind::bed},      {"house", AreaKind::building},
    {"yes", AreaKind::building},    {"haus", AreaKind::building}, {"pond", AreaKind::water},
    {"lake", AreaKind::water},      {"basin", AreaKind::water},   {"teich", AreaKind::water},
    {"see", AreaKind::water},       {"etang", AreaKind::water}};

std::optional<AreaKind> kind_of(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (std::size_t k = 0; k < terrain::kAreaKindNames.size(); ++k)
    if (text == terrain::kAreaKindNames[k]) return static_cast<AreaKind>(k);
  for (const auto& [word, kind] : kKindWords)
    if (text == word) return kind;
  return {};
}

class Maker {
 public:
  Maker(const GroundRecipe& recipe, Vec2 size_m, const scene::Georeference& place, std::uint64_t seed)
      : recipe_(recipe), size_(size_m), seed_(seed) {
    ground_.place = place;
  }

  Result<Ground> make() {
    if (auto done = find_boundary(); !done) return done.error();
    if (auto done = make_heights(); !done) return done.error();
    terrain::Terrain& site = ground_.terrain;
    if (!recipe_.map.empty())
      if (auto done = read_map(recipe_.map, recipe_.map_areas, site); !done) return done.error();
    if (recipe_.noise.amplitude_m > 0.0f) site.height = terrain::with_noise(site.height, recipe_.noise, seed_);
    for (terrain::Stroke stroke : recipe_.strokes) {
      stroke.seed += seed_;
      site = terrain::apply(site, stroke);
    }
    site.water_level_m = recipe_.water_level_m;
    for (const Polygon& part : boundary_)
      if (boundary_.size() == 1)
        site = terrain::exclude_outside(site, part, {"outside", AreaKind::other, terrain::Cover::natural});
    for (const AreaRecipe& area : recipe_.areas)
      if (auto done = add(area); !done) return done.error();
    if (recipe_.areas.size() + 1 >= terrain::kMostAreas || site.areas.count() >= terrain::kMostAreas)
      warn(fmt::format("more than {} areas with a name; the rest has none", terrain::kMostAreas));
    place_sun();
    return std::move(ground_);
  }

 private:
  void warn(std::string text) { ground_.warnings.push_back(std::move(text)); }

  // The boundary on the site, and the site around it when its size is not given.
  Result<void> find_boundary() {
    if (!recipe_.boundary.empty()) {
      boundary_ = untangled({recipe_.boundary, {}});
      if (boundary_.empty()) return Error{"[site]: the boundary has no area"};
    } else if (!recipe_.boundary_file.empty()) {
      ShapeOptions options;
      options.lines = options.clip = false;
      if (size_.x > 0) options.size_m = DVec2(size_);
      options.makes_site = size_.x <= 0 && !recipe_.site_corner_given;
      auto shapes = read_shapes(recipe_.boundary_file, ground_.place, options);
      if (!shapes) return shapes.error();
      const std::string file = recipe_.boundary_file.string();
      for (const std::string& note : shapes->notes) warn(fmt::format("{}: {}", file, note));
      if (shapes->place) ground_.place = *shapes->place, placed_ = true;
      for (Shape& shape : shapes->all) boundary_.push_back(std::move(shape.polygon));
    } else {
      return {};
    }
    if (boundary_.size() > 1)
      return Error{fmt::format("the site's boundary is {} separate polygons; it must be one that does not cross itself",
                               boundary_.size())};
    if (size_.x > 0) return {};
    // The site is the rectangle around it, its corner moved there.
    const Box2 box = boundary_.front().bounds();
    if (recipe_.dem.empty() || placed_ || recipe_.site_corner_given || !ground_.place.crs_wkt.empty())
      ground_.place.south_west += DVec2(box.low), moved_ = true;
    for (Vec2& p : boundary_.front().ring) p -= box.low;
    for (auto& hole : boundary_.front().holes)
      for (Vec2& p : hole) p -= box.low;
    size_ = box.size();
    return {};
  }

  Result<void> make_heights() {
    if (recipe_.dem.empty()) {
      auto lattice = terrain::make_lattice(size_);
      if (!lattice) return lattice.error();
      ground_.terrain = terrain::make_terrain(terrain::Heightfield(*lattice));
      return {};
    }
    ElevationOptions options;
    options.extent_m = recipe_.dem_size_m;
    options.low_high_m = recipe_.dem_heights_m;
    options.crs_wkt = ground_.place.crs_wkt;
    const bool placed = recipe_.dem_corner_given || recipe_.site_corner_given || placed_ || moved_;
    DVec2 corner = recipe_.dem_corner_given ? recipe_.dem_south_west : ground_.place.south_west;
    if (placed && size_.x > 0) options.window = MapRectangle{corner, corner + DVec2(size_)};
    auto raster = read_elevation(recipe_.dem, options);
    if (!raster) return raster.error();
    if (size_.x <= 0) {
      // The site is what the raster covers, from its corner or the given one on.
      if (!placed) corner = raster->whole.low;
      size_ = Vec2(raster->whole.high - corner);
      if (!(size_.x > 0 && size_.y > 0))
        return Error{fmt::format("{} lies wholly south or west of the site's corner ({:.10g}, {:.10g})", raster->file,
                                 corner.x, corner.y)};
    } else if (!placed) {
      corner = 0.5 * (raster->whole.low + raster->whole.high) - 0.5 * DVec2(size_);
    }
    auto lattice = terrain::make_lattice(size_);
    if (!lattice) return Error{fmt::format("{}: {}", raster->file, lattice.error().message)};
    auto heights = heights_at_corners(*raster, corner, lattice->cells.x, lattice->cells.y,
                                      static_cast<double>(lattice->cell_m), DVec2(size_));
    if (!heights) return heights.error();
    auto field = terrain::Heightfield::from_samples(*lattice, *heights);
    if (!field) return field.error();
    ground_.terrain = terrain::make_terrain(std::move(*field));
    tell(*raster, corner);
    ground_.place.south_west = corner;
    // The site's own words for its system stay; the raster was brought to it where it had another.
    if (ground_.place.crs_wkt.empty()) ground_.place.crs_wkt = raster->crs_wkt;
    return {};
  }

  void tell(const Elevation& raster, DVec2) {
    if (raster.filled > 0)
      warn(fmt::format("{}: {} cells without data were filled from their surroundings", raster.file, raster.filled));
    if (raster.reprojected)
      warn(ground_.place.crs_wkt.empty()
               ? fmt::format("{}: reprojected to local metres", raster.file)
               : fmt::format("{}: reprojected to {}", raster.file, system_facts(ground_.place.crs_wkt).name));
    // A recipe that tells the site's corner in the raster's coordinates knows what they are.
    const bool own = recipe_.dem_corner_given && ground_.place.crs_wkt.empty();
    if (raster.georeferenced && raster.crs_wkt.empty() && !own)
      warn(fmt::format("{}: names no reference system; its coordinates count as metres{}", raster.file,
                       ground_.place.crs_wkt.empty() ? "" : " of the site's"));
  }

  Result<void> add(const AreaRecipe& area) {
    const std::string name = area.area.name.empty() ? "" : fmt::format(" '{}'", area.area.name);
    if (!area.file.empty()) return add_file(area);
    if (!area.points.empty()) {
      add_line(area.points, area.width_m, area.area);
      return {};
    }
    const Polygon outline{area.polygon, {}};
    const std::vector<Polygon> parts = untangled(outline);
    if (parts.empty()) return Error{fmt::format("[terrain]: the polygon of area{} has no area", name)};
    if (parts.size() > 1)
      warn(fmt::format("[terrain]: the polygon of area{} crosses itself; what is inside goes by the even-odd rule",
                       name));
    for (const Polygon& part : parts) add_polygon(part, area, area.area);
    return {};
  }

  Result<void> add_file(const AreaRecipe& recipe) {
    ShapeOptions options;
    options.layer = recipe.layer, options.where = recipe.where;
    options.attributes = {recipe.kind_from.empty() ? "kind" : recipe.kind_from, "width_m", "width", "level_m"};
    options.size_m = DVec2(size_);
    auto shapes = read_shapes(recipe.file, ground_.place, options);
    if (!shapes) return shapes.error();
    const std::string file = recipe.file.string();
    for (const std::string& note : shapes->notes) warn(fmt::format("{}: {}", file, note));
    if (shapes->place) ground_.place = *shapes->place, placed_ = true;

    std::map<std::string, std::size_t> unknown;  // words for kinds, with count
    std::size_t dry = 0, bad_widths = 0;
    for (const Shape& shape : shapes->all) {
      terrain::Area area = recipe.area;
      if (area.name.empty()) area.name = shape.name.empty() ? recipe.file.stem().string() : shape.name;
      if (!recipe.kind_given && shape.values[0]) {
        if (const auto kind = kind_of(*shape.values[0]))
          area.kind = *kind;
        else
          ++unknown[*shape.values[0]];
      }
      if (!recipe.cover_given) area.cover = terrain::usual_cover(area.kind);
      if (!shape.line.empty()) {
        if (area.kind == AreaKind::water) {
          ++dry;
          continue;
        }
        add_line(shape.line, width_of(shape, recipe.width_m, bad_widths), area);
      } else {
        AreaRecipe own = recipe;
        if (const auto level = number(shape.values[3])) own.level_m = static_cast<float>(*level);
        add_polygon(shape.polygon, own, area);
      }
    }
    for (const auto& [word, count] : unknown)
      warn(fmt::format("{}: '{}' is no known kind of area; {} shapes are taken as {}", file, word, count,
                       terrain::kAreaKindNames[static_cast<std::size_t>(recipe.area.kind)]));
    if (dry > 0) warn(fmt::format("{}: {} lines of water were left out; water needs a polygon", file, dry));
    if (bad_widths > 0)
      warn(fmt::format("{}: {} widths are no numbers from 0.1 to 1000 m; {} m is taken", file, bad_widths,
                       recipe.width_m));
    return {};
  }

  static std::optional<double> number(const std::optional<std::string>& text) {
    if (!text || text->empty()) return {};
    char* end = nullptr;
    const double value = std::strtod(text->c_str(), &end);
    if (end == text->c_str() || !std::isfinite(value)) return {};
    return value;
  }

  static float width_of(const Shape& shape, float usual, std::size_t& bad) {
    for (std::size_t n : {1u, 2u}) {
      if (!shape.values[n] || shape.values[n]->empty()) continue;
      const auto width = number(shape.values[n]);
      if (width && *width >= 0.1 && *width <= 1000) return static_cast<float>(*width);
      ++bad;
      break;
    }
    return usual;
  }

  void add_line(const std::vector<Vec2>& line, float width_m, const terrain::Area& area) {
    ground_.terrain = terrain::exclude_path(ground_.terrain, line, width_m, area);
  }

  void add_polygon(const Polygon& polygon, const AreaRecipe& recipe, const terrain::Area& area) {
    if (area.kind != AreaKind::water) {
      ground_.terrain = terrain::exclude(ground_.terrain, polygon, area);
      return;
    }
    terrain::DugPond pond = terrain::dig_pond(ground_.terrain, area.name.empty() ? "water" : area.name, polygon,
                                              recipe.level_m, recipe.pond);
    if (pond.lowered)
      warn(fmt::format("water '{}': its level {:g} m would run out over the lowest place of its rim; {:g} m is taken",
                       area.name, *recipe.level_m, pond.level_m));
    if (pond.edit.touched.empty()) warn(fmt::format("water '{}' lies off the site", area.name));
    ground_.terrain = std::move(pond.edit.terrain);
  }

  // The sun stands where the site lies, unless the recipe says where.
  void place_sun() {
    scene::Georeference& place = ground_.place;
    if (recipe_.sun_place_given || place.crs_wkt.empty() || system_facts(place.crs_wkt).local) return;
    const auto to_degrees = Reprojection::make(place.crs_wkt, degrees_system());
    if (!to_degrees) return;
    const DVec2 degrees = (*to_degrees)(place.south_west + 0.5 * DVec2(size_));
    if (std::isfinite(degrees.x) && std::isfinite(degrees.y))
      place.longitude_deg = degrees.x, place.latitude_deg = degrees.y;
  }

  const GroundRecipe& recipe_;
  Vec2 size_;
  std::uint64_t seed_;
  Ground ground_;
  std::vector<Polygon> boundary_;
  bool placed_ = false, moved_ = false;  // the site's corner, by a file or its boundary
};

}  // namespace

Result<Ground> make_ground(const GroundRecipe& recipe, Vec2 size_m, const scene::Georeference& place,
                           std::uint64_t seed) {
  return Maker(recipe, size_m, place, seed).make();
}

}  // namespace bosquet::exchange
