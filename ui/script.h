// Script: a recorded session, replayed event by event in the window or without one.
//
// Format    a line each, times in seconds since the line before; # begins a comment:
//             wait S | settle [S]         some seconds, or until nothing grows and is drawn (at most S, 60)
//             move X Y | press [B] | release [B] | click X Y [B] | drag X Y X2 Y2 [B] | scroll N
//             key NAME | type TEXT        NAME as printed (A, 7, [, Enter, Escape, Delete, Ctrl+Z, Ctrl+Shift+S, F1)
//             tool NAME | radius M        as the toolbar names them
//             camera E N H TE TN TH       eye and target as east, north, height
//             ground E N                  the pointer to where a ground point is seen
//             open FILE | save FILE | year N | plan | trees
//             screenshot FILE.png         of the whole window
//             expect trees N | expect undo NAME | expect unsaved yes|no
//           X and Y in pixels of the window; B left, middle or right
// Errors    file, line and what is allowed; an expectation that is not met ends the script with an error
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace bosquet::ui {

struct ScriptLine {
  int number = 0;
  std::vector<std::string> words;
};

struct Script {
  std::filesystem::path file;
  std::vector<ScriptLine> lines;
};

/// Reads and checks a script: every command known, with its words and numbers.
Result<Script> read_script(const std::filesystem::path& file);
Result<Script> parse_script(std::string_view text, const std::filesystem::path& file);

}  // namespace bosquet::ui
