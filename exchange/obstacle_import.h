// Obstacle import: what a file holds becomes obstacles of a document that has a site.
//
// Model     a mesh (.glb, .gltf, .obj; exchange/mesh_file.h) is one obstacle with its origin on the ground at the site's
//           south-west corner, named as the file; every other file gives building outlines (exchange/footprints.h) that
//           are extruded from the ground, those of unknown height to kUsualHeight_m
// Place     outlines may tell where on the earth a site lies that did not know
// Units     metres
// Errors    those of the readers and of scene::add_obstacle(), with the file's name; no outline on the site
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::exchange {

inline constexpr float kUsualHeight_m = 8.0f;

struct ImportedObstacles {
  scene::Document document;
  std::size_t count = 0;           ///< at least 1
  std::vector<std::string> notes;  ///< about the file, without its name
};

Result<ImportedObstacles> import_obstacles(const scene::Document& document, const std::filesystem::path& file);

}  // namespace bosquet::exchange
