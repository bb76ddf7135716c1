// Command words: what is wrong with a command line, in words that name the nearest right ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace bosquet::cli {

/// The first word of `words` (those behind the program's name, in order) that `app`, having parsed them, had no use for:
/// a command or option that is not there, with the nearest that is, or a word too many; or the command that is missing
/// behind the last. Nothing when the mistake is another.
std::optional<std::string> wrong_word(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace bosquet::cli
