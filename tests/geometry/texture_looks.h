// The looks of the built-in species, read from the [look] table of their files for tests.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "geometry/look.h"

namespace bosquet::geometry {

/// Takes each described field from a flat table of texts; a field without a text keeps its default.
struct TextTable {
  std::map<std::string, std::string, std::less<>> texts;

  void operator()(const Real& info, float& value) {
    if (const std::string text = take(info.name); !text.empty()) value = std::strtof(text.c_str(), nullptr);
  }
  void operator()(const Whole& info, int& value) {
    if (const std::string text = take(info.name); !text.empty()) value = std::atoi(text.c_str());
  }
  void operator()(const Switch& info, bool& value) {
    if (const std::string text = take(info.name); !text.empty()) value = text == "true";
  }
  void operator()(const Colour& info, Vec3& value) {
    const std::string text = take(info.name);
    if (!text.empty()) value = srgb(static_cast<unsigned>(std::strtoul(text.c_str(), nullptr, 16)));
  }
  template <class Enum>
  void operator()(const Choice& info, Enum& value) {
    const std::string text = take(info.name);
    for (std::size_t i = 0; i < info.names.size(); ++i) {
      if (info.names[i] == text) value = static_cast<Enum>(i);
    }
  }

  std::string take(std::string_view name) {
    const auto found = texts.find(name);
    if (found == texts.end()) return {};
    std::string text = found->second;
    texts.erase(found);
    return text;
  }
};

/// The look of scene/species/NAME.toml; throws when the table has a key that no field takes.
inline Look species_look(const std::string& name) {
  std::ifstream file(std::string(BOSQUET_SOURCE_DIR) + "/scene/species/" + name + ".toml");
  TextTable table;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("[")) inside = line == "[look]";
    const std::size_t equals = line.find(" = ");
    if (!inside || equals == std::string::npos) continue;
    std::string text = line.substr(equals + 3);
    std::erase(text, '"');
    table.texts[line.substr(0, equals)] = text;
  }
  Look look;
  describe(look, table);
  if (!table.texts.empty()) throw std::runtime_error(name + ": unknown key " + table.texts.begin()->first);
  return look;
}

}  // namespace bosquet::geometry
