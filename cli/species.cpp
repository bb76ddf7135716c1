#include "scene/species.h"

#include <fmt/format.h>

#include "cli/commands.h"

namespace bosquet::cli {
namespace {

Result<void> list() {
  fmt::print("{:<18} {:<22} {:>9} {:>9} {:>9}\n", "name", "botanical name", "height m", "crown m", "trunk cm");
  for (const std::string& name : scene::builtin_species_names()) {
    auto species = scene::builtin_species(name);
    if (!species) return species.error();
    fmt::print("{:<18} {:<22} {:>9.1f} {:>9.1f} {:>9.0f}\n", name, species->botanical_name,
               species->shape.mature_height_m, species->shape.crown_width_m, 100.0f * species->shape.trunk_width_m);
  }
  return {};
}

}  // namespace

Result<void> run_species(const Options& options) {
  if (options.command == Command::species_list) return list();
  if (auto species = scene::builtin_species(options.species); !species) return species.error();
  fmt::print("{}", scene::builtin_species_text(options.species));
  return {};
}

}  // namespace bosquet::cli
