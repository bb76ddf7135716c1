// Options: what the command line asked for, as plain values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "exchange/gltf_writer.h"
#include "geometry/season.h"
#include "geometry/tree_mesh.h"
#include "scene/grown_scene.h"
#include "scene/model.h"

namespace bosquet::cli {

enum class Command {
  none,
  make,
  render,
  info,
  import_data,
  ui,
  recover_list,
  recover,
  stats,
  species_list,
  species_show,
  species_calibrate,
  species_gallery
};

enum class ViewKind { trees, shapes, regions, arrows, plan };

struct Options {
  Command command = Command::none;
  std::filesystem::path file;
  std::vector<std::filesystem::path> outputs;
  bool replace = false;  ///< projects, recipes and species files among the outputs may be lost
  std::string species;
  std::vector<std::string> names;  ///< of species, or .toml files of them

  // Scene.
  scene::GrowOptions grow;
  std::vector<float> years;  ///< one: that of `grow`; several: make writes its outputs for each
  geometry::Season season = geometry::Season::summer;
  geometry::FoliageLevel foliage = geometry::FoliageLevel::clusters;
  std::optional<std::size_t> max_triangles;
  bool instancing = false, wind = false;
  exchange::Compression compression = exchange::Compression::none;
  exchange::LodFiles lod = exchange::LodFiles::none;
  std::optional<std::int32_t> tree;  ///< id of the one that a .tree.json gets

  // Picture.
  ViewKind view = ViewKind::trees;
  std::optional<float> slice_m;
  std::string camera, sun;
  std::vector<Vec2> figures;  ///< people for scale, plan
  int width = 1600, height = 900;
  /// Pictures of a set share the camera that the first of them found, where neither recipe nor user gives one.
  std::shared_ptr<std::optional<scene::Camera>> set_camera;

  // Import.
  std::filesystem::path dem, inventory, obstacle;

  std::string recovery;  ///< name of what is recovered

  // Window.
  std::filesystem::path script, screenshot, window_state;
  float window_scale = 0;          ///< 0: the screen's
  bool window_size_given = false;  ///< else the window chooses its own

  // Calibration and gallery.
  std::vector<float> ages;
  int calibration_trees = 20;
  bool quick = false;

  // Common.
  int threads = 0;
  std::optional<std::uint64_t> seed;
  std::filesystem::path report;
  bool quiet = false, json = false;
  bool check = false;  ///< info: judge the file
};

/// What parsing led to: options to act on, or an exit status when everything is said (help, version, an error).
struct ParsedLine {
  Options options;
  std::optional<int> exit_status;
};

/// Parses the command line; prints help, version and usage errors itself.
ParsedLine parse_command_line(int argc, char** argv);

}  // namespace bosquet::cli
