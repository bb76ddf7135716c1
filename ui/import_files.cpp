#include "ui/import_files.h"

#include <fmt/format.h>

#include "exchange/elevation.h"
#include "exchange/footprints.h"
#include "exchange/mesh_file.h"
#include "exchange/tree_import.h"
#include "scene/site_edits.h"

namespace bosquet::ui {
namespace {

constexpr float kUsualHeight_m = 8.0f;

Result<scene::Edited> import_ground(const scene::Document& document, const std::filesystem::path& file) {
  auto raster = exchange::read_elevation(file);
  if (!raster) return raster.error();
  const terrain::Lattice& lattice = document.terrain->height.lattice();
  // A raster that says nothing of where it lies begins at the site's corner.
  const DVec2 corner = raster->georeferenced ? document.place.south_west : raster->low_corner();
  auto heights = exchange::heights_at_corners(*raster, corner, lattice.cells.x, lattice.cells.y,
                                              static_cast<double>(lattice.cell_m), DVec2(lattice.size_m));
  if (!heights) return heights.error();
  auto field = terrain::Heightfield::from_samples(lattice, *heights);
  if (!field) return field.error();
  terrain::Terrain ground = *document.terrain;
  ground.height = std::move(*field);
  scene::Edited edit = scene::set_ground(document, std::move(ground), "Import ground");
  if (raster->filled > 0)
    edit.notes.push_back(fmt::format("{} cells without data were filled from their surroundings", raster->filled));
  return edit;
}

Result<scene::Edited> import_trees(const scene::Document& document, const std::filesystem::path& file) {
  auto imported = exchange::import_trees(document, file);
  if (!imported) return imported.error();
  scene::Edited edit;
  edit.document = std::move(imported->document);
  edit.name = "Import " + scene::trees_in_words(imported->trees);
  edit.notes = std::move(imported->warnings);
  edit.displaced = scene::displaced_trees(edit.document);
  return edit;
}

Result<scene::Edited> import_buildings(const scene::Document& document, const std::filesystem::path& file) {
  scene::Edited edit;
  edit.document = document;
  std::size_t count = 0;
  const auto add = [&](scene::Obstacle obstacle) -> Result<void> {
    auto added = scene::add_obstacle(edit.document, std::move(obstacle));
    if (!added) return Error{fmt::format("{}: {}", file.string(), added.error().message)};
    edit.document = std::move(added->document);
    ++count;
    return {};
  };
  const std::string ending = file.extension().string();
  if (ending == ".glb" || ending == ".gltf" || ending == ".obj") {
    auto mesh = exchange::read_mesh(file);
    if (!mesh) return mesh.error();
    const float ground = document.terrain->ground(Vec2(0.0f));
    for (Vec3& p : mesh->positions) p.y += ground;
    scene::Obstacle obstacle;
    obstacle.name = file.stem().string();
    obstacle.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
    if (auto done = add(std::move(obstacle)); !done) return done.error();
  } else {
    auto outlines = exchange::read_footprints(file, document.place, DVec2(document.terrain->size_m()));
    if (!outlines) return outlines.error();
    edit.notes = std::move(outlines->notes);
    for (exchange::Footprint& f : outlines->all)
      if (auto done = add(scene::extruded(std::move(f.name), std::move(f.outline), f.height_m.value_or(kUsualHeight_m),
                                          *document.terrain));
          !done)
        return done.error();
  }
  if (count == 0) return Error{fmt::format("{}: holds no outline on this site", file.string())};
  edit.name = count == 1 ? "Import a building" : fmt::format("Import {} buildings", count);
  edit.displaced = scene::displaced_trees(edit.document);
  return edit;
}

}  // namespace

std::vector<std::string> import_endings(ImportKind kind) {
  switch (kind) {
    case ImportKind::ground:
      return {".tif", ".tiff", ".asc", ".png", ".hgt", ".vrt"};
    case ImportKind::trees:
      return {".csv", ".geojson", ".gpkg", ".shp", ".dxf"};
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
    case ImportKind::buildings:
      break;
  }
  return import_buildings(document, file);
}

}  // namespace bosquet::ui
