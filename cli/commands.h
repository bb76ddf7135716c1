// Commands: what each word of the command line does.
//
// Errors    come back as values; main() prints them and chooses the exit status
#pragma once

#include "cli/options.h"
#include "core/result.h"

namespace bosquet::cli {

/// `bosquet make`: recipe -> every output asked for, by its ending.
Result<void> run_make(const Options& options);
/// `bosquet render`: recipe -> one picture.
Result<void> run_render(const Options& options);
/// `bosquet info`: what is in a glTF file or a recipe, on stdout.
Result<void> run_info(const Options& options);
/// `bosquet import`: ground and trees into a recipe file.
Result<void> run_import(const Options& options);
/// The same into a project (.bosquet), obstacles too.
Result<void> import_into_project(const Options& options);
/// `bosquet` and `bosquet ui`: the window.
Result<void> run_ui(const Options& options);
/// `bosquet recover list`: what sessions left that ended without saving, on stdout.
Result<void> run_recover_list(const Options& options);
/// `bosquet recover NAME -o FILE`: saves one of them as a project.
Result<void> run_recover(const Options& options);
/// `bosquet stats`: pattern statistics of bases and crown centroids, on stdout.
Result<void> run_stats(const Options& options);
/// `bosquet species list | show NAME`.
Result<void> run_species(const Options& options);
/// `bosquet species calibrate`: free-standing trees beside what their species files say.
Result<void> run_calibrate(const Options& options);
/// `bosquet species gallery`: a sheet of species at three ages, with and without leaves.
Result<void> run_gallery(const Options& options);

}  // namespace bosquet::cli
