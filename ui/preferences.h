// Preferences: what a person chose for the window, kept from one session to the next.
//
// File      window.json in the user's state folder ($XDG_STATE_HOME/bosquet, else ~/.local/state/bosquet)
// Decision  a file that is missing, broken or says something unknown is as good as none: whatever of it can be understood
//           holds, the rest is as usual. One that cannot be written is left as it was; nobody is bothered
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ui/widgets/units.h"

namespace bosquet::ui {

inline constexpr std::size_t kMostRecent = 12;

struct Preferences {
  Units units = Units::metres;
  bool dark = true;
  std::vector<std::filesystem::path> recent;  ///< files opened, the newest first, at most kMostRecent

  bool operator==(const Preferences&) const = default;
};

/// Puts a file first in the list of recent ones; whole path.
void note_recent(Preferences& preferences, const std::filesystem::path& file);

Preferences preferences_of(std::string_view text);
std::string preferences_text(const Preferences& preferences);

/// Where a file of this name lies among what the user's windows remember.
std::filesystem::path state_path(std::string_view name);

Preferences read_preferences(const std::filesystem::path& file);
void write_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace bosquet::ui
