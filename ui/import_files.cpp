#include "ui/import_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "exchange/elevation.h"
#include "exchange/ground_recipe.h"
#include "exchange/image_file.h"
#include "exchange/obstacle_import.h"
#include "exchange/tree_file.h"
#include "exchange/tree_import.h"
#include "exchange/world_file.h"
#include "scene/settings_edits.h"
#include "scene/site_edits.h"

namespace bosquet::ui {
namespace {

constexpr std::size_t kMostNotes = 3;  ///< that are said at once

// Trees off good ground since the edit; those that were before are not its doing.
std::vector<std::int32_t> newly_displaced(const scene::Document& before, const scene::Document& after) {
  const std::vector<std::int32_t> were = scene::displaced_trees(before), are = scene::displaced_trees(after);
  std::vector<std::int32_t> since;
  std::set_difference(are.begin(), are.end(), were.begin(), were.end(), std::back_inserter(since));
  return since;
}

// Whether a raster says nothing of where it lies. What it holds where an unplaced one would lie under the site is read.
bool lies_nowhere(const std::filesystem::path& file, DVec2 size_m) {
  const auto there = exchange::read_elevation(file, {.window = exchange::MapRectangle{DVec2(0.0), size_m}});
  return there && !there->georeferenced;
}

Result<scene::Edited> import_ground(const scene::Document& document, const std::filesystem::path& file) {
  const Vec2 size = document.terrain->size_m();
  exchange::GroundRecipe recipe;
  recipe.dem = file;
  recipe.site_corner_given = recipe.sun_place_given = true;
  // An unplaced raster begins at the site's corner, wherever that is.
  const bool nowhere = document.place.south_west != DVec2(0.0) && lies_nowhere(file, DVec2(size));
  recipe.dem_corner_given = nowhere;
  auto made = exchange::make_ground(recipe, size, document.place, document.seed);
  if (!made) return made.error();
  if (made->terrain.height.lattice() != document.terrain->height.lattice())
    return Error{fmt::format("{}: heights come in cells of {:g} m here, and the site has cells of {:g} m",
                             file.string(), made->terrain.height.lattice().cell_m,
                             document.terrain->height.lattice().cell_m)};
  terrain::Terrain ground = *document.terrain;
  ground.height = std::move(made->terrain.height);
  scene::Edited edit = scene::set_ground(document, std::move(ground), "Import ground");
  if (!nowhere) edit.document.place = made->place;
  edit.notes.insert(edit.notes.begin(), made->warnings.begin(), made->warnings.end());
  return edit;
}

Result<scene::Edited> import_trees(const scene::Document& document, const std::filesystem::path& file) {
  auto imported = exchange::import_trees(document, file);
  if (!imported) return imported.error();
  scene::Edited edit;
  edit.document = std::move(imported->document);
  edit.name = "Import " + scene::trees_in_words(imported->tally.trees);
  edit.notes = std::move(imported->warnings);
  edit.displaced = newly_displaced(document, edit.document);
  return edit;
}

Result<scene::Edited> import_buildings(const scene::Document& document, const std::filesystem::path& file) {
  auto imported = exchange::import_obstacles(document, file);
  if (!imported) return imported.error();
  scene::Edited edit;
  edit.document = std::move(imported->document);
  edit.name = imported->count == 1 ? "Import a building" : fmt::format("Import {} buildings", imported->count);
  edit.notes = std::move(imported->notes);
  edit.displaced = newly_displaced(document, edit.document);
  return edit;
}

Result<scene::Edited> import_underlay(const scene::Document& document, const std::filesystem::path& file) {
  if (auto image = exchange::read_image(file); !image) return image.error();
  scene::Underlay underlay;
  underlay.file = std::filesystem::absolute(file).lexically_normal().string();
  const DVec2 size(document.terrain->size_m());
  underlay.width_m = static_cast<float>(size.x);
  std::vector<std::string> notes;
  const auto laid = exchange::lay_by_world_file(underlay, {}, document.place, size, notes);
  // One that cannot be read does not keep the picture away.
  if (!laid) notes.push_back(laid.error().message);
  if (!laid || !*laid) notes.push_back("it is as wide as the site; its width and corner are on the right");
  scene::Edited edit = scene::set_underlay(document, underlay);
  edit.notes = std::move(notes);
  return edit;
}

}  // namespace

Result<HeroInHand> read_hero(const scene::Document& document, const std::filesystem::path& file) {
  auto saved = exchange::read_tree(file);
  if (!saved) return saved.error();
  HeroInHand hero;
  // NAME of NAME.tree.json
  hero.name = file.stem().stem().string();
  hero.key = saved->key;
  for (const auto& species : document.species)
    if (species->name == saved->species) hero.species = species;
  if (!hero.species) {
    auto known = scene::builtin_species(saved->species);
    if (!known)
      return Error{fmt::format("{}: it is of the species '{}', which this document does not have", file.string(),
                               saved->species)};
    hero.species = std::make_shared<const scene::Species>(std::move(*known));
  }
  hero.skeleton = std::make_shared<const growth::Skeleton>(std::move(saved->skeleton));
  return hero;
}

std::vector<std::string> import_endings(ImportKind kind) {
  switch (kind) {
    case ImportKind::ground:
      return {".tif", ".tiff", ".asc", ".png", ".hgt", ".vrt"};
    case ImportKind::trees:
      return {".csv", ".geojson", ".gpkg", ".shp", ".dxf"};
    case ImportKind::underlay:
      return {".png", ".jpg", ".jpeg"};
    case ImportKind::buildings:
      return {".geojson", ".gpkg", ".shp", ".dxf", ".glb", ".gltf", ".obj"};
  }
  return {};
}

Result<scene::Edited> import_file(const scene::Document& document, ImportKind kind, const std::filesystem::path& file) {
  switch (kind) {
    case ImportKind::ground:
      return import_ground(document, file);
    case ImportKind::trees:
      return import_trees(document, file);
    case ImportKind::underlay:
      return import_underlay(document, file);
    case ImportKind::buildings:
      break;
  }
  return import_buildings(document, file);
}

std::string import_words(const scene::Edited& edit, const std::filesystem::path& file) {
  std::string words = edit.name + " from " + file.filename().string();
  if (!edit.displaced.empty())
    words += fmt::format(
        "\n{} now on a path, in water or under a building",
        edit.displaced.size() == 1 ? "1 tree stands" : fmt::format("{} trees stand", edit.displaced.size()));
  return edit.notes.empty() ? words : words + "\n" + first_lines(edit.notes);
}

std::string first_lines(const std::vector<std::string>& notes) {
  const std::size_t said = std::min(kMostNotes, notes.size());
  std::string words;
  for (std::size_t i = 0; i < said; ++i) words += (i > 0 ? "\n" : "") + notes[i];
  if (said < notes.size()) words += fmt::format("\nand {} more", notes.size() - said);
  return words;
}

}  // namespace bosquet::ui
