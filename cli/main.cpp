// The bosquet command: the only place that turns errors into an exit status.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands.h"
#include "core/heap.h"

namespace {

using namespace bosquet;

Result<void> run(const cli::Options& options) {
  switch (options.command) {
    case cli::Command::make:
      return cli::run_make(options);
    case cli::Command::render:
      return cli::run_render(options);
    case cli::Command::info:
      return cli::run_info(options);
    case cli::Command::import_data:
      return cli::run_import(options);
    case cli::Command::recover_list:
      return cli::run_recover_list(options);
    case cli::Command::recover:
      return cli::run_recover(options);
    case cli::Command::stats:
      return cli::run_stats(options);
    case cli::Command::species_list:
    case cli::Command::species_show:
      return cli::run_species(options);
    case cli::Command::species_calibrate:
      return cli::run_calibrate(options);
    case cli::Command::species_gallery:
      return cli::run_gallery(options);
    case cli::Command::none:
    case cli::Command::ui:
      break;
  }
  return cli::run_ui(options);
}

}  // namespace

int main(int argc, char** argv) {
  bosquet::keep_freed_memory();
  // A file size limit must come back as an error of write(), not end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const cli::ParsedLine line = cli::parse_command_line(argc, argv);
    if (line.exit_status) return *line.exit_status;
    const Result<void> done = run(line.options);
    if (done) return 0;
    fmt::print(stderr, "bosquet: {}\n", done.error().message);
    return done.error().kind == ErrorKind::input ? 1 : 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "bosquet: out of memory; ask for fewer trees, larger voxels (voxel_m) or fewer triangles\n");
  } catch (const std::exception& e) {
    fmt::print(stderr, "bosquet: unexpected failure: {}\n", e.what());
  }
  return 2;
}
