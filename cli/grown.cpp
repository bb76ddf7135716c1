#include "cli/grown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/picture.h"
#include "exchange/recipe.h"
#include "scene/clearance.h"

namespace bosquet::cli {
namespace {

constexpr std::size_t kShownWarnings = 12;

// A recipe's own files are never replaced by what is made from it.
Result<void> refuse_overwriting(const exchange::Recipe& recipe, const Options& options) {
  std::vector<std::filesystem::path> inputs{recipe.file, recipe.ground.dem};
  for (const exchange::PlantingRecipe& planting : recipe.plantings) inputs.push_back(planting.file);
  for (const exchange::ObstacleRecipe& obstacle : recipe.obstacles) inputs.push_back(obstacle.file);
  for (const exchange::HeroRecipe& hero : recipe.heroes) inputs.push_back(hero.file);
  std::vector<std::filesystem::path> targets = options.outputs;
  targets.push_back(options.report);
  for (const auto& target : targets)
    for (const auto& input : inputs) {
      std::error_code ec;
      if (!target.empty() && !input.empty() && std::filesystem::equivalent(target, input, ec))
        return Error{fmt::format("{}: the recipe reads this file; write to another name", target.string())};
    }
  return {};
}

}  // namespace

Result<scene::GrownScene> grow_recipe(const Options& options, Report& report, Progress& progress) {
  if (options.file.extension() != ".toml")
    return Error{fmt::format("{}: is no recipe, a .toml file", options.file.string())};
  auto recipe = exchange::read_recipe(options.file, options.seed);
  if (!recipe) return recipe.error();
  if (auto fine = refuse_overwriting(*recipe, options); !fine) return fine.error();
  auto built = exchange::build_document(*recipe, &progress);
  if (!built) return built.error();
  if (auto fine = check_picture_options(built->document, options); !fine) return fine.error();
  report.seed = built->document.seed;
  report.seconds = built->seconds;
  report.warnings = built->warnings;
  for (const auto& breach : scene::clearance_breaches(built->document, built->document.clearance))
    report.warnings.push_back(scene::words(breach, built->document));

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
