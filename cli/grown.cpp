#include "cli/grown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/picture.h"
#include "core/stopwatch.h"
#include "exchange/file_output.h"
#include "exchange/inventory.h"
#include "exchange/recipe.h"
#include "scene/clearance.h"
#include "scene/project_file.h"

namespace bosquet::cli {
namespace {

// What is read is never replaced by what is made from it.
Result<void> refuse_overwriting(const std::vector<std::filesystem::path>& inputs, const Options& options) {
  std::vector<std::filesystem::path> targets = options.outputs;
  targets.push_back(options.report);
  for (const auto& target : targets)
    for (const auto& input : inputs) {
      std::error_code ec;
      if (!target.empty() && !input.empty() && std::filesystem::equivalent(target, input, ec))
        return Error{fmt::format("{}: this file is read; write to another name", target.string())};
    }
  return {};
}

Result<void> refuse_overwriting(const exchange::Recipe& recipe, const Options& options) {
  std::vector<std::filesystem::path> inputs = recipe.ground.files();
  inputs.push_back(recipe.file);
  for (const exchange::PlantingRecipe& planting : recipe.plantings) inputs.push_back(planting.file);
  for (const exchange::ObstacleRecipe& obstacle : recipe.obstacles) inputs.push_back(obstacle.file);
  for (const exchange::HeroRecipe& hero : recipe.heroes) inputs.push_back(hero.file);
  return refuse_overwriting(inputs, options);
}

// A project, with all that opening it found.
Result<scene::Document> load_project(const Options& options, Report& report) {
  if (auto fine = refuse_overwriting(std::vector<std::filesystem::path>{options.file}, options); !fine)
    return fine.error();
  const Stopwatch watch;
  auto project = scene::read_project(options.file);
  if (!project) return project.error();
  for (const std::string& line : scene::lines(project->state))
    report.warnings.push_back(fmt::format("{}: {}", options.file.string(), line));
  if (options.seed) project->document.seed = *options.seed;
  report.seconds["terrain"] = watch.seconds();
  report.seconds["distribution"] = 0;
  return std::move(project->document);
}

}  // namespace

Result<scene::Document> load_document(const Options& options, Report& report, Progress& progress) {
  const std::string ending = exchange::lower_ending(options.file);
  scene::Document document;
  if (ending == ".bosquet") {
    auto project = load_project(options, report);
    if (!project) return project.error();
    document = std::move(*project);
  } else if (ending == ".toml") {
    auto recipe = exchange::read_recipe(options.file, options.seed);
    if (!recipe) return recipe.error();
    if (auto fine = refuse_overwriting(*recipe, options); !fine) return fine.error();
    auto built = exchange::build_document(*recipe, &progress);
    if (!built) return built.error();
    document = std::move(built->document);
    report.seconds = built->seconds;
    report.warnings = built->warnings;
  } else {
    return Error{fmt::format("{}: is no recipe (.toml) and no project (.bosquet){}", options.file.string(),
                             import_hint(options.file))};
  }
  report.seed = document.seed;
  return document;
}

std::string import_hint(const std::filesystem::path& file) {
  const std::string ending = exchange::lower_ending(file);
  const bool raster = ending == ".tif" || ending == ".tiff" || ending == ".asc" || ending == ".vrt";
  if (!raster && ending != ".csv" && !exchange::is_vector_file(file)) return "";
  return fmt::format("; one is made of it by: bosquet import NAME.toml {} {}", raster ? "--dem" : "--trees",
                     shell_word(file.string()));
}

Result<scene::GrownScene> grow_recipe(const Options& options, bool only_meshes, Report& report, Progress& progress) {
  auto document = load_document(options, report, progress);
  if (!document) return document.error();
  if (auto fine = check_picture_options(*document, options); !fine) return fine.error();
  for (const auto& breach : scene::clearance_breaches(*document, document->clearance))
    report.warnings.push_back(scene::words(breach, *document));

  scene::GrowOptions how = options.grow;
  how.only_meshes = only_meshes;
  auto grown = scene::grow_scene(*document, how, &progress);
  if (!grown) return grown.error();
  report.trees = grown->trees.size();
  report.removed = grown->given.trees->size() - grown->document.trees->size();
  report.internodes = grown->internodes();
  report.voxels = grown->claimed_voxels;
  report.skeleton_digest = grown->skeleton_digest;
  report.seconds.insert(grown->seconds.begin(), grown->seconds.end());
  report.warnings.insert(report.warnings.end(), grown->warnings.begin(), grown->warnings.end());
  return grown;
}

void print_warnings(const std::vector<std::string>& warnings, bool quiet, std::size_t most) {
  if (quiet) return;
  for (std::size_t i = 0; i < std::min(most, warnings.size()); ++i) fmt::print(stderr, "warning: {}\n", warnings[i]);
  if (warnings.size() > most)
    fmt::print(stderr, "warning: and {} more; make with --report FILE.json lists all\n", warnings.size() - most);
}

std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c >= 0x80 ||
           std::string_view("_./-+,:@%=").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace bosquet::cli
