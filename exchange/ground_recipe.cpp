#include "exchange/ground_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "exchange/site_frame.h"
#include "terrain/curve.h"

namespace bosquet::exchange {
namespace {

using scene::TomlTable;

std::vector<Vec2> near_points(TomlTable& table, std::string_view key, std::size_t least) {
  auto points = table.points(key);
  if (!points) return {};
  if (points->size() < least)
    table.error(key, fmt::format("{} needs at least {} points", key, least == 2 ? "two" : "three"));
  for (const Vec2& p : *points)
    if (!(std::fabs(p.x) <= kFarthest_m && std::fabs(p.y) <= kFarthest_m)) {
      table.error(key, "a point lies more than 1000 km away");
      return {};
    }
  return std::move(*points);
}

std::vector<Vec2> required_points(TomlTable& table, std::string_view key, std::size_t least) {
  if (!table.has(key)) table.error("", fmt::format("{} = [[east, north], ...] is missing", key));
  return near_points(table, key, least);
}

// The points of an outline or line, as they are or as what a curve is drawn through.
void read_curve(TomlTable& table, std::vector<Vec2>& points, bool closed) {
  if (table.boolean("curve").value_or(false) && !points.empty()) points = terrain::curve_through(points, closed);
}

void read_cover(TomlTable& table, AreaRecipe& out) {
  out.area.cover = terrain::usual_cover(out.area.kind);
  out.cover_given = table.has("cover");
  table(Choice{"cover", terrain::kCoverNames, "What it is drawn as"}, out.area.cover);
}

void read_kind(TomlTable& table, AreaRecipe& out, std::string_view key = "kind") {
  out.kind_given = table.has(key);
  table(Choice{key, terrain::kAreaKindNames, "What it is"}, out.area.kind);
  read_cover(table, out);
}

void read_stroke(TomlTable& table, GroundRecipe& ground) {
  terrain::Stroke stroke;
  describe(stroke, table);
  stroke.points = required_points(table, "points", 1);
  stroke.seed = hash_text("stroke") + ground.strokes.size();
  for (const char* key : {"area", "area_kind", "cover"})
    if (table.has(key) && stroke.kind != terrain::BrushKind::exclude)
      table.error(key, fmt::format("{} is for strokes of kind exclude", key));
  if (table.has("area") || table.has("area_kind") || table.has("cover")) {
    AreaRecipe named;
    named.area.name = table.text("area").value_or("");
    read_kind(table, named, "area_kind");
    stroke.area = named.area;
  }
  table.finish();
  ground.strokes.push_back(std::move(stroke));
}

void read_area(TomlTable& table, const std::filesystem::path& folder, GroundRecipe& ground) {
  AreaRecipe out;
  read_kind(table, out);
  out.area.name = table.text("name").value_or("");
  if (auto file = table.text("file")) {
    if (file->empty()) table.error("file", "needs the name of a GeoJSON, GeoPackage, Shapefile or DXF file");
    out.file = folder / *file;
  }
  const int shapes = table.has("polygon") + table.has("points") + table.has("file");
  if (shapes != 1)
    table.error("",
                "a [[terrain.area]] needs one of polygon = [[east, north], ...], points = [[east, north], ...] and "
                "file = \"paths.geojson\"");
  out.polygon = near_points(table, "polygon", 3);
  out.points = near_points(table, "points", 2);
  if (table.has("curve") && !out.file.empty()) table.error("curve", "curve is for polygon and points");
  read_curve(table, out.polygon.empty() ? out.points : out.polygon, !out.polygon.empty());
  out.width_m = static_cast<float>(table.number("width_m", 0.1, 1000).value_or(2.0));
  out.layer = table.text("layer").value_or("");
  out.where = table.text("where").value_or("");
  out.kind_from = table.text("kind_from").value_or("");
  for (const char* key : {"layer", "where", "kind_from"})
    if (table.has(key) && out.file.empty()) table.error(key, fmt::format("{} is for areas from a file", key));
  if (out.kind_given && table.has("kind_from")) table.error("kind_from", "give either kind or kind_from");
  if (table.has("width_m") && table.has("polygon")) table.error("width_m", "width_m is for lines");
  const bool water = out.area.kind == terrain::AreaKind::water;
  if (auto level = table.number("level_m", -10000, 10000)) out.level_m = static_cast<float>(*level);
  describe(out.pond, table);
  for (const char* key : {"level_m", "depth_m", "bank"})
    if (table.has(key) && !water && out.kind_from.empty())
      table.error(key, fmt::format("{} is for areas of kind water", key));
  if (water && table.has("points"))
    table.error("points", "water needs a polygon; a stream is a stroke of kind lower under water_level_m");
  table.finish();
  ground.areas.push_back(std::move(out));
}

void read_map_table(TomlTable& table, const std::filesystem::path& folder, GroundRecipe& ground) {
  if (auto file = table.text("file"); file && !file->empty())
    ground.map = folder / *file;
  else
    table.error(table.has("file") ? "file" : "", "[terrain.map] needs file = \"map.tif\", a raster that bosquet wrote");
  for (TomlTable& item : table.tables("area")) {
    AreaRecipe read;
    read_kind(item, read);
    read.area.name = item.text("name").value_or("");
    if (auto level = item.number("level_m", -10000, 10000)) read.area.water_level_m = static_cast<float>(*level);
    item.finish();
    ground.map_areas.push_back(std::move(read.area));
  }
  table.finish();
}

}  // namespace

std::vector<std::filesystem::path> GroundRecipe::files() const {
  std::vector<std::filesystem::path> out;
  if (!dem.empty()) out.push_back(dem);
  if (!map.empty()) out.push_back(map);
  if (!boundary_file.empty()) out.push_back(boundary_file);
  for (const AreaRecipe& area : areas)
    if (!area.file.empty()) out.push_back(area.file);
  return out;
}

void read_site_ground(TomlTable& site, const std::filesystem::path& folder, GroundRecipe& ground) {
  ground.site_corner_given = site.has("south_west");
  ground.sun_place_given = site.has("latitude_deg") || site.has("longitude_deg");
  ground.boundary = near_points(site, "boundary", 3);
  if (auto file = site.text("boundary_file")) ground.boundary_file = folder / *file;
  if (site.has("boundary") && site.has("boundary_file"))
    site.error("boundary", "give either boundary or boundary_file");
}

void read_ground(TomlTable& table, const std::filesystem::path& folder, GroundRecipe& ground) {
  if (auto noise = table.table("noise")) {
    ground.noise.amplitude_m = 0.3f;
    describe(ground.noise, *noise), noise->finish();
  }
  if (auto dem = table.text("dem")) {
    ground.dem = folder / *dem;
    std::error_code ec;
    if (!std::filesystem::exists(ground.dem, ec))
      table.error("dem", fmt::format("there is no elevation file {}", ground.dem.string()));
  }
  if (auto corner = table.numbers("dem_south_west", 2))
    ground.dem_south_west = {(*corner)[0], (*corner)[1]}, ground.dem_corner_given = true;
  if (auto heights = table.numbers("dem_heights_m", 2)) {
    ground.dem_heights_m = {(*heights)[0], (*heights)[1]};
    if (!(std::fabs((*heights)[0]) <= 12'000 && std::fabs((*heights)[1]) <= 12'000))
      table.error("dem_heights_m",
                  "dem_heights_m = [of the smallest number, of the largest] must be -12000 to 12000 m");
  }
  if (auto size = table.numbers("dem_size_m", 2)) {
    ground.dem_size_m = {(*size)[0], (*size)[1]};
    if (!((*size)[0] > 0 && (*size)[1] > 0)) table.error("dem_size_m", "dem_size_m must be larger than 0");
  }
  for (const char* key : {"dem_south_west", "dem_heights_m", "dem_size_m"})
    if (table.has(key) && ground.dem.empty()) table.error(key, fmt::format("{} needs dem beside it", key));
  if (auto level = table.number("water_level_m", -10000, 10000)) ground.water_level_m = static_cast<float>(*level);
  if (auto map = table.table("map")) read_map_table(*map, folder, ground);
  for (TomlTable& item : table.tables("stroke")) read_stroke(item, ground);
  for (TomlTable& item : table.tables("area")) read_area(item, folder, ground);
  for (TomlTable& item : table.tables("exclusion")) {
    AreaRecipe area;
    area.area.name = item.text("name").value_or("exclusion");
    area.polygon = required_points(item, "polygon", 3);
    read_curve(item, area.polygon, true);
    read_cover(item, area);
    item.finish();
    ground.areas.push_back(std::move(area));
  }
  for (TomlTable& item : table.tables("path")) {
    AreaRecipe path;
    path.area.name = item.text("name").value_or("path");
    path.area.kind = terrain::AreaKind::path;
    path.points = required_points(item, "points", 2);
    read_curve(item, path.points, false);
    path.width_m = static_cast<float>(item.number("width_m", 0.1, 1000).value_or(2.0));
    read_cover(item, path);
    item.finish();
    ground.areas.push_back(std::move(path));
  }
  table.finish();
}

}  // namespace bosquet::exchange
