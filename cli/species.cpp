#include "scene/species.h"

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/gallery.h"
#include "cli/progress_display.h"
#include "cli/species_source.h"
#include "core/parallel.h"
#include "exchange/file_output.h"
#include "exchange/image_file.h"

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
  auto source = species_source(options.species);
  if (!source) return source.error();
  fmt::print("{}", source->text);
  return {};
}

Result<void> run_gallery(const Options& options) {
  const std::filesystem::path& target = options.outputs.front();
  if (target.extension() != ".png" && target.extension() != ".jpg")
    return Error{fmt::format("{}: unknown kind of picture '{}'; known: .png .jpg", target.string(),
                             target.extension().string())};
  // What cannot be written is told before anything is drawn.
  if (auto writable = exchange::FileOutput::create(target); !writable) return writable.error();

  std::vector<scene::Species> species;
  for (const std::string& name : options.names.empty() ? scene::builtin_species_names() : options.names) {
    auto source = species_source(name);
    if (!source) return source.error();
    species.push_back(std::move(source->species));
  }
  GalleryOptions how;
  how.ages = options.ages;
  how.season = options.season;
  how.detail = options.grow.detail;
  how.seed = options.seed.value_or(how.seed);
  how.width = options.width, how.height = options.height;

  Progress progress;
  Result<Image> sheet = Error{};
  {
    ProgressDisplay display(progress, options.quiet);
    run_with_threads(options.threads, [&] { sheet = draw_gallery(species, how, &progress); });
  }
  if (!sheet) return sheet.error();
  if (auto written = exchange::write_image(target, *sheet); !written) return written;
  if (!options.quiet)
    fmt::print("{}  {} x {} pixels, {} species\n", target.string(), sheet->width, sheet->height, species.size());
  return {};
}

}  // namespace bosquet::cli
