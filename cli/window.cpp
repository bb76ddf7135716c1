#include <cstdlib>

#include "cli/commands.h"
#ifdef BOSQUET_WITH_WINDOW
#include "ui/run.h"
#endif

namespace bosquet::cli {

#ifdef BOSQUET_WITH_WINDOW

Result<void> run_ui(const Options& options) {
  ui::RunOptions run;
  run.file = options.file;
  run.script = options.script;
  run.screenshot = options.screenshot;
  run.report = options.report;
  run.state = options.window_state;
  run.scale = options.window_scale;
  if (options.window_size_given) run.size = {options.width, options.height};
  run.threads = options.threads;
  return ui::run_window(run);
}

#else

Result<void> run_ui(const Options&) {
  return Error{
      "this build has no window; grow a recipe with: bosquet make RECIPE.toml -o OUT.glb (bosquet --help lists all)"};
}

#endif

}  // namespace bosquet::cli
