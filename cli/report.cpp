#include "cli/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "exchange/file_output.h"

namespace bosquet::cli {
namespace {

constexpr const char* kStages[] = {"terrain",  "distribution", "crowns", "light", "growth",
                                   "geometry", "textures",     "export", "total"};

}  // namespace

std::string count_of(std::uint64_t n, std::string_view thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Result<void> write_report(const std::filesystem::path& path, const Report& report) {
  nlohmann::ordered_json json;
  json["trees"] = report.trees;
  json["internodes"] = report.internodes;
  json["leaves"] = report.leaves;
  json["voxels"] = report.voxels;
  json["triangles"] = report.triangles;
  json["bytes"] = nlohmann::ordered_json::object();
  for (const auto& [output, bytes] : report.bytes) json["bytes"][output] = bytes;
  if (!report.required_extensions.empty()) json["required_extensions"] = report.required_extensions;
  json["threads"] = report.threads;
  json["seed"] = report.seed;
  json["peak_rss_mb"] = peak_rss_mb();
  json["program_mb"] = report.program_mb;
  json["mesh_mb"] = static_cast<double>(report.mesh_bytes) / (1024.0 * 1024.0);
  json["skeleton_digest"] = hex_digits(report.skeleton_digest);
  for (const char* stage : kStages) {
    const auto found = report.seconds.find(stage);
    json["seconds"][stage] = found == report.seconds.end() ? 0.0 : found->second;
  }
  json["warnings"] = report.warnings;
  auto written =
      exchange::write_file(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  if (!written) return written.error();
  return {};
}

}  // namespace bosquet::cli
