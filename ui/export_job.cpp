#include "ui/export_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/letters.h"
#include "exchange/plan_drawing.h"
#include "exchange/recipe_write.h"
#include "exchange/schedule.h"
#include "exchange/texture_cache.h"
#include "exchange/vector_writer.h"

namespace bosquet::ui {
namespace {

// A triangle's share of vertices and indices as files store them, measured on the examples; images of a species.
constexpr double kBytesPerTriangle = 66, kPackedBytesPerTriangle = 14, kImageBytesPerSpecies = 1.6e6;

constexpr std::array<ExportKindInfo, kExportKinds> kKinds{{
    {"3D scene (glTF)", ".glb", ""},
    {"Plan sheet, picture (PNG)", ".plan.png", "Crowns to scale, key of the species, scale bar and north arrow."},
    {"Plan sheet, drawing (SVG)", ".svg", "The plan sheet as lines that stay sharp, for layout programs."},
    {"Plan sheet, CAD (DXF)", ".dxf", "The plan sheet for CAD programs, on layers."},
    {"Planting schedule (CSV)", ".csv", "Every tree with its species, place and sizes, for spreadsheets."},
    {"Species list (CSV)", ".species.csv", "How many of each species, by status and size."},
    {"Tree map (GeoPackage)", ".gpkg", "The trees as points for GIS, in the site's reference system."},
    {"Tree map (GeoJSON)", ".geojson", "The trees as points for maps on the web."},
    {"Recipe (TOML)", ".toml", "The whole site as a text to read and change, with its rasters beside it."},
}};

bool ends(const std::filesystem::path& path, std::string_view ending) {
  return folded_letters(path.filename().string()).ends_with(ending);
}

}  // namespace

const ExportKindInfo& export_kind(ExportKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::string bytes_words(std::uint64_t bytes) {
  const auto number = static_cast<double>(bytes);
  if (bytes >= 100'000'000) return fmt::format("{:.0f} MB", number / 1e6);
  if (bytes >= 1'000'000) return fmt::format("{:.1f} MB", number / 1e6);
  return fmt::format("{:.0f} kB", std::max(1.0, number / 1e3));
}

Result<std::uint64_t> write_sheet(const scene::GrownScene& scene, const std::string& name,
                                  const std::filesystem::path& target) {
  const bool drawing = ends(target, ".svg"), cad = ends(target, ".dxf");
  if (drawing || cad || ends(target, ".plan.png")) {
    auto plan = exchange::draw_plan(scene, name);
    if (!plan) return Error{fmt::format("{}: {}", target.string(), plan.error().message)};
    return drawing ? exchange::write_plan_svg(*plan, target)
           : cad   ? exchange::write_plan_dxf(*plan, target)
                   : exchange::write_plan_png(*plan, target);
  }
  if (ends(target, ".toml")) {
    auto written = exchange::write_recipe(scene.given, target);
    if (!written) return written.error();
    return written->bytes;
  }
  const std::vector<exchange::TreeRecord> records = exchange::tree_records(scene);
  if (ends(target, ".species.csv")) return exchange::write_summary(target, exchange::summarise(records));
  if (ends(target, ".csv")) return exchange::write_schedule(target, records);
  if (exchange::writes_trees(target)) {
    auto written =
        exchange::write_trees(target, records, scene.document.place, DVec2(scene.document.terrain->size_m()));
    if (!written) return written.error();
    return written->bytes;
  }
  return Error{target.string() + ": ends in nothing that the window can write"};
}

void ExportProbe::ask(std::uint64_t of, ExportKind kind, const std::function<scene::GrownScene()>& scene,
                      const std::string& name) {
  if (of == asked_ || coming_.valid()) return;
  asked_ = of;
  words_.clear();
  coming_ = std::async(std::launch::async, [kind, name, grown = scene()]() -> std::string {
    std::error_code ec;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path(ec) / fmt::format("bosquet-size-{}", ::getpid());
    std::filesystem::create_directories(folder, ec);
    auto written = write_sheet(grown, name, folder / ("out" + std::string(export_kind(kind).ending)));
    std::filesystem::remove_all(folder, ec);
    return written ? fmt::format("About {}", bytes_words(*written)) : written.error().message;
  });
}

const std::string& ExportProbe::words() {
  if (coming_.valid() && coming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) words_ = coming_.get();
  return words_;
}

exchange::GltfOptions gltf_options(const ExportSettings& settings) {
  exchange::GltfOptions options;
  if (settings.preset == ExportPreset::engines) options.lod = exchange::LodFiles::nodes;
  if (settings.preset == ExportPreset::web) {
    options.instancing = true;
    options.compression = exchange::Compression::meshopt;
    options.max_glb_bytes = 0x7fff'ffffu;
  }
  return options;
}

ExportSize estimate(const scene::GrownScene& scene, const ExportSettings& settings) {
  ExportSize size;
  std::vector<bool> used(scene.document.species.size(), false);
  std::size_t i = 0;
  for (const scene::Tree& tree : *scene.document.trees) {
    const scene::GrownTree& grown = scene.trees[i++];
    if (!grown.skeleton) continue;
    used[tree.species] = true;
    const scene::Species& species = scene.document.species_of(tree);
    size.triangles +=
        geometry::estimate_triangles(*grown.skeleton, grown.skeleton->radius, species.look, species.foliage, {});
  }
  if (settings.max_triangles > 0)
    size.triangles = std::min(size.triangles, static_cast<std::uint64_t>(settings.max_triangles));
  const double each = settings.preset == ExportPreset::web ? kPackedBytesPerTriangle : kBytesPerTriangle;
  const auto species = static_cast<double>(std::count(used.begin(), used.end(), true));
  size.bytes = static_cast<std::uint64_t>(each * static_cast<double>(size.triangles) + kImageBytesPerSpecies * species);
  return size;
}

ExportJob::~ExportJob() {
  cancel();
  if (done_.valid()) done_.wait();
}

void ExportJob::start(scene::GrownScene scene, const std::string& name, const ExportSettings& settings,
                      std::filesystem::path target) {
  if (running()) return;
  progress_ = std::make_unique<Progress>();
  progress_->begin("meshes", 0);
  done_ = std::async(std::launch::async,
                     [scene = std::move(scene), name, settings, target = std::move(target),
                      progress = progress_.get()]() -> std::string {
                       if (!ends(target, ".glb") && !ends(target, ".gltf")) {
                         auto written = write_sheet(scene, name, target);
                         if (!written) return written.error().message;
                         return fmt::format("Exported {}: {}", target.filename().string(), bytes_words(*written));
                       }
                       scene::ModelOptions model;
                       model.max_triangles = static_cast<std::size_t>(std::max(0, settings.max_triangles));
                       auto built = scene::build_model(scene, model, progress);
                       if (!built) return built.error().message;
                       const exchange::TextureCache cache = exchange::TextureCache::of_user();
                       exchange::GltfOptions options = gltf_options(settings);
                       options.version = "bosquet";
                       options.textures = &cache;
                       options.progress = progress;
                       auto written = exchange::write_gltf(built->model, target, options);
                       if (!written) return written.error().message;
                       return fmt::format("Exported {}: {:.1f} MB, {} triangles", target.filename().string(),
                                          static_cast<double>(written->bytes) / 1e6, built->triangles);
                     });
}

float ExportJob::share() const {
  if (!progress_ || progress_->total() == 0) return 0.0f;
  return static_cast<float>(progress_->done()) / static_cast<float>(progress_->total());
}

void ExportJob::cancel() {
  if (progress_) progress_->cancel();
}

std::optional<std::string> ExportJob::finished() {
  if (!done_.valid() || done_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  return done_.get();
}

}  // namespace bosquet::ui
