#include "ui/preferences.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "exchange/file_output.h"
#include "scene/recovery.h"

namespace bosquet::ui {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLargestFile = 1 << 20;

// What an object says under a name, if it is such a thing.
template <class T>
T said(const Json& json, const char* name, T usual) {
  const auto found = json.find(name);
  if (found == json.end()) return usual;
  if constexpr (std::is_same_v<T, bool>) {
    return found->is_boolean() ? found->template get<bool>() : usual;
  } else {
    return found->is_string() ? found->template get<std::string>() : usual;
  }
}

}  // namespace

void note_recent(Preferences& preferences, const std::filesystem::path& file) {
  std::error_code ec;
  const std::filesystem::path whole = std::filesystem::absolute(file, ec).lexically_normal();
  std::erase(preferences.recent, whole);
  preferences.recent.insert(preferences.recent.begin(), whole);
  preferences.recent.resize(std::min(preferences.recent.size(), kMostRecent));
}

Preferences preferences_of(std::string_view text) {
  Preferences preferences;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return preferences;
  if (said<std::string>(json, "units", "metres") == "feet") preferences.units = Units::feet;
  preferences.dark = said(json, "dark", preferences.dark);
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& file : *recent)
      if (file.is_string() && preferences.recent.size() < kMostRecent)
        preferences.recent.emplace_back(file.get<std::string>());
  return preferences;
}

std::string preferences_text(const Preferences& preferences) {
  Json json;
  json["units"] = preferences.units == Units::feet ? "feet" : "metres";
  json["dark"] = preferences.dark;
  json["recent"] = Json::array();
  for (const std::filesystem::path& file : preferences.recent) json["recent"].push_back(file.string());
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::filesystem::path state_path(std::string_view name) { return scene::recovery_folder().parent_path() / name; }

Preferences read_preferences(const std::filesystem::path& file) {
  const auto bytes = exchange::read_file(file, kLargestFile);
  if (!bytes) return {};
  return preferences_of({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

void write_preferences(const Preferences& preferences, const std::filesystem::path& file) {
  std::error_code ec;
  std::filesystem::create_directories(file.parent_path(), ec);
  (void)exchange::write_file(file, preferences_text(preferences));
}

}  // namespace bosquet::ui
