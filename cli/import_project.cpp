// Import into a project: ground, trees and obstacles become parts of its document.
#include <fmt/format.h>

#include <filesystem>

#include "cli/commands.h"
#include "cli/grown.h"
#include "exchange/elevation.h"
#include "exchange/footprints.h"
#include "exchange/mesh_file.h"
#include "exchange/tree_import.h"
#include "scene/project_file.h"
#include "scene/site_edits.h"

namespace bosquet::cli {
namespace {

// The ground of a raster: the site's extent where there is none yet, else resampled to the site.
Result<void> import_ground(const std::filesystem::path& file, scene::Document& document,
                           std::vector<std::string>& warnings) {
  auto raster = exchange::read_elevation(file);
  if (!raster) return raster.error();
  const bool fresh = !document.terrain;
  const DVec2 corner = fresh ? raster->low_corner() : document.place.south_west;
  auto lattice = fresh ? terrain::make_lattice(Vec2(raster->high_corner() - raster->low_corner()))
                       : Result<terrain::Lattice>(document.terrain->height.lattice());
  if (!lattice) return Error{fmt::format("{}: {}", file.string(), lattice.error().message)};
  auto heights = exchange::heights_at_corners(*raster, corner, lattice->cells.x, lattice->cells.y,
                                              static_cast<double>(lattice->cell_m), DVec2(lattice->size_m));
  if (!heights) return heights.error();
  auto field = terrain::Heightfield::from_samples(*lattice, *heights);
  if (!field) return field.error();
  if (raster->filled > 0)
    warnings.push_back(
        fmt::format("{}: {} cells without data were filled from their surroundings", file.string(), raster->filled));
  if (raster->reprojected) warnings.push_back(fmt::format("{}: reprojected to local metres", file.string()));
  if (fresh) {
    document.terrain = std::make_shared<const terrain::Terrain>(terrain::make_terrain(std::move(*field)));
    document.place.south_west = corner;
    document.place.crs_wkt = raster->crs_wkt;
  } else {
    terrain::Terrain ground = *document.terrain;
    ground.height = std::move(*field);
    document = scene::set_ground(document, std::move(ground), "Import ground").document;
  }
  fmt::print("{}: {} x {} cells of {:g} m\n", file.string(), raster->columns, raster->rows, raster->cell_x_m);
  return {};
}

// A mesh, its origin on the ground at the site's south-west corner, or outlines with heights.
Result<void> import_obstacles(const std::filesystem::path& file, scene::Document& document,
                              std::vector<std::string>& warnings) {
  if (!document.terrain)
    return Error{fmt::format("{}: the project has no site yet; import --dem or --trees first", file.string())};
  const auto add = [&](scene::Obstacle obstacle) -> Result<void> {
    auto edited = scene::add_obstacle(document, std::move(obstacle));
    if (!edited) return Error{fmt::format("{}: {}", file.string(), edited.error().message)};
    document = std::move(edited->document);
    return {};
  };
  const std::string ending = file.extension().string();
  std::size_t count = 0;
  if (ending == ".glb" || ending == ".gltf" || ending == ".obj") {
    auto mesh = exchange::read_mesh(file);
    if (!mesh) return mesh.error();
    const float ground = document.terrain->ground(Vec2(0.0f));
    for (Vec3& p : mesh->positions) p.y += ground;
    scene::Obstacle obstacle;
    obstacle.name = file.stem().string();
    obstacle.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
    if (auto done = add(std::move(obstacle)); !done) return done;
    count = 1;
  } else {
    auto outlines = exchange::read_footprints(file, document.place, DVec2(document.terrain->size_m()));
    if (!outlines) return outlines.error();
    for (const std::string& note : outlines->notes) warnings.push_back(fmt::format("{}: {}", file.string(), note));
    constexpr float kUsualHeight_m = 8.0f;
    for (exchange::Footprint& f : outlines->all) {
      if (auto done = add(scene::extruded(std::move(f.name), std::move(f.outline), f.height_m.value_or(kUsualHeight_m),
                                          *document.terrain));
          !done)
        return done;
      ++count;
    }
  }
  fmt::print("{}: {} obstacle{}\n", file.string(), count, count == 1 ? "" : "s");
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
    fmt::print("{}: {} trees\n", options.inventory.string(), imported->trees);
  }
  if (!options.obstacle.empty())
    if (auto done = import_obstacles(options.obstacle, document, warnings); !done) return done;
  print_warnings(warnings, options.quiet);

  if (file) {
    if (auto done = file->save(document); !done) return done;
  } else if (auto written = scene::write_project(document, options.file); !written) {
    return written.error();
  }
  const Vec2 size = document.terrain->size_m();
  fmt::print("{}: site {:g} x {:g} m, {} trees; grow it with: bosquet make {} -o OUT.glb\n", options.file.string(),
             size.x, size.y, document.trees->size(), options.file.string());
  return {};
}

}  // namespace bosquet::cli
