// Scene files: what of a grown scene is neither a model nor a picture, written by the file's ending.
//
// Format    .plan.png .svg .dxf plan sheets; .csv every tree, .species.csv their sums; .gpkg .geojson .shp trees on a map;
//           .vdb crown regions; .toml the recipe with its rasters; NAME.tree.json one tree as it has grown
// Who       the command and the window's export, alike
// Errors    those of the writers; an ending that is none of these
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/grown_scene.h"

namespace bosquet::exchange {

/// The ending that tells what a file is, in lower case: ".csv", and two parts where they mean something of their own
/// (".plan.png", ".species.csv", ".tree.json").
std::string telling_ending(const std::filesystem::path& file);

/// Whether write_scene_file() knows the ending.
bool writes_scene_file(const std::filesystem::path& file);

struct SceneFileOptions {
  std::string title;                 ///< of plan sheets
  std::optional<std::int32_t> tree;  ///< that a .tree.json holds
};

struct WrittenSceneFile {
  std::uint64_t bytes = 0;  ///< of all files that belong to it
  std::vector<std::string> warnings;
};

Result<WrittenSceneFile> write_scene_file(const scene::GrownScene& scene, const SceneFileOptions& options,
                                          const std::filesystem::path& target);

}  // namespace bosquet::exchange
