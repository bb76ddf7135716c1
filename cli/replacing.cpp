#include "cli/replacing.h"

#include <fmt/format.h>

#include "exchange/file_output.h"
#include "scene/project_file.h"

namespace bosquet::cli {
namespace {

using std::filesystem::path;

// What is there, in words.
std::string words_for(const path& target, const scene::ReadProject& project) {
  const std::size_t trees = project.document.trees->size();
  const std::string holds = fmt::format("is a project of {} tree{}", trees, trees == 1 ? "" : "s");
  if (project.state.damaged || project.state.edited_elsewhere)
    return holds + (project.state.damaged ? ", damaged" : " that another program edited");
  return project.made_from.empty()
             ? holds + " that was edited or saved by hand"
             : fmt::format("{} made from {}", holds, (target.parent_path() / project.made_from).string());
}

}  // namespace

std::string way_between(const path& target, const path& source) {
  std::error_code ec;
  const auto real = [&](const path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, ec), ec);
  };
  const path from = real(target).parent_path(), to = real(source);
  const path way = to.lexically_relative(from);
  return (way.empty() ? to : way).generic_string();
}

Result<void> check_replacing(const path& target, const path& source, bool replace) {
  const std::string ending = exchange::lower_ending(target);
  std::error_code ec;
  if (replace || (ending != ".bosquet" && ending != ".toml") || !std::filesystem::is_regular_file(target, ec) ||
      std::filesystem::file_size(target, ec) == 0)
    return {};
  std::string there = "is a recipe";
  if (ending == ".bosquet") {
    const auto old = scene::read_project(target);
    if (old && !source.empty() && old->made_from == way_between(target, source)) return {};
    there = old ? words_for(target, *old) : "is there already and is no project that can be read";
  }
  return Error{fmt::format("{}: {}, which would be lost; take another name, or say --replace", target.string(), there)};
}

}  // namespace bosquet::cli
