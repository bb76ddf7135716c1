// Import into a project: ground, trees and obstacles become parts of its document.
#include <fmt/format.h>

#include <filesystem>

#include "cli/commands.h"
#include "cli/grown.h"
#include "exchange/ground_recipe.h"
#include "exchange/obstacle_import.h"
#include "exchange/tree_import.h"
#include "scene/project_file.h"
#include "scene/site_edits.h"

namespace bosquet::cli {
namespace {

// The ground of a raster: the site's extent where there is none yet, else what lies under the site, in its reference
// system. What stands on the ground goes with it.
Result<void> import_ground(const std::filesystem::path& file, scene::Document& document,
                           std::vector<std::string>& warnings) {
  const bool fresh = !document.terrain;
  exchange::GroundRecipe recipe;
  recipe.dem = file;
  recipe.site_corner_given = recipe.sun_place_given = !fresh;
  const Vec2 size = fresh ? Vec2(0.0f) : document.terrain->size_m();
  auto ground = exchange::make_ground(recipe, size, document.place, document.seed);
  if (!ground) return ground.error();
  warnings.insert(warnings.end(), ground->warnings.begin(), ground->warnings.end());
  document.place = ground->place;
  const terrain::HeightRange heights = ground->terrain.height.range();
  if (fresh) {
    document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground->terrain));
  } else {
    terrain::Terrain with = *document.terrain;
    with.height = std::move(ground->terrain.height);
    scene::Edited edited = scene::set_ground(document, std::move(with), "Import ground");
    warnings.insert(warnings.end(), edited.notes.begin(), edited.notes.end());
    document = std::move(edited.document);
  }
  fmt::print("{}: heights from {:.1f} to {:.1f} m\n", file.string(), heights.low, heights.high);
  return {};
}

Result<void> import_obstacles(const std::filesystem::path& file, scene::Document& document,
                              std::vector<std::string>& warnings) {
  if (!document.terrain)
    return Error{fmt::format("{}: the project has no site yet; import --dem or --trees first", file.string())};
  auto imported = exchange::import_obstacles(document, file);
  if (!imported) return imported.error();
  document = std::move(imported->document);
  for (const std::string& note : imported->notes) warnings.push_back(fmt::format("{}: {}", file.string(), note));
  fmt::print("{}: {} obstacle{}\n", file.string(), imported->count, imported->count == 1 ? "" : "s");
  return {};
}

}  // namespace

Result<void> import_into_project(const Options& options) {
  if (options.dem.empty() && options.inventory.empty() && options.obstacle.empty())
    return Error{"import needs --dem FILE, --trees FILE or --obstacle FILE"};
  std::error_code ec;
  std::optional<scene::ProjectFile> file;
  scene::Document document;
  document.trees = std::make_shared<const scene::Trees>();
  if (std::filesystem::exists(options.file, ec)) {
    auto opened = scene::ProjectFile::open(options.file);
    if (!opened) return opened.error();
    file = std::move(*opened);
    document = file->document();
    print_warnings(scene::lines(file->state()), options.quiet);
  }

  std::vector<std::string> warnings;
  if (!options.dem.empty())
    if (auto done = import_ground(options.dem, document, warnings); !done) return done;
  if (!options.inventory.empty()) {
    auto imported = exchange::import_trees(document, options.inventory);
    if (!imported) return imported.error();
    document = std::move(imported->document);
    warnings.insert(warnings.end(), imported->warnings.begin(), imported->warnings.end());
    fmt::print("{}: {}\n", options.inventory.string(),
               exchange::words(imported->tally, exchange::is_vector_file(options.inventory)));
  }
  if (!options.obstacle.empty())
    if (auto done = import_obstacles(options.obstacle, document, warnings); !done) return done;
  print_warnings(warnings, options.quiet, kImportWarnings);

  if (file) {
    if (auto done = file->save(document); !done) return done;
  } else if (auto written = scene::write_project(document, options.file); !written) {
    return written.error();
  }
  const Vec2 size = document.terrain->size_m();
  fmt::print("{}: site {:g} x {:g} m, {}; grow it with: bosquet make {} -o OUT.glb\n", options.file.string(), size.x,
             size.y, count_of(document.trees->size(), "tree"), shell_word(options.file.string()));
  return {};
}

}  // namespace bosquet::cli
