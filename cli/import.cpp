#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/commands.h"
#include "cli/grown.h"
#include "exchange/elevation.h"
#include "exchange/file_output.h"
#include "exchange/inventory.h"
#include "exchange/recipe.h"
#include "exchange/reference_system.h"
#include "exchange/tree_import.h"

namespace bosquet::cli {
namespace {

using std::filesystem::path;

constexpr std::uint64_t kMostRecipeBytes = 64 << 20;

struct Extent {
  DVec2 south_west{0.0}, size{0.0};
};

std::string path_from(const path& recipe, const path& file) {
  std::error_code ec;
  const path folder = recipe.has_parent_path() ? recipe.parent_path() : path(".");
  const path relative = std::filesystem::relative(file, folder, ec);
  return (ec || relative.empty() ? std::filesystem::absolute(file) : relative).generic_string();
}

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

Result<Extent> extent_of_trees(const exchange::Inventory& inventory, const path& file) {
  if (inventory.trees.empty()) {
    const auto lines = exchange::problem_lines(inventory.problems, file.string(), inventory.features, 1);
    return Error{lines.empty() ? fmt::format("{}: has no tree", file.string())
                               : fmt::format("{}: no row has a usable position: {}", file.string(), lines.front())};
  }
  const auto species = exchange::species_to_name({});
  if (!species) return species.error();
  const std::string fallback = exchange::TreeImport().fallback;
  const auto found = std::find_if(species->begin(), species->end(), [&](const auto& s) { return s->name == fallback; });
  const auto [corner, size] =
      exchange::site_around(inventory.trees, *species, static_cast<std::size_t>(found - species->begin()));
  return Extent{corner, size};
}

// What a planting of the finished recipe makes of its inventory, told.
Result<void> tell_trees(const exchange::Recipe& recipe, const Extent& site, const path& file, bool quiet) {
  const exchange::PlantingRecipe& planting = recipe.plantings.back();
  exchange::TreeImport reading = planting.import;
  reading.reading.site = recipe.document.place;
  reading.reading.site.south_west = site.south_west;
  reading.reading.size_m = site.size;
  reading.status = planting.order.status;
  auto trees = exchange::read_trees(file, reading, recipe.document.seed, recipe.document.species.all(),
                                    planting.default_species);
  if (!trees) return trees.error();
  print_warnings(trees->warnings, quiet, kImportWarnings);
  fmt::print("{}: {}\n", file.string(), exchange::words(trees->tally, exchange::is_vector_file(file)));
  return {};
}

// Puts `lines` right under the header of a table, or makes the table at the end.
std::string with_table_lines(std::string text, std::string_view header, const std::string& lines) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line(text.data() + at, end - at);
    line = line.substr(0, line.find('#'));
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
    if (line == header) return text.insert(std::min(end + 1, text.size()), lines);
    at = end + 1;
  }
  return text + fmt::format("\n{}\n{}", header, lines);
}

Result<std::string> old_text(const path& recipe) {
  std::error_code ec;
  if (!std::filesystem::exists(recipe, ec)) return std::string();
  auto bytes = exchange::read_file(recipe, kMostRecipeBytes);
  if (!bytes) return bytes.error();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

}  // namespace

Result<void> run_import(const Options& options) {
  if (options.file.extension() == ".bosquet") return import_into_project(options);
  if (!options.obstacle.empty()) return Error{"--obstacle is for projects (.bosquet); a recipe has [[obstacle]]"};
  if (options.file.extension() != ".toml")
    return Error{fmt::format("{}: import adds to a recipe (.toml) or project (.bosquet){}", options.file.string(),
                             import_hint(options.file))};
  if (options.dem.empty() && options.inventory.empty())
    return Error{"import needs --dem FILE, --trees FILE or both; into a project also --obstacle FILE"};
  auto text = old_text(options.file);
  if (!text) return text.error();
  const bool fresh = text->empty();

  if (!fresh && text->back() != '\n') *text += '\n';

  std::optional<Extent> site;
  scene::Georeference georeference;
  std::set<std::string> names;  // of the plantings
  if (!fresh) {
    auto recipe = exchange::parse_recipe(*text, options.file);
    if (!recipe) return recipe.error();
    if (!options.dem.empty() && !recipe->ground.dem.empty())
      return Error{fmt::format("{}: has the ground {} already; change its key dem by hand", options.file.string(),
                               recipe->ground.dem.string())};
    for (const exchange::PlantingRecipe& planting : recipe->plantings) names.insert(planting.name);
    georeference = recipe->document.place;
    if (recipe->size_m != Vec2(0.0f))  // else the site's size comes with its elevation or boundary
      site = Extent{recipe->ground.dem_corner_given ? recipe->ground.dem_south_west : recipe->document.place.south_west,
                    DVec2(recipe->size_m)};
  }

  std::string ground;
  if (!options.dem.empty()) {
    auto raster = exchange::read_elevation(options.dem);
    if (!raster) return raster.error();
    if (georeference.crs_wkt.empty()) georeference.crs_wkt = raster->crs_wkt;
    if (!site) site = Extent{raster->low_corner(), raster->high_corner() - raster->low_corner()};
    ground = fmt::format("dem = {}\ndem_south_west = [{}, {}]\n", toml_text(path_from(options.file, options.dem)),
                         site->south_west.x, site->south_west.y);
    if (raster->georeferenced && raster->crs_wkt.empty())
      print_warnings(
          {fmt::format("{}: names no reference system; its coordinates count as metres", options.dem.string())},
          options.quiet);
    fmt::print("{}: {} x {} cells of {:g} m\n", options.dem.string(), raster->columns, raster->rows, raster->cell_x_m);
  }

  std::string trees, crs;
  if (!options.inventory.empty()) {
    exchange::InventoryOptions reading;
    if (site) {
      reading.site = georeference;
      reading.site.south_west = site->south_west;
      reading.size_m = site->size;
    }
    auto inventory = exchange::read_inventory(options.inventory, reading);
    if (!inventory) return inventory.error();
    if (!site) {
      auto extent = extent_of_trees(*inventory, options.inventory);
      if (!extent) return extent.error();
      site = *extent;
      // The trees' own system becomes the site's, so that they are found again.
      if (inventory->place)
        crs = fmt::format("crs = {}\nlatitude_deg = {:.4f}\nlongitude_deg = {:.4f}\n",
                          toml_text(exchange::short_definition(inventory->place->crs_wkt)),
                          inventory->place->latitude_deg, inventory->place->longitude_deg);
    }
    std::string name = options.inventory.stem().string();
    for (int n = 2; names.contains(name); ++n) name = fmt::format("{} {}", options.inventory.stem().string(), n);
    trees = fmt::format("\n[[planting]]\nname = {}\nkind = \"inventory\"\nfile = {}\n", toml_text(name),
                        toml_text(path_from(options.file, options.inventory)));
  }

  if (fresh)
    *text = fmt::format("[site]\nsize_m = [{}, {}]\nseed = 1\nsouth_west = [{}, {}]\n{}", site->size.x, site->size.y,
                        site->south_west.x, site->south_west.y, crs);
  if (!ground.empty()) *text = with_table_lines(std::move(*text), "[terrain]", ground);
  *text += trees;
  auto recipe = exchange::parse_recipe(*text, options.file);
  if (!recipe) return recipe.error();
  if (!options.inventory.empty())
    if (auto told = tell_trees(*recipe, *site, options.inventory, options.quiet); !told) return told;
  if (auto written = exchange::write_file(options.file, *text); !written) return written.error();
  fmt::print("{}: site {:g} x {:g} m; grow it with: bosquet make {} -o OUT.glb\n", options.file.string(), site->size.x,
             site->size.y, shell_word(options.file.string()));
  return {};
}

}  // namespace bosquet::cli
