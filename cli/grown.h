// Grown: the way from a recipe or project to a document and a grown scene that several commands share.
#pragma once

#include "cli/options.h"
#include "cli/report.h"
#include "core/progress.h"
#include "scene/grown_scene.h"

namespace bosquet::cli {

/// The document of a recipe (.toml), which is planted, or of a project (.bosquet); fills the report as far as it goes.
Result<scene::Document> load_document(const Options& options, Report& report, Progress& progress);

/// For messages about a file that is somebody's survey: how a recipe is made of it; empty for other files.
std::string import_hint(const std::filesystem::path& file);

/// Loads the document and grows it; `only_meshes` as in GrowOptions.
Result<scene::GrownScene> grow_recipe(const Options& options, bool only_meshes, Report& report, Progress& progress);

inline constexpr std::size_t kShownWarnings = 12, kImportWarnings = 100;

/// Prints warnings on stderr unless quiet; longer lists than `most` are cut, the report has them all.
void print_warnings(const std::vector<std::string>& warnings, bool quiet, std::size_t most = kShownWarnings);

/// A word as a shell takes it, in quotes where it needs them.
std::string shell_word(const std::string& word);

}  // namespace bosquet::cli
