// Report: what a run made and what it cost, as JSON for scripts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "scene/grown_scene.h"

namespace bosquet::cli {

struct Report {
  std::size_t removed = 0;  ///< trees that are not grown, for they are to be removed
  std::size_t trees = 0, internodes = 0, leaves = 0, voxels = 0, triangles = 0;
  std::vector<std::pair<std::string, std::uint64_t>> bytes;             ///< by output
  std::map<std::string, std::vector<std::string>> required_extensions;  ///< of glTF outputs that need any
  std::size_t mesh_bytes = 0;                                           ///< all meshes, in memory
  double program_mb = 0;                                                ///< peak_rss_mb() before any work
  int threads = 1;                                                      ///< that really worked
  std::uint64_t seed = 0;
  std::uint64_t skeleton_digest = 0;
  scene::Seconds seconds;
  std::vector<std::string> warnings;
};

/// "1 tree", "2 trees".
std::string count_of(std::uint64_t n, std::string_view thing);

/// Peak resident memory of this process in megabytes.
double peak_rss_mb();

Result<void> write_report(const std::filesystem::path& path, const Report& report);

}  // namespace bosquet::cli
