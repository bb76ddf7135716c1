// Built-in species: the files of scene/species/ as texts in the program (made by CMake from builtin_species.cpp.in).
#pragma once

#include <span>
#include <string_view>

namespace bosquet::scene {

struct BuiltinFile {
  std::string_view name, text;
};

extern const std::span<const BuiltinFile> kBuiltinSpecies;

}  // namespace bosquet::scene
