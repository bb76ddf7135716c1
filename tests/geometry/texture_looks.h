// The looks of the built-in species, as their files give them.
#pragma once

#include <stdexcept>
#include <string>

#include "geometry/look.h"
#include "scene/species.h"

namespace bosquet::geometry {

/// The look of a built-in species; throws when there is none of that name or its file is wrong.
inline Look species_look(const std::string& name) {
  auto species = scene::builtin_species(name);
  if (!species) throw std::runtime_error(species.error().message);
  return species->look;
}

}  // namespace bosquet::geometry
