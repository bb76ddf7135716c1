#include "cli/grown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "exchange/recipe.h"

namespace bosquet::cli {
namespace {

constexpr std::size_t kShownWarnings = 12;

}  // namespace

Result<scene::GrownScene> grow_recipe(const Options& options, Report& report, Progress& progress) {
  auto recipe = exchange::read_recipe(options.file, options.seed);
  if (!recipe) return recipe.error();
  auto built = exchange::build_document(*recipe, &progress);
  if (!built) return built.error();
  report.seed = built->document.seed;
  report.seconds = built->seconds;
  report.warnings = built->warnings;

  auto grown = scene::grow_scene(built->document, options.grow, &progress);
  if (!grown) return grown.error();
  report.trees = grown->trees.size();
  report.internodes = grown->internodes();
  report.voxels = grown->space.claimed_voxels();
  report.skeleton_digest = grown->skeleton_digest();
  report.seconds.insert(grown->seconds.begin(), grown->seconds.end());
  report.warnings.insert(report.warnings.end(), grown->warnings.begin(), grown->warnings.end());
  return grown;
}

void print_warnings(const std::vector<std::string>& warnings, bool quiet) {
  if (quiet) return;
  for (std::size_t i = 0; i < std::min(kShownWarnings, warnings.size()); ++i)
    fmt::print(stderr, "warning: {}\n", warnings[i]);
  if (warnings.size() > kShownWarnings)
    fmt::print(stderr, "warning: and {} more; --report FILE.json lists all\n", warnings.size() - kShownWarnings);
}

}  // namespace bosquet::cli
