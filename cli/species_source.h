// Species source: a species as the user names it, built in or a file of their own.
#pragma once

#include <string>

#include "core/result.h"
#include "scene/species.h"

namespace bosquet::cli {

struct SpeciesSource {
  scene::Species species;
  std::string text;  ///< of its file
};

/// A name that ends in .toml is a file's, any other a built-in species'.
Result<SpeciesSource> species_source(const std::string& name);

}  // namespace bosquet::cli
