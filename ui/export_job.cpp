#include "ui/export_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "exchange/image_file.h"
#include "exchange/texture_cache.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "scene/figures.h"
#include "scene/grass.h"
#include "scene/view_models.h"

namespace bosquet::ui {
namespace {

// A triangle's share of vertices and indices as files store them, measured on the examples; images of a species.
constexpr double kBytesPerTriangle = 66, kPackedBytesPerTriangle = 14, kWindBytesPerTriangle = 6,
                 kImageBytesPerSpecies = 1.6e6;

// A photograph-like picture of leaves packs badly: what PNG takes of a pixel in the examples' pictures, 1.2 (much sky and
// lawn, many pixels) to 2.2 (leaves all over).
constexpr double kPictureBytesPerPixel = 1.6;

constexpr std::array<ExportKindInfo, kExportKinds> kKinds{{
    {"3D scene (glTF)", ".glb", ""},
    {"Picture (PNG)", ".png", "What the window shows now, drawn with care."},
    {"Plan sheet, picture (PNG)", ".plan.png", "Crowns to scale, key of the species, scale bar and north arrow."},
    {"Plan sheet, drawing (SVG)", ".svg", "The plan sheet as lines that stay sharp, for layout programs."},
    {"Plan sheet, CAD (DXF)", ".dxf", "The plan sheet for CAD programs, on layers."},
    {"Planting schedule (CSV)", ".csv", "Every tree with its species, place and sizes, for spreadsheets."},
    {"Species list (CSV)", ".species.csv", "How many of each species, by status and size."},
    {"Tree map (GeoPackage)", ".gpkg", "The trees as points for GIS, in the site's reference system."},
    {"Tree map (Shapefile)", ".shp", "The trees as points for older GIS; several files, names of columns cut short."},
    {"Tree map (GeoJSON)", ".geojson", "The trees as points for maps on the web."},
    {"Crown regions (OpenVDB)", ".vdb", "Which tree owns which part of the air, as voxels for film tools."},
    {"One tree (.tree.json)", ".tree.json", "The selected tree exactly as it stands, to be a hero tree elsewhere."},
    {"Recipe (TOML)", ".toml", "The whole site as a text to read and change, with its rasters beside it."},
}};

}  // namespace

bool is_picture(const std::filesystem::path& target) { return exchange::telling_ending(target) == ".png"; }

const ExportKindInfo& export_kind(ExportKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::string bytes_words(std::uint64_t bytes) {
  const auto number = static_cast<double>(bytes);
  if (bytes >= 100'000'000) return fmt::format("{:.0f} MB", number / 1e6);
  if (bytes >= 1'000'000) return fmt::format("{:.1f} MB", number / 1e6);
  return fmt::format("{:.0f} kB", std::max(1.0, number / 1e3));
}

void ExportProbe::ask(std::uint64_t of, ExportKind kind, const std::function<scene::GrownScene()>& scene,
                      const exchange::SceneFileOptions& options) {
  if (of == asked_ || coming_.valid()) return;
  asked_ = of;
  words_.clear();
  coming_ = std::async(std::launch::async, [kind, options, grown = scene()]() -> std::string {
    std::error_code ec;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path(ec) / fmt::format("bosquet-size-{}", ::getpid());
    std::filesystem::create_directories(folder, ec);
    auto written = exchange::write_scene_file(grown, options, folder / ("out" + std::string(export_kind(kind).ending)));
    std::filesystem::remove_all(folder, ec);
    return written ? fmt::format("About {}", bytes_words(written->bytes)) : written.error().message;
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

std::uint64_t picture_bytes(IVec2 size) {
  return static_cast<std::uint64_t>(kPictureBytesPerPixel * static_cast<double>(size.x) * static_cast<double>(size.y));
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
  if (scene.document.ground_cover.in_files) {
    const scene::GrassSite grass(scene.document, {});
    size.triangles += scene::grass_triangles(
        grass, scene.document.cameras,
        static_cast<std::size_t>(scene::kGrassShare * static_cast<float>(std::max(0, settings.max_triangles))));
  }
  if (settings.max_triangles > 0)
    size.triangles = std::min(size.triangles, static_cast<std::uint64_t>(settings.max_triangles));
  double each = settings.preset == ExportPreset::web ? kPackedBytesPerTriangle : kBytesPerTriangle;
  if (settings.preset == ExportPreset::engines) each += kWindBytesPerTriangle;
  const auto species = static_cast<double>(std::count(used.begin(), used.end(), true));
  size.bytes = static_cast<std::uint64_t>(each * static_cast<double>(size.triangles) + kImageBytesPerSpecies * species);
  return size;
}

ExportJob::~ExportJob() {
  cancel();
  if (done_.valid()) done_.wait();
}

namespace {

Result<std::string> write_model(const scene::Model& model, std::size_t triangles, const ExportSettings& settings,
                                const std::filesystem::path& target, Progress* progress) {
  const exchange::TextureCache cache = exchange::TextureCache::of_user();
  exchange::GltfOptions options = gltf_options(settings);
  options.version = "bosquet";
  options.textures = &cache;
  options.progress = progress;
  auto written = exchange::write_gltf(model, target, options);
  if (!written) return written.error();
  return fmt::format("Exported {}: {:.1f} MB, {} triangles", target.filename().string(),
                     static_cast<double>(written->bytes) / 1e6, triangles);
}

/// `grass`: what grows before the camera.
Result<std::string> write_picture(const scene::Model& model, const render::View& view,
                                  const std::vector<scene::GrassPatch>& grass, const std::filesystem::path& target,
                                  Progress* progress) {
  progress->begin("picture", 1);
  auto context = render::HeadlessContext::create();
  if (!context) return context.error();
  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();
  if (auto uploaded = renderer->upload(model); !uploaded) return uploaded.error();
  renderer->set_grass_season(geometry::Season::summer);
  std::uint64_t key = 0;
  for (const scene::GrassPatch& patch : grass) renderer->put_grass(++key, patch);
  auto image = renderer->draw(view);
  if (!image) return image.error();
  if (auto written = exchange::write_image(target, *image); !written) return written.error();
  std::error_code ec;
  return fmt::format("Exported {}: {} x {} pixels, {}", target.filename().string(), view.width, view.height,
                     bytes_words(std::filesystem::file_size(target, ec)));
}

// What the window shows in place of the trees.
Result<scene::Model> shown_model(const ExportOrder& order) {
  switch (order.show) {
    case Show::shapes:
      return scene::shapes_model(order.scene);
    case Show::regions:
      return scene::regions_model(order.scene, order.slice_m);
    case Show::arrows:
      return scene::arrows_model(order.scene);
    default:
      return scene::plan_model(order.scene);
  }
}

Result<std::string> write_export(const ExportOrder& order, Progress* progress) {
  const std::filesystem::path& target = order.target;
  if (exchange::writes_scene_file(target)) {
    auto written = exchange::write_scene_file(order.scene, order.options, target);
    if (!written) return written.error();
    std::string words = fmt::format("Exported {}: {}", target.filename().string(), bytes_words(written->bytes));
    for (const std::string& warning : written->warnings) words += "\n" + warning;
    return words;
  }
  const bool picture = is_picture(target);
  const std::string ending = exchange::telling_ending(target);
  if (!picture && ending != ".glb" && ending != ".gltf")
    return Error{target.string() + ": ends in nothing that the window can write"};
  if (picture && order.show != Show::trees) {
    auto model = shown_model(order);
    return model ? write_picture(*model, order.view, {}, target, progress) : model.error();
  }
  scene::ModelOptions options;
  options.max_triangles = static_cast<std::size_t>(std::max(0, order.settings.max_triangles));
  const scene::PaintingCache paintings(exchange::TextureCache::of_user().folder());
  options.paintings = &paintings;
  if (picture) options.picture = order.view.camera, options.picture_height = order.view.height;
  options.grass = !picture && order.scene.document.ground_cover.in_files;
  options.wind = !picture && order.settings.preset == ExportPreset::engines;
  auto built = scene::build_model(order.scene, options, progress);
  if (!built) return built.error();
  if (!picture) return write_model(built->model, built->triangles, order.settings, target, progress);
  const auto& figures = order.scene.document.figures;
  scene::add_figures(built->model, {figures.begin(), figures.end()}, *order.scene.document.terrain);
  render::View view = order.view;
  view.grass_reach = scene::grass_reach(view.camera, view.height);
  const scene::GrassSite grass(order.scene.document,
                               scene::grass_options(order.scene, options.season, built->ground_triangles));
  return write_picture(built->model, view, scene::grass_before(grass, view.camera, view.grass_reach), target, progress);
}

}  // namespace

void ExportJob::start(ExportOrder order) {
  if (running()) return;
  progress_ = std::make_unique<Progress>();
  progress_->begin("meshes", 0);
  done_ = std::async(std::launch::async, [order = std::move(order), progress = progress_.get()]() -> std::string {
    auto written = write_export(order, progress);
    return written ? *written : written.error().message;
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
