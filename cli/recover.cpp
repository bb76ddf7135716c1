#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/grown.h"
#include "cli/replacing.h"
#include "exchange/file_output.h"
#include "scene/project_file.h"
#include "scene/recovery.h"

namespace bosquet::cli {
namespace {

std::string edits_words(std::uint64_t n) { return count_of(n, "edit"); }

// A session that opened a recipe, or nothing, has no project yet.
std::string project_words(const scene::Recovery& r) {
  if (r.project.empty()) return "a document that was never saved";
  if (exchange::lower_ending(r.project) == ".bosquet") return r.project.string();
  return fmt::format("the recipe {}", r.project.string());
}

}  // namespace

Result<void> run_recover_list(const Options&) {
  const std::vector<scene::Recovery> all = scene::list_recoveries();
  if (all.empty()) fmt::print("nothing to recover in {}\n", scene::recovery_folder().string());
  for (const scene::Recovery& r : all)
    fmt::print("{}  {}, {}, of {}{}\n", r.name, scene::time_words(r.time), edits_words(r.edits), project_words(r),
               r.in_use ? "; a session has it open" : "");
  return {};
}

Result<void> run_recover(const Options& options) {
  const std::vector<scene::Recovery> all = scene::list_recoveries();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& r) { return r.name == options.recovery; });
  if (found == all.end())
    return Error{fmt::format("there is nothing named '{}' to recover; 'bosquet recover list' lists what there is",
                             options.recovery)};
  if (found->in_use) return Error{fmt::format("'{}' belongs to a session that is still open", found->name)};
  const std::filesystem::path& target = options.outputs.front();
  if (target.extension() != ".bosquet")
    return Error{fmt::format("{}: a recovered document is saved as a project, a .bosquet file", target.string())};
  if (auto fine = check_replacing(target, {}, options.replace); !fine) return fine;
  auto recovered = scene::recover(*found);
  if (!recovered) return recovered.error();
  if (auto written = scene::write_project(recovered->document, target); !written) return written.error();
  print_warnings(scene::lines(recovered->state), options.quiet);
  // It is safe under its new name, unless a part was lost.
  if (!recovered->state.damaged) scene::discard(*found);
  fmt::print("{}: {}, as of {}, with {}\n", target.string(), count_of(recovered->document.trees->size(), "tree"),
             scene::time_words(found->time), edits_words(found->edits));
  return {};
}

}  // namespace bosquet::cli
