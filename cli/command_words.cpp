#include "cli/command_words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "scene/toml_table.h"

namespace bosquet::cli {
namespace {

// The command that was given, inmost.
const CLI::App& given(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : given(*commands.front());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
    for (const std::string& alias : command->get_aliases()) names.push_back(alias);
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string suggestion(const std::string& near) {
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

}  // namespace

std::optional<std::string> wrong_word(const CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<std::string> left = app.remaining(true);
  const auto found = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(left.begin(), left.end(), word) != left.end();
  });
  const CLI::App& command = given(app);
  const bool inmost = &command != &app;
  const std::string where = inmost ? fmt::format("'{}'", command.get_name()) : "bosquet";
  const std::vector<std::string> commands = command_names(command);
  if (found == words.end()) {
    if (!inmost || commands.empty()) return {};
    return fmt::format("{} needs one of: {}", where, fmt::join(commands, ", "));
  }
  if (found->size() > 1 && found->front() == '-') {
    const std::string name = found->substr(0, found->find('='));
    return fmt::format("{} has no option {}{}", where, name,
                       name.size() > 2 ? suggestion(scene::nearest_name(name, option_names(command))) : "");
  }
  if (commands.empty())
    return fmt::format("'{}' is a word too many for {}; a name with spaces needs quotes", *found, where);
  const std::vector<std::string> options = option_names(command);
  if (const std::string option = "--" + *found; std::find(options.begin(), options.end(), option) != options.end())
    return fmt::format("'{}' is an option: {}", *found, option);
  const std::string near = scene::nearest_name(*found, commands);
  if (near.empty() && !inmost && (found->ends_with(".toml") || found->ends_with(".bosquet")))
    return fmt::format("there is no command '{}'; to see a file in the window: bosquet ui {}", *found, *found);
  return fmt::format("{} no command '{}'{}", inmost ? where + " has" : "there is", *found,
                     near.empty() ? fmt::format("; known: {}", fmt::join(commands, ", ")) : suggestion(near));
}

}  // namespace bosquet::cli
