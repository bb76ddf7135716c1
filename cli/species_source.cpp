#include "cli/species_source.h"

#include "exchange/file_output.h"

namespace bosquet::cli {
namespace {

constexpr std::uint64_t kLongestSpeciesFile = std::uint64_t{1} << 20;

}  // namespace

Result<SpeciesSource> species_source(const std::string& name) {
  if (!name.ends_with(".toml")) {
    auto species = scene::builtin_species(name);
    if (!species) return species.error();
    return SpeciesSource{std::move(*species), std::string(scene::builtin_species_text(name))};
  }
  auto species = scene::read_species_file(name);
  if (!species) return species.error();
  auto bytes = exchange::read_file(name, kLongestSpeciesFile);
  if (!bytes) return bytes.error();
  return SpeciesSource{std::move(*species), std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())};
}

}  // namespace bosquet::cli
