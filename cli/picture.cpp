#include "cli/picture.h"

#include <fmt/format.h>

#include "exchange/image_file.h"
#include "geometry/human_figure.h"
#include "render/framing.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "render/sun_position.h"
#include "scene/figures.h"
#include "scene/grass.h"
#include "scene/view_models.h"

namespace bosquet::cli {
namespace {

// Height of the world that a plan shows, with a little margin round the site and its overhanging crowns.
constexpr float kPlanMargin = 1.06f;

bool from_above(ViewKind view) {
  return view == ViewKind::plan || view == ViewKind::arrows || view == ViewKind::regions;
}

render::View plan_view(const scene::Model& model, const Options& options) {
  const Box3 box = render::bounds(model);
  const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  render::View view;
  const Vec3 centre = box.centre();
  view.camera.target = centre;
  // North must be up in the picture: looking almost straight down from very slightly south of the centre.
  view.camera.eye = centre + Vec3(0.0f, 1000.0f, 0.01f);
  view.orthographic_height_m = kPlanMargin * std::max(box.size().z, box.size().x / aspect);
  view.shading = render::Shading::flat;
  view.sky = false;
  return view;
}

// The document's figures and those that are asked for.
std::vector<scene::Figure> wanted_figures(const scene::Document& document, const Options& options) {
  std::vector<scene::Figure> figures(document.figures.begin(), document.figures.end());
  for (const Vec2 at : options.figures) figures.push_back({at, geometry::kFigureHeading_deg});
  return figures;
}

Result<scene::Sun> chosen_sun(const scene::Document& document, const Options& options) {
  return render::sun_from_text(options.sun, {document.place.latitude_deg, document.place.longitude_deg, {}});
}

bool shows_grass(const scene::Model& model, const scene::Node& node) {
  return !node.parts.empty() && model.materials[node.parts.front().material].surface == scene::Surface::grass;
}

// What stands on the ground, a box for each node; everything where nothing stands.
std::vector<Box3> what_stands(const scene::Model& model) {
  std::vector<Box3> boxes;
  for (const scene::Node& node : model.nodes) {
    Box3 box;
    for (const scene::Part& part : node.parts) {
      const scene::Surface surface = model.materials[part.material].surface;
      if (!part.mesh || part.mesh->empty() || surface == scene::Surface::ground || surface == scene::Surface::water ||
          surface == scene::Surface::grass)
        continue;
      const Box3 own = part.mesh->bounds();
      box.add(own.low + node.translation), box.add(own.high + node.translation);
    }
    if (!box.empty()) boxes.push_back(box);
  }
  if (boxes.empty()) boxes.push_back(render::bounds(model));
  return boxes;
}

// From the south, low enough that trees stand before each other and some sky is left.
scene::Camera usual_camera(const scene::Model& model, const Options& options) {
  constexpr float kElevation_deg = 16.0f;
  if (options.set_camera && *options.set_camera) return **options.set_camera;
  const scene::Camera camera = render::frame(
      what_stands(model), static_cast<float>(options.width) / static_cast<float>(options.height), kElevation_deg);
  if (options.set_camera) *options.set_camera = camera;
  return camera;
}

}  // namespace

std::optional<scene::Camera> picture_camera(const scene::Document& document, const Options& options) {
  scene::Model cameras;
  cameras.cameras = document.cameras;
  if (!options.camera.empty())
    if (auto camera = render::camera_from_text(options.camera, cameras)) return *camera;
  if (!document.cameras.empty()) return document.cameras.front();
  return {};
}

Result<void> check_picture_options(const scene::Document& document, const Options& options) {
  scene::Model cameras;
  cameras.cameras = document.cameras;
  if (!options.camera.empty())
    if (auto camera = render::camera_from_text(options.camera, cameras); !camera) return camera.error();
  if (!options.sun.empty())
    if (auto sun = chosen_sun(document, options); !sun) return sun.error();
  const Vec2 size = document.terrain->size_m();
  for (const Vec2 at : options.figures)
    if (at.x < 0.0f || at.y < 0.0f || at.x > size.x || at.y > size.y)
      return Error{fmt::format("--figure {:g},{:g}: lies outside the site, which is {:g} m east by {:g} m north", at.x,
                               at.y, size.x, size.y)};
  return {};
}

Result<void> write_picture(const scene::BuiltModel& built, const scene::GrownScene& grown, const Options& options,
                           const std::filesystem::path& target) {
  const scene::Model& model = built.model;
  const scene::Document& document = grown.document;
  const bool plan = options.command == Command::render && from_above(options.view);
  render::View view;
  if (plan) {
    view = plan_view(model, options);
  } else if (!options.camera.empty()) {
    auto camera = render::camera_from_text(options.camera, model);
    if (!camera) return camera.error();
    view.camera = *camera;
  } else if (!model.cameras.empty()) {
    view.camera = model.cameras.front();
  } else {
    view.camera = usual_camera(model, options);
  }
  view.width = options.width;
  view.height = options.height;
  if (!options.sun.empty()) {
    auto sun = chosen_sun(document, options);
    if (!sun) return sun.error();
    view.sun = *sun;
  }

  auto context = render::HeadlessContext::create();
  if (!context) return context.error();
  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();
  scene::Model drawn = model;
  scene::add_figures(drawn, wanted_figures(document, options), *document.terrain);
  // The renderer has grass of its own.
  std::erase_if(drawn.nodes, [&](const scene::Node& node) { return shows_grass(drawn, node); });
  if (auto uploaded = renderer->upload(drawn); !uploaded) return uploaded;
  if (options.view == ViewKind::trees && !plan) {
    const scene::GrassSite grass(document, scene::grass_options(grown, options.season, built.ground_triangles));
    view.grass_reach = scene::grass_reach(view.camera, view.height);
    renderer->set_grass_season(options.season);
    std::uint64_t key = 0;
    for (const scene::GrassPatch& patch : scene::grass_before(grass, view.camera, view.grass_reach))
      renderer->put_grass(++key, patch);
  }
  auto image = renderer->draw(view);
  if (!image) return image.error();
  return exchange::write_image(target, *image);
}

Result<scene::Model> view_model(const scene::GrownScene& grown, const Options& options) {
  switch (options.view) {
    case ViewKind::shapes:
      return scene::shapes_model(grown);
    case ViewKind::regions:
      return scene::regions_model(grown, options.slice_m);
    case ViewKind::arrows:
      return scene::arrows_model(grown);
    default:
      return scene::plan_model(grown);
  }
}

}  // namespace bosquet::cli
