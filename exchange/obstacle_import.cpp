#include "exchange/obstacle_import.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/letters.h"
#include "exchange/footprints.h"
#include "exchange/mesh_file.h"
#include "scene/site_edits.h"

namespace bosquet::exchange {

Result<ImportedObstacles> import_obstacles(const scene::Document& document, const std::filesystem::path& file) {
  ImportedObstacles made;
  made.document = document;
  const auto add = [&](scene::Obstacle obstacle) -> Result<void> {
    auto added = scene::add_obstacle(made.document, std::move(obstacle));
    if (!added) return Error{fmt::format("{}: {}", file.string(), added.error().message)};
    made.document = std::move(added->document);
    ++made.count;
    return {};
  };
  const std::string ending = folded_letters(file.extension().string());
  if (ending == ".glb" || ending == ".gltf" || ending == ".obj") {
    auto mesh = read_mesh(file);
    if (!mesh) return mesh.error();
    const float ground = document.terrain->ground(Vec2(0.0f));
    for (Vec3& p : mesh->positions) p.y += ground;
    scene::Obstacle obstacle;
    obstacle.name = file.stem().string();
    obstacle.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
    if (auto done = add(std::move(obstacle)); !done) return done.error();
    return made;
  }
  auto outlines = read_footprints(file, document.place, DVec2(document.terrain->size_m()));
  if (!outlines) return outlines.error();
  if (outlines->place) made.document.place = *outlines->place;
  made.notes = std::move(outlines->notes);
  for (Footprint& f : outlines->all)
    if (auto done = add(scene::extruded(std::move(f.name), std::move(f.outline), f.height_m.value_or(kUsualHeight_m),
                                        *document.terrain));
        !done)
      return done.error();
  if (made.count == 0) return Error{fmt::format("{}: holds no outline on this site", file.string())};
  return made;
}

}  // namespace bosquet::exchange
